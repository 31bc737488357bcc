"""What Debian's tools know: which package owns a file, and what a list of packages installs."""

import functools
import os
import pathlib
import re
import shutil
import subprocess

ASSUMED = ["apt", "git", "ca-certificates", "sudo"]


class Unknown(Exception):
    """This machine cannot answer."""


def output_of(command, **more):
    return subprocess.run(command, capture_output=True, text=True, check=False, env={**os.environ, "LC_ALL": "C"}, **more).stdout


def require_package_lists():
    for program in ("apt-get", "apt-cache", "dpkg-query", "bash"):
        if not shutil.which(program):
            raise Unknown(f"{program} is not installed")
    files = output_of(["apt-get", "indextargets", "--format", "$(FILENAME)", "Created-By: Packages"]).split("\n")
    if not any(f and next(pathlib.Path(f).parent.glob(pathlib.Path(f).name + "*"), None) for f in files):
        raise Unknown("apt has no package lists (apt-get update was never run)")


def list_in(script, name):
    """The packages in an array of a shell script."""
    return output_of(["bash", "-c", f'. "$1" && printf "%s\\n" "${{{name}[@]}}"', "bash", str(script)]).split()


@functools.lru_cache(maxsize=None)
def real_folder(folder):
    return os.path.realpath(folder)


@functools.lru_cache(maxsize=None)
def chain_of_links(path):
    """Each symbolic link from the path to the file, and the file; with whether an alternative was chosen on the way."""
    chain, by_alternative = [], False
    while True:
        parent, name = os.path.split(path)
        path = os.path.join(real_folder(parent), name)
        by_alternative = by_alternative or path.startswith("/etc/alternatives/")
        chain.append((path, by_alternative))
        if not os.path.islink(path) or len(chain) > 40:
            return chain
        path = os.path.join(os.path.dirname(path), os.readlink(path))


def spellings(file):
    """The file's names in dpkg's database, which may lack or have /usr where /lib is a link to /usr/lib."""
    yield file
    if re.match(r"/usr/(s?bin|lib[^/]*)/", file):
        yield file[len("/usr"):]


def owners(files):
    """{file: [package…]} of the files that a package owns."""
    known = {}
    names = [s for file in files for s in spellings(file)]
    for i in range(0, len(names), 2000):
        for line in output_of(["dpkg-query", "-S", *names[i:i + 2000]]).splitlines():
            packages, _, file = line.partition(": ")
            if not packages.startswith("diversion by "):
                known[file] = sorted({p.partition(":")[0] for p in packages.split(", ")})
    found = {file: next((known[s] for s in spellings(file) if s in known), None) for file in files}
    return {file: packages for file, packages in found.items() if packages}


def general_name(package):
    """libboost-dev for libboost1.74-dev, if there is such a package."""
    stem = re.sub(r"-?\d[\d.]*(?=-|$)", "", package)
    return stem if stem != package and output_of(["apt-cache", "show", stem]) else package


def version_free(package):
    return re.sub(r"\d[\d.]*", "", package)


class Closure:
    """The packages that apt would install on a minimal machine."""

    def __init__(self, names):
        self.names = names
        self._version_free = {version_free(n) for n in names}
        self._fields = None

    def has(self, package, by_alternative=False):
        """Another version of a package counts as the package; so does any that provides the same, among alternatives."""
        if package in self.names or version_free(package) in self._version_free:
            return True
        return by_alternative and not self.provided.isdisjoint(provides_of(self.fields.get(package) or fields([package])[package]))

    @property
    def fields(self):
        self._fields = self._fields or fields(self.names)
        return self._fields

    @property
    def provided(self):
        return {p for f in self.fields.values() for p in provides_of(f)}

    def dependants(self, package):
        return sorted(n for n, f in self.fields.items() if package in relations(f, "Depends", "Pre-Depends"))


def fields(packages):
    """{package: text} of apt's descriptions."""
    texts = output_of(["apt-cache", "show", "--no-all-versions", *sorted(packages)]).split("\n\n")
    return {p: "" for p in packages} | {m[1]: t for t in texts if (m := re.match(r"Package: (\S+)", t))}


def relations(text, *names):
    values = ", ".join(re.findall(rf"^(?:{'|'.join(names)}): (.*)", text, re.M))
    return {re.split(r"[\s:(]", part.strip(), maxsplit=1)[0] for part in re.split("[,|]", values)} - {""}


def provides_of(text):
    return relations(text, "Provides")


@functools.lru_cache(maxsize=None)
def minimal_system():
    """The packages that every machine has, as far as apt knows them."""
    lines = output_of(["dpkg-query", "-W", "-f", "${Package} ${Priority} ${Essential}\n"]).splitlines()
    names = {line.split()[0] for line in lines if line.split()[1] == "required" or line.endswith(" yes")}
    return [p for p, text in fields({*names, *ASSUMED}).items() if text]


@functools.lru_cache(maxsize=None)
def closure(packages, cache):
    """What `apt-get install --no-install-recommends` of the packages installs where nothing is installed."""
    (cache / "partial").mkdir(parents=True, exist_ok=True)
    wanted = [*packages, *minimal_system()]
    # --print-uris takes half of the time of a simulation (-s), but leaves out packages of sources on this machine.
    for form, name in ("--print-uris", r"^'[^']*' ([^_\s]+)_"), ("-s", r"^Inst (\S+)"):
        command = ["apt-get", "-qq", form, "-o", "Dir::State::status=/dev/null", "-o", f"Dir::Cache::archives={cache}",
                   "-o", "Debug::NoLocking=1", "install", "--no-install-recommends", *wanted]
        done = subprocess.run(command, capture_output=True, text=True, check=False, env={**os.environ, "LC_ALL": "C"})
        if done.returncode != 0:
            raise SystemExit(f"{' '.join(command)}\nended with {done.returncode}: {done.stderr}")
        names = set(re.findall(name, done.stdout, re.M))
        if names.issuperset(wanted):
            break
    return Closure(names)
