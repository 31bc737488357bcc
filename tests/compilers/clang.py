"""Clang compiles what GCC compiles, with the same warnings as errors.

    python3 clang.py BUILD [TARGET…]

BUILD has a compile_commands.json. The short form checks the kernels of the oldest and the newest instruction set, the
fuzzers, all headers, up to four sources that changed since HEAD~1, and every source that names a view of ranges, because
Clang 14 cannot compile most views of libstdc++. With PHASETREE_LONG_TESTS, it checks all sources; with TARGETs, all
sources of these targets.

Only syntax and types are checked. Sources that are compiled with the same options are checked as one unit, because parsing
the standard library's headers takes most of the time. If two of them give a name two meanings, they are checked again
without the others.

Exits with 77 where Clang is not installed.
"""

import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
SKIPPED = 77
# Options are GCC's; lib/cmake/compile_options.cmake has the second for builds with Clang.
FOR_CLANG = ["-Wno-unknown-warning-option", "-Wno-bitwise-instead-of-logical"]
SHORT_TARGETS = {"fuzz"}
MOST_CHANGED = 4
# The kernels of the instruction sets between these two differ only in their options.
KERNELS = tuple(f"/lib/src/kernel/{name}.cpp" for name in ("baseline", "avx512", "precise_baseline", "precise_avx512", "faces"))
# Views, and the algorithms that return one.
VIEW = re.compile(r"\bviews::|ranges::(subrange|unique|remove|partition|stable_partition|rotate|search|equal_range|find_end)\w*\b")
# Folders whose headers the short form checks, with the target whose options they are checked with.
HEADERS = [("phasetree", "lib/include"), ("phasetree", "lib/src"), ("phasetree_command", "tracer/src"),
           ("phasetree_embree[34]", "lib/embree"), ("phasetree_embree[34]", "plugins/embree"),
           ("phasetree_python", "plugins/python/src")]


def commands(build):
    """[(target, options, sources)]: sources of a target that are compiled with the same options."""
    groups = {}
    for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        words = shlex.split(entry["command"])
        file, target = entry["file"], re.search(r"CMakeFiles/([\w.+-]+)\.dir/", words[words.index("-o") + 1])[1]
        if not file.endswith((".cpp", ".cxx")):
            continue
        skip = {words.index("-o"), words.index("-o") + 1, words.index("-c"), words.index("-c") + 1}
        options = [w for i, w in enumerate(words) if i > 0 and i not in skip and not re.match(r"-O\d$|-fvisibility", w)]
        sources = [file]
        if "/Unity/" in file:
            sources = re.findall(r'^#include "([^"]+\.cpp)"', pathlib.Path(file).read_text(encoding="utf-8"), re.M)
        if "ccache" in os.path.basename(words[0]):
            options = options[1:]
        groups.setdefault((target, tuple(options)), []).extend(s for s in sources if os.path.isfile(s))
    return [(target, list(options), sources) for (target, options), sources in groups.items() if sources]


def changed_files():
    """Sources that differ from the commit before the last, at most MOST_CHANGED, spread over the list; none without git."""
    command = ["git", "-C", str(SOURCE), "diff", "--name-only", "HEAD~1"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError:
        return set()
    names = sorted(name for name in done.stdout.splitlines() if name.endswith(".cpp"))
    return {str(SOURCE / name) for name in names[:: max(1, -(-len(names) // MOST_CHANGED))]}


def names_a_view(source):
    return VIEW.search(pathlib.Path(source).read_text(encoding="utf-8", errors="replace")) is not None


def selected(groups, targets):
    if targets or os.environ.get("PHASETREE_LONG_TESTS"):
        yield from ((t, o, s) for t, o, s in groups if not targets or t in targets)
        return
    changed = changed_files()
    for target, options, sources in groups:
        if target not in SHORT_TARGETS:
            sources = [s for s in sources if s.endswith(KERNELS) or s in changed or names_a_view(s)]
        if sources:
            yield target, options, sources
    units = {}
    for target, folder in HEADERS:
        match = next(((t, o) for t, o, _ in groups if re.fullmatch(target, t)), None)
        if match:
            headers = sorted(h for h in (SOURCE / folder).rglob("*.hpp") if "examples" not in h.parts)
            units.setdefault((match[0], tuple(match[1])), []).extend(map(str, headers))
    yield from ((f"headers of {target}", list(options), headers) for (target, options), headers in units.items())


def compile_together(clang, options, sources, folder):
    """The compiler's messages, empty if it accepts the sources."""
    unit = folder / "unit.cpp"
    unit.write_text("".join(f'#include "{s}"\n' for s in sources), encoding="utf-8")
    command = [clang, *options, *FOR_CLANG, "-fsyntax-only", "-ferror-limit=0", "-fno-caret-diagnostics", str(unit)]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False, env={**os.environ, "LC_ALL": "C"})
    return "" if done.returncode == 0 else done.stderr or f"{shlex.join(command)} ended with {done.returncode}"


def with_errors(text, sources):
    """The sources that the errors are in."""
    found = set()
    for block in re.split(r"^(?=\S+:\d+:\d+: (?:fatal )?error: )", text, flags=re.M)[1:]:
        place = block.partition(":")[0]
        found |= {place} if place in sources else {s for s in sources if s in block}
    return [s for s in sources if s in found]


def errors_of(clang, options, sources, folder):
    """The messages about sources that Clang does not accept by themselves."""
    text = compile_together(clang, options, sources, folder)
    if not text or len(sources) == 1:
        return text
    failing = with_errors(text, sources)
    if failing and len(failing) < len(sources):
        # After a fatal error, say a header that is missing, the others were not checked.
        others = [s for s in sources if s not in failing] if "fatal error: " in text else []
        return errors_of(clang, options, failing, folder) + (errors_of(clang, options, others, folder) if others else "")
    return "".join(errors_of(clang, options, [s], folder) for s in sources)


def main():
    build, targets = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:]
    clang = shutil.which("clang++")
    if not clang:
        print("SKIPPED: clang++ is not installed")
        return SKIPPED
    failed = False
    with tempfile.TemporaryDirectory() as folder:
        for target, options, sources in selected(commands(build), targets):
            before = os.times()
            text = errors_of(clang, options, sources, pathlib.Path(folder))
            after = os.times()
            seconds = after.children_user + after.children_system - before.children_user - before.children_system
            print(f"{target}: {len(sources)} files, {seconds:.1f} s" + ("" if not text else f", which Clang does not accept:\n{text}"), flush=True)
            failed = failed or bool(text)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
