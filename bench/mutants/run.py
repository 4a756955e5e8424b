#!/usr/bin/env python3
"""How many cases the fuzzer needs to find faults that were planted in the generator: docs/mutants.md."""

import argparse
import concurrent.futures
import hashlib
import json
import math
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
PROFILES = HERE / "profiles"
CLEAN = "clean"
ARMS = {"mixture": {}, "uniform": {"guided": 0, "uniform": 1}}
FIRST_CHUNK = 256  # cases; every further chunk begins anew with four times as many


def say(text):
    print(f"[{time.strftime('%H:%M:%S')}] {text}", file=sys.stderr, flush=True)


def short_hash(data):
    return hashlib.sha256(data).hexdigest()[:8]


def write_json(path, value):
    path.parent.mkdir(parents=True, exist_ok=True)
    draft = path.with_suffix(".tmp")
    draft.write_text(json.dumps(value, indent=1, sort_keys=True) + "\n")
    draft.replace(path)


def run(command, **options):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **options)


def must(command, **options):
    done = run(command, **options)
    if done.returncode != 0:
        sys.exit(f"failed: {' '.join(map(str, command))}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout


class Mutant:
    def __init__(self, path):
        self.path = path
        self.name = path.stem
        self.is_equivalent = "-equivalent_" in self.name
        self.about, diff = path.read_text().split("\n", 1)
        self.id = short_hash(diff.encode())
        named = re.search(r" Profile: (\w+)\.$", self.about)
        self.profile = named.group(1) if named else ""
        self.race = None  # which has what was measured of it


class Builds:
    """Binaries of the clean generator and of every mutant, made in one scratch tree of a commit."""

    def __init__(self, out, jobs):
        self.out, self.jobs = out, jobs
        self.tree, self.bin = out / "tree", out / "bin"

    def prepare(self):
        commit = must(["git", "-C", ROOT, "rev-parse", "HEAD"]).strip()
        base = self.out / "commit"
        if base.exists() and base.read_text().strip() != commit:
            say(f"going on with commit {base.read_text()[:8]}; another --out begins with {commit[:8]}")
            return
        if not base.exists():
            shutil.rmtree(self.tree, ignore_errors=True)
            self.tree.mkdir(parents=True)
            must(["bash", "-c", f"git -C '{ROOT}' archive {commit} | tar -x -C '{self.tree}'"])
            must(["cmake", "--preset", "golden", "-DCONTORT_TESTS=OFF"], cwd=self.tree)
            base.write_text(commit + "\n")

    def binary(self, name):
        return self.bin / name

    def make(self, name, identity, patch=None):
        """Builds the mutant if it is not there, and says whether it could."""
        binary, stamp = self.binary(name), self.bin / (name + ".id")
        if binary.exists() and stamp.exists() and stamp.read_text() == identity:
            return True
        # The tree may lie in a folder of another repository, which shall not matter to git.
        alone = dict(os.environ, GIT_CEILING_DIRECTORIES=str(self.out))
        if patch and run(["git", "apply", patch], cwd=self.tree, env=alone).returncode != 0:
            say(f"{name}: the patch does not apply")
            return False
        environment = dict(os.environ, CCACHE_BASEDIR=str(self.tree), CCACHE_NOHASHDIR="true")
        built = run(["nice", "cmake", "--build", "build/golden", "--target", "contort", f"-j{self.jobs}"],
                    cwd=self.tree, env=environment)
        if built.returncode == 0:
            self.bin.mkdir(exist_ok=True)
            shutil.copy2(self.tree / "build/golden/contort", binary)
            stamp.write_text(identity)
        else:
            say(f"{name} does not compile:\n{built.stdout[-1500:]}")
        if patch:
            must(["git", "apply", "-R", patch], cwd=self.tree, env=alone)
        return built.returncode == 0


class Race:
    """Mutants that are looked for with one profile."""

    def __init__(self, args, builds, profile, mutants):
        self.args, self.builds, self.mutants = args, builds, mutants
        self.out = builds.out
        self.seeds = range(1, args.seeds + 1)
        self.clean_families = {}  # of specs that were played on the clean generator, by their hash
        for mutant in mutants:
            mutant.race = self
        text = json.dumps(profile, sort_keys=True)
        self.results = self.out / "results" / f"{profile['name']}-{short_hash(text.encode())}"
        for mode, arms in ARMS.items():
            write_json(self.results / f"{mode}.profile.json", dict(profile, **arms))

    def fuzz(self, name, mode, seed, cases, corpus, shrinks, log):
        per_family, evaluations = shrinks
        command = ["nice", "timeout", str(self.args.run_timeout), self.builds.binary(name), "fuzz", "--profile",
                   self.results / f"{mode}.profile.json", "--seed", seed, "--cases", cases, "--jobs", 1, "--corpus", corpus,
                   "--shrinks-per-family", per_family, "--shrink-evaluations", evaluations, "--case-timeout",
                   self.args.case_timeout, "--log", log]
        done = run(command)
        if done.returncode not in (0, 1, 4):
            raise RuntimeError(f"{name} {mode} seed {seed}: exit code {done.returncode}: {done.stderr[-500:]}")

    # ---- what a generator shows of one spec

    def play(self, name, spec):
        with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
            json.dump(spec, file)
            file.flush()
            done = run(["nice", "timeout", "60", self.builds.binary(name), "check", file.name, "--json"])
        character = spec["character"]["name"]
        if done.returncode == 124:
            return {f"timeout|{character}|evaluation"}
        if done.returncode not in (0, 1):
            return {f"crash|{character}"}
        return {f"{f['check']}|{character}|{f['subject']}" for f in json.loads(done.stdout)["findings"]}

    def is_on_clean(self, spec, family):
        """Whether the clean generator shows the family for this very spec."""
        key = short_hash(json.dumps(spec, sort_keys=True).encode())
        if key not in self.clean_families:
            self.clean_families[key] = self.play(CLEAN, spec)
        return any(family.startswith(own) for own in self.clean_families[key])

    def is_news(self, name, spec, family):
        """Whether the fault shows it. A busy machine may be slow, once."""
        if self.is_on_clean(spec, family):
            return False
        return not family.startswith("timeout|") or family in self.play(name, spec)

    # ---- the race

    def path(self, name, mode, seed):
        return self.results / mode / f"{name}.seed_{seed}.json"

    def known(self, path, identity):
        if not path.exists():
            return None
        result = json.loads(path.read_text())
        fits = result["id"] == identity and result["case_timeout"] == self.args.case_timeout
        return result if fits and (result["cases"] >= self.args.cases or result.get("found")) else None

    def chunks(self):
        cases = FIRST_CHUNK
        while cases < self.args.cases:
            yield cases
            cases *= 4
        yield self.args.cases

    def first_kill(self, name, mode, seed, first, cases):
        """The first case, from `first` on, that fails in a way in which the clean generator's does not."""
        with tempfile.TemporaryDirectory(dir=self.out) as folder:
            log = Path(folder) / "log.jsonl"
            self.fuzz(name, mode, seed, cases, Path(folder) / "corpus", (1, 0), log)
            with log.open() as lines:
                for case in map(json.loads, lines):
                    families = case["families"] if case["index"] >= first else []
                    news = [family for family in families if self.is_news(name, case["spec"], family)]
                    if news:
                        return {"found": case["index"] + 1, "family": news[0], "arm": case["arm"]}
        return {}

    def race(self, mutant, mode, seed):
        path = self.path(mutant.name, mode, seed)
        if self.known(path, mutant.id):
            return
        started = time.monotonic()
        kill, first = {}, 0
        for cases in self.chunks():
            kill = self.first_kill(mutant.name, mode, seed, first, cases)
            if kill:
                break
            first = cases
        result = {"id": mutant.id, "cases": self.args.cases, "case_timeout": self.args.case_timeout}
        write_json(path, dict(result, **kill, seconds=round(time.monotonic() - started, 1)))
        what = f"case {kill['found']}, {kill['arm']}, {kill['family']}" if kill else "not found"
        say(f"{mutant.name} {mode} seed {seed}: {what}")

    # ---- buckets

    def bucket_path(self, name):
        return self.results / "buckets" / f"{name}.json"

    def find_buckets(self, name, identity):
        path = self.bucket_path(name)
        if path.exists() and json.loads(path.read_text()).get("id") == identity:
            return
        with tempfile.TemporaryDirectory(dir=self.out) as corpus:
            self.fuzz(name, "mixture", 1, self.args.bucket_cases, corpus, (2, self.args.bucket_evaluations), os.devnull)
            buckets = []
            for file in sorted(Path(corpus).glob("buckets/*/bucket.json")):
                described = json.loads(file.read_text())
                least = json.loads((file.parent / described["min"]).read_text())["spec"]
                if name == CLEAN or not self.is_on_clean(least, described["family"]):
                    buckets.append(file.parent.name)
        write_json(path, {"id": identity, "buckets": buckets})
        say(f"{name}: {len(buckets)} buckets")

    def own_buckets(self, name):
        path = self.bucket_path(name)
        if not path.exists() or not self.bucket_path(CLEAN).exists():
            return None
        known = set(json.loads(self.bucket_path(CLEAN).read_text())["buckets"])
        return [b for b in json.loads(path.read_text())["buckets"] if b not in known]

    # ---- what was measured

    def counts(self, mutant, mode):
        """Cases to detection of each seed that was run; none where it was not found."""
        results = [self.known(self.path(mutant.name, mode, seed), mutant.id) for seed in self.seeds]
        found = [result.get("found") for result in results if result]
        return [count if count and count <= self.args.cases else None for count in found]

    def seen_by(self, mutant):
        checks = {}
        for mode in ARMS:
            for seed in self.seeds:
                result = self.known(self.path(mutant.name, mode, seed), mutant.id)
                if result and result.get("found"):
                    check = result["family"].split("|")[0]
                    checks[check] = checks.get(check, 0) + 1
        return ", ".join(sorted(checks, key=lambda check: (-checks[check], check)))


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
        print("\n".join(self.table()))

    def measure(self):
        seeds = range(1, self.args.seeds + 1)
        self.run_all([(m.race.race, m, mode, seed) for seed in seeds for mode in self.args.modes for m in self.mutants])
        if self.args.buckets:
            faults = [(m.race.find_buckets, m.name, m.id) for m in self.mutants if not m.is_equivalent]
            self.run_all([(race.find_buckets, CLEAN, CLEAN) for race in self.races] + faults)

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
        measured = {m.name: m.race.own_buckets(m.name) for m in faults}
        measured = {name: own for name, own in measured.items() if own}
        if not measured:
            return []
        filed, seen = 0, set()
        for own in measured.values():
            filed += len(own)
            seen |= set(own)
        median = statistics.median([len(own) for own in measured.values()])
        return [f"* Buckets of a fault, median of {len(measured)} faults with any: {median:g}.",
                f"* Cases filed in a bucket that an earlier fault has too: {100.0 * (filed - len(seen)) / filed:.1f} %."]


def parse_args():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    parser.add_argument("--out", type=Path, default=ROOT / "contort-out/mutants", help="builds and results are kept here")
    parser.add_argument("--profile", help="of the fuzzer, by name or a file, for all mutants instead of each one's own")
    parser.add_argument("--seeds", type=int, default=3, help="seeds 1 to this one")
    parser.add_argument("--cases", type=int, default=3000, help="of one run, at most")
    parser.add_argument("--modes", nargs="+", choices=list(ARMS), default=list(ARMS))
    parser.add_argument("--only", nargs="+", help="mutants whose names contain one of these words")
    parser.add_argument("--buckets", action="store_true", help="measure buckets too: shorter runs with shrinking")
    parser.add_argument("--bucket-cases", type=int, default=512)
    parser.add_argument("--bucket-evaluations", type=int, default=150, help="motions generated per shrink, at most")
    parser.add_argument("--jobs", type=int, default=2, help="runs at a time, each with one worker")
    parser.add_argument("--build-jobs", type=int, default=2)
    parser.add_argument("--case-timeout", type=float, default=5.0, help="seconds for one case")
    parser.add_argument("--run-timeout", type=int, default=7200, help="seconds for one run")
    parser.add_argument("--check", action="store_true", help="only see whether the patches apply to this tree")
    parser.add_argument("--build-only", action="store_true", help="only see whether they compile")
    parser.add_argument("--table", action="store_true", help="print what was measured so far")
    return parser.parse_args()


def check_patches():
    """Whether every patch says what it breaks and applies to this tree, to the generator alone."""
    bad = []
    for mutant in map(Mutant, sorted(HERE.glob("*.patch"))):
        files = [line[6:] for line in mutant.path.read_text().split("\n") if line.startswith("+++ b/")]
        if not mutant.about or mutant.about.startswith("---") or not all(f.startswith("generator/") for f in files):
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
