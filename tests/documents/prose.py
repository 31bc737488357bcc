"""The prose of the project contains no new unidiomatic phrases and no new overlong sentences.

    python3 tests/documents/prose.py            the test
    python3 tests/documents/prose.py --list     every offence, with file and line
    python3 tests/documents/prose.py --update   lower prose_baseline.json to what is left

Prose is what people read: Markdown, comments, and string literals of at least four words (messages, help, docstrings).
A file may have as many offences as prose_baseline.json allows, which is what it had when the test was introduced. The
baseline may only shrink.
"""

import collections
import json
import pathlib
import re
import sys
import tempfile
import unittest

from markdown import FENCE, ROOT

BASELINE = pathlib.Path(__file__).with_name("prose_baseline.json")
FOLDERS = ("lib", "tracer", "plugins", "tests", "benchmarks", "scenes")
LONGEST_SENTENCE = 40  # words; Markdown and documentation comments

# What to avoid, and what to write instead.
PHRASES = {
    r"\banew\b": "again, or re-run",
    r"\bdear(er|est)?\b": "expensive",
    r"\b(is|are|was|were|be) told\b": "is reported, or: receives",
    r"\btold of\b": "reported",
    r"\btells (?!apart)": "reports, says, returns",
    r"\bcannot be had\b": "is unavailable",
    r"\bin (the|its|their) place\b|\bin place of\b": "instead of",
    r"\bno more\b(?! (\w+ )?(\w+ )?than)": "no longer",
    r"\bso many\b": "N, or at most N",
    r"\b(is|are) (not )?looked at\b": "is used, checked, ignored",
    r"\b(who|what)ever (they|it|he|sets|adds)\b": "anyone who, or drop it",
    r"\bfor who\b": "for people who",
    r"\ball the same\b": "still, nevertheless",
    r"\bas ever\b": "as before",
    r"\bhow(ever)? that comes\b": "whatever the cause",
    r"\bshines? not\b": "does not emit",
    r"\bout of (a|the) (making|reading|building)\b": "when …ing",
    r"\bthe (making|writing|telling|looking) of\b": "making, writing …",
    r"\bis refused\b|\bare refused\b": "is rejected",
    r"\bsay so\b|\bsays so\b": "reports it",
    r"\bwhat of (it|them|its|their)\b": "the part that",
    r"\bevery now and then\b|\bnow and then\b": "periodically",
    r"\bstands? in for\b": "replaces",
    r"\bas good as\b": "almost",
    r"\ba pixel\b(?=\W*(\d|at most))": "per pixel",
}
PHRASES = {re.compile(pattern, re.I): advice for pattern, advice in PHRASES.items()}

# Words for which a phrase above is right: quotations and titles.
ALLOWED = ("tests/documents/prose.py", "tests/documents/prose_baseline.json")

STRING = re.compile(r'R"(\w*)\((.*?)\)\1"|"((?:[^"\\\n]|\\.)*)"', re.S)


def line_of(text: str, position: int) -> int:
    return text.count("\n", 0, position) + 1


def markdown_prose(text: str):
    """(line, text) of each paragraph, list item or table cell outside code."""
    text = FENCE.sub(lambda m: "\n" * m.group(0).count("\n"), text)
    text = re.sub(r"<!--.*?-->", lambda m: "\n" * m.group(0).count("\n"), text, flags=re.S)
    text = re.sub(r"`[^`\n]*`", "X", text)
    text = re.sub(r"\]\([^)]*\)", "]", text)
    paragraph: list[str] = []
    begin = 1
    for number, line in enumerate(text.split("\n") + [""], 1):
        is_item = re.match(r"\s*([*+-]|\d+\.)\s", line)
        if not line.strip() or is_item or line.startswith(("#", "|")):
            if paragraph:
                yield begin, " ".join(paragraph)
            paragraph, begin = [], number
        if line.startswith("|"):
            for cell in line.split("|"):
                yield number, cell.strip()
        elif line.strip():
            if not paragraph:
                begin = number
            paragraph.append(line.strip())


def comment_prose(text: str, marker: str):
    """(line, text) of each block of comment lines."""
    block: list[str] = []
    begin = 0
    for number, line in enumerate(text.split("\n") + [""], 1):
        match = re.search(marker, line)
        is_alone = match and not line[: match.start()].strip()
        if match and block and is_alone and line[match.end():].strip():
            block.append(line[match.end():].strip())
            continue
        if block:
            yield begin, " ".join(block)
        block = []
        if match and line[match.end():].strip():
            begin, block = number, [line[match.end():].strip()]
    return


