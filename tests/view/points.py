"""What the page is told about a point of the picture: the surface, the crossings behind it, and the nodes that made it."""

import json
import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from support import COMMAND, SCENE, View, is_ready  # noqa: E402


class Points(unittest.TestCase):
    def test_a_point_tells_the_nodes_that_made_it(self):
        def places(x, y):
            told = json.loads(view.post("ask", {"x": x, "y": y}).body)["path"]
            return [(n["name"], n["line"], n["column"], n["pointer"]) for n in told]
        with View() as view:
            view.ready()
            self.assertEqual(places(64, 32), [("under", 4, 10, "/tree/under"),
                                              ("set", 4, 21, "/tree/under/0/set"),
                                              ("translate", 4, 53, "/tree/under/0/set/of/translate"),
                                              ("sphere", 3, 21, "/shapes/ball/sphere")])
            self.assertEqual(places(32, 32)[2], ("translate", 5, 54, "/tree/under/1/set/of/translate"))
            self.assertEqual(places(1, 1), [])
            # What the view itself cuts with is in no file.
            view.post("change", {"cut": {"normal": [0, -1, 0], "offset": 0}})
            view.wait_for(lambda s: is_ready(s) and s["cut"])
            self.assertEqual(places(64, 32), [("intersect_shape", 0, 0, ""), ("plane", 0, 0, "")])

    def test_nodes_of_objects_with_phases_of_their_own_stand_where_their_files_have_them(self):
        objects = """"objects": [
  {"name": "taken", "file": "ball.json", "transform": {"translate": {"by": [0.6, 0, 0]}}},
  {"name": "own", "phases": {"wood": {"diffuse": {"color": [0.1, 0.1, 0.5]}}},
   "tree": {"set": {"phase": "wood", "of": {"translate": {"by": [-0.6, 0, 0], "of": "ball"}}}}}]"""
        text = SCENE[:SCENE.index('"tree"')] + objects + SCENE[SCENE.index(',\n"lights"'):]

        class WithBall(View):
            def prepare(self):
                ball = '{"version": 1, "phases": {"wood": {"clear": {"ior": 1.5}}},\n"tree": {"set": {"phase": "wood", "of": {"sphere": {"radius": 0.5}}}}}'
                (self.file.parent / "ball.json").write_text(ball, encoding="utf-8")

        with WithBall(text) as view:
            view.ready()

            def places(x, y):
                told = json.loads(view.post("ask", {"x": x, "y": y}).body)
                return told["met"], [(n["name"], pathlib.Path(n["file"]).name, n["line"], n["column"], n["pointer"]) for n in told["path"]]
            # What holds the objects together and what places them is in no file.
            self.assertEqual(places(64, 32), ("taken.wood", [("over", "", 0, 0, ""), ("translate", "", 0, 0, ""),
                                                             ("set", "ball.json", 2, 10, ""), ("sphere", "ball.json", 2, 42, "")]))
            own = [("over", "", 0, 0, ""), ("set", "scene.json", 7, 13, "/objects/1/tree/set"),
                   ("translate", "scene.json", 7, 45, "/objects/1/tree/set/of/translate"),
                   ("sphere", "scene.json", 3, 21, "/shapes/ball/sphere")]
            self.assertEqual(places(32, 32), ("own.wood", own))
            # Nodes of which nothing is left are not taken for others that are made where they were.
            for by in (0.61, 0.625, 0.7):
                view.post("change", {"numbers": {"/objects/0/transform/translate/by/0": by}})
                view.wait_for(lambda s, v=by: is_ready(s) and v in s["numbers"].values())
                self.assertEqual(places(32, 32), ("own.wood", own))
            # Numbers that stand there for the file's own, but longer, shift no place of the file.
            view.post("change", {"numbers": {"/objects/1/tree/set/of/translate/by/0": -0.5625, "/phases/glass/clear/ior": 1.50001}})
            view.wait_for(lambda s: is_ready(s) and -0.5625 in s["numbers"].values())
            self.assertEqual(places(32, 32), ("own.wood", own))

    def test_a_point_tells_what_trace_and_eval_tell(self):
        with View() as view:
            view.ready()
            told = json.loads(view.post("ask", {"x": 34, "y": 32}).body)
            self.assertEqual(told["met"], "glass")
            ray = " ".join(map(str, told["origin"] + told["direction"]))
            traced = subprocess.run([COMMAND, "trace", str(view.file)], input=ray, capture_output=True, text=True, check=True, timeout=60)
            lines = [line.split(",") for line in traced.stdout.splitlines()[2:]]
            self.assertEqual([(c["from"], c["to"]) for c in told["crossings"]], [(n[2], n[3]) for n in lines])
            for crossing, line in zip(told["crossings"], lines):
                self.assertAlmostEqual(crossing["distance"], float(line[1]), delta=1e-4)
            self.assertEqual([d["phase"] for d in told["distances"]], ["vacuum", "glass", "wood"])
            # The position is the near end of the bracket, which is still in the vacuum.
            self.assertLess(told["distances"][0]["phi"], 0)
            self.assertAlmostEqual(told["distances"][1]["phi"], 0, delta=1e-4)


if __name__ == "__main__":
    unittest.main()
