"""Random operations on a scene with undo and redo, as the studio's page sends them: the file is always the one that the
history says, never an invalid one, and neither the server nor the page grows. No request takes long, whatever the scene
has become.

The long form (PHASETREE_LONG_TESTS=1) has 10,000 operations over HTTP, and 250 actions in the page."""

import json
import os
import pathlib
import random
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))

import browser  # noqa: E402
from studio_user import User  # noqa: E402
from support import PATIENCE, View, skip  # noqa: E402

IS_LONG = os.environ.get("PHASETREE_LONG_TESTS") == "1"
OPERATIONS, IN_PAGE = (10000, 250) if IS_LONG else (400, 120)
MOST_CHARACTERS = 3000  # of the text, from which on parts are deleted rather than added

SCENE = """{
  // Comments stay.
  "version": 1,
  "phases": {"glass": {"clear": {"ior": 1.50}}, "wood": {"diffuse": {"color": [0.6, 0.3, 0.1]}}},
  "shapes": {"ball": {"sphere": {"radius": 0.5}}},
  "tree": {"over": [
    {"set": {"phase": "wood", "of": "ball"}},  // a reusable one
    {"set": {"phase": "glass", "of": {"translate": {"by": [0.8, 0, 0], "of": {"box": {"size": [0.5, 0.5, 0.5]}}}}}}
  ]},
  "lights": [{"constant": {"radiance": [1, 1, 1]}}],
  "camera": {"position": [0, -9, 0], "look_at": [0, 0, 0], "fov": 30},
  "render": {"width": 32, "height": 24, "samples": 1}
}
"""


def nodes_of(outline):
    for entry in outline:
        yield entry
        yield from nodes_of(entry["children"])


class Editor:
    """What a page knows, and chooses at random."""

    def __init__(self, view, seed):
        self.view, self.random, self.slowest = view, random.Random(seed), 0
        self.kinds = [k for k in json.loads(view.get("catalogue").body)["kinds"] if k["template"] and "<file>" not in k["template"]]
        self.read()
        self.done, self.undone = [self.text], []
        self.count = {}

    def read(self):
        told = json.loads(self.view.get("document?after=0").body)
        self.version, self.text, self.outline = told["version"], told["text"], list(nodes_of(told["outline"]))
        self.told = told

    def filled(self, template):
        phases = [e["label"] for e in self.outline if e["type"] == "material" and e["label"]]
        return template.replace('"<phase>"', json.dumps(self.random.choice(phases))).replace('"<other phase>"', json.dumps(self.random.choice(phases)))

    def operations(self):
        entries, choice = self.outline, self.random.choice
        parts = [e for e in entries if e["type"] in ("field", "object") and e["pointer"].startswith("/tree")]
        roll = self.random.random() + (0.5 if len(self.text) > MOST_CHARACTERS else 0)
        if roll < 0.35:
            numbers = [(p["pointer"], float(p["text"])) for e in entries for p in e["parameters"].values()
                       if p["text"] and p["text"].replace(".", "", 1).lstrip("-").isdigit() and not e["pointer"].startswith("/render")]
            pointer, value = choice(numbers)
            return "set", [{"set": pointer, "to": f"{value * self.random.uniform(0.7, 1.4) + choice([0, 0, 0.1, -5]):.4g}"}]
        if roll < 0.55:
            kind = choice([k for k in self.kinds if k["type"] in ("field", "object", "light", "material")])
            value = self.filled(kind["template"])
            if kind["type"] == "light":
                return "insert", [{"insert": "/lights/-", "value": value}]
            if kind["type"] == "material":
                return "insert", [{"insert": f"/phases/{kind['kind']} {self.version}", "value": value}]
            lists = [e for e in parts if e["kind"] in ("over", "under", "union") and any(s["list"] for s in e["slots"])]
            fitting = [e for e in lists if e["type"] == kind["type"] or (kind["type"] == "field" and e["type"] == "object")]
            if not fitting:
                return None, []
            to = choice(fitting)
            if to["type"] == "object" and kind["type"] == "field":
                value = self.filled('{"set": {"phase": "<phase>", "of": %s}}' % value)
            return "insert", [{"insert": f"{to['pointer']}/{to['kind']}/-", "value": value}]
        part = choice(parts)
        if roll < 0.7:
            kind = choice([k for k in self.kinds if k["type"] == part["type"] and any(s["type"] == part["type"] for s in k["slots"])])
            slot = next(s for s in kind["slots"] if s["type"] == part["type"])
            value = json.loads(self.filled(kind["template"]))
            members = value[kind["kind"]]
            if isinstance(members, list):
                value[kind["kind"]] = [None]
            else:
                members[slot["name"]] = [None] if slot["list"] else None
            return "wrap", [{"wrap": part["pointer"], "in": json.dumps(value)}]
        if roll < 0.75:
            name = f"shape {self.version}"
            return "shape", [{"insert": f"/shapes/{name}", "value": '{"sphere": {"radius": 0.25}}'}] + (
                [{"set": part["pointer"], "to": json.dumps(name)}] if part["type"] == "field" else [])
        if roll < 0.8:
            material = choice([e for e in entries if e["type"] == "material" and e["label"]])
            return "rename", [{"rename": material["pointer"], "to": f"phase {self.version}", "references": True}]
        listed = [e for e in parts if e["pointer"].rsplit("/", 1)[1].isdigit()]
        if roll > 1.1:
            # Lights, and what may be in use.
            others = [e for e in entries if e["pointer"].startswith(("/lights/", "/phases/", "/shapes/")) and e["pointer"].count("/") == 2]
            return "remove", [{"remove": choice(others)["pointer"]}]
        if roll < 0.9 and listed:
            one = choice(listed)
            return "move", [{"move": one["pointer"], "to": one["pointer"].rsplit("/", 1)[0] + f"/{choice([0, 0, 1, '-'])}"}]
        wrappers = [(e, c) for e in parts for c in e["children"] if c["type"] == e["type"]]
        if self.random.random() < 0.5 and wrappers:
            outer, inner = choice(wrappers)
            return "unwrap", [{"unwrap": outer["pointer"], "keep": inner["pointer"]}]
        return ("remove", [{"remove": choice(listed)["pointer"]}]) if listed else (None, [])

    def post(self, name, body):
        begun = time.monotonic()
        try:
            answer = self.view.post(name, body, timeout=60 * PATIENCE)
        except TimeoutError as error:
            raise AssertionError(f"no answer to {body}, for the scene {self.text}") from error
        self.slowest = max(self.slowest, time.monotonic() - begun)
        self.read()
        return answer.status

    def step(self):
        """Does something at random; returns what, and whether it was accepted. The text is what the history says."""
        roll = self.random.random()
        if roll < 0.2 and len(self.done) > 1:
            self.post("undo", {})
            self.undone.append(self.done.pop())
            return "undo", True
        if roll < 0.3 and self.undone:
            self.post("redo", {})
            self.done.append(self.undone.pop())
            return "redo", True
        what, operations = None, []
        while not operations:
            what, operations = self.operations()
        status = self.post("document", {"base": self.version, "label": what, "operations": operations, "strict": True})
        if status not in (200, 400):
            raise AssertionError((status, operations))
        if status == 200 and self.text != self.done[-1]:
            self.done.append(self.text)
            self.undone.clear()
        return what, status == 200


