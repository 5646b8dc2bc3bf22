# SPDX-License-Identifier: Apache-2.0
"""The scenes of bench/peers for renderers that cannot read ours: `cornell` and `pieces` as in examples/, and `mesh`.

`write(name, folder)` leaves FOLDER/NAME.json, its meshes as PLY beside it and, for `mesh`, which is no example,
our own mesh.scene. The world is right-handed, so z is the negative of that in our scenes; v = 0 is a picture's
lowest row; corners of a quad go counter-clockwise seen from the side that its normal points to."""
import json
import os
import shutil

import numpy as np

ASSETS = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "examples", "assets")
UNIT_UV = ((0, 0), (1, 0), (1, 1), (0, 1))
TERRAIN_QUADS = 723  # along each side: 723 x 723 x 2 = 1,045,458 triangles

MESH_SCENE = """// SPDX-License-Identifier: Apache-2.0
// Written by bench/peers: a height field of 1,045,458 triangles under an area light and an even sky.
#ifndef (Depth) #declare Depth = 5; #end
#ifndef (Split) #declare Split = 1; #end
camera pinhole { location <0, 4.5, -8.5>  look_at <0, -0.3, -0.5>  angle 45 }
film { resolution <512, 384>  filter "box" }
integrator path { samples 64  depth Depth  split Split }
light environment { radiance rgb <0.3, 0.35, 0.45> }
light area { <-5, 7, 1>, <0, 0, -2>, <2, 0, 0>  radiance rgb <50, 45, 38> }
mesh { "mesh-ground.ply"  smooth false  brdf lambert { diffuse pigment image { "gravel.png"  color_space "srgb" } } }
"""


# ------------------------------------------------------------------ PLY

def _vertex_type(normals, uv):
    names = ["x", "y", "z"] + ["nx", "ny", "nz"] * normals + ["s", "t"] * uv
    return np.dtype([(name, "<f4") for name in names])


FACE_TYPE = np.dtype([("count", "u1"), ("corners", "<i4", 3)])


def write_ply(path, mesh):
    """Binary; under another name first, so that a file which is there is whole."""
    columns = [mesh["points"]] + [mesh[k] for k in ("normals", "uv") if k in mesh]
    vertices = np.ascontiguousarray(np.concatenate(columns, 1), "<f4")
    faces = np.empty(len(mesh["faces"]), FACE_TYPE)
    faces["count"], faces["corners"] = 3, mesh["faces"]
    names = _vertex_type("normals" in mesh, "uv" in mesh).names
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(vertices)}",
              *(f"property float {name}" for name in names), f"element face {len(faces)}",
              "property list uchar int vertex_indices", "end_header", ""]
    with open(path + ".part", "wb") as file:
        file.write("\n".join(header).encode())
        vertices.tofile(file)
        faces.tofile(file)
    os.replace(path + ".part", path)


def read_ply(path):
    """A mesh that write_ply() wrote."""
    with open(path, "rb") as file:
        header = []
        while not header or header[-1] != "end_header":
            header.append(file.readline().decode().strip())
        counts = [int(line.split()[2]) for line in header if line.startswith("element")]
        kind = _vertex_type("property float nx" in header, "property float s" in header)
        vertices = np.fromfile(file, kind, counts[0])
        faces = np.fromfile(file, FACE_TYPE, counts[1])

    def columns(*names):
        return np.stack([vertices[name] for name in names], 1)
    mesh = {"points": columns("x", "y", "z"), "faces": faces["corners"].copy()}
    if "nx" in kind.names:
        mesh["normals"] = columns("nx", "ny", "nz")
    if "s" in kind.names:
        mesh["uv"] = columns("s", "t")
    return mesh


def has_normals(path):
    with open(path, "rb") as file:
        return b"property float nx" in file.read(400)


# ------------------------------------------------------------------ meshes

def quads(*all_corners, uv=UNIT_UV):
    n = len(all_corners)
    first = 4 * np.arange(n)[:, None, None]
    return {"points": np.array(all_corners, float).reshape(-1, 3), "uv": np.tile(np.array(uv, float), (n, 1)),
            "faces": (first + np.array([[0, 1, 2], [0, 2, 3]])).reshape(-1, 3)}


