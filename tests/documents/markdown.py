"""Markdown files of the repository, and the fenced blocks in them."""

import dataclasses
import pathlib
import re
import textwrap

ROOT = pathlib.Path(__file__).resolve().parents[2]

FENCE = re.compile(r"^ *```([\w+-]*)[^\n]*\n(.*?)^ *```$", re.M | re.S)
DIRECTIVE = re.compile(r"<!-- test: ([^\n]*?) -->\n *\Z")


def markdown_files() -> list[pathlib.Path]:
    """All Markdown files outside build folders."""
    ignored = ("build", "out", "node_modules")
    return sorted(
        path
        for path in ROOT.rglob("*.md")
        if not any(part.startswith(".") or part in ignored or part.startswith("build-")
                   for part in path.relative_to(ROOT).parts[:-1])
    )


def prose(text: str, keep_inline_code: bool = False) -> str:
    """The text without fenced blocks, comments and, unless kept, inline code."""
    text = FENCE.sub("", text)
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    return text if keep_inline_code else re.sub(r"`[^`\n]*`", "", text)


@dataclasses.dataclass
class Block:
    """A fenced block. The directive is the comment `<!-- test: … -->` directly above it, or empty."""

    path: pathlib.Path
    line: int
    language: str
    text: str
    directive: str

    def __str__(self) -> str:
        return f"{self.path.relative_to(ROOT)}:{self.line}"


def blocks(path: pathlib.Path) -> list[Block]:
    text = path.read_text(encoding="utf-8")
    found = []
    for match in FENCE.finditer(text):
        before = text[: match.start()]
        directive = DIRECTIVE.search(before)
        found.append(Block(path, before.count("\n") + 1, match.group(1), textwrap.dedent(match.group(2)),
                           directive.group(1) if directive else ""))
    return found


def without_comments(text: str) -> str:
    """JSON without // and /* */ comments."""
    return re.sub(r'("(?:\\.|[^"\\])*")|//[^\n]*|/\*.*?\*/', lambda m: m.group(1) or "", text, flags=re.S)
