#!/usr/bin/env python3
"""Measures how many cases the fuzzer needs to find faults that were planted in the generator, for
docs/internals/mutants.md."""

import argparse
import collections
import concurrent.futures
import json
import math
import statistics
import sys
from pathlib import Path

sys.dont_write_bytecode = True
from faults import CLEAN, HERE, PROFILES, ROOT, Builds, Mutant, must, run, say  # noqa: E402
from race import ARMS, Race  # noqa: E402


class Bench:
    """All mutants, each with the profile that its first line names, unless the command line says one."""

    def __init__(self, args):
        self.args = args
        self.mutants = [Mutant(path) for path in sorted(HERE.glob("*.patch"))]
        if args.only:
            self.mutants = [m for m in self.mutants if any(word in m.name for word in args.only)]
        self.builds = Builds(args.out.resolve(), args.build_jobs)
        self.races = []

    def build(self):
        self.builds.prepare()
        if not self.builds.make(CLEAN, CLEAN):
            sys.exit("the clean tree does not compile")
        self.mutants = [m for m in self.mutants if self.builds.make(m.name, m.id, m.path)]

    def profile_of(self, mutant):
        return self.args.profile or str(PROFILES / f"{mutant.profile}.json")

    def make_races(self):
        built_in = json.loads(must([self.builds.binary(CLEAN), "list", "profiles", "--json"]))
        named = {entry["name"]: entry["profile"] for entry in built_in}
        by_profile = {}
        for mutant in self.mutants:
            by_profile.setdefault(self.profile_of(mutant), []).append(mutant)
        for name, mutants in sorted(by_profile.items()):
            profile = named.get(name) or json.loads(Path(name).read_text())
            self.races.append(Race(self.args, self.builds, profile, mutants))

    def run_all(self, jobs):
        with concurrent.futures.ThreadPoolExecutor(self.args.jobs) as pool:
            for done in concurrent.futures.as_completed([pool.submit(*job) for job in jobs]):
                try:
                    done.result()
                except Exception as error:  # one run that fails must not end the bench
                    say(f"no result: {error!r}")

    def run(self):
        self.build()
        if self.args.build_only:
            return
        self.make_races()
        if not self.args.table:
            self.measure()
        print("\n".join(self.count_table() if self.args.count else self.table()))

    def measure(self):
        seeds = range(1, self.args.seeds + 1)
        what = Race.count if self.args.count else Race.race
        self.run_all([(what, m.race, m, mode, seed) for seed in seeds for mode in self.args.modes for m in self.mutants])
        if self.args.buckets:
            faults = [(m.race.find_buckets, m.name, m.id) for m in self.mutants if not m.is_equivalent]
            self.run_all([(race.find_buckets, CLEAN, CLEAN) for race in self.races] + faults)
        if self.args.filed:
            self.run_all([(m.race.file_kills, m) for m in self.mutants if not m.is_equivalent])

    # ---- the table

    def median(self, counts):
        if not counts:
            return ""
        middle = statistics.median([math.inf if c is None else c for c in counts])
        return f"> {self.args.cases}" if middle == math.inf else f"{middle:g}"

    def restricted_mean(self, counts):
        """A miss counts as many cases as were tried."""
        return statistics.fmean([c or self.args.cases for c in counts]) if counts else math.nan

    @staticmethod
    def a12(mixture, uniform):
        """How often a run of the mixture is the quicker one, ties half (Vargha and Delaney, J. Educ. Behav. Stat. 25, 2000)."""
        last = [[math.inf if c is None else c for c in counts] for counts in (mixture, uniform)]
        wins = [1.0 if m < u else 0.5 if m == u else 0.0 for m in last[0] for u in last[1]]
        return statistics.fmean(wins) if wins else math.nan

    def table(self):
        lines = ["| mutant | found, mixture | median cases, mixture | median, uniform | mean, mixture | mean, uniform | A12 | "
                 "seen first by | buckets |", "|---|---|---|---|---|---|---|---|---|"]
        for mutant in self.mutants:
            mixture, uniform = (mutant.race.counts(mutant, mode) for mode in ARMS)
            own = mutant.race.own_buckets(mutant.name)
            lines.append(f"| {mutant.name} | {sum(c is not None for c in mixture)} of {len(mixture)} | "
                         f"{self.median(mixture)} | {self.median(uniform)} | {self.restricted_mean(mixture):.0f} | "
                         f"{self.restricted_mean(uniform):.0f} | {self.a12(mixture, uniform):.2f} | "
                         f"{mutant.race.seen_by(mutant)} | {'' if own is None else len(own)} |")
        return lines + [""] + self.summary()

    def count_table(self):
        """Kills of as many cases by both: the ratio is that of the cases that it takes to see one."""
        lines = [f"| mutant | kills of {self.args.count} cases, mixture | uniform | ratio |", "|---|---|---|---|"]
        ratios = []
        for mutant in self.mutants:
            mixture, uniform = (mutant.race.counted(mutant, mode) for mode in ARMS)
            if not mixture or not uniform or not mixture[0] + uniform[0]:
                continue
            per_run = [kills * self.args.count / cases for kills, cases in (mixture, uniform)]
            least = 0.5 * self.args.count / min(mixture[1], uniform[1])  # none counts as half of one
            ratios.append(max(per_run[0], least) / max(per_run[1], least))
            lines.append(f"| {mutant.name} | {per_run[0]:g} | {per_run[1]:g} | {ratios[-1]:.1f} |")
        if ratios:
            lines += ["", f"* Geometric mean of the ratios: {statistics.geometric_mean(ratios):.2f} ({len(ratios)} mutants)."]
        return lines

    def often(self, faults, mode):
        runs = [m.race.counts(m, mode) for m in faults]
        return sum(bool(counts) and sum(c is not None for c in counts) >= 0.9 * len(counts) for counts in runs)

    def summary(self):
        faults = [m for m in self.mutants if not m.is_equivalent]
        wrong = [m.name for m in self.mutants if m.is_equivalent and
                 any(c is not None for mode in ARMS for c in m.race.counts(m, mode))]
        lines = [f"* Found in at least 90 % of the seeds: {self.often(faults, 'mixture')} of {len(faults)} by the mixture, "
                 f"{self.often(faults, 'uniform')} by even draws.",
                 f"* Geometric mean of uniform / mixture, mean cases with {self.args.cases} for a miss: "
                 f"{self.speed_up(faults)}.",
                 f"* Equivalent mutants reported: {len(wrong)} of {len(self.mutants) - len(faults)}"
                 f"{' (' + ', '.join(wrong) + ')' if wrong else ''}."]
        return lines + self.bucket_summary(faults)

    def speed_up(self, faults):
        ratios = []
        for mutant in faults:
            mixture, uniform = (mutant.race.counts(mutant, mode) for mode in ARMS)
            if mixture and uniform and any(mixture + uniform):
                ratios.append(self.restricted_mean(uniform) / self.restricted_mean(mixture))
        return f"{statistics.geometric_mean(ratios):.2f} ({len(ratios)} mutants)" if ratios else "not measured"

    def bucket_summary(self, faults):
        measured = [len(own) for own in (m.race.own_buckets(m.name) for m in faults) if own]
        lines = []
        if measured:
            lines.append(f"* Buckets of a fault, median of {len(measured)} faults with any: {statistics.median(measured):g}.")
        if self.args.filed:
            lines.append(self.filed_summary(faults))
        return lines

    def filed_summary(self, faults):
        """A bucket is the fault's of which most cases are in it; all others in it are hidden there. So are cases whose
        smallest specs fail on the clean generator."""
        in_bucket = collections.defaultdict(collections.Counter)
        for mutant in faults:
            for bucket, made in (item for case in mutant.race.filed(mutant) for item in case.items()):
                in_bucket[bucket][mutant.name if made["is_news"] else CLEAN] += 1
        filed = sum(counts.total() for counts in in_bucket.values())
        slipped = sum(counts.pop(CLEAN, 0) for counts in in_bucket.values())
        hidden = sum(counts.total() - max(counts.values(), default=0) for counts in in_bucket.values())
        for bucket, counts in sorted(in_bucket.items()):
            if len(counts) > 1:
                say(f"{bucket}: {', '.join(f'{name} {n}' for name, n in counts.most_common())}")
        share = 100.0 / max(filed, 1)
        return (f"* Of {filed} times that a case was filed, {hidden} in a bucket that is mostly another fault's "
                f"({share * hidden:.1f} %), {slipped} by a spec that the clean generator fails, too ({share * slipped:.1f} %).")


