"""Files outside the repository that the build and the tests use."""

import ast
import collections
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

import debian

SOURCE = pathlib.Path(__file__).resolve().parents[2]

# A file, what of ours uses it, and the list of packages that must provide it.
Use = collections.namedtuple("Use", "file reader list")

# Programs and modules that tests use where they are installed, and are skipped without.
OPTIONAL_PROGRAMS = {"blender", "chromium", "chromium-browser", "google-chrome", "groff", "lintian", "setarch", "ninja-build"}
OPTIONAL_MODULES = {"IPython", "pip", "setuptools", "wheel", "nbconvert"}
# Scripts beside the tests that make pictures, or that are run by hand.
NOT_RUN_BY_TESTS = {"studio_tutorial.py", "pictures.py", "check_exports.py"}
# Libraries that CMake takes only where they are installed, and that the lists leave out.
OPTIONAL_PATHS = re.compile(r"/benchmark/|libbenchmark|OpenImageDenoise")


def text_of(path):
    return pathlib.Path(path).read_text(encoding="utf-8", errors="replace")


def is_outside(path):
    is_ours = path.startswith((f"{SOURCE}/", "/tmp/", "/proc/", "/dev/"))
    return path.startswith("/") and not is_ours and not OPTIONAL_PATHS.search(path) and os.path.isfile(path)


class Build:
    """A folder that CMake made a build in, by Ninja or make."""

    def __init__(self, folder):
        self.folder = folder.resolve()
        cache = self.folder / "CMakeCache.txt"
        if not cache.is_file():
            raise debian.Unknown(f"{folder} has no CMakeCache.txt")
        self.cache = dict(re.findall(r"^([^#/:\n]+:[A-Z]+)=(.*)$", text_of(cache), re.M))

    def value(self, name):
        return next((v for k, v in self.cache.items() if k.partition(":")[0] == name), "")

    def dependencies(self):
        """{object: [path…]}: what the compiler read for each object."""
        if (self.folder / "build.ninja").is_file():
            text = debian.output_of([self.value("CMAKE_MAKE_PROGRAM") or "ninja", "-C", str(self.folder), "-t", "deps"])
            parts = [part.split("\n") for part in re.sub(r"^ninja: .*\n", "", text).split("\n\n")]
            found = {head.partition(":")[0]: [f.strip() for f in files] for head, *files in parts if head}
        else:
            texts = [text_of(d).replace("\\\n", " ") for d in self.folder.rglob("*.o.d")]
            found = {head: files.split() for head, _, files in (text.partition(":") for text in texts)}
        if not found:
            raise debian.Unknown(f"{self.folder} has no dependency information of compilers: it is not built, or by a generator that keeps none")
        return found

    def named_files(self):
        """Programs, libraries and CMake's files that the build system names."""
        # Of the cache, programs only: the libraries in it may be found without being used.
        found = {v for k, v in self.cache.items() if k.endswith(":FILEPATH") and not re.search(r"\.(so|a)$", v)}
        patterns = ("build.ninja", "CMakeFiles/rules.ninja", "CMakeFiles/Makefile.cmake", "**/link.txt")
        for file in (f for pattern in patterns for f in self.folder.glob(pattern)):
            found.update(re.findall(r'(?<![\w./-])/[^\s"|;:,$]+', text_of(file).replace("$ ", "\0")))
        found = {f for f in found if is_outside(f)}
        return found | {f for cmake in found if cmake.endswith(".cmake") for f in checked_files(cmake)} | set(self.pc_files())

    def pc_files(self):
        """The .pc files of the modules that pkg-config was asked for, and of those that they require."""
        folders = debian.output_of(["pkg-config", "--variable", "pc_path", "pkg-config"]).strip().split(":")
        modules, seen = [v for k, v in self.cache.items() if k.endswith("_MODULE_NAME:INTERNAL")], set()
        while modules:
            module = modules.pop()
            file = next((f for f in (f"{folder}/{module}.pc" for folder in folders) if os.path.isfile(f)), None)
            if file and file not in seen:
                seen.add(file)
                yield file
                for names in re.findall(r"^Requires(?:\.private)?:(.*)", text_of(file), re.M):
                    modules += re.findall(r"[\w.+-]+", re.sub(r"[<>=!]+\s*[\d.]+", "", names))


