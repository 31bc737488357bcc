"""Files of triangles that `phasetree export` writes, read by readers of their own, and meshes in Python."""

import json
import pathlib
import signal
import struct
import subprocess
import tempfile
import time
import unittest
import xml.etree.ElementTree
import zipfile

import numpy as np
import phasetree as pt
from support import COMMAND

# A ball of glass, whose lower half a block of wax replaces, and a small cube above: all volumes are known.
SCENE = """{"version": 1,
  "phases": {
    "clear glass": {"clear": {"ior": 1.5, "absorption": [1, 2, 4]}},
    "w<a>x": {"diffuse": {"color": [0.8, 0.4, 0.1]}},
    "gold": {"conductor": {"metal": "gold"}},
    "ember": {"glowing": {"radiance": 4, "light": [1, 0.5, 0.25]}}
  },
  "tree": {"over": [
    {"set": {"phase": "ember", "of": {"translate": {"by": [0, 0, 2], "of": {"box": {"size": [0.5, 0.5, 0.5]}}}}}},
    {"set": {"phase": "w<a>x", "of": {"translate": {"by": [0, 0, -1], "of": {"box": {"size": [2.5, 2.5, 2]}}}}}},
    {"set": {"phase": "clear glass", "of": {"sphere": {"radius": 1}}}}
  ]},
  "lights": [{"constant": {"radiance": [1, 1, 1]}}],
  "camera": {"position": [0, -9, 0], "look_at": [0, 0, 0]}
}"""
VOLUMES = {"clear glass": 2 / 3 * np.pi, "w<a>x": 12.5, "ember": 0.125}


def volume(vertices, triangles):
    a, b, c = (vertices[triangles[:, i]].astype(float) for i in range(3))
    return (a * np.cross(b, c)).sum() / 6


def is_closed(triangles):
    """Whether each edge has one triangle on each side, of the same orientation."""
    edges = np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)]).astype(np.int64)
    there = edges[:, 0] << 32 | edges[:, 1]
    back = edges[:, 1] << 32 | edges[:, 0]
    return len(np.unique(there)) == len(there) and np.array_equal(np.sort(there), np.sort(back))


def read_stl(path):
    data = path.read_bytes()
    (count,) = struct.unpack_from("<I", data, 80)
    kind = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    assert len(data) == 84 + count * kind.itemsize
    facets = np.frombuffer(data, kind, offset=84)
    vertices, numbers = np.unique(facets["corners"].reshape(-1, 3), axis=0, return_inverse=True)
    triangles = numbers.reshape(-1, 3)
    a, b, c = (facets["corners"][:, i].astype(float) for i in range(3))
    normals = np.cross(b - a, c - a)
    assert ((normals * facets["normal"]).sum(axis=1) >= 0.999 * np.linalg.norm(normals, axis=1)).all()
    return vertices, triangles


def read_ply(path):
    data = path.read_bytes()
    head, _, body = data.partition(b"end_header\n")
    lines = head.decode().splitlines()
    names = {int(line.split()[2]): line.split(" ", 3)[3] for line in lines if line.startswith("comment phase")}
    counts = {line.split()[1]: int(line.split()[2]) for line in lines if line.startswith("element")}
    vertices = np.frombuffer(body, "<f4", 3 * counts["vertex"]).reshape(-1, 3)
    kind = np.dtype([("n", "u1"), ("v", "<i4", 3), ("behind", "u1"), ("front", "u1"), ("color", "u1", 3)])
    faces = np.frombuffer(body, kind, offset=vertices.nbytes)
    assert len(faces) == counts["face"] and (faces["n"] == 3).all()
    return names, vertices, faces


def read_obj(path):
    vertices, normals, objects, materials = [], [], {}, {}
    for line in path.read_text().splitlines():
        word, *rest = line.split()
        if word == "v":
            vertices.append([float(x) for x in rest])
        elif word == "vn":
            normals.append([float(x) for x in rest])
        elif word == "o":
            faces = objects.setdefault(rest[0], [])
        elif word == "usemtl":
            materials[list(objects)[-1]] = rest[0]
        elif word == "f":
            faces.append([[int(n) - 1 for n in corner.split("//")] for corner in rest])
        elif word == "mtllib":
            library = rest[0]
    return np.array(vertices), np.array(normals), {k: np.array(v) for k, v in objects.items()}, materials, library


