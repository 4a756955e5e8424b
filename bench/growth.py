#!/usr/bin/env python3
"""Measures how CPU time and memory grow with joints, obstacles, the length of a motion, cases of a run and failures of
a corpus, and draws the curves: bench/growth.py CONTORT [--plot FILE.svg]. For docs/internals/performance.md."""

import argparse
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

RATE_HZ = 60


class Measured:
    """CPU seconds and peak memory of one command, its worker processes included."""

    def __init__(self, command):
        process = subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        problem = process.stderr.read()
        _, status, usage = os.wait4(process.pid, 0)
        self.cpu_s, self.memory_mb = usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024
        if os.waitstatus_to_exitcode(status) not in (0, 1):
            sys.exit(f"{command}: {problem.decode()[-500:]}")


def write_bvh(path, joints, frames):
    """A chain that swings gently. Written line by line: a child's peak memory counts its parent's when it began."""
    lines = ["HIERARCHY", "ROOT joint_0", "{", "OFFSET 0 1 0", "CHANNELS 3 Zrotation Xrotation Yrotation"]
    for j in range(1, joints):
        lines += [f"JOINT joint_{j}", "{", "OFFSET 0 0.1 0", "CHANNELS 3 Zrotation Xrotation Yrotation"]
    lines += ["End Site", "{", "OFFSET 0 0.1 0", "}"] + ["}"] * joints
    lines += ["MOTION", f"Frames: {frames}", f"Frame Time: {1 / RATE_HZ}"]
    with path.open("w") as file:
        file.write("\n".join(lines) + "\n")
        for f in range(frames):
            angle = round(5 * math.sin(2 * math.pi * f / RATE_HZ), 3)
            file.write(f"{angle} 0 {angle} " * joints + "\n")


def of_joints(contort, folder, joints):
    write_bvh(folder / "chain.bvh", joints, 10 * RATE_HZ)
    return Measured([contort, "check", folder / "chain.bvh", "--max-speed-deg-s", 1000])


def of_seconds(contort, folder, seconds):
    write_bvh(folder / "long.bvh", 20, seconds * RATE_HZ)
    return Measured([contort, "check", folder / "long.bvh", "--max-speed-deg-s", 1000])


def of_obstacles(contort, folder, obstacles):
    """A walk of ten seconds along rows of pillars."""
    pillars = [{"name": f"pillar_{n}", "shape": {"type": "box", "center_m": [1.0 if n % 2 else -1.0, 0.5, 0.25 * n],
                                                 "half_m": [0.1, 0.5, 0.1]}} for n in range(obstacles)]
    walk = {"action": "walk", "slot": "waist", "duration_frames": 10 * RATE_HZ, "params": {"speed_m_s": 1.0}}
    spec = {"format": "contort.spec/1", "character": {"name": "human"}, "environment": {"obstacles": pillars},
            "sequences": [{"name": "walk", "clips": [{"actions": [walk]}]}]}
    (folder / "pillars.json").write_text(json.dumps(spec))
    return Measured([contort, "check", folder / "pillars.json"])


def of_cases(contort, folder, cases):
    shutil.rmtree(folder / "run", ignore_errors=True)
    return Measured([contort, "fuzz", "--profile", "tame", "--cases", cases, "--seed", 1, "--jobs", 1, "--corpus",
                     folder / "run"])


def of_failures(contort, folder, failures):
    """A corpus with copies of one stored failure of a made-up limit, each under a joint's name of its own."""
    corpus = folder / "corpus"
    if not corpus.exists():
        strict = {"format": "contort.settings/1", "limits": [{"check": "angular_velocity", "tolerance": -1.5,
                                                              "reason": "Ordinary motion has to fail."}]}
        (folder / "strict.json").write_text(json.dumps(strict))
        Measured([contort, "fuzz", "--cases", 48, "--seed", 3, "--shrink-evaluations", 6, "--settings",
                  folder / "strict.json", "--corpus", corpus])
    buckets = corpus / "buckets"
    present = sorted(buckets.iterdir())
    for n in range(len(present), failures):
        copy = buckets / f"{present[0].name.split('-')[0]}-{n:012x}"
        shutil.copytree(present[0], copy)
        described = json.loads((copy / "bucket.json").read_text())
        described["id"] = f"{n:012x}"
        (copy / "bucket.json").write_text(json.dumps(described))
    return Measured([contort, "corpus", "list", corpus])


