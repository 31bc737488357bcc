"""Defects planted in scenes of the gallery: thin walls, gaps, leaks, crumbs, contacts, swallowed phases and dead nodes.

`phasetree check --prove` must refute the statement that each defect breaks, at the statement's line, with a witness.
Labels in double precision check the witness independently of the prover. Beside each defect is a sound twin whose
statement is true and must not be refuted.

The long form takes every scene of the gallery that has room for defects, and prints a table:

    PHASETREE_LONG_TESTS=1 PYTHONPATH=build/release/plugins/python python3 tests/python/planted_defects.py
"""

import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import phasetree as pt
from support import COMMAND, SCENES, gallery_scenes, without_comments

LONG = bool(os.environ.get("PHASETREE_LONG_TESTS"))
SHORT_SCENES = ("jade", "two_pears")
KINDS = ("wall", "gap", "leak", "crumbs", "contact", "swallowed", "dead", "covered")
# Sites smaller than this share of the object's longest side are not used, because finding a defect in them takes long.
LEAST_SITE = 1 / 24
# Of the random points among which sites are chosen.
SEEDS = [int(s) for s in os.environ.get("PHASETREE_DEFECT_SEEDS", "78 79" if LONG else "78").split()]
# Of wall-clock time for each scene. On a busy machine, allow more.
SECONDS = float(os.environ.get("PHASETREE_DEFECT_SECONDS", 200))


def ball(centre, radius):
    return {"translate": {"by": [float(x) for x in centre], "of": {"sphere": {"radius": float(radius)}}}}


def block(centre, size):
    return {"translate": {"by": [float(x) for x in centre], "of": {"box": {"size": [float(x) for x in size]}}}}


def filled(phase, field):
    return {"set": {"phase": phase, "of": field}}


class Site:
    """A ball in a single phase, in which a defect is planted."""

    def __init__(self, centre, radius, phase):
        self.centre, self.radius, self.phase = np.array(centre, dtype=float), float(radius), phase

    def at(self, x, y, z):
        """A point of the ball, in units of its radius."""
        return self.centre + self.radius * np.array([x, y, z])


def sites_of(scene, count, seed):
    """Disjoint balls, each in one phase, the largest first."""
    low, high = (np.array(b, dtype=float) for b in scene.bounds)
    longest = (high - low).max()
    points = np.random.default_rng(seed).uniform(low, high, (20_000, 3))
    radii = scene.safe_distance(points)
    # So that no defect touches the box around the object, beyond which nothing is prepared.
    radii = np.minimum(radii, np.minimum(points - low, high - points).min(axis=1)) * 0.95
    labels = scene.locate(points)
    found = []
    # Balls in a material come first: most kinds need one.
    for i in np.lexsort((-radii, labels == 0)):
        if radii[i] < LEAST_SITE * longest or len(found) == count:
            continue
        if all(np.linalg.norm(points[i] - s.centre) > radii[i] + s.radius for s in found):
            found.append(Site(points[i], radii[i], scene.names[labels[i]]))
    return found


