#!/usr/bin/env python3
# What planes of the film cost: time of rendering, memory, and the size of files, as a table in Markdown.
#
#   benchmarks/planes_cost.py build/release/tracer/phasetree [ROUNDS [PLANES…]]
#
# Time is processor time against the picture alone, the median of rounds in each of which all are run in turn, one thread
# each. Memory is the peak against the picture alone, and the file what it is larger by; both a million pixels.
import os
import statistics
import subprocess
import sys
import tempfile

SCENE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "scenes", "drinks.json")
ROWS = [
    ("", "the picture alone"),
    ("depth,position,normal,albedo", ""),
    ("depth_behind,position_behind,normal_behind,albedo_behind", ""),
    ("phase_from,phase_to,object,instance", ""),
    ("length", " (eleven phases)"),
    ("direct,indirect", ""),
    ("lights", " (one group)"),
    ("variance", ""),
    ("noise,samples", ""),
    ("half", ""),
    ("crypto_phase,crypto_object,crypto_material", ""),
    ("all", ""),
]


def run(program, planes, words, output):
    """The processor time in seconds and the peak of memory in bytes of one render."""
    command = [program, "render", SCENE, "--quiet", "--threads", "1", "-o", output, *words]
    if planes:
        command += ["--planes", planes]
    process = subprocess.Popen(command)
    _, status, used = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"{' '.join(command)}: failed")
    return used.ru_utime + used.ru_stime, 1024 * used.ru_maxrss


def main():
    program, rounds = os.path.abspath(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 5
    if wanted := sys.argv[3:]:  # only some, against the picture alone
        ROWS[:] = [row for row in ROWS if not row[0] or row[0] in wanted]
    with tempfile.TemporaryDirectory() as folder:
        times, memory, size = {}, {}, {}
        for _ in range(rounds):
            seconds = [run(program, p, ["--size", "480x270", "--spp", "16"], f"{folder}/a.exr")[0] for p, _ in ROWS]
            for (planes, _), s in zip(ROWS, seconds):
                times.setdefault(planes, []).append(s / seconds[0])
        for planes, _ in ROWS:
            _, memory[planes] = run(program, planes, ["--size", "1920x1080", "--spp", "1"], f"{folder}/a.exr")
            run(program, planes, ["--size", "960x540", "--spp", "16"], f"{folder}/a.exr")
            size[planes] = os.path.getsize(f"{folder}/a.exr")
    print("| planes | time | memory | EXR |\n|---|---|---|---|")
    for planes, words in ROWS:
        name = words if not planes else ", ".join(f"`{p}`" for p in planes.split(",")) + words
        extra = (memory[planes] - memory[""]) / (1920 * 1080)
        if not planes:
            print(f"| {name} | 1 | {memory[''] / 1e6:.0f} MB in all | {size[''] / (960 * 540):.1f} MB |")
        else:
            print(f"| {name} | {statistics.median(times[planes]):.2f} | {extra:.0f} MB | "
                  f"{(size[planes] - size['']) / (960 * 540):.1f} MB |")


main()