def grid_faces(rows, columns):
    """Two triangles for each cell of a grid of rows x columns points."""
    at = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:]
    return np.concatenate([np.stack(t, -1).reshape(-1, 3) for t in ((a, b, c), (a, c, d))])


def turned(points, normals):
    """A surface of revolution round y from its profile, both of shape (n, 2): radius and height."""
    turn = np.linspace(0, 2 * np.pi, 513)
    round_y = np.stack([np.sin(turn), np.cos(turn)], -1)

    def spin(profile):
        radius, height = np.asarray(profile, float).T
        xz = radius[:, None, None] * round_y
        return np.stack([xz[..., 0], np.broadcast_to(height[:, None], xz.shape[:2]), xz[..., 1]], -1).reshape(-1, 3)
    faces, where = grid_faces(len(points), len(turn)), spin(points)
    a, b, c = (where[faces[:, i]] for i in range(3))
    has_area = np.linalg.norm(np.cross(b - a, c - a), axis=1) > 1e-12  # none at a pole
    return {"points": where, "normals": spin(normals), "faces": faces[has_area]}


def joined(*meshes):
    first = np.cumsum([0] + [len(m["points"]) for m in meshes])
    whole = {k: np.concatenate([m[k] for m in meshes]) for k in ("points", "normals")}
    return whole | {"faces": np.concatenate([m["faces"] + n for m, n in zip(meshes, first)])}


def flat_ball(centre):
    a = np.linspace(0, np.pi, 257)
    radii = np.array([0.9, 0.54])
    circle = np.stack([np.sin(a), np.cos(a)], -1)
    normals = circle / radii
    mesh = turned(circle * radii, normals / np.linalg.norm(normals, axis=1)[:, None])
    return mesh | {"points": mesh["points"] + centre}


def base(centre):
    """A closed cylinder; its edges are sharp, so each part has its own vertices."""
    r, h = 0.7, 0.35
    mesh = joined(turned([(0, h), (r, h)], [(0, 1)] * 2), turned([(r, h), (r, 0)], [(1, 0)] * 2),
                  turned([(r, 0), (0, 0)], [(0, -1)] * 2))
    return mesh | {"points": mesh["points"] + centre}


def terrain():
    """Folded sines of nine octaves, four directions each; six repeats of the picture along each side."""
    random = np.random.Generator(np.random.PCG64(7))
    n, half = TERRAIN_QUADS + 1, 5.0
    x, z = np.meshgrid(*[np.linspace(-half, half, n)] * 2)
    height = np.zeros_like(x)
    for octave in range(9):
        for _ in range(4):
            direction, phase = random.random(2) * 2 * np.pi
            along = np.cos(direction) * x + np.sin(direction) * z
            height += (1 - np.abs(np.sin(0.9 * 1.75 ** octave * along + phase))) * 0.42 * 0.56 ** octave
    points = np.stack([x, height - height.mean(), z], -1).reshape(-1, 3)
    uv = 6 * np.stack([0.5 + x / (2 * half), 0.5 - z / (2 * half)], -1).reshape(-1, 2)
    return {"points": points, "uv": uv, "faces": grid_faces(n, n)}


# ------------------------------------------------------------------ scenes

def diffuse(*rgb):
    return {"kind": "diffuse", "rgb": rgb}


def picture(name, raw):
    return {"kind": "diffuse", "picture": os.path.join(ASSETS, name), "raw": raw}