def read_3mf(path):
    """The parts of a 3MF file: name, base material, vertices and triangles. Checks that the materials divide the
    triangles of the one object in the same way as the ranges that PrusaSlicer reads."""
    space = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
    with zipfile.ZipFile(path) as package:
        assert package.testzip() is None
        relations = xml.etree.ElementTree.fromstring(package.read("_rels/.rels"))
        types = xml.etree.ElementTree.fromstring(package.read("[Content_Types].xml"))
        assert {name.rsplit(".", 1)[1] for name in package.namelist()[1:]} == {t.get("Extension") for t in types}
        model = xml.etree.ElementTree.fromstring(package.read(relations[0].get("Target").lstrip("/")))
        config = xml.etree.ElementTree.fromstring(package.read("Metadata/Slic3r_PE_model.config"))
    assert model.get("unit") == "millimeter"
    bases = [(b.get("name"), b.get("displaycolor")) for b in model.iter(space + "base")]
    materials, = model.iter(space + "basematerials")
    thing, = model.iter(space + "object")
    item, = model.iter(space + "item")
    configured, = config
    assert item.get("objectid") == thing.get("id") == configured.get("id")
    all_vertices = np.array([[float(v.get(k)) for k in "xyz"] for v in thing.iter(space + "vertex")])
    written = list(thing.iter(space + "triangle"))
    all_triangles = np.array([[int(t.get(k)) for k in ("v1", "v2", "v3")] for t in written])
    assert {t.get("pid") for t in written} == {materials.get("id")}
    of = np.array([int(t.get("p1")) for t in written])
    parts, first = [], 0
    for i, volume in enumerate(configured):
        assert int(volume.get("firstid")) == first
        end = int(volume.get("lastid")) + 1
        assert set(of[first:end]) == {i}
        values = {m.get("key"): m.get("value") for m in volume}
        assert values["volume_type"] == "ModelPart" and values["extruder"] == str(i + 1)
        used, triangles = np.unique(all_triangles[first:end], return_inverse=True)
        parts.append((values["name"], bases[i], all_vertices[used], triangles.reshape(-1, 3)))
        first = end
    assert first == len(written) and sum(len(p[2]) for p in parts) == len(all_vertices)
    return parts


def read_glb(path):
    data = path.read_bytes()
    magic, version, size, length = struct.unpack_from("<4sIII", data)
    assert (magic, version, size) == (b"glTF", 2, len(data)) and data[16:20] == b"JSON"
    tree = json.loads(data[20 : 20 + length])
    (binary,) = struct.unpack_from("<I", data, 20 + length)
    assert data[24 + length : 28 + length] == b"BIN\0" and binary == tree["buffers"][0]["byteLength"]

    def array(number, kind, columns):
        accessor = tree["accessors"][number]
        view = tree["bufferViews"][accessor["bufferView"]]
        start = 28 + length + view["byteOffset"]
        return np.frombuffer(data, kind, accessor["count"] * columns, offset=start).reshape(-1, columns)

    parts = {}
    for node in tree["nodes"][1:]:
        (primitive,) = tree["meshes"][node["mesh"]]["primitives"]
        places = array(primitive["attributes"]["POSITION"], "<f4", 3)
        normals = array(primitive["attributes"]["NORMAL"], "<f4", 3)
        accessor = tree["accessors"][primitive["attributes"]["POSITION"]]
        assert np.allclose(accessor["min"], places.min(axis=0)) and np.allclose(accessor["max"], places.max(axis=0))
        triangles = array(primitive["indices"], "<u4", 1).reshape(-1, 3)
        parts[node["name"]] = (places, normals, triangles, tree["materials"][primitive["material"]])
    return tree, parts