SERIES = {
    "joints": ("chain of joints, a clip of 10 s", of_joints, [10, 30, 100, 300]),
    "seconds": ("clip of 20 joints, s", of_seconds, [10, 60, 600, 3600]),
    "obstacles": ("obstacles beside a walk of 10 s", of_obstacles, [1, 4, 16, 64]),
    "cases": ("cases of a run of tame", of_cases, [30, 300, 3000]),
    "failures": ("failures of a corpus that is listed", of_failures, [100, 1000, 10_000]),
}


def exponent(sizes, values):
    """Slope of the curve's last step in logarithms: 1 is linear."""
    return math.log(values[-1] / values[-2]) / math.log(sizes[-1] / sizes[-2])


def path_of(sizes, values, left, top):
    x = [left + 40 + 180 * math.log(n / sizes[0]) / math.log(sizes[-1] / sizes[0]) for n in sizes]
    least = min(values)
    y = [top + 150 - 130 * math.log10(max(v, 1e-9) / least) / 4 for v in values]
    return " ".join(f"{'M' if i == 0 else 'L'}{a:.1f} {b:.1f}" for i, (a, b) in enumerate(zip(x, y)))


def plot(measured):
    """A panel for each series: both axes logarithmic, four powers of ten high, each curve from its smallest value."""
    out = [f"<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {250 * len(measured)} 200' font-family='sans-serif' "
           "font-size='11'><rect width='100%' height='100%' fill='white'/>"]
    for n, (title, sizes, runs) in enumerate(measured):
        left = 250 * n
        out.append(f"<text x='{left + 40}' y='14'>{title}</text>")
        for power in range(5):
            y = 170 - 130 * power / 4
            out.append(f"<path d='M{left + 40} {y}h180' stroke='#ddd'/>"
                       f"<text x='{left + 4}' y='{y + 4}'>×1e{power}</text>")
        for values, colour in (([r.cpu_s for r in runs], "#c33"), ([r.memory_mb for r in runs], "#36c")):
            out.append(f"<path d='{path_of(sizes, values, left, 20)}' fill='none' stroke='{colour}' stroke-width='2'/>")
        out.append(f"<text x='{left + 40}' y='190'>{sizes[0]}</text><text x='{left + 220}' y='190' "
                   f"text-anchor='end'>{sizes[-1]}</text>")
    return "\n".join(out) + "\n<!-- red: CPU time; blue: peak memory -->\n</svg>\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("contort", type=Path)
    parser.add_argument("--only", nargs="+", choices=SERIES, default=list(SERIES))
    parser.add_argument("--plot", type=Path, help="SVG file to write")
    args = parser.parse_args()
    print("| grows | sizes | CPU time, s | peak memory, MB | exponent of time | of memory |\n|---|---|---|---|---|---|")
    measured = []
    with tempfile.TemporaryDirectory() as folder:
        for name in args.only:
            title, measure, sizes = SERIES[name]
            runs = [measure(args.contort.resolve(), Path(folder), size) for size in sizes]
            measured.append((title, sizes, runs))
            times, memories = [run.cpu_s for run in runs], [run.memory_mb for run in runs]
            print(f"| {title} | {', '.join(map(str, sizes))} | {', '.join(f'{t:.2f}' for t in times)} | "
                  f"{', '.join(f'{m:.0f}' for m in memories)} | {exponent(sizes, times):.2f} | "
                  f"{exponent(sizes, memories):.2f} |", flush=True)
    if args.plot:
        args.plot.write_text(plot(measured))


if __name__ == "__main__":
    main()
