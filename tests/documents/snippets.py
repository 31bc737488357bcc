"""Every fenced block of the front page, the manual and the plugins' documents is run or checked.

What is done follows from the block's language, and from a comment `<!-- test: … -->` directly above it:

  json, jsonc   A whole scene is checked and rendered, small. Members of a scene are added to a plain one and checked.
                `phases`: the block has members of "phases". `step`: its members replace those of the scene before it in
                the same document, and the result is checked and rendered. `step = FILE`: it is also what is in that file.
  sh            Run by bash in a folder of its own, where pictures are small and cmake, sbatch and the like are stubs
                that check their arguments (stubs/). `with FILE`: the scene above is in that file. `then`: run in the folder
                of the block before it in the same document.
  console       Lines that begin with `$ ` are run; what follows them must be their output.
  python        All blocks of a document are run, one after the other, with small pictures.
  text          `output`: part of what the document's Python blocks print.
  c             `main`: statements of a main() with an Embree device and scene. Compiled, linked, run.
  cpp           `program`: a whole program. `step`: its functions and structs replace those of the program before it, or
                are added to it. Compiled, linked, and run with a scene and a picture, which must change with each step.
                `step = FILE`: the program is also what is in that file.
  any           `excerpt FILE`: the block stands in that file, which other tests compile or run.
                `none, REASON`: it cannot be run.

The pages of the scene reference show examples, each of which is rendered in its studio.
"""

import importlib.util
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import textwrap
import unittest

import forked
from markdown import ROOT, Block, blocks, without_comments

STUBS = pathlib.Path(__file__).parent / "stubs"
REFERENCE = ROOT / "scenes/reference"
DOCUMENTS = sorted([ROOT / "README.md", ROOT / "scenes/README.md", ROOT / "plugins/embree/README.md",
                    ROOT / "plugins/python/README.md", ROOT / "plugins/blender/README.md", *(ROOT / "tracer/manual").rglob("*.md")])
ALL = [block for document in DOCUMENTS for block in blocks(document)]
# Blocks that no test runs. Raise this only for something that cannot be run at all.
MOST_UNTESTED = 6

# The comments that may stand above a block of each language; "" is none. Any block may be an excerpt, or untested.
FORMS: dict[str, tuple[str, ...]] = {
    "json": ("", "phases", "step"), "jsonc": ("", "phases", "step"), "sh": ("", "with", "then"), "console": ("",), "python": ("",),
    "c": ("main",), "cpp": ("program", "step"), "cmake": (), "rooms": ("",), "text": ("", "output"),
}

PLAIN = {
    "version": 1,
    "phases": {"paper": {"diffuse": {"color": [0.5, 0.5, 0.5]}}},
    "tree": {"set": {"phase": "paper", "of": {"sphere": {"radius": 1}}}},
    "lights": [{"constant": {}}],
    "camera": {"position": [0, -8, 2], "look_at": [0, 0, 0]},
}


def sandbox(folder: str) -> dict[str, str]:
    """Makes a folder look like the repository's root, and returns the environment for commands in it."""
    for entry in ROOT.iterdir():
        if entry.name != ".git" and not (pathlib.Path(folder) / entry.name).exists():
            (pathlib.Path(folder) / entry.name).symlink_to(entry)
    return {**os.environ, "PATH": f"{STUBS}:{os.environ['PATH']}", "PHASETREE_ROOT": str(ROOT),
            "REAL_PYTHON": sys.executable}


def parsed(block: Block):
    text = without_comments(block.text).strip().rstrip(",")
    try:
        return json.loads(text if text.startswith("{") else "{" + text + "}")
    except json.JSONDecodeError as e:
        raise AssertionError(f"{block}: {e}") from None


def row_of(phases) -> dict:
    """A tree with a sphere of each phase."""
    spheres = [{"set": {"phase": name, "of": {"translate": {"by": [3 * i, 0, 0], "of": {"sphere": {"radius": 1}}}}}}
               for i, name in enumerate(phases)]
    return {"over": spheres} if len(spheres) > 1 else spheres[0]


def completed(members: dict) -> dict:
    """A whole scene that has these members."""
    scene = {**PLAIN, **members}
    if "objects" in members:
        del scene["tree"]
        if "phases" not in members:
            del scene["phases"]
    elif "phases" in members and "tree" not in members:
        scene["tree"] = row_of(members["phases"])
    return scene