class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = pathlib.Path(cls.folder.name)
        (cls.path / "scene.json").write_text(SCENE)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def export(self, name, *options):
        command = [COMMAND, "export", "scene.json", "-o", name, "--spacing", "0.08", *options]
        done = subprocess.run(command, cwd=self.path, capture_output=True, text=True, check=True)
        self.assertEqual(done.stderr, "")
        return self.path / name

    def check_part(self, name, vertices, triangles):
        self.assertTrue(is_closed(triangles), name)
        self.assertAlmostEqual(volume(vertices, triangles) / VOLUMES[name], 1, delta=0.005, msg=name)

    def test_stl_has_what_bounds_all(self):
        vertices, triangles = read_stl(self.export("all.stl"))
        self.assertTrue(is_closed(triangles))
        self.assertAlmostEqual(volume(vertices, triangles), sum(VOLUMES.values()), delta=0.02)

    def test_stl_of_each_phase_and_of_some(self):
        self.export("part {phase}.stl")
        found = {p.name for p in self.path.glob("part*")}
        self.assertEqual(found, {"part clear_glass.stl", "part w_a_x.stl", "part ember.stl"})
        for name in VOLUMES:
            file = name.replace(" ", "_").replace("<", "_").replace(">", "_")
            self.check_part(name, *read_stl(self.path / f"part {file}.stl"))
        large, _ = read_stl(self.export("large.stl", "--phase", "ember", "--scale", "20"))
        self.assertTrue(np.allclose(large.max(axis=0), [5, 5, 45], atol=0.01))
        vertices, triangles = read_stl(self.export("two.stl", "--phase", "ember", "--phase", "clear glass"))
        self.assertAlmostEqual(volume(vertices, triangles), VOLUMES["ember"] + VOLUMES["clear glass"], delta=0.02)

    def test_ply_has_each_triangle_once_with_both_phases(self):
        names, vertices, faces = read_ply(self.export("all.ply"))
        self.assertEqual(names, {0: "vacuum", 1: "clear glass", 2: "w<a>x", 4: "ember"})
        self.assertTrue((faces["behind"] > faces["front"]).all())
        for number, name in list(names.items())[1:]:
            inside = faces["behind"] == number
            outside = faces["front"] == number
            triangles = np.concatenate([faces["v"][inside], faces["v"][outside][:, ::-1]])
            self.check_part(name, vertices, triangles)
            colors = np.unique(faces["color"][inside], axis=0)
            self.assertEqual(len(colors), 1)
            if name == "w<a>x":
                self.assertEqual(colors[0].tolist(), [0xE7, 0xAA, 0x59])
        shared = (faces["behind"] == 2) & (faces["front"] == 1)
        self.assertTrue(shared.any())
        # One phase alone: its own triangles, and in its colour even where another is behind.
        _, _, of_glass = read_ply(self.export("glass.ply", "--phase", "clear glass"))
        self.assertTrue(((of_glass["behind"] == 1) | (of_glass["front"] == 1)).all())
        self.assertEqual(len(np.unique(of_glass["color"], axis=0)), 1)

    def test_obj_has_an_object_for_each_phase_with_common_vertices(self):
        vertices, normals, objects, materials, library = read_obj(self.export("all.obj"))
        self.assertEqual(library, "all.mtl")
        self.assertEqual(list(objects), ["clear_glass", "w<a>x", "ember"])
        self.assertEqual(materials, {name: name for name in objects})
        for name, corners in objects.items():
            self.check_part(name.replace("_", " "), vertices, corners[:, :, 0])
            # Normals are of unit length, and near to those of their triangles.
            a, b, c = (vertices[corners[:, i, 0]] for i in range(3))
            flat = np.cross(b - a, c - a)
            flat /= np.linalg.norm(flat, axis=1)[:, None]
            of_corners = normals[corners[:, :, 1]]
            self.assertTrue(np.allclose(np.linalg.norm(of_corners, axis=2), 1, atol=2e-3))
            self.assertGreater((of_corners * flat[:, None]).sum(axis=2).min(), 0.8)
        touching = set(objects["clear_glass"][:, :, 0].flat) & set(objects["w<a>x"][:, :, 0].flat)
        self.assertGreater(len(touching), 100)
        self.assertEqual(len(np.unique(vertices, axis=0)), len(vertices))
        text = (self.path / "all.mtl").read_text()
        self.assertEqual(text.count("newmtl"), 3)
        self.assertIn("Ni 1.5", text)
        self.assertIn("Kd 0.8 0.4 0.1", text)

    def test_edges_of_a_box_keep_their_normals(self):
        vertices, normals, objects, *_ = read_obj(self.export("ember.obj", "--phase", "ember"))
        of_corners = normals[objects["ember"][:, :, 1]].reshape(-1, 3)
        # All are along an axis, but for the rims, where triangles of both faces are within 30° of none.
        self.assertGreater((np.abs(of_corners).max(axis=1) > 0.999).mean(), 0.99)

    def test_3mf_has_a_part_for_each_phase_with_its_colour(self):
        parts = read_3mf(self.export("all.3mf"))
        self.assertEqual([name for name, *_ in parts], list(VOLUMES))
        for name, base, vertices, triangles in parts:
            self.assertEqual(base[0], name)
            self.check_part(name, vertices, triangles)
        self.assertEqual(parts[1][1][1], "#E7AA59")  # sRGB of 0.8, 0.4, 0.1

    def test_glb_has_a_node_for_each_phase_with_its_material(self):
        tree, parts = read_glb(self.export("all.glb"))
        self.assertEqual(tree["scenes"], [{"nodes": [0]}])
        self.assertEqual(tree["nodes"][0]["children"], [1, 2, 3])
        self.assertEqual(list(parts), list(VOLUMES))
        turn = tree["nodes"][0]["rotation"]
        # z becomes y: the quaternion turns (0, 0, 1) to (0, 1, 0).
        x, w = turn[0], turn[3]
        self.assertTrue(np.allclose([0, -2 * x * w, 1 - 2 * x * x], [0, 1, 0]))
        for name, (places, normals, triangles, _) in parts.items():
            # Vertices are there once for each normal; by their places the surface is closed.
            vertices, numbers = np.unique(places, axis=0, return_inverse=True)
            self.check_part(name, vertices, numbers.reshape(-1)[triangles])
            self.assertTrue(np.allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-4))
        glass = parts["clear glass"][3]["extensions"]
        self.assertEqual(glass["KHR_materials_ior"]["ior"], 1.5)
        self.assertAlmostEqual(glass["KHR_materials_volume"]["attenuationDistance"], 0.25)
        self.assertTrue(np.allclose(glass["KHR_materials_volume"]["attenuationColor"], np.exp([-0.25, -0.5, -1])))
        self.assertAlmostEqual(parts["w<a>x"][3]["pbrMetallicRoughness"]["baseColorFactor"][0], 0.8, places=5)
        self.assertIn("emissiveFactor", parts["ember"][3])
        self.assertEqual(set(tree["extensionsUsed"]), {"KHR_materials_emissive_strength", "KHR_materials_ior",
                                                       "KHR_materials_transmission", "KHR_materials_volume"})

    def test_scale(self):
        _, parts = read_glb(self.export("large.glb", "--scale", "10"))
        places, _, _, material = parts["clear glass"]
        self.assertAlmostEqual(places[:, 2].max(), 10, delta=0.1)
        # What is ten times as large absorbs as much on its way.
        self.assertAlmostEqual(material["extensions"]["KHR_materials_volume"]["attenuationDistance"], 2.5)

    def test_files_are_the_same_each_time(self):
        for extension in ("stl", "ply", "obj", "3mf", "glb"):
            once = self.export(f"once.{extension}").read_bytes()
            again = self.export(f"once.{extension}").read_bytes()
            self.assertEqual(once, again, extension)

    def test_what_is_written_can_be_read_as_a_field(self):
        for name in ("back.stl", "back.ply", "back.obj"):
            self.export(name, "--phase", "w<a>x")
            wax = pt.Phase("wax", None)
            block = wax(pt.mesh(file=str(self.path / name)))
            points = np.random.default_rng(4).uniform(-1.6, 1.6, (4000, 3)).astype(np.float32)
            ours = pt.load(self.path / "scene.json").object
            away = np.abs(ours.phi(points)[:, 2]) > 0.02
            self.assertTrue(np.array_equal(block.label(points)[away] == 1, ours.label(points)[away] == 2), name)