def sentences(text: str) -> list[str]:
    return re.split(r"(?<=[.!?:;])\s+|\s\|\s|\s\*\s", text)


def offences_in(path: pathlib.Path):
    """(line, message) of each offence in a file."""
    text = path.read_text(encoding="utf-8", errors="replace")
    suffix = path.suffix
    passages: list[tuple[int, str, bool]] = []
    if suffix == ".md":
        passages = [(line, p, True) for line, p in markdown_prose(text)]
    else:
        marker = r"#(?!!)\s" if suffix in (".py", ".sh", ".cmake") or path.name == "CMakeLists.txt" else r"//[/!]?<?\s"
        passages = [(line, p, "///" in text.split("\n")[line - 1]) for line, p in comment_prose(text, marker)]
        if suffix == ".h":
            passages += [(line_of(text, m.start()), re.sub(r"\n\s*\*", " ", m.group(1)), True)
                         for m in re.finditer(r"/\*(.*?)\*/", text, re.S)]
        if ROOT / "tests" not in path.parents:
            for match in STRING.finditer(text):
                literal = match.group(2) or match.group(3) or ""
                if len(re.findall(r"[A-Za-z]{2,}\s", literal)) >= 3:
                    passages.append((line_of(text, match.start()), literal, False))
    for line, passage, has_limit in passages:
        for pattern, advice in PHRASES.items():
            for match in pattern.finditer(passage):
                yield line, f'"{match.group(0).strip()}" (better: {advice})'
        if has_limit:
            for sentence in sentences(passage):
                count = len(re.findall(r"[A-Za-zÀ-ž'’-]{2,}", sentence))
                if count > LONGEST_SENTENCE:
                    yield line, f"a sentence of {count} words: {sentence[:60]} …"


def all_offences() -> dict[str, list[tuple[int, str]]]:
    suffixes = {".md", ".hpp", ".cpp", ".inl", ".h", ".c", ".py", ".sh", ".cmake"}
    files = [path for path in ROOT.glob("*.md")]
    for folder in FOLDERS:
        files += [path for path in (ROOT / folder).rglob("*")
                  if path.suffix in suffixes or path.name == "CMakeLists.txt"]
    found: dict[str, list[tuple[int, str]]] = {}
    for path in sorted(files):
        name = path.relative_to(ROOT).as_posix()
        if name.startswith(ALLOWED) or "__pycache__" in name or not path.is_file():
            continue
        if offences := list(offences_in(path)):
            found[name] = offences
    return found


class Prose(unittest.TestCase):
    def test_offences_are_found(self):
        def messages(name: str, text: str) -> str:
            with tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder) / name
                path.write_text(text, encoding="utf-8")
                return "\n".join(message for _, message in offences_in(path))

        self.assertIn("anew", messages("probe.md", "The cells are built anew.\n\n```\nanew dear\n```\n"))
        self.assertNotIn("dear", messages("probe.md", "It is fine.\n\n```\nanew dear\n```\n"))
        self.assertIn("dear", messages("probe.hpp", "/// A trial is dear.\nint f();\n"))
        self.assertIn("41 words", messages("probe.hpp", "/// " + "word " * 41 + "\nint f();\n"))
        self.assertEqual("", messages("probe.hpp", "/// " + "word " * 20 + ".\n/// " + "word " * 25 + "\nint f();\n"))

    def test_there_are_no_new_offences(self):
        allowed = json.loads(BASELINE.read_text(encoding="utf-8"))
        problems = []
        for name, offences in all_offences().items():
            if len(offences) > allowed.get(name, 0):
                problems.append(f"{name} has {len(offences)} offences; {allowed.get(name, 0)} are allowed:")
                problems += [f"    {name}:{line}: {message}" for line, message in offences]
        self.assertFalse(problems, "\n" + "\n".join(problems))


def update() -> None:
    counts = {name: len(offences) for name, offences in all_offences().items()}
    allowed = json.loads(BASELINE.read_text(encoding="utf-8")) if BASELINE.exists() else counts
    lowered = {name: min(count, allowed.get(name, 0)) for name, count in counts.items()}
    text = json.dumps({name: count for name, count in lowered.items() if count}, indent=1)
    BASELINE.write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    if "--list" in sys.argv:
        total: collections.Counter[str] = collections.Counter()
        for name, offences in all_offences().items():
            for line, message in offences:
                print(f"{name}:{line}: {message}")
                total[re.sub(r"\d+ words: .*", "N words", message)] += 1
        for message, count in total.most_common():
            print(f"{count:6} {message}", file=sys.stderr)
    elif "--update" in sys.argv:
        update()
    else:
        unittest.main()