def checked_files(cmake):
    """The files whose absence a package's CMake file makes an error."""
    text = text_of(cmake)
    if "_IMPORT_PREFIX" not in text:
        return
    main = re.sub(r"-[a-z]+\.cmake$", ".cmake", cmake)
    if 'message(FATAL_ERROR "The imported target' not in (text_of(main) if os.path.isfile(main) else text):
        return
    for name in set(re.findall(r'\$\{_IMPORT_PREFIX\}(/[^"\s;$]+)', text)):
        for folder in pathlib.Path(cmake).parents:
            if os.path.isfile(f"{folder}{name}"):
                yield f"{folder}{name}".replace("//", "/")
                break


def of_command(build, work):
    """What the phasetree command and the libraries are built with, by a configure run of their own."""
    probed = [f"-D{k}={v}" for k, v in build.cache.items() if k.endswith("_PROBED:INTERNAL")]
    command = ["cmake", "--preset", "quickstart", "-G", build.value("CMAKE_GENERATOR"), "-B", str(work),
               "-DPHASETREE_BUILD_PYTHON=OFF", *probed]
    for name in ("CMAKE_C_COMPILER", "CMAKE_CXX_COMPILER", "CMAKE_PREFIX_PATH"):
        command += [f"-D{name}={build.value(name)}"] if build.value(name) else []
    done = subprocess.run(command, cwd=SOURCE, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(command)}\nended with {done.returncode}\n{done.stdout}{done.stderr}")
    uses = [Use(f, "CMake, or the build", "packages_to_build") for f in Build(work).named_files()]
    for name, files in build.dependencies().items():
        if re.match(r"(lib|tracer|plugins/embree|plugins/packaging)/", name):
            uses += uses_of_object(name, files, "packages_to_build")
    uses += linked([build.folder / "tracer/phasetree", *build.folder.glob("plugins/embree/embree?/*.so")], "packages_to_build")
    for script in ("tracer/quickstart.sh", "tracer/packages.sh"):
        uses += programs(SOURCE / script, "packages_to_build")
    return uses


def of_tests(build):
    uses = [Use(f, "CMake, or the build of the tests", "packages_to_test") for f in build.named_files()]
    for name, files in build.dependencies().items():
        uses += uses_of_object(name, files, "packages_to_test")
    uses += linked([*build.folder.glob("tests/**/test-*"), *build.folder.glob("plugins/python/phasetree/*.so")], "packages_to_test")
    uses += loaded_by_shader_tests(build)
    scripts = [SOURCE / "tests/run.sh", SOURCE / "tests/coverage.sh", *SOURCE.glob("tests/**/*.cmake"), *SOURCE.glob("tests/**/*.cpp")]
    scripts += python_scripts()
    for script in scripts:
        uses += programs(script, "packages_to_test")
    return uses + modules(build)


def uses_of_object(name, files, packages):
    ours = [os.path.basename(f) for f in files if str(SOURCE) in f and f.endswith(".cpp")]
    reader = f"{name.removesuffix('.o')} ({', '.join(ours)})" if ours else name.removesuffix(".o")
    return [Use(f, reader, packages) for f in files if is_outside(f)]


def linked(binaries, packages):
    uses = []
    for binary in (b for b in binaries if b.is_file() and not b.name.endswith(".o")):
        text = debian.output_of(["ldd", str(binary)])
        uses += [Use(f, binary.name, packages) for f in re.findall(r"(/\S+) \(0x", text) if is_outside(f)]
    return uses