def parse_args():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    parser.add_argument("--out", type=Path, default=ROOT / "contort-out/mutants", help="builds and results are kept here")
    parser.add_argument("--profile", help="of the fuzzer, by name or a file, for all mutants instead of each one's own")
    parser.add_argument("--seeds", type=int, default=3, help="seeds 1 to this one")
    parser.add_argument("--cases", type=int, default=3000, help="of one run, at most")
    parser.add_argument("--count", type=int, default=0, metavar="N",
                        help="count all kills of the first N cases, instead of cases up to the first one")
    parser.add_argument("--modes", nargs="+", choices=list(ARMS), default=list(ARMS))
    parser.add_argument("--only", nargs="+", help="mutants whose names contain one of these words")
    parser.add_argument("--buckets", action="store_true", help="measure buckets too: shorter runs with shrinking")
    parser.add_argument("--filed", type=int, default=0, metavar="N",
                        help="measure in which buckets the first N cases of each fault are filed")
    parser.add_argument("--bucket-cases", type=int, default=512)
    parser.add_argument("--bucket-evaluations", type=int, default=2000,
                        help="motions generated per shrink of --buckets and --filed, at most")
    parser.add_argument("--jobs", type=int, default=2, help="runs at a time, each with one worker")
    parser.add_argument("--build-jobs", type=int, default=2)
    parser.add_argument("--case-timeout", type=float, default=5.0, help="seconds for one case")
    parser.add_argument("--run-timeout", type=int, default=7200, help="seconds for one run")
    parser.add_argument("--check", action="store_true", help="only see whether the patches apply to this tree")
    parser.add_argument("--build-only", action="store_true", help="only see whether they compile")
    parser.add_argument("--table", action="store_true", help="print what was measured so far")
    return parser.parse_args()


def check_patches():
    """Whether every patch says what it breaks and applies to this tree: to the generator or to the model and formats below it."""
    bad = []
    for mutant in map(Mutant, sorted(HERE.glob("*.patch"))):
        files = [line[6:] for line in mutant.path.read_text().split("\n") if line.startswith("+++ b/")]
        if not mutant.about or mutant.about.startswith("---") or not all(f.startswith(("generator/", "model/", "formats/")) for f in files):
            bad.append(f"{mutant.name}: no first line, or not of the generator")
        if not (PROFILES / f"{mutant.profile}.json").exists():
            bad.append(f"{mutant.name}: its first line ends with no profile of bench/mutants/profiles")
        applied = run(["git", "apply", "--check", mutant.path], cwd=ROOT)
        if applied.returncode != 0:
            bad.append(f"{mutant.name}: {applied.stderr.strip()}")
    print("\n".join(bad) or "all patches apply")
    return 1 if bad else 0


if __name__ == "__main__":
    arguments = parse_args()
    if arguments.check:
        sys.exit(check_patches())
    Bench(arguments).run()