def text_of_scene(above: list[Block]) -> str:
    """The scene after the last of these blocks, with all steps that lead to it."""
    if not above[-1].directive.startswith("step"):
        return above[-1].text
    first = max(i for i, b in enumerate(above) if not b.directive.startswith("step"))
    scene: dict = {}
    for block in above[first:]:
        scene |= parsed(block)
    return json.dumps(scene)


# A function or struct at the beginning of a line, with the comments above it; its name is in one of the groups.
DEFINITION = re.compile(r"^(?://[^\n]*\n)*(?:struct (\w+)|[\w:<> ]+ (\w+)\([^;{]*\)) \{\n.*?^\};?\n", re.M | re.S)


def with_definitions(program: str, block: Block) -> str:
    """A program whose functions and structs are replaced by those of a block. New ones go before the next known one."""
    found = list(DEFINITION.finditer(block.text))
    assert "".join(m.group(0) for m in found).split() == block.text.split(), f"{block}: more than functions and structs"
    new = ""
    for match in found:
        name = match.group(1) or match.group(2)
        old = [m for m in DEFINITION.finditer(program) if name in m.groups()]
        new += match.group(0)
        if old:
            program = program[: old[0].start()] + new + program[old[0].end() :]
            new = ""
        else:
            new += "\n"
    assert not new, f"{block}: what comes last must replace something"
    return program


def setUpModule() -> None:
    server = forked.server()
    server.__enter__()
    unittest.addModuleCleanup(server.__exit__, None, None, None)


