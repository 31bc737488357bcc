"""Whole scenes: read, written, shown. What the command makes of a file is what the package makes of it."""

import filecmp
import os
import pathlib
import pickle
import shutil
import tempfile
import threading
import unittest

import numpy as np
import phasetree as pt
from support import SCENES, gallery_scenes, gallery_scenes_for_the_command, run


def small_scene():
    glass = pt.phase("glass", pt.clear(ior=1.5, color=(0.8, 0.95, 1), color_distance=2))
    water = pt.phase("water", pt.clear(ior=1.33))
    filled = pt.sphere(1).thin_shell(glass, water, half_thickness=0.05)
    return pt.Scene(
        filled.intersect_shape(pt.plane(offset=0.2), phases=water),
        camera=pt.camera((0, -6, 1), (0, 0, 0), fov=30),
        lights=[
            pt.lights.gradient(zenith=(1, 1, 1), horizon=(0.5, 0.5, 0.5), ground="#404040"),
            pt.lights.sphere((2, -2, 4), 0.5, radiance=(20, 20, 20)),
        ],
        meshes=pt.meshes.floor(pt.diffuse(pt.textures.checker(size=0.5)), height=-1.02),
        image=pt.image(width=60, height=40, samples=4),
    )


def several_objects():
    glass, sand = pt.phase("glass", pt.clear(ior=1.5)), pt.phase("sand", pt.diffuse((0.8, 0.6, 0.3)))
    block = pt.box((0.5, 0.5, 0.5))
    turned = np.array([[0, -1, 0, 0.25], [1, 0, 0, 0], [0, 0, 1, 0.1]])
    return pt.Scene(
        # Its tree shares a part, and both trees have parts of the same name.
        objects={"ball": glass(pt.sphere(0.4) | pt.sphere(0.4).translate((0, 0, 0.1))),
                 "cube": (sand(block | block.translate((0, 0, 0.2))), turned)},
        groups={"pair": [pt.instances_of("ball", (0, 0, 0)), pt.instances_of("cube", (1, 0, 0))]},
        instances=[pt.instances_of("pair", [(0, 0, 0), (0, 2, 0)]), pt.instances_of("ball", np.eye(4) * [[0.5], [0.5], [0.5], [1]])],
        camera=pt.camera((0.5, -8, 3), (0.5, 2, 0)),
        lights=pt.lights.gradient(zenith=(1, 1, 1), horizon=(0.7, 0.7, 0.7), ground=(0.2, 0.2, 0.2)),
        image=pt.image(width=60, height=40, samples=2),
    )  # fmt: skip