class Meshes(unittest.TestCase):
    def setUp(self):
        glass, water = pt.phase("glass"), pt.phase("water")
        self.object = pt.sphere(1).thin_shell(glass, water, half_thickness=0.1)

    def test_a_mesh_is_that_of_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder)
            (path / "scene.json").write_text(SCENE)
            subprocess.run([COMMAND, "export", "scene.json", "-o", "a.ply", "--spacing", "0.1"], cwd=path, check=True)
            _, vertices, faces = read_ply(path / "a.ply")
            mesh = pt.load(path / "scene.json").object.prepare("low").mesh(0.1)
        self.assertEqual(len(mesh.triangles), len(faces))
        self.assertTrue(np.array_equal(mesh.behind, faces["behind"]) and np.array_equal(mesh.front, faces["front"]))
        self.assertTrue(np.array_equal(mesh.vertices[mesh.triangles], vertices[faces["v"]]))

    def test_surfaces(self):
        told = []
        mesh = self.object.mesh(0.05, progress=lambda *what: told.append(what))
        self.assertTrue(all(stage == "meshing" and 0 < share <= 1 for stage, share in told))
        # Long work reports progress a few times per second.
        self.object.mesh(0.006, progress=lambda *what: told.append(what))
        self.assertGreater(len(told), 0)
        self.assertEqual(mesh.names, ("vacuum", "glass", "water"))
        self.assertAlmostEqual(mesh.spacing, 0.05)
        for phases, expected in [(("water",), 0.9**3), (("glass",), 1.1**3 - 0.9**3), (("water", "glass"), 1.1**3)]:
            vertices, triangles = mesh.surface(*phases)
            self.assertTrue(is_closed(triangles))
            self.assertAlmostEqual(volume(vertices, triangles) / (4 / 3 * np.pi * expected), 1, delta=0.01)
        ball = mesh.surface(self.object.phases[2])
        self.assertTrue(np.array_equal(ball[0], mesh.surface("water")[0]))
        self.assertAlmostEqual(volume(*mesh.surface("vacuum")), -volume(*mesh.surface("water", "glass")), places=9)

    def test_what_is_wrong_is_said(self):
        with self.assertRaisesRegex(pt.Error, "more than 1024 cubes"):
            self.object.mesh(1e-6)
        with self.assertRaisesRegex(pt.Error, "must be a length"):
            self.object.mesh(-1)
        with self.assertRaisesRegex(pt.Error, "no phase 'wood'"):
            self.object.mesh(0.2).surface("wood")
        with self.assertRaises(KeyError):

            def raises(*_):
                raise KeyError

            self.object.mesh(0.004, progress=raises)


