"""Every relative link and every anchor in the Markdown files of the repository resolves."""

import pathlib
import re
import unittest
from urllib.parse import unquote

from markdown import ROOT, markdown_files, prose

LINK = re.compile(r"\]\(<?([^()\s>]+)>?(?:\s+\"[^\"]*\")?\)|<img[^>]*\ssrc=\"([^\"]+)\"")
HEADING = re.compile(r"^#{1,6}\s+(.*?)\s*#*$", re.M)


def slug(heading: str) -> str:
    """The anchor that GitHub gives to a heading."""
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    text = re.sub(r"[`*]", "", text).strip().lower()
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


def anchors(path: pathlib.Path) -> set[str]:
    found: set[str] = set()
    for heading in HEADING.findall(prose(path.read_text(encoding="utf-8"), keep_inline_code=True)):
        name, count = slug(heading), 0
        while (name if not count else f"{name}-{count}") in found:
            count += 1
        found.add(name if not count else f"{name}-{count}")
    return found


class Links(unittest.TestCase):
    def test_slugs_are_those_of_github(self):
        self.assertEqual(slug("The paper's tentacle, in `sixty` lines"), "the-papers-tentacle-in-sixty-lines")
        self.assertEqual(slug("glTF & a_b"), "gltf--a_b")

    def test_links_resolve(self):
        files = markdown_files()
        self.assertGreater(len(files), 20)
        known: dict[pathlib.Path, set[str]] = {}
        broken, checked = [], 0
        for path in files:
            for match in LINK.finditer(prose(path.read_text(encoding="utf-8"))):
                target = match.group(1) or match.group(2)
                if re.match(r"[a-z][a-z0-9+.-]*:", target):
                    continue
                checked += 1
                name, _, anchor = unquote(target).partition("#")
                goal = (path.parent / name).resolve() if name else path
                where = f"{path.relative_to(ROOT)}: {target}"
                if not goal.exists():
                    broken.append(f"{where}: no such file")
                elif anchor and goal.suffix == ".md":
                    if goal not in known:
                        known[goal] = anchors(goal)
                    if anchor not in known[goal]:
                        broken.append(f"{where}: no such heading")
        self.assertGreater(checked, 500)
        self.assertEqual(broken, [], "\n" + "\n".join(broken))


if __name__ == "__main__":
    unittest.main()