def kilobytes(process):
    status = pathlib.Path(f"/proc/{process.pid}/status").read_text(encoding="utf-8")
    return int(status.split("VmRSS:")[1].split()[0])


def descriptors(process):
    return len(os.listdir(f"/proc/{process.pid}/fd"))


class Random(unittest.TestCase):
    def assert_valid(self, editor):
        told = editor.told
        while not told["checked"]:
            told = json.loads(editor.view.get(f"document?after={told['version']}").body)
        self.assertIsNone(told["error"])

    def test_over_http(self):
        with View(SCENE, "--threads", "1") as view:
            editor = Editor(view, 77)
            view.ready()
            counts, begun, open_at_first, started = {}, kilobytes(view.process), descriptors(view.process), time.monotonic()
            for i in range(OPERATIONS):
                what, is_accepted = editor.step()
                counts.setdefault(what, [0, 0])[is_accepted] += 1
                self.assertEqual(editor.text, editor.done[-1], (i, what))
                if i % 50 == 0:
                    self.assertEqual(view.file.read_text(encoding="utf-8"), editor.text)
                    self.assert_valid(editor)
                if i % 1000 == 999:
                    print(f"{i + 1} operations in {time.monotonic() - started:.0f} s, {kilobytes(view.process)} KiB, {descriptors(view.process)} descriptors, "
                          f"{len(editor.text)} characters, slowest request {editor.slowest:.1f} s", file=sys.stderr, flush=True)
            print({what: f"{yes} of {no + yes}" for what, (no, yes) in sorted(counts.items())}, file=sys.stderr)
            for what in ("set", "insert", "wrap", "unwrap", "remove", "move", "rename", "shape", "undo", "redo"):
                self.assertGreater(counts[what][1], 0, what)
            self.assertIn("// Comments stay.", editor.text)
            self.assertLessEqual(descriptors(view.process), open_at_first + 2)
            final, steps = editor.text, len(editor.done) - 1
            for _ in range(steps):
                editor.view.post("undo", {})
            editor.read()
            self.assertEqual(editor.text, SCENE)
            self.assertIsNone(editor.told["undo"])
            # An undo step takes as much memory as the part of the text that it changes. Freed memory is returned to the
            # system after seconds, except for 64 MiB.
            view.wait_for(lambda state: state["doing"] == "Ready", within=600)
            most, end = begun + 96 * 1024 + OPERATIONS, time.monotonic() + 20 * PATIENCE
            while kilobytes(view.process) > most and time.monotonic() < end:
                time.sleep(0.5)
            grown = kilobytes(view.process) - begun
            print(f"{steps} steps undone after {time.monotonic() - started:.0f} s; grown by {grown} KiB", file=sys.stderr, flush=True)
            for _ in range(steps):
                editor.view.post("redo", {})
            editor.read()
            self.assertEqual(editor.text, final)
            self.assertEqual(view.file.read_text(encoding="utf-8"), final)
            self.assert_valid(editor)
            self.assertLess(grown, most - begun)


