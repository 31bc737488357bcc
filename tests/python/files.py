"""Files that scenes name: images, meshes, networks. They are found from anywhere, and saved scenes name them again."""

import filecmp
import json
import os
import pathlib
import shutil
import tempfile
import unittest

import numpy as np
import phasetree as pt
from support import SCENES, run

# Names that JSON has to escape, that are longer in bytes than in letters, and that look like the text around them.
AWKWARD = ['with "quotes"', "back\\slash", "käse 猫 🐙", '", "file": "x', "file", "a,b]}", "per%20cent"]


def picture(path, seed=0):
    """A small image file of colours that differ from seed to seed."""
    pt.Image(np.random.default_rng(seed).random((2, 4, 3)) + seed).save(path)
    return path


def triangle(path):
    path.write_text("v -3 -3 -1.1\nv 3 -3 -1.1\nv 0 3 -1.1\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n", encoding="utf-8")
    return path


def shown(material, **parts):
    """A ball of this material, lit and seen."""
    parts.setdefault("lights", pt.lights.constant())
    ball = pt.phase("ball", material)(pt.sphere(1))
    return pt.Scene(ball, pt.camera((0, -5, 0), (0, 0, 0)), image=pt.image(16, 16, samples=2), **parts)


class WrongPathsAndTimes(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def test_null_characters_in_paths_are_refused(self):
        scene = shown(pt.diffuse((0.5, 0.5, 0.5)))
        image = pt.Image(np.zeros((2, 2, 3)))
        for path in (f"{self.folder}/a\0b.exr", self.folder / "a\0b.json", os.fsencode(self.folder) + b"/a\0b.exr"):
            with self.subTest(path):
                for call in (image.save, scene.save, pt.load):
                    with self.assertRaisesRegex(pt.Error, "a path must not contain null characters, but is"):
                        call(path)
        with self.assertRaisesRegex(pt.Error, "null characters"):
            pt.textures.image(pathlib.Path("a\0b.png"))
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_the_time_of_a_picture_must_be_finite(self):
        scene = shown(pt.diffuse((0.5, 0.5, 0.5)))
        for at in (float("nan"), float("inf"), -float("inf"), "x", "1", None, [0], 10**400):
            with self.subTest(at), self.assertRaisesRegex(pt.Error, "^at must be a finite number of seconds, but is "):
                scene.render(at=at)
        self.assertEqual(scene.render(at=np.float32(0)), scene.render(at=0))


class FilesOfScenes(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "assets").mkdir()

    def asset(self, name):
        return self.folder / "assets" / name

    def check(self, scene, names):
        """A scene is equal when read back, and its picture that of the command; the file names these files."""
        path = self.folder / "scene.json"
        scene.save(path)
        text = path.read_text(encoding="utf-8")
        self.assertEqual(sorted(files_in(json.loads(text))), sorted(f"assets/{name}" for name in names))
        again = pt.load(path)
        self.assertEqual(again, scene)
        again.save(self.folder / "again.json")
        self.assertEqual((self.folder / "again.json").read_text(encoding="utf-8"), text)
        image, own = self.folder / "theirs.exr", self.folder / "own.exr"
        run("render", path, "-o", image, "--quiet")
        again.render().save(own)
        self.assertTrue(filecmp.cmp(image, own, shallow=False))
        np.testing.assert_array_equal(scene.render().pixels, again.render().pixels)
        return again

    def test_image_textures_of_materials(self):
        tile = pt.textures.image(picture(self.asset("tile.png")))
        for material in (pt.diffuse(tile), pt.coated(tile, roughness=0.3), pt.glowing(tile)):
            with self.subTest(material.kind):
                self.check(shown(material), ["tile.png"])
        seen = shown(pt.diffuse(tile)).render().pixels
        self.assertFalse(np.array_equal(seen, shown(pt.diffuse((0.5, 0.5, 0.5))).render().pixels))

    def test_image_textures_within_textures(self):
        first, second = (pt.textures.image(picture(self.asset(f"{i}.png"), i), size=0.5) for i in (1, 2))
        network = self.asset("net.json")
        shutil.copy(SCENES / "assets/bunny.siren.json", network)
        mixed = pt.textures.field(pt.siren(network), [[-0.5, first], [0, "#804020"], [0.5, second]])
        self.check(shown(pt.diffuse(mixed)), ["1.png", "2.png", "net.json"])

    def test_image_lights_and_textures_and_meshes_at_once(self):
        tile, sky = picture(self.asset("tile.png")), picture(self.asset("sky.exr"), 1)
        scene = shown(
            pt.coated(pt.textures.image(tile)),
            lights=[pt.lights.image(sky, rotation=30), pt.lights.sphere((2, -2, 4), 0.5)],
            meshes=[
                pt.meshes.obj(pt.diffuse(pt.textures.mesh_image(tile)), triangle(self.asset("leaf.obj"))),
                pt.meshes.floor(pt.diffuse(pt.textures.image(tile)), height=-1.2),
            ],
        )
        self.check(scene, ["leaf.obj", "sky.exr", "tile.png", "tile.png", "tile.png"])

    def test_awkward_names(self):
        for name in AWKWARD:
            with self.subTest(name):
                tile, sky = picture(self.asset(name + ".png")), picture(self.asset(name + ".exr"), 1)
                leaf = triangle(self.asset(name + ".obj"))
                scene = shown(
                    pt.diffuse(pt.textures.image(tile)),
                    lights=pt.lights.image(sky),
                    meshes=pt.meshes.obj(pt.diffuse(pt.textures.mesh_image(tile)), leaf),
                )
                self.check(scene, [name + ".exr", name + ".obj", name + ".png", name + ".png"])

    def test_a_folder_may_have_an_awkward_name(self):
        for name in AWKWARD:
            with self.subTest(name):
                inside = self.folder / name
                inside.mkdir()
                scene = shown(pt.diffuse(pt.textures.image(picture(inside / "tile.png"))))
                scene.save(self.folder / "from_outside.json")
                scene.save(inside / "beside.json")
                self.assertEqual(pt.load(self.folder / "from_outside.json"), scene)
                self.assertEqual(pt.load(inside / "beside.json"), scene)
                self.assertIn('"tile.png"', (inside / "beside.json").read_text(encoding="utf-8"))

    def test_names_as_bytes(self):
        tile = picture(self.asset("tile.png"))
        self.assertEqual(pt.textures.image(os.fsencode(tile)), pt.textures.image(tile))
        for make in (pt.textures.image, pt.siren):
            with self.assertRaisesRegex(pt.Error, "scene files are UTF-8"):
                make(os.fsencode(self.folder) + b"/tile\xff.png")

    def test_objects_of_a_scene_of_several(self):
        tile, other = picture(self.asset("tile.png")), picture(self.asset("other.png"), 1)
        scene = pt.Scene(
            objects={
                "a": pt.phase("a", pt.diffuse(pt.textures.image(tile)))(pt.sphere(0.5)),
                "b": (pt.phase("b", pt.diffuse(pt.textures.image(other)))(pt.sphere(0.5)), (1.5, 0, 0)),
            },
            camera=pt.camera((0, -5, 0), (0, 0, 0)),
            lights=pt.lights.image(picture(self.asset("sky.exr"), 2)),
            image=pt.image(16, 16, samples=2),
        )
        self.check(scene, ["other.png", "sky.exr", "tile.png"])

    def test_files_that_people_wrote(self):
        picture(self.asset("tile.png"))
        picture(self.asset("ä.png"), 1)
        path = self.folder / "by_hand.json"
        path.write_text(
            """{"version": 1, // An é before the names of files, and "file": "in a comment".
            "phases": {"image": {"diffuse": {"color": {"image": {"file": "assets/tile.png"}}}},
                       "file": {"diffuse": {"color": {"image": {"size": 2, "file": "assets/\\u00e4.png"}}}}},
            "tree": {"over": [{"set": {"phase": "image", "of": {"sphere": {"radius": 1}}}},
                              {"set": {"phase": "file", "of": {"sphere": {"radius": 1.2}}}}]},
            "lights": [{"image": {"file": "assets/tile.png"}}],
            "camera": {"position": [0, -5, 0], "look_at": [0, 0, 0]}, "render": {"width": 8, "height": 8, "samples": 1}}""",
            encoding="utf-8",
        )
        before = os.getcwd()
        os.chdir("/")
        self.addCleanup(os.chdir, before)
        scene = pt.load(path)
        self.check(scene, ["tile.png", "tile.png", "ä.png"])
        run("render", path, "-o", self.folder / "by_hand.exr", "--quiet")
        scene.render().save(self.folder / "loaded.exr")


def files_in(value):
    """All that is called "file" in a scene of no names of that kind but those of files."""
    if isinstance(value, list):
        return [name for one in value for name in files_in(one)]
    if not isinstance(value, dict):
        return []
    own = [value["file"]] if isinstance(value.get("file"), str) else []
    return own + [name for one in value.values() for name in files_in(one)]


if __name__ == "__main__":
    unittest.main()
