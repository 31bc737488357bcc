"""What a render makes beside the picture, and how long it takes: the same as the command makes."""

import filecmp
import pathlib
import shutil
import tempfile
import unittest

import numpy as np
import phasetree as pt
from support import run


def ball_on_floor(**image):
    """A ball around the origin, which the camera sees from 5 away."""
    ball = pt.phase("ball", pt.coated((0.8, 0.2, 0.1), roughness=0.1))(pt.sphere(1))
    return pt.Scene(
        ball,
        camera=pt.camera((0, -5, 0), (0, 0, 0), fov=40),
        lights=[pt.lights.constant(), pt.lights.sphere((2, -2, 4), 0.5, radiance=(20, 20, 20))],
        meshes=pt.meshes.floor(pt.diffuse("#808080"), height=-1.02),
        image=pt.image(**{"width": 33, "height": 25, "samples": 8, **image}),
    )


class WithFiles(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.scene = self.folder / "scene.json"

    def check_command(self, options, **arguments):
        """The files are the command's to the last bit."""
        theirs, own = self.folder / "theirs.exr", self.folder / "own.exr"
        run("render", self.scene, "-o", theirs, "--quiet", *options)
        image = pt.load(self.scene).render(**arguments)
        image.save(own)
        self.assertTrue(filecmp.cmp(theirs, own, shallow=False), options)
        return image

    def test_planes_are_the_command_s(self):
        ball_on_floor().save(self.scene)
        names = ["depth", "normal", "crypto_phase", "lights"]
        some = self.check_command(["--planes", ",".join(names)], planes=names)
        everything = self.check_command(["--planes", "all"], planes="all")
        self.assertLess(set(some.planes), set(everything.planes))
        self.check_command(["--crop", "3,4,20,15", "--planes", "depth"], planes="depth", crop=(3, 4, 20, 15))
        self.check_command(["--noise", "0.1", "--planes", "albedo"], planes=("albedo",), noise=0.1)
        some.save(self.folder / "own.{plane}.exr")
        for name in ("beauty", "depth", "normal"):
            self.assertTrue((self.folder / f"own.{name}.exr").exists(), name)

    def test_denoised_pictures_are_the_command_s(self):
        ball_on_floor(samples=16).save(self.scene)
        self.check_command(["--denoise=regression"], denoise="regression")
        self.check_command(["--denoise"], denoise=True)
        self.check_command(["--denoise=regression", "--planes", "normal,half"], denoise="regression", planes=["normal", "half"])
        self.check_command(["--denoise=regression", "--noise", "0.1"], denoise="regression", noise=0.1)

    def test_what_moves_is_as_at_a_time(self):
        moving = {"keys": [[0, (0, -5, 0)], [2, (0, -7, 0)]]}
        ball_on_floor().with_(camera=pt.camera(moving, (0, 0, 0))).save(self.scene)
        still = self.check_command([])
        later = self.check_command(["--at", "1"], at=1)
        self.assertFalse(np.array_equal(still.pixels, later.pixels))


class Planes(unittest.TestCase):
    def test_arrays(self):
        scene = ball_on_floor()
        plain = scene.render()
        self.assertEqual(plain.planes, {})
        image = scene.render(planes=["depth", "normal", "position"])
        np.testing.assert_array_equal(image.pixels, plain.pixels)
        self.assertEqual(
            list(image.planes),
            ["depth.Z", "position.X", "position.Y", "position.Z", "normal.X", "normal.Y", "normal.Z"],
        )
        for values in image.planes.values():
            self.assertEqual((values.shape, values.dtype), ((25, 33), np.float32))
        middle = {name: values[12, 16] for name, values in image.planes.items()}
        self.assertAlmostEqual(middle["depth.Z"], 4, delta=0.02)
        self.assertAlmostEqual(middle["normal.Y"], -1, delta=0.02)
        self.assertAlmostEqual(middle["position.Y"], -1, delta=0.02)

    def test_denoising(self):
        scene = ball_on_floor(samples=16)
        plain, clean = scene.render(planes="depth"), scene.render(planes="depth", denoise="regression")
        self.assertEqual(list(clean.planes), ["depth.Z", "noisy.R", "noisy.G", "noisy.B"])
        np.testing.assert_array_equal(np.stack([clean.planes[f"noisy.{c}"] for c in "RGB"], axis=2), plain.pixels)
        np.testing.assert_array_equal(clean.planes["depth.Z"], plain.planes["depth.Z"])
        reference = scene.render(samples=1024).pixels
        self.assertLess(np.mean((clean.pixels - reference) ** 2), 0.8 * np.mean((plain.pixels - reference) ** 2))
        stages = set()
        scene.render(width=300, height=200, denoise=True, progress=lambda stage, share: stages.add(stage))
        self.assertIn("denoising", stages)

    def test_a_limit_of_time(self):
        scene = ball_on_floor()
        enough = scene.render(samples=4, time_limit=600)
        self.assertEqual(enough.samples, 4)
        np.testing.assert_array_equal(enough.pixels, scene.render(samples=4).pixels)
        shares = []
        told = scene.render(time_limit=3, progress=lambda stage, share: shares.append(share))
        self.assertGreater(told.samples, 8)
        self.assertLess(told.seconds, 60)
        self.assertTrue(all(0 <= share <= 1 for share in shares))
        # The first pass is always done, and has too few samples to be denoised.
        with self.assertWarnsRegex(UserWarning, "not denoised"):
            short = scene.render(time_limit=1e-9, denoise="regression")
        self.assertEqual((short.samples, short.planes), (1, {}))
        np.testing.assert_array_equal(short.pixels, scene.render(samples=1).pixels)

    def test_what_cannot_be_is_refused(self):
        scene = ball_on_floor()
        for said, arguments in (
            ('planes: unknown plane "dept"; choose from .*depth.*, or "all"', {"planes": ["depth", "dept"]}),
            ('planes: unknown plane "all"', {"planes": ["all", "depth"]}),
            ('denoise: must be "regression" or "oidn", but is "magic"', {"denoise": "magic"}),
            ("denoise: needs at least 8 samples per pixel, but the picture has 7", {"denoise": True, "samples": 7}),
            ("denoise must be True", {"denoise": 3}),
            ("time_limit must be seconds", {"time_limit": 0}),
            ("time_limit must be seconds", {"time_limit": float("nan")}),
        ):
            with self.subTest(said):
                with self.assertRaisesRegex(pt.Error, said):
                    scene.render(**arguments)
        image = scene.render(samples=1, crop=(0, 0, 5, 5))
        self.assertEqual(image.crop, (0, 0, 33, 25))
        image.crop = (30, 0, 33, 25)
        with self.assertRaisesRegex(ValueError, "crop must be"):
            image.save("nowhere.exr")


if __name__ == "__main__":
    unittest.main()
