"""The functions of the package are those of the library's lists, with their names, defaults and documentation."""

import inspect
import json
import pathlib
import unittest

import numpy as np
import phasetree as pt
from phasetree import _parts, _phasetree, _reference, _stubs, _trees
from support import ROOT, SCENES, calls, run, without_comments


class ListOfNodes(unittest.TestCase):
    def test_every_node_is_a_function(self):
        schema = json.loads(run("nodes", "--json-schema"))["definitions"]
        for of in ("field", "object"):
            nodes = schema[of]["anyOf"][1]["properties"]
            self.assertGreater(len(nodes), 40)
            for name, node in nodes.items():
                function = getattr(pt, name)
                node = node.get("anyOf", [node])[0]
                names = {_reference.python_name(n) for n in node["properties"]}
                # A warp of an object says more than one of a field.
                self.assertLessEqual(names, set(inspect.signature(function).parameters), name)
                self.assertIn(pt.Field if of == "field" else pt.Object, function.makes, name)

    def test_documentation_is_that_of_the_list(self):
        for chapter in _phasetree.chapters():
            for page in chapter["kinds"] if chapter["title"] in ("Fields", "Warps") else ():
                function = getattr(pt, page["name"])
                if chapter["title"] == "Fields" and pt.Object in function.makes:
                    continue  # documented as the object's
                for text in (page["summary"], page["equation"], *(p["description"] for p in page["parameters"])):
                    self.assertIn(text, function.__doc__, page["name"])
                if page["section"]:
                    self.assertIn(f"Section {page['section']}", function.__doc__)
                for p in page["parameters"]:
                    argument = inspect.signature(function).parameters[_reference.python_name(p["name"])]
                    is_required = argument.default is argument.empty
                    self.assertEqual(is_required, not p["optional"], f"{page['name']}: {p['name']}")
                    hash(argument.default)  # Nobody can change it for all others.
                    if p["optional"] and p["type"] == "number":
                        self.assertEqual(argument.default, json.loads(p["default"]))

    def test_build_is_that_of_the_command(self):
        self.assertEqual(run("--version").splitlines()[0], f"phasetree {pt.build_id}")
        self.assertTrue(pt.build_id.startswith(pt.__version__ + "+"))

    def test_names_do_not_clash(self):
        nodes = set(_trees.functions)
        for module in ("materials",):
            self.assertFalse(nodes & set(vars(getattr(pt, module))) - {"__doc__"})
        for name in nodes:
            self.assertFalse(hasattr(_trees, name) and not name.startswith("_"), name)

    def test_every_example_by_calls_is_the_file_s_tree(self):
        studio = (SCENES / "nodes/studio.json").read_text(encoding="utf-8")
        count = 0
        for path in sorted((SCENES / "nodes").glob("*/*.json")):
            with self.subTest(path.stem):
                text = studio.replace("@TREE@", path.read_text(encoding="utf-8"))
                scene = without_comments(text)
                phases = {name: pt.phase(name) for name in scene["phases"]}
                phases["vacuum"] = pt.vacuum
                try:
                    made = calls(scene["tree"], scene["shapes"], phases, SCENES / "nodes")
                except pt.Error as error:
                    if "built without OpenVDB" not in str(error):
                        raise
                    self.skipTest(str(error))
                made = made.with_phases(*phases.values())
                handle, _ = _phasetree.read_text(text, str(SCENES / "nodes/studio.json"))
                own = _phasetree.with_files(made.to_json(), "own", lambda f: pathlib.Path(f).name)
                names = list(made.names[1:])
                file = _phasetree.with_files(
                    handle.text(names, ["null"] * len(names)), "file", lambda f: pathlib.Path(f).name
                )
                self.assertEqual(own, file)
                count += 1
        self.assertGreater(count, 90)

    def test_parts_are_those_of_the_list(self):
        for chapter in _phasetree.chapters():
            for page in chapter["kinds"] if chapter["title"] in _parts.kinds else ():
                # Where there is one kind only it is a function of the package.
                alone = {"Render settings": pt.image, "Normal maps": pt.normal_map, "Voxel grids": pt.voxels}
                function = alone.get(chapter["title"]) or getattr(getattr(pt, _parts.module_name(chapter["title"])), page["name"])
                self.assertIn(page["summary"], function.__doc__)
                for p in page["parameters"]:
                    self.assertIn(_reference.python_name(p["name"]), inspect.signature(function).parameters)

    def test_stubs_are_those_of_the_list(self):
        stub = ROOT / "plugins/python/phasetree/__init__.pyi"
        self.assertTrue(
            stub.read_text(encoding="utf-8") == _stubs.text(),
            "the stubs are of another list: python3 -m phasetree._stubs > plugins/python/phasetree/__init__.pyi",
        )
        compile(_stubs.text(), str(stub), "exec")

    def test_arrays_are_parameters(self):
        points = np.array([[0, 0, 0], [0, 0, 1], [1, 0, 1]], dtype=np.float64)
        self.assertEqual(pt.polyline(points, 0.1), pt.polyline(points.tolist(), 0.1))
        self.assertEqual(pt.sphere(np.float32(0.1)), pt.sphere(float(np.float32(0.1))))


if __name__ == "__main__":
    unittest.main()
