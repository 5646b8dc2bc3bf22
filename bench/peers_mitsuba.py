# SPDX-License-Identifier: Apache-2.0
"""Renders a scene that peers_scenes.py wrote with Mitsuba 3, in a process of its own (bench/peers starts it).

    peers_mitsuba.py VARIANT SAMPLER SCENE.json OUT.npy SPP SEED THREADS"""
import json
import sys

import drjit
import mitsuba as mi
import numpy as np

MOST_SAMPLES_A_PASS = 64  # a vectorised pass keeps every path in memory


def rgb(values):
    return {"type": "rgb", "value": list(values)}


def unbounded(values):
    """Values above 1, which "rgb" would not take for what is no radiance."""
    return {"type": "srgb", "color": mi.ScalarColor3f(*values), "unbounded": True}


def reflectance(material):
    if "rgb" in material:
        return rgb(material["rgb"])
    # Mitsuba's v = 0 is the uppermost row. Floats rather than half floats, as ours are kept.
    return {"type": "bitmap", "filename": material["picture"], "raw": material["raw"], "format": "variant",
            "to_uv": mi.ScalarTransform3f().scale([1, -1])}


def bsdf(material):
    if material["kind"] == "dielectric":
        return {"type": "roughdielectric", "distribution": "ggx", "alpha": material["alpha"],
                "int_ior": material["ior"], "ext_ior": 1.0}
    if material["kind"] == "conductor":
        inner = {"type": "roughconductor", "distribution": "ggx", "alpha": material["alpha"],
                 "eta": unbounded(material["eta"]), "k": unbounded(material["k"])}
    else:
        inner = {"type": "diffuse", "reflectance": reflectance(material)}
    return {"type": "twosided", "inner": inner}


def sensor(scene, sampler, samples):
    film = {"type": "hdrfilm", "width": scene["width"], "height": scene["height"], "rfilter": {"type": "box"},
            "pixel_format": "rgb", "component_format": "float32", "sample_border": False}
    return {"type": "perspective", "fov": scene["angle"], "fov_axis": "x", "film": film,
            "to_world": mi.ScalarTransform4f().look_at(scene["from"], scene["to"], [0, 1, 0]),
            "sampler": {"type": sampler, "sample_count": samples}}


def area_light(light):
    return {"type": "ply", "filename": light["file"], "face_normals": True,
            "bsdf": {"type": "diffuse", "reflectance": rgb([0, 0, 0])},
            "emitter": {"type": "area", "radiance": unbounded(light["radiance"])}}


def build(scene, sampler, samples):
    parts = {"type": "scene", "integrator": {"type": "path", "max_depth": scene["depth"]},
             "sensor": sensor(scene, sampler, samples), "light": area_light(scene["light"])}
    if "sky" in scene:
        parts["sky"] = {"type": "constant", "radiance": unbounded(scene["sky"])}
    for name, shape in scene["shapes"].items():
        parts["shape_" + name] = {"type": "ply", "filename": shape["file"], "face_normals": not shape["smooth"],
                                  "bsdf": bsdf(shape["material"])}
    return mi.load_dict(parts)


def main():
    variant, sampler, scene_file, out, spp, seed, threads = sys.argv[1:]
    spp, seed = int(spp), int(seed)
    mi.set_variant(variant)
    drjit.set_thread_count(int(threads))
    a_pass = spp if variant.startswith("scalar") else min(spp, MOST_SAMPLES_A_PASS)
    with open(scene_file) as file:
        scene = build(json.load(file), sampler, a_pass)
    total, done = 0, 0
    while done < spp:
        samples = min(a_pass, spp - done)
        total = total + samples * np.array(mi.render(scene, spp=samples, seed=seed * 100003 + done), dtype=np.float64)
        done += samples
    np.save(out, (total / spp).astype(np.float32))


main()