def cornell():
    def cm(*corners):
        return [[c / 100 for c in corner] for corner in corners]

    def block(a, b, c, d, h):
        """Top and four sides of a box that stands on these corners of its top."""
        def up(p, y):
            return (p[0], y, p[1])
        ring = [a, b, c, d]
        sides = [cm(up(p, 0), up(p, h), up(q, h), up(q, 0)) for p, q in zip(ring[1:] + ring[:1], ring)]
        return [cm(*(up(p, h) for p in ring)), *sides]
    white = [cm((552.8, 0, 0), (0, 0, 0), (0, 0, 559.2), (549.6, 0, 559.2)),
             cm((556, 548.8, 0), (556, 548.8, 559.2), (0, 548.8, 559.2), (0, 548.8, 0)),
             cm((549.6, 0, 559.2), (0, 0, 559.2), (0, 548.8, 559.2), (556, 548.8, 559.2)),
             *block((130, 65), (82, 225), (240, 272), (290, 114), 165),
             *block((423, 247), (265, 296), (314, 456), (472, 406), 330)]
    green = [cm((0, 0, 559.2), (0, 0, 0), (0, 548.8, 0), (0, 548.8, 559.2))]
    red = [cm((552.8, 0, 0), (549.6, 0, 559.2), (556, 548.8, 559.2), (556, 548.8, 0))]
    return {
        "depth": 8, "width": 512, "height": 512, "angle": 39.3076, "from": (2.78, 2.73, -8), "to": (2.78, 2.73, 0),
        "light": {"corners": cm((343, 548, 227), (343, 548, 332), (213, 548, 332), (213, 548, 227)),
                  "radiance": (18.4, 15.6, 8)},
        "shapes": {"white": (diffuse(0.725, 0.71, 0.68), lambda: quads(*white)),
                   "green": (diffuse(0.14, 0.45, 0.091), lambda: quads(*green)),
                   "red": (diffuse(0.63, 0.065, 0.05), lambda: quads(*red))}}


def pieces():
    left, right = np.array([-1.15, 0, 0.3]), np.array([1.15, 0, 0.7])
    lift = np.array([0, 0.891, 0])
    gold = {"kind": "conductor", "alpha": 0.15, "eta": (0.143, 0.375, 1.442), "k": (3.983, 2.386, 1.603)}
    glass = {"kind": "dielectric", "alpha": 0.1, "ior": 1.5}
    top = [(-4, 0, 3), (4, 0, 3), (4, 0, -3), (-4, 0, -3)]
    side = [(-4, -0.3, 3), (4, -0.3, 3), (4, 0, 3), (-4, 0, 3)]
    wall = [(-6, -2, -3), (6, -2, -3), (6, 5, -3), (-6, 5, -3)]
    return {
        "depth": 16, "width": 512, "height": 384, "angle": 40, "from": (0, 3.2, 7.5), "to": (0, 0.55, 0),
        "light": {"corners": [(-0.5, 6, 1), (1.5, 6, 1), (1.5, 6, 3), (-0.5, 6, 3)], "radiance": (36, 34, 30)},
        "shapes": {"top": (picture("board.png", raw=True), lambda: quads(top, uv=((0, 0), (1, 0), (1, 0.75), (0, 0.75)))),
                   "side": (diffuse(0.25, 0.12, 0.06), lambda: quads(side)),
                   "wall": (picture("brick.png", raw=True), lambda: quads(wall, uv=((0, 0), (3, 0), (3, 1.75), (0, 1.75)))),
                   "left": (diffuse(0.15, 0.3, 0.6), lambda: base(left)),
                   "right": (diffuse(0.55, 0.12, 0.1), lambda: base(right)),
                   "gold": (gold, lambda: flat_ball(left + lift)),
                   "glass": (glass, lambda: flat_ball(right + lift))}}


def mesh():
    return {
        "depth": 5, "width": 512, "height": 384, "angle": 45, "from": (0, 4.5, 8.5), "to": (0, -0.3, 0.5),
        "sky": (0.3, 0.35, 0.45),
        "light": {"corners": [(-5, 7, -1), (-3, 7, -1), (-3, 7, 1), (-5, 7, 1)], "radiance": (50, 45, 38)},
        "shapes": {"ground": (picture("gravel.png", raw=False), terrain)}}


SCENES = {"cornell": cornell, "pieces": pieces, "mesh": mesh}


def write(name, folder):
    """The scene's JSON; meshes that are there already are taken as they are."""
    scene = SCENES[name]()

    def file_of(shape, build):
        path = os.path.join(folder, f"{name}-{shape}.ply")
        if not os.path.exists(path):
            write_ply(path, build())
        return path
    scene["light"]["file"] = file_of("light", lambda: quads(scene["light"]["corners"]))
    for shape, (material, build) in scene["shapes"].items():
        path = file_of(shape, build)
        scene["shapes"][shape] = {"file": path, "material": material, "smooth": has_normals(path)}
    with open(os.path.join(folder, name + ".json"), "w") as file:
        json.dump(scene, file, indent=1)
    if name == "mesh":
        shutil.copy(os.path.join(ASSETS, "gravel.png"), folder)
        with open(os.path.join(folder, "mesh.scene"), "w") as file:
            file.write(MESH_SCENE)
