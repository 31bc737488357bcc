"""Every file of a Debian or Ubuntu package that the build or the tests use belongs to a package that tracer/packages.sh
lists, or to a dependency of one.

A fresh machine is assumed to have packages of priority "required", and apt, git, ca-certificates and sudo; everything else
must follow from the lists, without recommended packages. What the command and the libraries read counts against
packages_to_build, everything else in the build and the tests against packages_to_test. Files that no package owns, below
/usr/local for example, are skipped.

    python3 listed_packages.py BUILD                  a finished build, with Ninja or make
    python3 listed_packages.py BUILD --without NAME   as if NAME were not in the lists; it should fail
    python3 listed_packages.py BUILD --without EACH   a table of what happens without each of them in turn (minutes)

Exits with 77 if this machine cannot tell, for example without apt.
"""

import argparse
import concurrent.futures
import pathlib
import sys
import tempfile

import debian
import used_files

SKIPPED = 77
SCRIPT = "tracer/packages.sh"
LISTS = ("packages_to_build", "packages_to_test")


def missing_packages(uses, closures, owners):
    """{(list, package): use} for each package that the list neither contains nor depends on, with its first use."""
    missing = {}
    for use in uses:
        for file, by_alternative in debian.chain_of_links(use.file):
            packages = owners.get(file, ())
            if packages and not any(closures[use.list].has(p, by_alternative) for p in packages):
                missing.setdefault((use.list, packages[0]), (file, use.reader))
    return missing


def report(missing):
    for (name, package), (file, reader) in sorted(missing.items()):
        print(f"{SCRIPT}: {name} does not install {package}: {reader} uses {file}. Add {debian.general_name(package)} to {name}.")


def closures_of(lists, work):
    debian.minimal_system()
    with concurrent.futures.ThreadPoolExecutor() as pool:
        return dict(zip(lists, pool.map(lambda names: debian.closure(tuple(names), work / "archives"), lists.values())))


def without(name, lists):
    return {key: [p for p in names if p != name] for key, names in lists.items()}


def table(uses, lists, owners, work):
    """Prints what becomes of the test without each package; returns whether every package is needed."""
    ok = True
    print("| package | without it |\n|---|---|")
    for name in lists["packages_to_test"]:
        closures = closures_of(without(name, lists), work)
        missing = missing_packages(uses, closures, owners)
        closure = closures["packages_to_build" if name in lists["packages_to_build"] else "packages_to_test"]
        if missing:
            (_, package), (file, reader) = min(missing.items())
            text = f"fails: {reader} uses {file} of {package}"
        elif name in closure.names:
            text = f"passes: it is a dependency of {', '.join(closure.dependants(name)[:3])}"
        else:
            ok, text = False, "passes: NOTHING USES IT"
        print(f"| {name} | {text} |", flush=True)
    return ok


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--without", metavar="NAME")
    arguments = parser.parse_args()
    try:
        debian.require_package_lists()
        build = used_files.Build(arguments.build)
        lists = {name: debian.list_in(used_files.SOURCE / SCRIPT, name) for name in LISTS}
        with tempfile.TemporaryDirectory() as folder:
            work = pathlib.Path(folder)
            uses = used_files.of_command(build, work / "command") + used_files.of_tests(build)
            files = sorted({file for use in uses for file, _ in debian.chain_of_links(use.file)})
            owners = debian.owners(files)
            if arguments.without == "EACH":
                return 0 if table(uses, lists, owners, work) else 1
            missing = missing_packages(uses, closures_of(without(arguments.without, lists), work), owners)
    except debian.Unknown as error:
        print(f"SKIPPED: {error}")
        return SKIPPED
    report(missing)
    packages = {p for file in files for p in owners.get(file, ())}
    print(f"{len(files)} files of {len(packages)} packages; {sum(f not in owners for f in files)} that no package owns are skipped")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