class Planted:
    """A scene with defects, the statements about them, and how to check each witness."""

    def __init__(self, path, seed):
        self.path, self.seed = path, seed
        self.scene = without_comments(path.read_text(encoding="utf-8"))
        self.object = pt.load(path).object
        self.over, self.under, self.cut = [], [], []
        self.statements, self.checks = [], []  # a check is None for the sound twin of a defect
        self.dead, self.alive = None, None
        self.smallest = np.inf

    def expect(self, kind, statement, check):
        self.statements.append((kind, statement))
        self.checks.append(check)

    def plant_all(self):
        sites = sites_of(self.object, len(KINDS), self.seed)
        materials = [s for s in sites if s.phase != "vacuum"]
        planted, used = [], []
        for kind in KINDS:
            if kind == "covered":
                if self.plant_covered(used):
                    planted.append(kind)
                continue
            needs_material = kind in ("wall", "gap", "contact", "swallowed", "dead")
            choice = materials if needs_material else sites[::-1]
            if not choice:
                continue
            site = choice[0]
            sites.remove(site)
            used.append(site)
            if site in materials:
                materials.remove(site)
            self.smallest = min(self.smallest, site.radius)
            getattr(self, "plant_" + kind)(site)
            planted.append(kind)
        return planted

    def plant_wall(self, s):
        """Two cavities with a wall between them that is a seventh of the site's radius thick."""
        gap = block(s.centre, (4 * s.radius, 4 * s.radius, s.radius / 7))
        self.cut.append({"difference": {"from": ball(s.centre, 0.95 * s.radius), "subtract": [gap]}})
        thickness = 0.6 * s.radius
        self.expect(
            "wall",
            {"wall": {"phase": s.phase, "at_least": thickness}},
            lambda o, w: len(w) == 1 and w[0][1] == s.phase and is_thin(o, w[0][0], s.phase, thickness),
        )

    def plant_gap(self, s):
        """A ball in a cavity that it should fill."""
        self.over.append(filled("planted_insert", ball(s.centre, 0.5 * s.radius)))
        self.cut.append(ball(s.centre, 0.9 * s.radius))
        gap = 0.4 * s.radius
        self.expect("gap", {"touching": {"phases": ["planted_insert", s.phase]}}, lambda o, w: not w)
        self.expect(
            "gap",
            {"apart": {"phases": ["planted_insert", s.phase], "at_least": 1.6 * gap}},
            lambda o, w: {n for _, n in w} == {"planted_insert", s.phase} and distance(w[0], w[1]) < 1.6 * gap,
        )
        self.expect("gap", {"apart": {"phases": ["planted_insert", s.phase], "at_least": 0.1 * gap}}, None)

    def plant_leak(self, s):
        """A vessel with a hole. Its content is closed in by the phases around the site together with it."""
        r = 0.95 * s.radius
        hole = block(s.centre + np.array([0, 0.6 * r, 0]), (0.6 * r, 1.2 * r, 0.6 * r))
        self.over.append(filled("planted_content", ball(s.centre, 0.5 * r)))
        self.over.append(filled("planted_vessel", {"difference": {"from": ball(s.centre, r), "subtract": [hole]}}))
        closed = {"walls": ["planted_vessel"], "around": "planted_content"}
        self.expect("leak", {"closed": closed}, is_leak)
        self.expect("leak", {"connected": {"phase": "planted_vessel"}}, None)

    def plant_crumbs(self, s):
        """Two balls of one phase that do not touch."""
        a, b = s.at(-0.55, 0, 0), s.at(0.55, 0, 0)
        self.over.append(filled("planted_crumbs", {"union": [ball(a, 0.35 * s.radius), ball(b, 0.35 * s.radius)]}))
        self.expect(
            "crumbs",
            {"connected": {"phase": "planted_crumbs"}},
            lambda o, w: len(w) == 2 and sorted(np.linalg.norm(p - a) < 0.35 * s.radius for p, _ in w) == [0, 1],
        )
        self.expect("crumbs", {"present": {"phase": "planted_crumbs"}}, None)

    def plant_contact(self, s):
        """A ball that touches the phase around it, although the two must be apart."""
        self.over.append(filled("planted_stone", ball(s.centre, 0.6 * s.radius)))
        self.expect(
            "contact",
            {"apart": {"phases": ["planted_stone", s.phase]}},
            lambda o, w: {n for _, n in w} == {"planted_stone", s.phase} and np.linalg.norm(w[0][0] - s.centre) < 3 * s.radius,
        )
        self.expect("contact", {"touching": {"phases": ["planted_stone", s.phase]}}, None)

    def plant_swallowed(self, s):
        """A ball below a phase that fills all of it."""
        self.under.append(filled("planted_swallowed", ball(s.centre, 0.7 * s.radius)))
        self.expect("swallowed", {"present": {"phase": "planted_swallowed"}}, lambda o, w: not w)
        self.expect("swallowed", {"present": {"phase": s.phase}}, None)

    def plant_covered(self, sites):
        """A phase of the scene that another one covers completely."""
        measures = self.object.measure(tolerance=0.2, seconds=5)
        low, high = (np.array(b, dtype=float) for b in self.object.bounds)
        best = None
        for i, name in enumerate(measures.names):
            box = measures.low[i, :, 0], measures.high[i, :, 1]
            size = box[1] - box[0]
            if not np.all(np.isfinite(size)) or measures.volume[i, 0] <= 0 or size.max() > 0.5 * (high - low).max():
                continue
            if any(np.all(np.abs(s.centre - (box[0] + box[1]) / 2) < size / 2 + s.radius) for s in sites):
                continue
            if best is None or size.max() < best[2].max():
                best = name, (box[0] + box[1]) / 2, size
        if best is None:
            return False
        name, centre, size = best
        margin = 0.01 * (high - low).max()
        self.covered = name
        self.first = filled("planted_cover", block(centre, size + 2 * margin))
        self.expect("covered", {"present": {"phase": name}}, lambda o, w: not w)
        return True

    def plant_dead(self, s):
        """A ball in the same phase, which changes nothing."""
        self.dead = filled(s.phase, ball(s.centre, 0.5 * s.radius))

    def written(self, folder):
        """The file, in which each planted statement and node has a line of its own."""
        scene = dict(absolute(self.scene, self.path.parent))
        phases = dict(scene["phases"])
        for name in ("insert", "vessel", "content", "crumbs", "stone", "swallowed", "cover"):
            phases["planted_" + name] = {"diffuse": {"color": [0.5, 0.5, 0.5]}}
        tree = scene.pop("tree")
        for key in ("expect", "phases"):
            scene.pop(key, None)
        if self.cut:
            tree = {"subtract_shape": {"of": tree, "shape": {"union": self.cut}}}
        items = [getattr(self, "first", None), self.dead, *self.over, tree, *self.under]
        lines = ['{"phases": ' + json.dumps(phases) + ",", '"tree": {"over": [']
        items = [json.dumps(item) for item in items if item is not None]
        self.dead_line = len(lines) + 1 + items.index(json.dumps(self.dead)) if self.dead else None
        lines += [item + "," for item in items[:-1]] + [items[-1] + "]},", '"expect": [']
        self.first_line = len(lines) + 1
        texts = [json.dumps(statement) for _, statement in self.statements]
        lines += [text + "," for text in texts[:-1]] + [texts[-1] + "],"]
        lines.append(json.dumps(scene)[1:])
        path = pathlib.Path(folder) / (self.path.stem + ".json")
        path.write_text("\n".join(lines), encoding="utf-8")
        return path


