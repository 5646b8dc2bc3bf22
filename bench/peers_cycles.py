# SPDX-License-Identifier: Apache-2.0
"""Renders a scene that peers_scenes.py wrote with Blender's Cycles, in a process of its own (bench/peers starts it).

    peers_cycles.py SCENE.json OUT.exr SPP SEED THREADS"""
import json
import os
import sys

import bpy
import mathutils
import numpy as np

import peers_scenes


def frame(x, y, z, origin):
    m = np.eye(4)
    m[:3, 0], m[:3, 1], m[:3, 2], m[:3, 3] = x, y, z, origin
    return mathutils.Matrix(m.tolist())


def add(name, data, where=None):
    thing = bpy.data.objects.new(name, data)
    if where is not None:
        thing.matrix_world = where
    bpy.context.scene.collection.objects.link(thing)
    return thing


def settings(scene, out, spp, seed, threads):
    """Everything that makes the picture another one, or a part of it better, is off."""
    render, cycles = bpy.context.scene.render, bpy.context.scene.cycles
    render.engine, cycles.device = "CYCLES", "CPU"
    render.threads_mode, render.threads = "FIXED", threads
    cycles.samples, cycles.seed = spp, seed
    cycles.use_adaptive_sampling = cycles.use_denoising = cycles.use_guiding = False
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0.0
    cycles.light_sampling_threshold = 0.0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    for kind in ("max", "diffuse", "glossy", "transmission"):
        setattr(cycles, kind + "_bounces", scene["depth"] - 2)  # Cycles counts direct light as no bounce
    render.resolution_x, render.resolution_y, render.resolution_percentage = scene["width"], scene["height"], 100
    bpy.context.scene.view_settings.view_transform = "Raw"
    image = render.image_settings
    image.file_format, image.color_mode, image.color_depth, image.exr_codec = "OPEN_EXR", "RGB", "32", "ZIP"
    render.filepath = out


def camera(scene):
    data = bpy.data.cameras.new("camera")
    data.sensor_fit, data.angle = "HORIZONTAL", float(np.radians(scene["angle"]))
    data.clip_start, data.clip_end = 0.01, 1000
    back = np.subtract(scene["from"], scene["to"])
    back = back / np.linalg.norm(back)
    right = np.cross((0, 1, 0), back)
    right /= np.linalg.norm(right)
    bpy.context.scene.camera = add("camera", data, frame(right, np.cross(back, right), back, scene["from"]))


def picture(nodes, material):
    node = nodes.new("ShaderNodeTexImage")
    node.image = bpy.data.images.load(material["picture"])
    node.image.colorspace_settings.name = "Non-Color" if material["raw"] else "sRGB"
    return node


def surface(nodes, links, material):
    """Its roughness is the root of GGX' alpha."""
    if material["kind"] == "diffuse":
        node = nodes.new("ShaderNodeBsdfDiffuse")
        node.inputs["Roughness"].default_value = 0
        if "picture" in material:
            links.new(picture(nodes, material).outputs["Color"], node.inputs["Color"])
        else:
            node.inputs["Color"].default_value = (*material["rgb"], 1)
        return node
    if material["kind"] == "conductor":
        node = nodes.new("ShaderNodeBsdfMetallic")
        node.fresnel_type = "PHYSICAL_CONDUCTOR"
        node.inputs["IOR"].default_value, node.inputs["Extinction"].default_value = material["eta"], material["k"]
    else:
        node = nodes.new("ShaderNodeBsdfGlass")
        node.inputs["Color"].default_value = (1, 1, 1, 1)
        node.inputs["IOR"].default_value = material["ior"]
    node.distribution = "GGX"
    node.inputs["Roughness"].default_value = material["alpha"] ** 0.5
    return node


def add_shape(name, shape):
    mesh = peers_scenes.read_ply(shape["file"])
    data, faces = bpy.data.meshes.new(name), mesh["faces"].astype(np.int32)
    data.vertices.add(len(mesh["points"]))
    data.vertices.foreach_set("co", mesh["points"].ravel())
    data.loops.add(faces.size)
    data.loops.foreach_set("vertex_index", faces.ravel())
    data.polygons.add(len(faces))
    data.polygons.foreach_set("loop_start", np.arange(0, faces.size, 3, dtype=np.int32))
    if "uv" in mesh:
        data.uv_layers.new(name="uv").data.foreach_set("uv", mesh["uv"][faces.ravel()].ravel())
    data.update(calc_edges=True)
    if "normals" in mesh:
        data.polygons.foreach_set("use_smooth", np.ones(len(faces), bool))
        data.normals_split_custom_set_from_vertices(mesh["normals"].tolist())
    else:
        data.shade_flat()
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    out = nodes.new("ShaderNodeOutputMaterial")
    links.new(surface(nodes, links, shape["material"]).outputs[0], out.inputs["Surface"])
    data.materials.append(material)
    add(name, data)


def add_light(light):
    """A lamp that sends along its own -z only, as ours do."""
    corners = np.array(light["corners"], float)
    x, y = corners[1] - corners[0], corners[0] - corners[3]
    width, height = np.linalg.norm(x), np.linalg.norm(y)
    top = max(light["radiance"])
    data = bpy.data.lights.new("light", "AREA")
    data.shape, data.size, data.size_y, data.spread = "RECTANGLE", width, height, np.pi
    data.color = [c / top for c in light["radiance"]]
    data.energy = top * width * height * np.pi  # watts
    data.cycles.use_multiple_importance_sampling = True
    x, y = x / width, y / height
    add("light", data, frame(x, y, np.cross(x, y), corners.mean(0))).visible_camera = True


def sky(radiance):
    world = bpy.data.worlds.new("sky")
    bpy.context.scene.world = world
    world.use_nodes = True
    node = world.node_tree.nodes.get("Background") or world.node_tree.nodes.new("ShaderNodeBackground")
    node.inputs["Color"].default_value = (*radiance, 1)
    node.inputs["Strength"].default_value = 1


def main():
    scene_file, out, spp, seed, threads = sys.argv[1:]
    with open(scene_file) as file:
        scene = json.load(file)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    settings(scene, out, int(spp), int(seed), int(threads))
    camera(scene)
    sky(scene.get("sky", (0, 0, 0)))
    add_light(scene["light"])
    for name, shape in scene["shapes"].items():
        add_shape(name, shape)
    bpy.ops.render.render(write_still=True)
    sys.stdout.flush()
    os._exit(0)  # Blender's own end may fail long after the picture is written


main()