class Preparation(unittest.TestCase):
    def test_a_signal_stops_the_preparation_of_a_large_mesh(self):
        # A closed surface of 980,000 triangles, written as a torus of squares.
        n = 700
        around, along = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
        u, v = 2 * np.pi * around / n, 2 * np.pi * along / n
        vertices = np.stack([(2 + np.cos(v)) * np.cos(u), (2 + np.cos(v)) * np.sin(u), np.sin(v)], -1).reshape(-1, 3)
        number = lambda i, k: ((i % n) * n + k % n).ravel()
        a, b = number(around, along), number(around + 1, along)
        c, d = number(around + 1, along + 1), number(around, along + 1)
        triangles = np.concatenate([np.stack([a, b, c], -1), np.stack([a, c, d], -1)])
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "torus.ply"
            faces = np.empty(len(triangles), dtype=[("count", "u1"), ("corners", "<i4", 3)])
            faces["count"], faces["corners"] = 3, triangles
            header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\nproperty float x\n"
                      f"property float y\nproperty float z\nelement face {len(triangles)}\n"
                      "property list uchar int vertex_indices\nend_header\n")
            path.write_bytes(header.encode() + vertices.astype("<f4").tobytes() + faces.tobytes())
            whole = time.monotonic()
            pt.mesh(path)
            whole = time.monotonic() - whole
            was = signal.signal(signal.SIGALRM, signal.default_int_handler)
            signal.setitimer(signal.ITIMER_REAL, whole / 2)
            try:
                with self.assertRaises(KeyboardInterrupt):
                    pt.mesh(path)
            finally:
                signal.setitimer(signal.ITIMER_REAL, 0)
                signal.signal(signal.SIGALRM, was)


if __name__ == "__main__":
    unittest.main()
