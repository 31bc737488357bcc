"""What changes with time: parts of a scene keep their keys; trees, which stand still, refuse them."""

import pathlib
import shutil
import tempfile
import unittest
import warnings

import numpy as np
import phasetree as pt
from support import SCENES, run


def keys(first, last):
    return {"keys": [[0, first], [1, last]]}


class Motion(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def test_trees_refuse_keys(self):
        glass = pt.phase("glass")
        for name, call in (
            ('sphere: "radius"', lambda: pt.sphere(keys(1, 2))),
            ('sphere: "radius"', lambda: pt.sphere(radius={"between": "smooth", **keys(1, 2)})),
            ('translate: "by"', lambda: pt.sphere(1).translate(keys((0, 0, 0), (1, 0, 0)))),
            ('translate: "by"', lambda: pt.sphere(1).translate([keys(0, 1), 0, 0])),
            ('rotate: "angle"', lambda: glass(pt.sphere(1)).rotate(keys(0, 90))),
            ("transforms", lambda: pt.instances_of("ball", keys((0, 0, 0), (1, 0, 0)))),
            ('the map of "ball"', lambda: pt.Scene(objects={"ball": (glass(pt.sphere(1)), keys((0, 0, 0), (1, 0, 0)))})),
        ):  # fmt: skip
            with self.subTest(name):
                with self.assertRaises(pt.Error) as caught:
                    call()
                self.assertIn(f"{name} has keys, but trees and transforms made in Python do not move", str(caught.exception))
                self.assertIn("write the scene file by hand", str(caught.exception))

    def test_all_else_keeps_them(self):
        ball = pt.phase("ball", pt.diffuse(keys((1, 0, 0), (0, 1, 0))))(pt.sphere(1))
        scene = pt.Scene(
            ball,
            pt.camera(keys((0, -5, 0), (0, -6, 0)), (0, 0, 0)),
            pt.lights.constant(radiance=keys((1, 1, 1), (2, 2, 2))),
            pt.meshes.floor(pt.diffuse("#808080"), height=keys(-1.2, -1.1)),
            background=keys((0, 0, 0), (0, 0, 1)),
            image=pt.image(8, 8, samples=1),
        )
        path = self.folder / "moves.json"
        scene.save(path)
        self.assertEqual(path.read_text(encoding="utf-8").count('"keys"'), 5)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertEqual(pt.load(path), scene)
        before, after = self.folder / "0.exr", self.folder / "1.exr"
        run("render", path, "--at", "0", "-o", before, "--quiet")
        run("render", path, "--at", "1", "-o", after, "--quiet")
        pt.load(path).render().save(self.folder / "own.exr")
        self.assertEqual((self.folder / "own.exr").read_bytes(), before.read_bytes())
        self.assertNotEqual(before.read_bytes(), after.read_bytes())

    def test_files_whose_trees_move_are_read_with_a_warning(self):
        with self.assertWarnsRegex(UserWarning, "hourglass.json: its trees or transforms change with time; they are read at time 0"):
            pt.load(SCENES / "film" / "hourglass.json")
        for moving in (
            '"tree": {"set": {"phase": "a", "of": {"sphere": {"radius": {"keys": [[0, 1], [1, 2]]}}}}}',
            '"shapes": {"s": {"sphere": {"radius": {"keys": [[0, 1], [1, 2]]}}}}, "tree": {"set": {"phase": "a", "of": "s"}}',
            '"objects": [{"name": "o", "tree": {"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}}, '
            '"transform": {"translate": {"by": {"keys": [[0, [0, 0, 0]], [1, [1, 0, 0]]]}}}}]',
        ):
            path = self.folder / "moves.json"
            path.write_text('{"version": 1, "phases": {"a": {"diffuse": {"color": [1, 1, 1]}}}, ' + moving + "}")
            with self.subTest(moving):
                with self.assertWarnsRegex(UserWarning, "change with time"):
                    scene = pt.load(path)
                if scene.object:
                    self.assertEqual(scene.object, pt.phase("a", pt.diffuse((1, 1, 1)))(pt.sphere(1)))
        of_texture = """{"version": 1, "phases": {"a": {"diffuse": {"color": {"field": {
            "of": {"sphere": {"radius": {"keys": [[0, 1], [1, 2]]}}}, "ramp": [[0, [1, 1, 1]]]}}}}},
            "tree": {"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}}}"""
        (self.folder / "texture.json").write_text(of_texture)
        with self.assertWarnsRegex(UserWarning, "change with time"):
            pt.load(self.folder / "texture.json")

    def test_names_that_are_keys(self):
        ball = pt.phase("keys", pt.diffuse((1, 1, 1)))(pt.sphere(1))
        scene = pt.Scene(objects={"keys": ball}, groups={"k": [pt.instances_of("keys", np.eye(4))]}, instances=pt.instances_of("k", (0, 0, 0)))
        scene.save(self.folder / "keys.json")
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertEqual(pt.load(self.folder / "keys.json"), scene)


if __name__ == "__main__":
    unittest.main()