class Snippets(unittest.TestCase):
    def of(self, *languages: str, directive: str | None = None) -> list[Block]:
        """The blocks in these languages, of which there must be some."""
        found = [b for b in ALL if b.language in languages and (directive is None or b.directive == directive)]
        self.assertTrue(found)
        return found

    def run_scene(self, block: Block, scene: dict, render: bool) -> None:
        arguments = ["render", "-", "--spp", "1", "--size", "32x24", "--quiet", "-o", os.devnull + ".png"]
        with tempfile.TemporaryDirectory() as folder:
            arguments[-1] = f"{folder}/picture.png"
            # Rendering checks the scene too, except for its "expect".
            for words in [*([["check", "-"]] if not render or "expect" in scene else []), *([arguments] if render else [])]:
                done = forked.run(words, json.dumps(scene), cwd=ROOT / "scenes")
                self.assertEqual(done.returncode, 0, f"{block}\n{done.stderr}{done.stdout}")

    def test_languages_are_known(self):
        """A misspelt language or comment would leave a block untested."""
        self.assertGreater(len(ALL), 50)
        for block in ALL:
            self.assertIn(block.language, FORMS, block)
            form = re.split(r" = |[ ,]", block.directive)[0]
            self.assertIn(form, ("excerpt", "none", *FORMS[block.language]), block)

    def test_few_blocks_are_untested(self):
        untested = [b for b in ALL if b.directive.startswith("none")]
        for block in untested:
            self.assertRegex(block.directive, r"^none, .{10}", block)
        self.assertLessEqual(len(untested), MOST_UNTESTED, [str(b) for b in untested])

    def test_excerpts_stand_in_their_files(self):
        excerpts = [b for b in ALL if b.directive.startswith("excerpt ")]
        self.assertGreater(len(excerpts), 2)
        for block in excerpts:
            whole = (ROOT / block.directive.removeprefix("excerpt ")).read_text(encoding="utf-8")
            lines = [line.strip() for line in whole.splitlines()]
            wanted = [line.strip() for line in block.text.splitlines()]
            self.assertTrue(
                any(lines[i : i + len(wanted)] == wanted for i in range(len(lines))),
                f"{block}: not an excerpt of {block.directive.removeprefix('excerpt ')}",
            )

    def test_scenes(self):
        before: dict[pathlib.Path, dict] = {}
        for block in self.of("json", "jsonc"):
            if block.directive.startswith("none"):
                continue
            with self.subTest(str(block)):
                members = parsed(block)
                is_step, _, result = block.directive.partition(" = ")
                if is_step == "step":
                    scene = {**before[block.path], **members}
                elif block.directive == "phases":
                    scene = completed({"phases": members})
                else:
                    scene = members if "version" in members else completed(members)
                before[block.path] = scene
                if result:
                    self.assertEqual(scene, json.loads(without_comments((ROOT / result).read_text(encoding="utf-8"))), block)
                self.run_scene(block, scene, "version" in members or is_step == "step")

    def test_shell(self):
        folders: dict[pathlib.Path, tempfile.TemporaryDirectory] = {}
        for block in self.of("sh"):
            form, _, name = block.directive.partition(" ")
            if form not in ("", "with", "then"):
                continue
            if form != "then":
                folders[block.path] = tempfile.TemporaryDirectory()
                self.addCleanup(folders[block.path].cleanup)
            folder = folders[block.path].name
            with self.subTest(str(block)):
                if form == "with":
                    above = [b for b in self.of("json") if b.path == block.path and b.line < block.line]
                    (pathlib.Path(folder) / name).write_text(text_of_scene(above), encoding="utf-8")
                done = subprocess.run(["/bin/bash", "-eo", "pipefail", "-c", block.text], cwd=folder,
                                      env=sandbox(folder), capture_output=True, text=True, timeout=600)
                self.assertEqual(done.returncode, 0, f"{block}\n{done.stdout}{done.stderr}")

    def test_consoles(self):
        for block in self.of("console", directive=""):
            with self.subTest(str(block)), tempfile.TemporaryDirectory() as folder:
                environment = sandbox(folder)
                for line, output in re.findall(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", block.text, re.M):
                    done = subprocess.run(["/bin/bash", "-c", line], cwd=folder, env=environment,
                                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
                    self.assertEqual(done.stdout, output, block)

    def test_python(self):
        for document in DOCUMENTS:
            parts = [b for b in blocks(document) if b.language == "python" and not b.directive]
            for block in parts:
                compile(block.text, str(block), "exec")
            if not parts or not importlib.util.find_spec("phasetree"):
                continue
            with self.subTest(str(document)), tempfile.TemporaryDirectory() as folder:
                prelude = "import sys; sys.path.insert(0, %r); import small_pictures\n" % str(STUBS)
                script = prelude + "".join(f"# {b}\n{b.text}" for b in parts)
                done = subprocess.run([sys.executable, "-c", script], cwd=folder, env=sandbox(folder),
                                      capture_output=True, text=True, timeout=600)
                self.assertEqual(done.returncode, 0, f"{document}\n{done.stderr}")
                for block in blocks(document):
                    if block.directive == "output":
                        self.assertIn(block.text, done.stdout, block)

    @unittest.skipUnless(os.environ.get("PHASETREE_C_FLAGS") and shutil.which("cc"), "no plugin or no C compiler")
    def test_c(self):
        for block in self.of("c", directive="main"):
            with self.subTest(str(block)), tempfile.TemporaryDirectory() as folder:
                source, program = pathlib.Path(folder) / "main.c", pathlib.Path(folder) / "program"
                body = textwrap.indent(block.text, "    ")
                source.write_text(
                    "#include <phasetree/phasetree_embree.h>\n#include <stdio.h>\nint main(void) {\n"
                    "    RTCDevice device = rtcNewDevice(NULL);\n    RTCScene scene = rtcNewScene(device);\n"
                    f"{body}    rtcCommitScene(scene);\n    struct RTCBounds bounds;\n    rtcGetSceneBounds(scene, &bounds);\n"
                    "    return bounds.lower_x < bounds.upper_x ? 0 : 1;\n}\n", encoding="utf-8")
                compiled = subprocess.run(["cc", "-std=c99", "-Wall", "-Wextra", "-Werror", source, "-o", program,
                                           *shlex.split(os.environ["PHASETREE_C_FLAGS"])], capture_output=True, text=True)
                self.assertEqual(compiled.returncode, 0, f"{block}\n{compiled.stderr}")
                done = subprocess.run([program], cwd=ROOT, capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, f"{block}\n{done.stderr}")


    @unittest.skipUnless(os.environ.get("PHASETREE_C_FLAGS") and shutil.which("c++"), "no plugin or no C++ compiler")
    def test_programs(self):
        programs: dict[pathlib.Path, str] = {}
        pictures: dict[pathlib.Path, list[bytes]] = {}
        for block in self.of("cpp"):
            form, _, result = block.directive.partition(" = ")
            if form not in ("program", "step"):
                continue
            with self.subTest(str(block)), tempfile.TemporaryDirectory() as folder:
                text = block.text if form == "program" else with_definitions(programs[block.path], block)
                programs[block.path] = text
                if result:
                    self.assertEqual(text, (ROOT / result).read_text(encoding="utf-8"), block)
                source, program = pathlib.Path(folder) / "main.cpp", pathlib.Path(folder) / "program"
                source.write_text(text, encoding="utf-8")
                compiled = subprocess.run(["c++", "-std=c++17", "-O1", "-Wall", "-Wextra", "-Werror", source, "-o", program,
                                           *shlex.split(os.environ["PHASETREE_C_FLAGS"])], capture_output=True, text=True)
                self.assertEqual(compiled.returncode, 0, f"{block}\n{compiled.stderr}")
                picture = pathlib.Path(folder) / "picture.ppm"
                done = subprocess.run([program, ROOT / "scenes/hourglass.json", picture], capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, f"{block}\n{done.stderr}")
                before = pictures.setdefault(block.path, [])
                self.assertNotIn(picture.read_bytes(), before, block)
                before.append(picture.read_bytes())
        self.assertTrue(programs)


class SceneReference(unittest.TestCase):
    """The examples of scenes/reference, as render.py renders them, and the pages that show them."""

    def test_examples_are_rendered(self):
        specification = importlib.util.spec_from_file_location("render", REFERENCE / "render.py")
        render = importlib.util.module_from_spec(specification)
        specification.loader.exec_module(render)
        self.assertGreater(len(render.examples()), 40)
        with tempfile.TemporaryDirectory() as folder:
            for example in render.examples():
                with self.subTest(str(example.relative_to(REFERENCE))):
                    done = forked.run(["render", "-", "--spp", "1", "--size", "32x24", "--quiet", "-o",
                                       f"{folder}/picture.png"], json.dumps(render.scene_of(example)), cwd=ROOT / "scenes")
                    self.assertEqual((done.returncode, done.stderr), (0, ""), example)

    def test_command_writes_the_pages(self):
        with tempfile.TemporaryDirectory() as folder:
            failed = forked.run(["nodes", "--markdown", folder])
            self.assertEqual(failed.returncode, 2)
            self.assertIn(f"--markdown: {folder}/scene-file/scene.json: ", failed.stderr)
            self.assertEqual(os.listdir(folder), [])
            for example in REFERENCE.glob("*/*.json"):
                copy = pathlib.Path(folder) / example.relative_to(REFERENCE)
                copy.parent.mkdir(exist_ok=True)
                shutil.copy(example, copy)
            self.assertEqual(forked.run(["nodes", "--markdown", folder]).returncode, 0)
            for page in REFERENCE.glob("*.md"):
                self.assertTrue((pathlib.Path(folder) / page.name).read_bytes() == page.read_bytes(), page)

    def test_pages_show_only_examples(self):
        """So that no block of these pages is untested."""
        examples = {path.read_text(encoding="utf-8").strip() for path in REFERENCE.glob("*/*.json")}
        shown = [block for page in REFERENCE.glob("*.md") for block in blocks(page)]
        self.assertGreater(len(shown), 40)
        for block in shown:
            self.assertEqual(block.language, "json", block)
            self.assertIn(block.text.strip(), examples, block)


class CommandLine(unittest.TestCase):
    """The reference of the command line against --help."""

    def test_every_option_is_described(self):
        page = (ROOT / "tracer/manual/reference/command-line.md").read_text(encoding="utf-8")
        common = page[: page.index("\n## render")]
        overview = forked.run(["--help"]).stdout
        commands = re.findall(r"^  ([a-z]+) ", overview[overview.lower().index("commands:") :], re.M)
        self.assertGreater(len(commands), 8)
        for command in commands:
            section = re.search(rf"^## {command}\n(.*?)(?=^## |\Z)", page, re.M | re.S)
            self.assertIsNotNone(section, f"{command} has no section")
            text = forked.run([command, "--help"]).stdout
            for option in sorted(set(re.findall(r"^ +(?:-\w, *)?(--[a-z][a-z-]+)", text, re.M)) - {"--help"}):
                with self.subTest(f"{command} {option}"):
                    self.assertRegex(section.group(1) + common, rf"`[^`]*{option}\b(?!-)")

    def test_exit_codes(self):
        """The table of exit codes is that of --help."""
        page = (ROOT / "tracer/manual/reference/command-line.md").read_text(encoding="utf-8")
        table = re.search(r"^\| exit code \|.*?\n\n|^\| exit code \|.*\Z", page + "\n", re.M | re.S).group(0)
        described = {code: meaning.replace("`", "") for code, meaning in re.findall(r"^\| (\d+) \| (.*) \|$", table, re.M)}
        overview = forked.run(["--help"]).stdout
        listed = overview[overview.index("Exit codes:") :]
        self.assertEqual(described, dict(re.findall(r"^  (\d+) +(.*)$", listed, re.M)))
        self.assertGreater(len(described), 5)


if __name__ == "__main__":
    unittest.main()
