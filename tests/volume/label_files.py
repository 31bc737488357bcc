"""`phasetree export` to NRRD and OpenVDB: each voxel has the label that `phasetree eval` gives for its centre.

NRRD is read by a few lines below; OpenVDB by the node `labels`, which reads it with the library.
"""

import gzip
import json
import os
import pathlib
import signal
import struct
import subprocess
import tempfile
import time
import unittest

COMMAND = os.environ["PHASETREE_COMMAND"]
SCENE = {
    "version": 1,
    "unit": "mm",
    "phases": {"glass": {"clear": {"ior": 1.5}}, "a \\ b": {"diffuse": {"color": [0.5, 0.25, 0]}}},
    "tree": {"over": [
        {"set": {"phase": "a \\ b", "of": {"translate": {"by": [4, 1, 0], "of": {"sphere": {"radius": 3}}}}}},
        {"thin_shell": {"of": {"box": {"size": [9, 6, 4]}}, "shell": "glass", "inside": "a \\ b", "half_thickness": 0.5}},
    ]},
}


def nrrd(path):
    """The header, the keys and the voxels, x fastest."""
    data = path.read_bytes()
    head, body = data.split(b"\n\n", 1)
    lines = head.decode().split("\n")
    assert lines[0] == "NRRD0005", lines[0]
    fields, keys = {}, {}
    for line in lines[1:]:
        if line.startswith("#"):
            continue
        if ":=" in line:
            key, value = line.split(":=", 1)
            keys[key] = value.replace("\\\\", "\\")
        else:
            field, value = line.split(": ", 1)
            fields[field] = value
    assert fields["encoding"] == "gzip" and fields["type"] == "uint8"
    return fields, keys, gzip.decompress(body)


def numbers(text):
    return [float(x) for x in text.strip("()").split(",")]


class LabelFiles(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)
        (self.path / "scene.json").write_text(json.dumps(SCENE), encoding="utf-8")

    def run_command(self, *words, text=None):
        return subprocess.run([COMMAND, *words], cwd=self.path, input=text, capture_output=True, text=True, check=False)

    def labels_at(self, scene, points):
        # The labels are those of the centres in 32 bits.
        rounded = [struct.unpack("3f", struct.pack("3f", *p)) for p in points]
        text = "".join("%.9g %.9g %.9g\n" % p for p in rounded)
        lines = self.run_command("eval", scene, text=text).stdout.splitlines()[1:]
        return [line.split(",")[3] for line in lines]

    def centres(self, fields):
        sizes = [int(n) for n in fields["sizes"].split()]
        steps = [numbers(v) for v in fields["space directions"].split()]
        origin = numbers(fields["space origin"])
        return [[origin[i] + (x, y, z)[i] * steps[i][i] for i in range(3)]
                for z in range(sizes[2]) for y in range(sizes[1]) for x in range(sizes[0])]

    def test_nrrd(self):
        done = self.run_command("export", "scene.json", "-o", "labels.seg.nrrd", "--spacing", "0.375")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        fields, keys, voxels = nrrd(self.path / "labels.seg.nrrd")
        self.assertEqual(fields["space units"], '"mm" "mm" "mm"')
        names = ["vacuum", keys["Segment0_Name"], keys["Segment1_Name"]]
        self.assertEqual(names, ["vacuum", "glass", "a \\ b"])
        self.assertEqual((keys["Segment1_LabelValue"], keys["Segment1_Color"].count(" ")), ("2", 2))
        centres = self.centres(fields)
        self.assertEqual(len(centres), len(voxels))
        self.assertEqual(numbers(fields["space directions"].split()[0]), [0.375, 0, 0])
        comments = [line for line in (self.path / "labels.seg.nrrd").read_bytes().split(b"\n") if line.startswith(b"#")]
        self.assertEqual(comments, [b"# Labels of phases at the centres of voxels: 0 vacuum, 1 glass, 2 a \\\\ b",
                                    b"# Coordinates are those of the scene"])
        found = [names[v] for v in voxels]
        self.assertTrue(found == self.labels_at("scene.json", centres))
        self.assertTrue(all(found.count(name) > 100 for name in names))
        # The grid covers the object: its outermost voxels reach beyond the bounds.
        self.assertTrue(min(c[0] for c in centres) - 0.1875 <= -5 and max(c[0] for c in centres) + 0.1875 >= 7)

    def test_scale(self):
        self.run_command("export", "scene.json", "-o", "a.nrrd", "--spacing", "0.5")
        self.run_command("export", "scene.json", "-o", "b.nrrd", "--spacing", "0.5", "--scale", "3")
        (a, _, plain), (b, _, scaled) = nrrd(self.path / "a.nrrd"), nrrd(self.path / "b.nrrd")
        self.assertIn(b"# Coordinates are those of the scene, multiplied by 3\n", (self.path / "b.nrrd").read_bytes())
        self.assertEqual(plain, scaled)
        self.assertNotIn("space units", b)
        for x, y in zip(numbers(a["space origin"]), numbers(b["space origin"])):
            self.assertAlmostEqual(3 * x, y, places=6)

    def test_openvdb(self):
        done = self.run_command("export", "scene.json", "-o", "labels.vdb", "--spacing", "0.375")
        if "without OpenVDB" in done.stderr:
            self.skipTest("this build has no OpenVDB")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.run_command("export", "scene.json", "-o", "labels.nrrd", "--spacing", "0.375")
        read = dict(SCENE, tree={"labels": {"file": "labels.vdb", "phases": ["glass", "a \\ b"], "smoothing": 0}})
        (self.path / "read.json").write_text(json.dumps(read), encoding="utf-8")
        fields, _, voxels = nrrd(self.path / "labels.nrrd")
        names = ["vacuum", "glass", "a \\ b"]
        self.assertTrue(self.labels_at("read.json", self.centres(fields)) == [names[v] for v in voxels])
        content = (self.path / "labels.vdb").read_bytes()
        for text in (b"labels", b"phase_2", b"a \\ b", b"unit"):
            self.assertIn(text, content)

    def test_mistakes(self):
        for words, said in (
            (["-o", "a.nrrd", "--spacing", "1e-4"], "use a larger --spacing or --max-memory"),
            (["-o", "a.nrrd", "--max-memory", "1K"], "the limit is"),
            (["-o", "a.nrrd", "--phase", "glass"], "--phase is for triangles"),
            (["-o", "a.nrrd", "--grid", "3"], "--grid is for .glsl"),
            (["-o", "scene.json/a.nrrd"], "a.nrrd"),
        ):
            done = self.run_command("export", "scene.json", *words)
            self.assertIn(done.returncode, (1, 2), words)
            self.assertIn(said, done.stderr)
        self.assertEqual([p.name for p in self.path.iterdir()], ["scene.json"])

    def test_interruption(self):
        process = subprocess.Popen([COMMAND, "export", "scene.json", "-o", "a.nrrd", "--spacing", "0.012"],
                                   cwd=self.path, stderr=subprocess.PIPE, text=True)
        time.sleep(2)
        process.send_signal(signal.SIGINT)
        said = process.communicate()[1]
        # Unless it was done, or had not begun.
        if process.returncode not in (0, -signal.SIGINT):
            self.assertIn("no file was written", said)
            self.assertEqual(process.returncode, 130)
        if process.returncode != 0:
            self.assertEqual([p.name for p in self.path.iterdir()], ["scene.json"])


if __name__ == "__main__":
    unittest.main()