def absolute(value, folder):
    """Names of files, which are relative to the scene's folder."""
    if isinstance(value, dict):
        return {k: absolute(v, folder) for k, v in value.items()}
    if isinstance(value, list):
        return [absolute(v, folder) for v in value]
    if isinstance(value, str) and "/" in value and (folder / value).parent.is_dir():
        return str(folder / value)
    return value


def distance(a, b):
    return np.linalg.norm(a[0] - b[0])


def is_thin(scene, point, phase, diameter):
    """Whether no ball of this diameter in the phase has its centre within a diameter of the point.

    Cubes that may contain such a centre are divided until each has a point outside the phase that is closer than the
    radius to all of it. These points are those of a grid that becomes finer together with the cubes."""
    index, half, pieces = scene.index(phase), diameter / 8, 4
    line = (np.arange(2 * 8 + 1) - 8) * diameter / 8
    centres = point + np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3)
    while len(centres) and pieces < 128:
        half, pieces = half / 2, pieces * 2
        corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * half
        centres = (centres[:, None] + corners).reshape(-1, 3)
        outer = np.linalg.norm(np.maximum(np.abs(centres - point) - half, 0), axis=1)
        centres = centres[outer <= diameter]
        # Points outside the phase that are next to one inside.
        low, high = centres.min(axis=0) - diameter / 2, centres.max(axis=0) + diameter / 2
        lines = [np.arange(low[k], high[k] + half, half) for k in range(3)]
        grid = np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1)
        is_outside = scene.locate(grid) != index
        is_edge = np.zeros_like(is_outside)
        for axis in range(3):
            for shift in (-1, 1):
                is_edge |= is_outside & ~np.roll(is_outside, shift, axis)
        edge = grid[is_edge]
        left = []
        for some in np.array_split(centres, max(1, len(centres) * max(1, len(edge)) // 20_000_000)):
            distance_to_edge = np.full(len(some), np.inf)
            for at in edge:  # one point at a time takes little memory
                np.minimum(distance_to_edge, ((some - at) ** 2).sum(axis=1), out=distance_to_edge)
            reached = np.sqrt(distance_to_edge) + half * np.sqrt(3) < diameter / 2
            is_far = (scene.locate(some) != index) & (half * np.sqrt(3) < diameter / 2)
            left.append(some[~(reached | is_far)])
        centres = np.concatenate(left)
    return len(centres) == 0


def is_leak(scene, witnesses):
    """Whether a path leads from a vessel's content to the space around the object without meeting the wall."""
    points = np.array([p for p, _ in witnesses])
    if len(points) < 2 or witnesses[0][1] != "planted_content":
        return False
    low, high = (np.array(b, dtype=float) for b in scene.bounds)
    if np.all((low < points[-1]) & (points[-1] < high)):
        # The last box reaches the space around; one of its sides is the closest side of the bounds.
        beyond = [np.where(np.arange(3) == i, b + (b - (low + high) / 2) * 0.1, points[-1])
                  for b in (low, high) for i in range(3)]  # fmt: skip
        points = np.array([*points, min(beyond, key=lambda p: np.linalg.norm(p - points[-1]))])
    steps = np.linspace(0, 1, 41)[:, None]
    path = np.concatenate([a + steps * (b - a) for a, b in zip(points[:-1], points[1:])])
    return not np.any(scene.locate(path) == scene.index("planted_vessel"))


class Result:
    def __init__(self, scene):
        self.scene = scene
        self.refuted, self.problems, self.twins = {}, [], []
        self.seconds = 0.0


def examine(path, seed, seconds, folder):
    """Plants defects in a scene, and compares what is found with what was planted."""
    result = Result(path.stem)
    planted = Planted(path, seed)
    kinds = planted.plant_all()
    if not planted.statements:
        return result
    file = planted.written(folder)
    start = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = subprocess.run(
        [COMMAND, "check", "--prove", "--json", "--time", f"{seconds}s", "--resolution", str(planted.smallest / 10), file],
        capture_output=True,
        text=True,
        check=False,
    )
    result.seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - start
    if done.returncode not in (0, 4, 5):
        result.problems.append(f"exit code {done.returncode}: {done.stderr[:300]}")
        return result
    said = json.loads(done.stdout)
    scene = pt.load(file).object
    for i, (kind, statement) in enumerate(planted.statements):
        found, check = said["statements"][i], planted.checks[i]
        verdict = found["verdict"]
        witnesses = [(np.array(w["point"], dtype=float), w["phase"]) for w in found["witnesses"]]
        if (found["line"], found["column"]) != (planted.first_line + i, 1):
            result.problems.append(f"{kind}: at {found['line']}:{found['column']}")
        if check is None:
            result.twins.append(verdict)
            if verdict == "undecided" and LONG:
                print(path.stem, kind, found.get("reason"), json.dumps(statement), file=sys.stderr)
            if verdict == "refuted":
                result.problems.append(f"{kind}: a true statement is refuted: {json.dumps(statement)}")
            continue
        wrong = [n for p, n in witnesses if scene.names[int(scene.locate(p))] != n]
        if verdict != "refuted":
            result.problems.append(f"{kind}: {verdict}: {found.get('reason', '')}: {json.dumps(statement)}")
        elif wrong:
            result.problems.append(f"{kind}: {len(wrong)} witnesses are not in their phases")
        elif not check(scene, witnesses):
            result.problems.append(f"{kind}: wrong witness {found['witnesses'][:2]}")
        else:
            result.refuted[kind] = result.refuted.get(kind, 0) + 1
    if "dead" in kinds:
        dead = [n for n in said["nodes"] if n["line"] == planted.dead_line and n["node"] == "set"]
        verdict = dead[0]["is_dead"] if dead else "not examined"
        if verdict != "proved":
            result.problems.append(f"dead: {verdict}")
        else:
            result.refuted["dead"] = 1
    # A node that is said to change a label at a point: the label with it is the one in double precision.
    for node in said["nodes"]:
        if change := node.get("change"):
            if scene.names[int(scene.locate(change["point"]))] != change["with"]:
                result.problems.append(f"{node['node']} in line {node['line']}: wrong label at {change['point']}")
    return result


def row(r):
    counts = [str(r.refuted.get(k, "")) for k in KINDS]
    return f"| {r.scene} | {' | '.join(counts)} | {r.twins.count('proved')} of {len(r.twins)} | {r.seconds:.0f} |"


def table(results):
    lines = [f"| scene | {' | '.join(KINDS)} | true ones proved | seconds |", "|---" * (len(KINDS) + 3) + "|"]
    lines += [row(r) for r in results]
    totals = [str(sum(r.refuted.get(k, 0) for r in results)) for k in KINDS]
    proved, twins = sum(r.twins.count("proved") for r in results), sum(len(r.twins) for r in results)
    lines.append(f"| {len(results)} scenes | {' | '.join(totals)} | {proved} of {twins} | |")
    return "\n".join(lines)


class PlantedDefects(unittest.TestCase):
    def test_each_is_refuted_with_a_right_witness_and_nothing_false_is_proved(self):
        chosen = os.environ.get("PHASETREE_DEFECTS_IN", "").split() or (() if LONG else SHORT_SCENES)
        paths = [p for p in gallery_scenes() if not chosen or p.stem in chosen]
        paths.sort(key=lambda p: p.stat().st_size)
        results = []
        with tempfile.TemporaryDirectory() as folder:
            for path in paths:
                if '"tree"' not in path.read_text(encoding="utf-8"):
                    continue
                for seed in SEEDS:
                    result = examine(path, seed, SECONDS, folder)
                    if LONG:
                        print(row(result), result.problems, file=sys.stderr, flush=True)
                    if result.refuted or result.problems:
                        results.append(result)
        if LONG:
            print(table(results))
        for r in results:
            with self.subTest(r.scene):
                self.assertEqual(r.problems, [])
        count = sum(sum(r.refuted.values()) for r in results)
        self.assertGreaterEqual(count, 200 if LONG and not chosen else 12)


if __name__ == "__main__":
    unittest.main()