def loaded_by_shader_tests(build):
    """The OpenGL driver, which is loaded at run time."""
    binary = build.folder / "tests/test-glsl"
    if not binary.is_file():
        return []
    command = [str(binary), "--source-file=*/rays.cpp", "--test-case=*GLSL 3.30*"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, env={**os.environ, "LD_DEBUG": "files", "LC_ALL": "C"})
    if not re.search(r"test cases: +[1-9]", done.stdout):
        raise SystemExit(f"{' '.join(command)} runs no test: name one that draws")
    files = set(re.findall(r"calling init: (/\S+)", done.stderr))
    return [Use(f, "test-glsl", "packages_to_test") for f in files if is_outside(f)]


def programs(script, packages):
    """The programs that a script names where a command stands, as far as they are installed."""
    text = re.sub(r"^\s*(#|//).*", "", text_of(script), flags=re.M)
    if script.suffix == ".sh":
        text = re.sub(r"'[^']*'|\"[^\"$]*\"", "''", text)  # programs for awk, messages
        before = r"(?:^|[|;&!{]|(?<!=)\(|\b(?:then|do|else|if|while|until|exec|command -v|env|xargs|twice|as_root)\s)"
        names = set(re.findall(before + r"\s*([a-z][\w.+-]*)(?=[\s)]|$)", text, re.M))
    elif script.suffix == ".cmake":
        names = {n for words in re.findall(r"(?:find_program\(\w+(?: NAMES)?|\brun(?:_failing)?\(|\bCOMMAND|set\(needs)((?: ?[a-z][\w.+-]*)+)", text)
                 for n in (words.split() if "COMMAND" not in words else words.split()[:1])}
    elif script.suffix == ".cpp":
        names = {n for line in re.findall(r"(?:std::system|popen)\((.*)", text) for n in re.findall(r"(?:\"|&& )([a-z][\w.+-]*) ", line)}
    else:
        names = set(re.findall(r"(?:subprocess\.\w+\(\s*\[|which\()\s*\"([\w.+-]+)\"", text))
    functions = set(re.findall(r"^(\w+)\(\)", text, re.M))
    found = {n: shutil.which(n) for n in names - functions - OPTIONAL_PROGRAMS}
    reader = str(script.relative_to(SOURCE))
    return [Use(path, reader, packages) for path in found.values() if path and is_outside(path)]


def python_scripts():
    """What tests run, and the package."""
    patterns = ("tests/compilers/*.py", "tests/packaging/*.py", "tests/python/*.py", "tests/view/*.py",
                "plugins/python/phasetree/*.py", "scenes/pages/*.py", "scenes/python/*.py")
    return [f for pattern in patterns for f in SOURCE.glob(pattern) if f.name not in NOT_RUN_BY_TESTS]


def modules(build):
    """The Python modules that the tests, the package and the notebooks import."""
    sources = {str(f.relative_to(SOURCE)): text_of(f) for f in python_scripts()}
    for notebook in SOURCE.glob("scenes/notebooks/*.ipynb"):
        cells = [c for c in json.loads(text_of(notebook))["cells"] if c["cell_type"] == "code"]
        sources[str(notebook.relative_to(SOURCE))] = "\n".join("".join(c["source"]) for c in cells)
    readers = {}
    for reader, text in sources.items():
        for node in ast.walk(ast.parse(text)):
            names = [a.name for a in node.names] if isinstance(node, ast.Import) else []
            if isinstance(node, ast.ImportFrom) and node.level == 0:
                names = [node.module]
            readers |= {n: reader for n in names if n.partition(".")[0] not in OPTIONAL_MODULES}
    find = """if True:
        import importlib.util, sys
        for name in sys.argv[1:]:
            try:
                spec = importlib.util.find_spec(name)
            except ImportError:
                continue
            print(name, spec.origin if spec else None)"""
    python = build.value("PHASETREE_PYTHON_EXECUTABLE") or sys.executable
    lines = [line.split(" ", 1) for line in debian.output_of([python, "-c", find, *sorted(readers)]).splitlines()]
    uses = [Use(python, "the Python tests", "packages_to_test")]
    return uses + [Use(file, readers[name], "packages_to_test") for name, file in lines if is_outside(file)]
