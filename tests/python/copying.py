"""Copies and pickles: of every public class, of every function, and through processes that start afresh."""

import copy
import importlib
import inspect
import multiprocessing
import pathlib
import pickle
import pkgutil
import tempfile
import unittest

import numpy as np
import support

import phasetree as pt
from phasetree._values import Value

GLASS = pt.phase("glass", pt.clear(ior=1.5))
WATER = pt.phase("water", pt.clear(ior=1.33, absorption=(0.3, 0.1, 0.05)))
BALL = pt.sphere(1).smooth(0.4) | pt.capsule((0, 0, 0), (0, 0, 1.5), 0.3)
BOTTLE = BALL.thin_shell(GLASS, WATER, half_thickness=0.1)
LAYERS = pt.principled((0.5, 0.1, 0.1), base_metalness=0.3, coat_weight=1, fuzz_weight=pt.numbers.field(pt.sphere(1), [(0, 0), (1, 0.5)]))
CAMERA = pt.camera((0, -6, 1), look_at=(0, 0, 0.3))
SKY = pt.lights.gradient((1, 1, 1), (0.7, 0.7, 0.7), (0.2, 0.2, 0.2))
FLOOR = pt.meshes.floor(pt.coated(pt.textures.speckle((0.2, 0.1, 0.1), (0.4, 0.2, 0.2))), height=-1.2)
SCENE = pt.Scene(BOTTLE, CAMERA, SKY, FLOOR, image=pt.image(24, 16, samples=2), background=(0, 0, 0))
POINTS = np.random.default_rng(1).uniform(-1.5, 1.5, (200, 3)).astype(np.float32)
UP = np.tile(np.float32([0, 0, 1]), (len(POINTS), 1))


def scene_error():
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "scene.json"
        file.write_text('{"version": 1, "phases": {"a": {"claer": {"ior": 1}}}, "tree": {}}')
        try:
            pt.load(file)
        except pt.SceneError as error:
            return error
    raise AssertionError("the scene is wrong")


def examples():
    """For each public class its values, or the start of the TypeError that says why it cannot be copied."""
    x, y, z = pt.coordinates()
    with pt.view(SCENE, open=False) as view:
        view.close()
    several = pt.Scene(
        camera=CAMERA, lights=SKY, objects={"a": BOTTLE, "b": (GLASS(pt.sphere(0.3)), (3, 0, 0))},
        groups={"row": [pt.instances_of("a", POINTS[:3] * 10)]}, instances=pt.instances_of("row", np.eye(4)), name="several",
    )  # fmt: skip
    chain = x
    for i in range(3000):
        chain = chain + i * y
    return {
        "Closest": [BOTTLE.closest(POINTS)],
        "Crossings": [BOTTLE.trace(POINTS, UP)],
        "Error": [pt.Error("what is wrong")],
        "Expression": [x, pt.sqrt(x**2 + y * y) - 1.5, (x**2 + z - 1).within(-2, (1, 2, 3)), chain],
        "Field": [BALL, BALL.smooth(0.2), pt.sphere(1) | pt.box((1, 2, 3)), pt.extrude(pt.polygon([(0, 0), (1, 0), (0, 1)]), 1)],
        "Hits": [BOTTLE.intersect(POINTS, UP)],
        "NextCrossings": [BOTTLE.next_crossing(POINTS, UP)],
        "Image": [SCENE.render(planes=["depth"])],
        "Interrupted": [pt.Interrupted(("known", 2))],
        "Measures": [BOTTLE.measure(tolerance=0.3)],
        "Object": [BOTTLE, pt.phase("bare")(BALL), BOTTLE.with_phases(WATER, GLASS)],
        "Part": [GLASS.material, LAYERS, SKY, FLOOR, CAMERA, SCENE.image, pt.textures.speckle((0, 0, 0), (1, 1, 1))],
        "Phase": [GLASS, pt.phase("bare"), pt.vacuum],
        "PhaseMesh": [BOTTLE.mesh(0.3)],
        "Proof": BOTTLE.prove({"present": {"phase": BOTTLE.names[1]}}, {"closed": {"walls": BOTTLE.names[1], "around": BOTTLE.names[2]}}),
        "Instances": [pt.instances_of("a", POINTS)],
        "Scene": [SCENE, several, pt.Scene(BOTTLE)],
        "SceneError": [scene_error()],
        "Solution": [pt.solve(lambda radius: WATER(pt.sphere(radius)), 1, 0.3, 1, tolerance=0.1)],
        "View": [(view, "a View can be neither copied nor pickled")],
    }


def public_classes():
    """Those of the package's modules, but for what only describes its lists (_reference) and the common base class."""
    found = {}
    for module in pkgutil.iter_modules(pt.__path__):
        if module.name in ("_phasetree", "_reference", "_stubs"):
            continue
        for name, cls in vars(importlib.import_module(f"phasetree.{module.name}")).items():
            if inspect.isclass(cls) and cls.__module__.split(".")[0] == "phasetree" and not name.startswith("_"):
                found[name] = cls
    return {name: cls for name, cls in found.items() if cls is not Value and cls.__module__ != "phasetree._reference"}


