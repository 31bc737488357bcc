"""phasetree for the documents' shell blocks: renders small pictures with few samples, and ends `view` once it serves."""

import os
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import forked

COMMAND = os.environ["PHASETREE_COMMAND"]


def without(arguments: list[str], option: str) -> list[str]:
    """The arguments without an option and its value."""
    kept, skip = [], False
    for argument in arguments:
        if not skip and argument != option:
            kept.append(argument)
        skip = argument == option
    return kept


def value_of(arguments: list[str], option: str) -> str | None:
    return arguments[arguments.index(option) + 1] if option in arguments else None


def view(arguments: list[str]) -> int:
    """Serves the page until it has an address."""
    words = [a for a in arguments if a != "--open"]
    with subprocess.Popen([COMMAND, *words, "--width", "24"], stdout=subprocess.PIPE, text=True) as process:
        address = process.stdout.readline()
        process.terminate()
        try:
            process.wait(timeout=30)
        except subprocess.TimeoutExpired:
            process.kill()
    return 0 if "http://127.0.0.1" in address else 1


def main() -> int:
    arguments = sys.argv[1:]
    if arguments[:1] == ["view"]:
        return view(arguments)
    if arguments[:1] == ["render"]:
        if "--time" in arguments:
            arguments = [*without(arguments, "--time"), "--time", "0.3s"]
        if "--sample-range" not in arguments and "--samples" not in arguments:
            enough = 8 if any(a.startswith("--denoise") for a in arguments) else 1
            # Few samples are kept, so that a picture has the bytes of its parts.
            if not enough <= int(value_of(arguments, "--spp") or 0) <= 32:
                arguments = [*without(arguments, "--spp"), "--spp", str(enough)]
        arguments = [*without(arguments, "--size"), "--size", "24x18"]
    if arguments[:1] == ["measure"] and "--time" in arguments:
        arguments = [*without(arguments, "--time"), "--time", "1s"]
    if arguments[:1] == ["export"] and "--spacing" not in arguments:
        if not any(a.endswith((".html", ".glsl")) for a in arguments):
            arguments += ["--spacing", "0.05"]
    return forked.exit_code(arguments)


sys.exit(main())