class ManyObjects(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def test_they_are_equal_when_read_back_and_the_command_agrees(self):
        scene = several_objects()
        scene.save(self.folder / "several.json")
        run("check", self.folder / "several.json")
        again = pt.load(self.folder / "several.json")
        self.assertEqual(again, scene)
        self.assertEqual([len(places) for places in again.instances], [2, 1])
        points = "0.3 0 0.1\n1.25 0.2 0.1\n0.35 2 0\n1.25 2.2 0.1\n-0.1 0 0\n5 5 5\n"
        said = run("eval", self.folder / "several.json", given=points)
        self.assertEqual([row.split(",")[3] for row in said.splitlines()[1:]], ["glass", "sand", "glass", "sand", "glass", "vacuum"])
        image = self.folder / "several.exr"
        run("render", self.folder / "several.json", "-o", image, "--quiet")
        again.render().save(self.folder / "from_python.exr")
        self.assertTrue(filecmp.cmp(image, self.folder / "from_python.exr", shallow=False))

    def test_objects_of_other_files_become_the_scene_s_own(self):
        path = SCENES / "objects" / "hourglasses.json"
        scene = pt.load(path)
        self.assertEqual(scene.instances[0].transforms.shape, (2400, 3, 4))
        self.assertEqual([p.name for p in scene.phases], ["vacuum", "hourglass.glass", "hourglass.sand", "hourglass.wood", "hourglass.brass"])
        few = scene.with_(instances=pt.instances_of("hourglass", scene.instances[0].transforms[:5]))
        few.save(self.folder / "few.json")
        self.assertEqual(pt.load(self.folder / "few.json"), few)
        own, files = (run("trace", p, "--object", "hourglass", given="0 -3 0.5 0 1 0\n") for p in (self.folder / "few.json", path))
        self.assertEqual(own.splitlines(), files.splitlines())
        self.assertGreater(len(own.splitlines()), 5)

    def test_a_phase_may_be_called_as_a_shape(self):
        ball = pt.sphere(1)
        twice = pt.phase("shape 1", pt.diffuse("#808080"))(ball | ball.translate((0, 0, 0.1)))
        scene = pt.Scene(objects={"a": twice, "b": (twice, (3, 0, 0))})
        scene.save(self.folder / "shapes.json")
        self.assertEqual(pt.load(self.folder / "shapes.json"), scene)

    def test_an_object_may_have_materials_of_its_own(self):
        text = """{"version": 1, "phases": {"wood": {"diffuse": {"color": [0.5, 0.3, 0.1]}}},
            "shapes": {"ball": {"set": {"phase": "wood", "of": {"sphere": {"radius": 1}}}}},
            "objects": [{"name": "a", "tree": "ball"},
                        {"name": "b", "tree": "ball", "transform": {"translate": {"by": [3, 0, 0]}},
                         "phases": {"wood": {"clear": {"ior": 1.5}}}}]}"""
        (self.folder / "own.json").write_text(text, encoding="utf-8")
        scene = pt.load(self.folder / "own.json")
        self.assertEqual([(p.name, p.material.kind) for p in scene.phases[1:]], [("wood", "diffuse"), ("b.wood", "clear")])
        self.assertEqual(scene.instances, ())
        np.testing.assert_array_equal(scene.objects["b"][1][:, 3], (3, 0, 0))

    def test_what_cannot_be_is_refused(self):
        ball = pt.phase("glass", pt.clear(ior=1.5))(pt.sphere(1))
        other = pt.phase("glass", pt.clear(ior=1.4))(pt.sphere(1))
        for make, said in (
            (lambda: pt.Scene(), "an object, named objects, or only meshes"),
            (lambda: pt.Scene(ball, objects={"a": ball}), "an object, named objects, or only meshes"),
            (lambda: pt.Scene(ball, instances=pt.instances_of("a", (0, 0, 0))), "place named objects"),
            (lambda: pt.Scene(objects={"a": pt.sphere(1)}), "must be an object of phases"),
            (lambda: pt.Scene(objects={"a": ball, "b": other}), 'different materials for the phase "glass"'),
            (lambda: pt.Scene(objects={"a": (ball, np.zeros((2, 3)))}), "2 maps of its own"),
            (lambda: pt.instances_of("a", np.zeros((2, 2))), r"the shape is \(2, 2\)"),
            (lambda: pt.instances_of("a", (0, np.nan, 0)), "finite"),
            (lambda: pt.instances_of("a", np.ones((4, 4))), "the last row"),
            (lambda: pt.instances_of(ball, (0, 0, 0)), "need the name"),
        ):
            with self.assertRaisesRegex(pt.Error, said):
                make()
        with self.assertRaisesRegex(pt.SceneError, 'did you mean "ball"'):
            several_objects().with_(instances=pt.instances_of("bal", (0, 0, 0))).render()


class Files(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def test_what_cannot_be_saved_leaves_nothing_behind(self):
        (self.folder / "scene.json").mkdir()
        with self.assertRaises(OSError):
            small_scene().save(self.folder / "scene.json")
        self.assertEqual([p.name for p in self.folder.iterdir()], ["scene.json"])

    def test_scenes_are_equal_when_read_back(self):
        for path in gallery_scenes():
            scene = pt.load(path)
            scene.save(self.folder / "again.json")
            again = pt.load(self.folder / "again.json")
            self.assertEqual(again, scene, path.name)
            self.assertEqual(again.object, scene.object)
            if path in gallery_scenes_for_the_command():
                run("check", self.folder / "again.json")
        scene = small_scene()
        scene.save(self.folder / "small.json")
        self.assertEqual(pt.load(self.folder / "small.json"), scene)

    def test_a_scene_may_have_meshes_alone(self):
        scene = pt.Scene(
            meshes=pt.meshes.floor(pt.diffuse((0.5, 0.5, 0.5)), height=0),
            camera=pt.camera((0, -5, 1), (0, 0, 0)),
            lights=pt.lights.gradient(zenith=(1, 1, 1), horizon=(0.5, 0.5, 0.5), ground=(0.2, 0.2, 0.2)),
            image=pt.image(width=8, height=6, samples=1),
        )
        self.assertIn("no object", repr(scene))
        scene.save(self.folder / "meshes.json")
        run("check", self.folder / "meshes.json")
        again = pt.load(self.folder / "meshes.json")
        self.assertEqual(again, scene)
        self.assertIsNone(again.object)
        self.assertGreater(again.render().pixels.min(), 0)
        with self.assertRaisesRegex(pt.Error, "only meshes"):
            scene.with_(meshes=())

    def test_a_medium_s_density_and_temperature_are_voxels(self):
        for i in (1, 2):
            (self.folder / f"layer_{i}.pgm").write_bytes(b"P5 2 1 255\n\x40\xff")
        stack = self.folder / "layer_#.pgm"
        grid = pt.voxels(file=stack, spacing=(1, 1, 1), factor=3)
        heat = pt.voxels(file=stack, spacing=(1, 1, 1), factor=2000)
        fire = pt.clear(ior=1, absorption=(1, 1, 1), emission=(5, 5, 5), density_grid=grid, temperature_grid=heat)
        scene = small_scene().with_(object=pt.phase("fire", fire)(pt.sphere(1.5)))
        scene.save(self.folder / "fire.json")
        self.assertIn('"file": "layer_#.pgm"', (self.folder / "fire.json").read_text())
        self.assertEqual(pt.load(self.folder / "fire.json"), scene)
        with self.assertRaises(pt.Error):
            pt.voxels(file=stack)

    def test_phase_functions_are_parts(self):
        phase_functions = pt.phase_functions
        lobes = phase_functions.mix(
            phase_functions.droplets(diameter=8), second=phase_functions.draine(g=-0.5, alpha=2), amount=0.25
        )
        fog = pt.clear(ior=1, scattering=(1, 1, 1), phase_function=lobes)
        scene = small_scene().with_(object=pt.phase("fog", fog)(pt.sphere(1.5)))
        scene.save(self.folder / "fog.json")
        self.assertIn('"droplets": {', (self.folder / "fog.json").read_text())
        self.assertEqual(pt.load(self.folder / "fog.json"), scene)
        self.assertEqual(pickle.loads(pickle.dumps(lobes)), lobes)
        self.assertEqual(repr(phase_functions.rayleigh()), "rayleigh()")
        for wrong in (
            lambda: phase_functions.droplets(diameter=4.9),
            lambda: phase_functions.droplets(diameter=float("nan")),
            lambda: phase_functions.mix(phase_functions.rayleigh(), phase_functions.rayleigh(), amount=2),
            lambda: phase_functions.mix(phase_functions.rayleigh(), 0.5),
            lambda: pt.clear(ior=1, scattering=(1, 1, 1), anisotropy=0.5, phase_function=lobes),
        ):
            with self.assertRaises(pt.Error):
                wrong()

    def test_a_medium_s_density_is_a_field(self):
        ball = pt.sphere(0.5)
        density = ball.translate((0.4, 0, 0)) | ball.translate((-0.4, 0, 0))
        fog = pt.phase("fog", pt.clear(ior=1, scattering=(9, 9, 9), density=density, density_depth=0.2))
        scene = small_scene().with_(object=fog(pt.sphere(1.5)))
        scene.save(self.folder / "fog.json")
        again = pt.load(self.folder / "fog.json")
        self.assertEqual(again, scene)
        self.assertTrue(np.array_equal(again.render().pixels, scene.render().pixels))
        clear = scene.with_(object=pt.phase("fog", pt.clear(ior=1))(pt.sphere(1.5)))
        self.assertFalse(np.array_equal(clear.render().pixels, scene.render().pixels))

    def test_textures_follow_fields_that_a_file_names(self):
        pond = pt.sphere(1).translate((0, 0, 1))
        sand = pt.coated(
            pt.textures.field(pond | pond.translate((2, 0, 0)), [[0, (0.2, 0.1, 0)], [0.5, "#d0c090"]]),
            roughness=pt.numbers.field(pond, [[0, 0.1], [0.5, 0.9]]),
        )
        scene = pt.Scene(pt.phase("sand", sand)(pt.box((4, 4, 0.2))), camera=pt.camera((0, -6, 1), (0, 0, 0)))
        scene.save(self.folder / "sand.json")
        self.assertEqual(pt.load(self.folder / "sand.json"), scene)
        named = self.folder / "named.json"
        named.write_text(
            """{"version": 1, "shapes": {"round": {"sphere": {"radius": 1}}, "pond": {"translate": {"by": [0, 0, 1],
            "of": "round"}}}, "phases": {"sand": {"diffuse": {"color": {"field": {"of": "pond", "ramp": [[0, [1, 1, 1]]]}}}}},
            "tree": {"set": {"phase": "sand", "of": "round"}}}"""
        )
        loaded = pt.load(named)
        expected = pt.diffuse(pt.textures.field(pond, [[0, [1, 1, 1]]]))
        self.assertEqual(loaded.object.phases[1].material, expected)

    def test_what_differs_is_not_equal(self):
        scene = small_scene()
        self.assertNotEqual(scene, scene.with_(camera=pt.camera((0, -6, 2), (0, 0, 0), fov=30)))
        self.assertNotEqual(scene, scene.with_(lights=scene.lights[:1]))
        self.assertNotEqual(scene, scene.with_(object=scene.object.translate((0, 0, 1e-6))))
        self.assertNotEqual(scene, scene.with_(background=(0, 0, 0)))

    def test_files_beside_a_scene_are_found_from_anywhere(self):
        inside = self.folder / "assets"
        inside.mkdir()
        shutil.copy(SCENES / "assets/bunny.siren.json", inside / "net.json")
        bunny = pt.phase("bunny")(pt.siren(inside / "net.json"))
        before = os.getcwd()
        pt.Scene(bunny).save(self.folder / "bunny.json")
        text = (self.folder / "bunny.json").read_text()
        self.assertIn('"assets/net.json"', text)
        os.chdir("/")
        self.addCleanup(os.chdir, before)
        self.assertEqual(pt.load(self.folder / "bunny.json").object, bunny)
        other = self.folder / "other"
        other.mkdir()
        pt.load(self.folder / "bunny.json").save(other / "bunny.json")
        self.assertEqual(pt.load(other / "bunny.json").object, bunny)

    def test_errors_name_file_line_and_column(self):
        path = self.folder / "bad.json"
        path.write_text('{"version": 1,\n "phases": {"glass": {"clear": {"ior": 1.5}}},\n "tree": {"unde": []}}')
        with self.assertRaises(pt.SceneError) as caught:
            pt.load(path)
        error = caught.exception
        self.assertEqual((error.file, error.line, error.column), (str(path), 3, 11))
        self.assertEqual(error.suggestion, "under")
        self.assertTrue(str(error).startswith(f"{path}:3:11: "))
        with self.assertRaises(pt.SceneError):
            pt.load(self.folder / "nowhere.json")

    def test_no_file_is_left_by_half(self):
        scene = small_scene()
        with self.assertRaises(OSError):
            scene.save(self.folder / "no_folder" / "a.json")
        self.assertEqual(list(self.folder.iterdir()), [])


class Pictures(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def test_pictures_are_the_command_s(self):
        scene = small_scene()
        scene.save(self.folder / "small.json")
        for extension in ("png", "exr"):
            theirs, own = self.folder / f"theirs.{extension}", self.folder / f"own.{extension}"
            run("render", self.folder / "small.json", "-o", theirs, "--quiet")
            pt.load(self.folder / "small.json").render().save(own)
            self.assertTrue(filecmp.cmp(theirs, own, shallow=False), extension)

    def test_arrays(self):
        scene = small_scene()
        image = scene.render()
        self.assertEqual(image.pixels.shape, (40, 60, 3))
        self.assertEqual(image.pixels.dtype, np.float32)
        self.assertGreater(image.pixels.max(), 0)
        self.assertTrue(np.array_equal(scene.render(threads=1).pixels, image.pixels))
        self.assertFalse(np.array_equal(scene.render(seed=1).pixels, image.pixels))
        crop = scene.render(crop=(10, 5, 30, 25))
        self.assertTrue(np.array_equal(crop.pixels, image.pixels[5:25, 10:30]))
        for plane in image.planes.values():
            self.assertEqual(plane.shape, (40, 60))
        self.assertEqual(scene.render(width=20, height=10, samples=1).pixels.shape, (10, 20, 3))
        self.assertEqual(np.asarray(image).shape, (40, 60, 3))

    def test_png_in_notebooks(self):
        for shown in (small_scene().render(samples=1), small_scene()):
            self.assertTrue(shown._repr_png_().startswith(b"\x89PNG"))
        self.assertIsNone(pt.Scene(pt.phase("a")(pt.sphere(1)))._repr_png_())

    def test_progress(self):
        told = []
        small_scene().render(width=200, height=150, samples=32, progress=lambda stage, share: told.append((stage, share)))
        self.assertTrue(told)
        self.assertTrue(all(0 <= share <= 1 for _, share in told))
        with self.assertRaises(ZeroDivisionError):
            small_scene().render(width=400, height=300, samples=4096, progress=lambda stage, share: 1 / 0)

    def test_a_signal_ends_it(self):
        import signal

        was = signal.signal(signal.SIGALRM, signal.default_int_handler)
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        try:
            with self.assertRaises(KeyboardInterrupt):
                small_scene().render(width=2000, height=2000, samples=4096)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, was)

    def test_two_at_once(self):
        scene = small_scene()
        expected = scene.render().pixels
        results = []
        threads = [threading.Thread(target=lambda: results.append(scene.render().pixels)) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(results), 3)
        for result in results:
            self.assertTrue(np.array_equal(result, expected))

    def test_what_is_missing_is_told(self):
        scene = small_scene()
        for expected, call in (
            ("no camera", lambda: scene.with_(camera=None).render()),
            ("no lights", lambda: scene.with_(lights=()).render()),
            ('"b" has no material', lambda: scene.with_(object=pt.phase("b")(pt.sphere(1))).render()),
            ("must lie within", lambda: scene.render(crop=(0, 0, 100, 10))),
            ('"samples" must be', lambda: scene.render(samples=0)),
            ("a light cannot be", lambda: scene.with_(lights=[pt.diffuse("#ffffff")])),
            ("needs an object of phases", lambda: pt.Scene(pt.sphere(1))),
            ("is inside", lambda: scene.with_(object=pt.phase("b", pt.diffuse("#808080"))(pt.sphere(9))).render()),
        ):
            with self.subTest(expected):
                with self.assertRaisesRegex(pt.Error, expected):
                    call()


if __name__ == "__main__":
    unittest.main()