def pickled(value, protocol=pickle.HIGHEST_PROTOCOL):
    return pickle.loads(pickle.dumps(value, protocol))


def label(object, points):
    return object.label(points)


def distance(field, points):
    return field.distance(points)


def pixels(scene):
    return scene.render(threads=1).pixels


class Values(unittest.TestCase):
    def assert_same(self, a, b):
        self.assertIs(type(a), type(b))
        if isinstance(a, tuple):
            for one, other in zip(a, b, strict=True):
                if isinstance(one, list):
                    self.assertEqual(one, other)
                else:
                    np.testing.assert_array_equal(one, other)
        elif isinstance(a, BaseException):
            self.assertEqual((str(a), vars(a)), (str(b), vars(b)))
        else:
            self.assertEqual(a, b)
            self.assertEqual(repr(a), repr(b))

    def test_every_public_class(self):
        values, classes = examples(), public_classes()
        self.assertEqual(sorted(classes), sorted(values), "each public class has examples here")
        for name in pt.__all__:
            if inspect.isclass(getattr(pt, name)):
                self.assertIn(name, classes)
        ways = [copy.copy, copy.deepcopy, *(lambda v, p=p: pickled(v, p) for p in range(2, pickle.HIGHEST_PROTOCOL + 1))]
        for name, several in values.items():
            for value in several:
                for way in ways:
                    with self.subTest(name=name, value=value, way=way):
                        if isinstance(value, tuple) and name == "View":
                            with self.assertRaisesRegex(TypeError, value[1]):
                                way(value[0])
                            continue
                        self.assertIsInstance(value, classes[name])
                        self.assert_same(way(value), value)

    def test_what_is_not_equal(self):
        x, y, _ = pt.coordinates()
        image = SCENE.render()
        other = copy.deepcopy(image)
        other.pixels[0, 0, 0] += 1
        for a, b in ((x + y, y + x), (x, x.within(-1, 1)), (image, other), (image, None), (x, None)):
            self.assertNotEqual(a, b)
        self.assertEqual(len({x + y, x + y, y}), 2)

    def test_a_smooth_seam_is_kept(self):
        self.assertEqual(pickled(pt.sphere(1).smooth(0.3)) | pt.torus(1, 0.2), pt.sphere(1).smooth(0.3) | pt.torus(1, 0.2))

    def test_deep_and_shared_trees(self):
        deep, shared = pt.sphere(1), pt.sphere(0.1)
        for i in range(390):
            deep = deep.translate((0.001, 0, 0))
        for i in range(30):  # a billion spheres
            shared = shared | shared.translate((0.2, 0, 0))
        self.assertEqual(pickled(deep), deep)
        self.assertEqual(pickled(shared).nodes, shared.nodes)

    def test_scenes_of_the_gallery(self):
        for file in support.gallery_scenes()[::4]:
            with self.subTest(file=file.name):
                scene = pt.load(file)
                again = pickled(scene)
                self.assertEqual(again, scene)
                if scene.object is not None:
                    self.assertEqual(again.object, scene.object)
                    np.testing.assert_array_equal(again.object.label(POINTS), scene.object.label(POINTS))

    def test_functions(self):
        for namespace in (pt.materials, pt.textures, pt.numbers, pt.lights, pt.meshes, pt.cameras):
            for function in vars(namespace).values():
                if callable(function):
                    self.assertIs(pickled(function), function)
        for name in pt.__all__:
            if inspect.isfunction(getattr(pt, name)):
                self.assertIs(pickled(getattr(pt, name)), getattr(pt, name))


class Processes(unittest.TestCase):
    def test_processes_that_start_afresh(self):
        x, y, z = pt.coordinates()
        formula = (pt.sqrt(x**2 + y**2) - 0.5 - 0.1 * pt.sin(3 * z)).within(-2, 2)
        with multiprocessing.get_context("spawn").Pool(2) as pool:
            labels = pool.starmap(label, [(BOTTLE, part) for part in np.array_split(POINTS, 4)])
            distances = pool.starmap(distance, [(BALL, POINTS), (formula, POINTS)])
            pictures = pool.map(pixels, [SCENE, SCENE.with_(object=GLASS(BALL))])
            (made,) = pool.map(pt.sphere, [1.5])
        np.testing.assert_array_equal(np.concatenate(labels), BOTTLE.label(POINTS))
        np.testing.assert_array_equal(distances[0], BALL.distance(POINTS))
        np.testing.assert_array_equal(distances[1], formula.distance(POINTS))
        np.testing.assert_array_equal(pictures[0], pixels(SCENE))
        np.testing.assert_array_equal(pictures[1], pixels(SCENE.with_(object=GLASS(BALL))))
        self.assertEqual(made, pt.sphere(1.5))


if __name__ == "__main__":
    unittest.main()
