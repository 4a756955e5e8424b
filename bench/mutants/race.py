"""Looks for mutants with one profile, and keeps what it saw."""

import contextlib
import hashlib
import itertools
import json
import subprocess
import tempfile
import time
from pathlib import Path

from faults import CLEAN, run, say, short_hash, write_json

ARMS = {"mixture": {}, "uniform": {"guided": 0, "uniform": 1}}
LOOKS_AGAIN_S = 0.02  # at the log of a run
FIRST_CASES = 32  # are run alone: a run tells of its cases a round at a time, and most faults are found before


def followed(log, process):
    """Lines of a log, as a process adds them."""
    with log.open() as file:
        rest, ended = "", False
        while not ended:
            ended = process.poll() is not None  # before reading: nothing can be added afterwards
            *lines, rest = (rest + file.read()).split("\n")
            yield from lines
            if not lines:
                time.sleep(LOOKS_AGAIN_S)


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

    @contextlib.contextmanager
    def fuzzing(self, name, mode, seed, cases, folder, shrinks, *options):
        """A run in this folder. Left before its end, it is stopped."""
        per_family, evaluations = shrinks
        command = ["nice", "timeout", self.args.run_timeout, self.builds.binary(name), "fuzz", "--profile",
                   self.results / f"{mode}.profile.json", "--seed", seed, "--cases", cases, "--jobs", 1, "--corpus",
                   folder / "corpus", "--shrinks-per-family", per_family, "--shrink-evaluations", evaluations,
                   "--case-timeout", self.args.case_timeout, "--log", folder / "log.jsonl", *options]
        (folder / "log.jsonl").touch()
        with (folder / "stderr").open("w") as errors:
            process = subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=errors)
        try:
            yield process
            if process.wait() not in (0, 1, 4):
                why = (folder / "stderr").read_text()[-500:]
                raise RuntimeError(f"{name} {mode} seed {seed}: exit code {process.returncode}: {why}")
        finally:
            process.terminate()
            process.wait()

    # ---- what a generator shows of one spec

    def play(self, name, spec):
        with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
            json.dump(spec, file)
            file.flush()
            patience_s = 2.0 * self.args.case_timeout
            done = run(["nice", "timeout", patience_s, self.builds.binary(name), "check", file.name, "--json"])
        character = spec["character"]["name"]
        if done.returncode == 124:
            return {f"timeout|{character}|evaluation"}
        if done.returncode not in (0, 1):
            return {f"crash|{character}"}
        return {f"{f['check']}|{character}|{f['subject']}" for f in json.loads(done.stdout)["findings"]}

    def is_on_clean(self, spec, family):
        """Whether the clean generator shows the family for this very spec."""
        # The whole hash: with 32 bits of it, two of 6,446 specs had the same, and a mutant that changes nothing was reported.
        key = hashlib.sha256(json.dumps(spec, sort_keys=True).encode()).digest()
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

    def kills(self, name, mode, seed, cases):
        """Cases that fail in a way in which the clean generator's do not, with the family that shows it."""
        with tempfile.TemporaryDirectory(dir=self.out, ignore_cleanup_errors=True) as made:
            folder = Path(made)
            with self.fuzzing(name, mode, seed, cases, folder, (1, 0)) as process:
                for case in map(json.loads, followed(folder / "log.jsonl", process)):
                    news = next((f for f in case["families"] if self.is_news(name, case["spec"], f)), None)
                    if news:
                        yield {"found": case["index"] + 1, "family": news, "arm": case["arm"]}, case["spec"]

    def first_kill(self, name, mode, seed):
        for cases in (min(FIRST_CASES, self.args.cases), self.args.cases):
            with contextlib.closing(self.kills(name, mode, seed, cases)) as kills:
                kill, _ = next(kills, ({}, None))
            if kill:
                return kill
        return {}

    def count_path(self, name, mode, seed):
        return self.results / mode / f"{name}.seed_{seed}.of_{self.args.count}.json"

    def count(self, mutant, mode, seed):
        """How many of the first cases of a run are kills."""
        path = self.count_path(mutant.name, mode, seed)
        if path.exists() and json.loads(path.read_text())["id"] == mutant.id:
            return
        count = sum(1 for _ in self.kills(mutant.name, mode, seed, self.args.count))
        write_json(path, {"id": mutant.id, "kills": count})
        say(f"{mutant.name} {mode} seed {seed}: {count} of {self.args.count}")

    def counted(self, mutant, mode):
        """Kills of all seeds that were counted, and of how many cases."""
        paths = [self.count_path(mutant.name, mode, seed) for seed in self.seeds]
        known = [json.loads(path.read_text()) for path in paths if path.exists()]
        known = [result["kills"] for result in known if result["id"] == mutant.id]
        return (sum(known), len(known) * self.args.count) if known else None

    def race(self, mutant, mode, seed):
        path = self.path(mutant.name, mode, seed)
        if self.known(path, mutant.id):
            return
        started = time.monotonic()
        kill = self.first_kill(mutant.name, mode, seed)
        result = {"id": mutant.id, "cases": self.args.cases, "case_timeout": self.args.case_timeout}
        write_json(path, dict(result, **kill, seconds=round(time.monotonic() - started, 1)))
        what = f"case {kill['found']}, {kill['arm']}, {kill['family']}" if kill else "not found"
        say(f"{mutant.name} {mode} seed {seed}: {what}")

    # ---- buckets

    def fresh(self, path, identity, **parameters):
        """What was measured of this very fault in this very way."""
        known = json.loads(path.read_text()) if path.exists() else {}
        return known if all(known.get(key) == value for key, value in dict(parameters, id=identity).items()) else None

    @staticmethod
    def buckets_in(corpus):
        """Of each bucket its folder, its family, and its smallest spec."""
        for file in sorted(Path(corpus).glob("buckets/*/bucket.json")):
            described = json.loads(file.read_text())
            least = json.loads((file.parent / described["min"]).read_text())["spec"]
            yield file.parent.name, described["family"], least

    def bucket_path(self, name):
        return self.results / "buckets" / f"{name}.json"

    def find_buckets(self, name, identity):
        path = self.bucket_path(name)
        how = {"cases": self.args.bucket_cases, "evaluations": self.args.bucket_evaluations}
        if self.fresh(path, identity, **how):
            return
        with tempfile.TemporaryDirectory(dir=self.out) as made:
            shrinks = (2, self.args.bucket_evaluations)
            with self.fuzzing(name, "mixture", 1, self.args.bucket_cases, Path(made), shrinks):
                pass
            buckets = {bucket: {"family": family, "least": least}
                       for bucket, family, least in self.buckets_in(Path(made) / "corpus")
                       if name == CLEAN or not self.is_on_clean(least, family)}
        write_json(path, dict(how, id=identity, buckets=buckets))
        say(f"{name}: {len(buckets)} buckets")

    def own_buckets(self, name):
        path = self.bucket_path(name)
        if not path.exists() or not self.bucket_path(CLEAN).exists():
            return None
        known = set(json.loads(self.bucket_path(CLEAN).read_text())["buckets"])
        return [b for b in json.loads(path.read_text())["buckets"] if b not in known]

    def filed_path(self, name):
        return self.results / "filed" / f"{name}.json"

    def how_filed(self):
        return {"kills": self.args.filed, "evaluations": self.args.bucket_evaluations}

    def file_kills(self, mutant):
        """In which buckets each of a fault's first kills is filed, every one in a corpus of its own."""
        path = self.filed_path(mutant.name)
        if self.fresh(path, mutant.id, **self.how_filed()):
            return
        with contextlib.closing(self.kills(mutant.name, "mixture", 1, self.args.cases)) as kills:
            specs = [spec for _, spec in itertools.islice(kills, self.args.filed)]
        filed = [self.filed_in(mutant.name, spec) for spec in specs]
        write_json(path, dict(self.how_filed(), id=mutant.id, filed=filed))
        say(f"{mutant.name}: {len(filed)} cases in {len(set(itertools.chain(*filed)))} buckets")

    def filed_in(self, name, spec):
        """Buckets of what the clean generator does not show for this spec, and whether their smallest specs still
        tell the two apart: shrinking may have slipped to what is wrong with the clean one, too."""
        with tempfile.TemporaryDirectory(dir=self.out, ignore_cleanup_errors=True) as made:
            folder = Path(made)
            write_json(folder / "seeds/spec.json", spec)
            shrinks = (1, self.args.bucket_evaluations)
            with self.fuzzing(name, "mixture", 1, 0, folder, shrinks, "--seeds", folder / "seeds"):
                pass
            return {bucket: {"is_news": not self.is_on_clean(least, family), "family": family, "least": least}
                    for bucket, family, least in self.buckets_in(folder / "corpus") if not self.is_on_clean(spec, family)}

    def filed(self, mutant):
        known = self.fresh(self.filed_path(mutant.name), mutant.id, **self.how_filed())
        return known["filed"] if known else []

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
