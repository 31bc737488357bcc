"""Prints the processor time that each test takes, and the sum of each folder.

    python3 tests/costs.py BUILD [REGULAR_EXPRESSION]

Runs the tests of a build folder whose names match, one at a time, and prints a Markdown table, longest first. Processor
time includes that of child processes, and hardly depends on what else the machine does. Tests that take less than a
second count only in the sums. PHASETREE_LONG_TESTS selects the long forms.
"""

import collections
import json
import os
import re
import subprocess
import sys


def listed(build):
    """Yields (name, command, working folder, environment) of each test."""
    text = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], capture_output=True, text=True, check=True).stdout
    for test in json.loads(text)["tests"]:
        properties = {p["name"]: p["value"] for p in test.get("properties", [])}
        added = dict(entry.partition("=")[::2] for entry in properties.get("ENVIRONMENT", []))
        yield test["name"], test.get("command", []), properties.get("WORKING_DIRECTORY", build), {**os.environ, **added}


def processor_seconds():
    times = os.times()
    return times.children_user + times.children_system


def main():
    build, pattern = sys.argv[1], re.compile(sys.argv[2] if len(sys.argv) > 2 else "")
    costs, failed = {}, []
    for name, command, folder, environment in listed(build):
        if not pattern.search(name) or not command:
            continue
        before = processor_seconds()
        done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, check=False)
        costs[name] = processor_seconds() - before
        # 77 is the exit code of a skipped test.
        if done.returncode not in (0, 77):
            failed.append(name)
        print(f"{costs[name]:7.1f} {name}", file=sys.stderr, flush=True)
    folders = collections.Counter()
    for name, cost in costs.items():
        folders[name.partition("/")[0]] += cost
    print("| test | processor time, s |\n|---|---|")
    for name, cost in sorted(costs.items(), key=lambda item: -item[1]):
        if cost >= 1:
            print(f"| `{name}` | {cost:.0f} |")
    print("\n| folder | processor time, s |\n|---|---|")
    for name, cost in folders.most_common():
        print(f"| `{name}` | {cost:.0f} |")
    print(f"| all | {sum(costs.values()):.0f} |")
    for name in failed:
        print(f"{name} failed", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