# One random action of the page's own: what its menus and keys do.
ACTION = """async (seed) => {
    let state = seed;
    const random = (n) => { state = (state * 1103515245 + 12345) % 2147483648; return Math.floor(state / 2147483648 * n); };
    const pick = (list) => list[random(list.length)];
    const {actions, scene, selection} = studio;
    for (let i = 0; i < 3; ++i) random(1);
    const parts = scene.entries.filter((e) => !e.isSection && e.pointer.startsWith("/tree"));
    if (parts.length === 0) { // the object itself has been deleted
      await actions.undo();
      return scene.text;
    }
    selection.set(random(4) === 0 ? [pick(parts).key, pick(parts).key] : [pick(parts).key]);
    const kinds = actions.catalogue.kinds.filter((k) => k.template && !k.template.includes("<file>") && ["field", "object", "light", "material"].includes(k.type));
    const {wraps} = await import("./recipes.js"), active = actions.active, large = scene.text.length > 5000;
    const wrap = pick(wraps[active.type]?.filter(Boolean) ?? [null]);
    const acts = [
      () => actions.undo(), () => actions.undo(), () => actions.redo(), () => actions.delete(), () => actions.duplicate(), () => actions.group(),
      () => actions.unwrap(), () => actions.shift(1), () => actions.shift(-1),
      () => (large ? actions.delete() : actions.addKind(pick(kinds))), () => (large ? actions.undo() : actions.addKind(pick(kinds))),
      () => (wrap ? actions.wrap(active, wrap.kind, wrap.in) : null), () => (wrap ? actions.wrapTogether(actions.selected, wrap) : null),
    ];
    const field = document.querySelector("#inspector .number input");
    acts.push(async () => {
      const before = scene.text;
      field?.dispatchEvent(new KeyboardEvent("keydown", {key: pick(["ArrowUp", "ArrowDown"])}));
      for (let i = 0; i < 40 && scene.text === before; ++i) await new Promise((done) => setTimeout(done, 5));
    });
    await pick(acts)();
    while (scene.isBusy) await new Promise((done) => setTimeout(done, 5));
    document.getElementById("toasts").replaceChildren();
    return scene.text;
}"""


class InThePage(unittest.TestCase):
    def test_through_the_page(self):
        if not browser.program():
            skip("Chromium is not installed (package chromium)")
        with View(SCENE, "--threads", "1") as view, browser.Browser(1280, 720) as page:
            user = User(page)
            user.open(view.url)

            def size():
                page.call("HeapProfiler.collectGarbage")
                return page.call("Runtime.getHeapUsage")["usedSize"], page.call("Memory.getDOMCounters")["nodes"]

            begun = None
            for i in range(IN_PAGE):
                page.run(f"({ACTION})({7919 * i + 11})")
                if i % 10 == 0:
                    self.assertEqual(view.file.read_text(encoding="utf-8"), page.run("studio.scene.text"))
                if i == IN_PAGE // 3:
                    page.run("studio.selection.set([])")
                    begun = size()
            page.run("studio.selection.set([])")
            final = page.run("studio.scene.text")
            told = json.loads(view.get("document?after=0").body)
            while not told["checked"]:
                told = json.loads(view.get(f"document?after={told['version']}").body)
            self.assertIsNone(told["error"])
            steps = 0
            while page.run("studio.scene.undo !== null"):
                page.run("studio.scene.goBack()")
                steps += 1
            self.assertEqual(view.file.read_text(encoding="utf-8"), SCENE)
            for _ in range(steps):
                page.run("studio.scene.goForward()")
            self.assertEqual(view.file.read_text(encoding="utf-8"), final)
            for _ in range(steps):
                page.run("studio.scene.goBack()")
            grown = [after - before for before, after in zip(begun, size())]
            print(f"{IN_PAGE} actions, {steps} steps; the heap has grown by {grown[0]} bytes, the page by {grown[1]} nodes", file=sys.stderr)
            self.assertGreater(steps, IN_PAGE // 10)
            self.assertLess(grown[0], 4 << 20)
            self.assertLess(grown[1], 3000)
            expected = "Failed to load resource"  # what the server rejects
            self.assertEqual([c for c in page.complaints() if not c.startswith(expected)], [])


if __name__ == "__main__":
    unittest.main()
