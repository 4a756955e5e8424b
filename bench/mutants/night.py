#!/usr/bin/env python3
"""Measures what a night tells its reader, for docs/internals/mutants.md: clean nights one after the other, each with
all earlier ones as baseline, and then one night of each planted fault with the clean nights as baseline. Judged are
the rows that the command prints, as a person reads them."""

import argparse
import random
import re
import shutil
import statistics
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

sys.dont_write_bytecode = True
from against import passes  # noqa: E402
from faults import CLEAN, HERE, ROOT, Builds, Mutant, run, say  # noqa: E402

FIRST_ROWS = 3  # a reader with ten minutes looks at these


@dataclass
class Night:
    """One run's printed result. marks and minimal_cases have an element for each printed row, in order."""

    seconds: float
    failing: int = 0
    causes: int = 0
    marks: list = field(default_factory=list)
    sentences: list = field(default_factory=list)
    minimal_cases: list = field(default_factory=list)

    def news(self):
        return sum(mark in ("NEW", "MORE") for mark in self.marks)


def read_rows(text, seconds):
    night = Night(seconds)
    head = re.search(r"; ([\d\u202f]+) cases? fails?, by ([\d\u202f]+) cause", text)
    if not head and "RESULT findings=0 " not in text:
        raise RuntimeError("the result of the night cannot be read: " + text[:200])
    if head:
        night.failing, night.causes = (int(number.replace("\u202f", "")) for number in head.groups())
    rows = re.finditer(r"^\d+\. +(?:(NEW|MORE|RARE) +)?(.*)\n.*contort replay (\S+)$", text, re.MULTILINE)
    for mark, sentence, path in (row.groups() for row in rows):
        night.marks.append(mark or "")
        night.sentences.append(sentence)
        night.minimal_cases.append(path)
    return night


def play(binary, args, seed, corpus, baseline=None):
    length = ["--time", args.time] if args.time else ["--cases", args.cases]
    command = [binary, "fuzz", *length, "--seed", seed, "--jobs", args.jobs, "--corpus", corpus,
               "--profile", args.profile]
    begun = time.monotonic()
    done = run(command + (["--baseline", baseline] if baseline else []))
    if done.returncode not in (0, 1, 4):
        raise RuntimeError(done.stderr[-500:])
    return read_rows(done.stdout, time.monotonic() - begun)


def play_clean_nights(binary, args, corpus):
    """Adds clean nights to one corpus. Each is compared with those before it: its news are false alarms."""
    print("| clean night | failing cases | causes | false alarms |\n|---|---|---|---|")
    for seed in range(args.first_seed, args.first_seed + args.clean_nights):
        if any((corpus / "runs").glob(f"seed_{seed}_*.json")):
            continue
        is_first = not corpus.exists()
        night = play(binary, args, seed, corpus)
        told = [f"{mark} {sentence}" for mark, sentence in zip(night.marks, night.sentences) if mark in ("NEW", "MORE")]
        alarms = "(first)" if is_first else "; ".join(told) or 0
        print(f"| {seed} | {night.failing} | {night.causes} | {alarms} |", flush=True)


def true_rows(night, clean):
    """The ranks, from 1, of the rows that are marked as news and whose minimal case passes on the clean build."""
    return [rank for rank, (mark, case) in enumerate(zip(night.marks, night.minimal_cases), 1)
            if mark in ("NEW", "MORE") and passes(clean, case)]


def play_faults(mutants, builds, args, baseline):
    print("| fault | failing cases | causes | marked as news | rows of the fault | first row | seconds |\n"
          "|---|---|---|---|---|---|---|")
    ranks = {}
    for mutant in mutants:
        if not args.built and not builds.make(mutant.name, mutant.id, mutant.path):
            continue
        corpus = args.out / "nights" / mutant.name
        shutil.rmtree(corpus, ignore_errors=True)
        try:
            night = play(builds.binary(mutant.name), args, args.fault_seed, corpus, baseline)
            rows = true_rows(night, builds.binary(CLEAN))
        except (RuntimeError, ValueError, OSError) as error:  # one fault that fails must not end the bench
            say(f"{mutant.name}: no result: {error!r}")
            continue
        ranks[mutant.name] = rows
        print(f"| {mutant.name} | {night.failing} | {night.causes} | {night.news()} | {len(rows)} | "
              f"{rows[0] if rows else '–'} | {night.seconds:.0f} |", flush=True)
    found = [rows for rows in ranks.values() if rows and rows[0] <= FIRST_ROWS]
    print(f"\n{len(found)} of {len(ranks)} faults have a row of theirs among the first {FIRST_ROWS}; rows of a fault, "
          f"median: {statistics.median(map(len, found)) if found else 0}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    parser.add_argument("--out", type=Path, default=ROOT / "contort-out/mutants",
                        help="builds are kept here, as by run.py")
    parser.add_argument("--only", nargs="+", help="mutants whose names contain one of these words")
    parser.add_argument("--sample", type=int, default=0, help="so many faults, drawn at random (0: all)")
    parser.add_argument("--profile", default="nightly")
    parser.add_argument("--cases", type=int, default=8000, help="length of a night")
    parser.add_argument("--time", help="length of a night instead of --cases, such as 10m")
    parser.add_argument("--clean-nights", type=int, default=10)
    parser.add_argument("--first-seed", type=int, default=1, help="seed of the first clean night")
    parser.add_argument("--fault-seed", type=int, default=1001, help="seed of the nights with faults")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--build-jobs", type=int, default=2)
    parser.add_argument("--built", action="store_true", help="use the programs in OUT/bin as they are")
    args = parser.parse_args()
    args.out = args.out.resolve()
    mutants = [m for m in map(Mutant, sorted(HERE.glob("*.patch")))
               if not args.only or any(word in m.name for word in args.only)]
    if args.sample:
        drawn = random.Random(args.fault_seed).sample(mutants, min(args.sample, len(mutants)))
        mutants = sorted(drawn, key=lambda mutant: mutant.name)
    builds = Builds(args.out, args.build_jobs)
    if not args.built:
        builds.prepare()
        if not builds.make(CLEAN, CLEAN):
            sys.exit("the clean tree does not compile")
    baseline = args.out / "nights" / CLEAN
    baseline.parent.mkdir(parents=True, exist_ok=True)
    play_clean_nights(builds.binary(CLEAN), args, baseline)
    play_faults(mutants, builds, args, baseline)


if __name__ == "__main__":
    main()
