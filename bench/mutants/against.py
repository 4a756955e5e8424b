#!/usr/bin/env python3
"""Measures how soon `contort fuzz --against` the clean build shows planted faults, and whether its small cases pass
there, for docs/reference/against.md."""

import argparse
import json
import sys
import tempfile
import time
from pathlib import Path

sys.dont_write_bytecode = True
from faults import CLEAN, HERE, PROFILES, ROOT, Builds, Mutant, run, say  # noqa: E402


def fuzz(binary, clean, profile, args, cases, folder):
    """The result of a run as JSON, with the seconds that it took and the indices of cases that broke or got worse."""
    log = folder / "log.jsonl"
    command = [binary, "fuzz", "--against", clean, "--profile", profile, "--cases", cases, "--seed", args.seed, "--jobs",
               args.jobs, "--shrinks-per-family", 1, "--shrinks-per-case", 1, "--shrink-evaluations", args.evaluations,
               "--corpus", folder / "corpus", "--log", log, "--json"]
    begun = time.monotonic()
    done = run(command)
    seconds = time.monotonic() - begun
    if done.returncode not in (0, 1, 4):
        raise RuntimeError(done.stderr[-500:])
    return json.loads(done.stdout), seconds, [json.loads(line)["index"] for line in log.read_text().splitlines()]


def passes(clean, path):
    """Whether the clean build has no finding of the case's family."""
    stored = json.loads(Path(path).read_text())
    expect = stored["expect"]
    if expect["check"] in ("crash", "timeout", "memory"):
        request = {"spec": stored["spec"]}
    else:
        request = {"spec": stored["spec"], "check": expect["check"]}
    lines = run([clean, "measure"], input=json.dumps(request) + "\n").stdout.splitlines()
    answer = json.loads(lines[1]) if len(lines) > 1 else {"error": {}}
    family = (expect["check"], expect["subject"])
    return "error" not in answer and all((f["check"], f["subject"]) != family for f in answer.get("findings", []))


def actions_of(path):
    spec = json.loads(Path(path).read_text())["spec"]
    sequences = spec.get("sequences", []) + [i["sequence"] for i in spec.get("interrupts", [])]
    return sum(len(clip.get("actions", [])) for sequence in sequences for clip in sequence.get("clips", []))


def row_of(mutant, builds, args):
    binary, clean = builds.binary(mutant.name), builds.binary(CLEAN)
    profile = str(PROFILES / f"{mutant.profile}.json") if args.own_profiles else args.profile
    with tempfile.TemporaryDirectory() as scratch:
        result, seconds, broken = fuzz(binary, clean, profile, args, args.cases, Path(scratch))
        counts = result["against"]
        cases = [row["case"] for row in counts["rows"] if row["change"] == "broke"]
        good = sum(passes(clean, case) for case in cases)
        smallest = min((actions_of(case) for case in cases), default="")
    first = ""
    if broken:
        with tempfile.TemporaryDirectory() as scratch:
            first = f"{fuzz(binary, clean, profile, args, broken[0] + 1, Path(scratch))[1]:.0f} s"
    number = broken[0] + 1 if broken else f"> {args.cases}"
    return (f"| {mutant.name} | {number} | {first} | {counts['broke']} | {counts['worse']} | {counts['mended']} | "
            f"{counts['moved']} | {counts['refused']} | {good} of {len(cases)} | {smallest} | {seconds:.0f} s |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    parser.add_argument("--out", type=Path, default=ROOT / "contort-out/mutants", help="builds are kept here, as by run.py")
    parser.add_argument("--only", nargs="+", help="mutants whose names contain one of these words")
    parser.add_argument("--profile", default="nightly")
    parser.add_argument("--own-profiles", action="store_true", help="the profile that each fault's first line names")
    parser.add_argument("--cases", type=int, default=256)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--evaluations", type=int, default=300, help="motions generated per shrink, at most")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--build-jobs", type=int, default=2)
    parser.add_argument("--built", action="store_true", help="use the programs in OUT/bin as they are")
    args = parser.parse_args()
    mutants = [m for m in map(Mutant, sorted(HERE.glob("*.patch"))) if not args.only or any(w in m.name for w in args.only)]
    builds = Builds(args.out.resolve(), args.build_jobs)
    if not args.built:
        builds.prepare()
        if not builds.make(CLEAN, CLEAN):
            sys.exit("the clean tree does not compile")
        mutants = [m for m in mutants if builds.make(m.name, m.id, m.path)]
    print("| fault | cases to the first that broke | time to its row | broke | worse | mended | moved | refused | "
          "small cases that pass in the base | fewest actions | all |\n|---|---|---|---|---|---|---|---|---|---|---|")
    for mutant in mutants:
        try:
            print(row_of(mutant, builds, args), flush=True)
        except (RuntimeError, ValueError, OSError) as error:  # one fault that fails must not end the bench
            say(f"{mutant.name}: no result: {error!r}")


if __name__ == "__main__":
    main()
