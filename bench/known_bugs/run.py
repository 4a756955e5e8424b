#!/usr/bin/env python3
"""Looks for publicly reported bugs of animation engines, and prints a table of them.

For each bug it installs the affected and the fixed version with npm, searches the affected one through the adapter of
the engine, and replays each minimal case in the fixed one. A bug counts as found if a finding of the check that its
symptom belongs to is gone in the fixed version. README.md says how blind the search is.
"""
import argparse
import collections
import json
import os
import pathlib
import shlex
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
JUMP = {"pop", "angular_velocity", "angular_acceleration"}

# Bugs that are still open have no fixed version to compare with: the minimal case must have some of the `actions`.
Bug = collections.namedtuple("Bug", "id engine affected fixed checks symptom actions", defaults=[()])
BUGS = [
    Bug("K1", "three", "0.183.2", "0.184.0", JUMP, "ping-pong loop jumps when its time scale turns negative"),
    Bug("K2", "three", "0.184.0", "0.185.1", {"fresh_error"}, "warping leaves an action in slow motion after reset"),
    Bug("K3", "three", "0.119.1", "0.120.1", {"non_finite", "joint_range"}, "additive copy of a cubic clip is NaN"),
    Bug("K4", "three", "0.131.3", "0.132.2", {"quaternion_length"}, "cubic interpolation does not normalise"),
    Bug("K5", "three", "0.116.1", "0.117.1", {"rest_error"}, "stopAllAction does not restore the pose"),
    Bug("K6", "three", "0.186.1", "0.187.0", {"reach_error"}, "limits near 180 degrees make targets unreachable"),
    Bug("K7", "babylon", "5.22.1", "5.23.0", {"quaternion_length"} | JUMP, "blending of bone matrices scales and pops"),
    Bug("K8", "babylon", "6.40.0", "6.41.2", {"rest_error"} | JUMP, "group with negative speed ratio does not end"),
    Bug("K9", "babylon", "4.2.0", "5.0.0", {"joint_range"} | JUMP, "negative speed ratio leaves the range of keys"),
    Bug("K10", "playcanvas", "1.38.4", "1.39.1", JUMP, "transition is instant between roots of other names"),
    Bug("S1", "three", "0.187.0", None, JUMP, "after a NaN step a cross-fade takes one frame",
        ("cross_fade", "fade_to")),
    Bug("S2", "babylon", "9.35.0", None, {"non_finite", "joint_range"}, "goal of bone IK exactly on the shoulder",
        ("reach",)),
]
PACKAGES = {"three": "three", "babylon": "@babylonjs/core", "playcanvas": "playcanvas"}


def install(cache, engine, version):
    """The folder into which a version of an engine is installed, unless it is there."""
    folder = cache / f"{engine}-{version}"
    if not (folder / "node_modules" / PACKAGES[engine]).exists():
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "package.json").write_text("{}")
        subprocess.run(["npm", "install", "--no-audit", "--no-fund", "--ignore-scripts", "--silent",
                        f"{PACKAGES[engine]}@{version}"], cwd=folder, check=True)
    return folder


class Contort:
    """Contort with the adapter of one engine in one version."""

    def __init__(self, options, engine, version):
        self.options = options
        self.generator = "node " + shlex.quote(str(ROOT / "adapters" / engine / "adapter.mjs"))
        self.environment = {**os.environ, f"CONTORT_{engine.upper()}": str(install(options.cache, engine, version))}

    def run(self, *arguments):
        command = [self.options.contort, *map(str, arguments)]
        result = subprocess.run(command, env=self.environment, capture_output=True, text=True)
        if result.returncode not in (0, 1):
            print(f"{' '.join(command)}\n{result.stderr}", file=sys.stderr)
        return result.stdout

    def fuzz(self, corpus):
        self.run("fuzz", "--generator", self.generator, "--corpus", corpus, "--time", f"{self.options.time}s", "--seed",
                 self.options.seed, "--jobs", self.options.jobs)

    def verdicts(self, cases):
        """What a replay says of each case file: `passes` where nothing fails any more."""
        replayed = json.loads(self.run("replay", *cases, "--generator", self.generator, "--json"))
        flat = [case for entry in replayed for case in entry.get("cases", [entry])]
        return {case["case"]: case["verdict"] for case in flat}


def findings(contort, corpus):
    """Each minimal case of the corpus, with its cause."""
    known = contort.run("causes", "--all", "--json", corpus) if corpus.exists() else ""
    for cause in json.loads(known or '{"causes": []}')["causes"]:
        for bucket in cause["buckets"]:
            case = json.loads(pathlib.Path(bucket["case"]).read_text())
            clips = [clip for sequence in case["spec"].get("sequences", []) for clip in sequence["clips"]]
            actions = [use["action"] for clip in clips for use in clip["actions"]]
            yield {"check": bucket["family"].split("|")[0], "case": bucket["case"], "headline": cause["headline"],
                   "cause": cause["id"], "actions": actions, "index": case["provenance"]["index"]}


def search(bug, options):
    """The row of the table for a bug."""
    corpus = options.cache / "corpora" / f"{bug.id}-{options.seed}"
    subprocess.run(["rm", "-rf", str(corpus)], check=True)
    affected = Contort(options, bug.engine, bug.affected)
    affected.fuzz(corpus)
    everything = list(findings(affected, corpus))
    found = [one for one in everything if one["check"] in bug.checks]
    if bug.actions:
        found = [one for one in found if set(bug.actions) & set(one["actions"])]
    if bug.fixed and found:
        verdicts = Contort(options, bug.engine, bug.fixed).verdicts([one["case"] for one in found])
        found = [one for one in found if verdicts.get(one["case"]) == "passes"]
    causes = len({one["cause"] for one in everything})
    versions = f"{bug.affected} → {bug.fixed or 'open'}"
    if not found:
        return [bug.id, bug.engine, versions, "no", "", "", "", f"{causes}", bug.symptom]
    least = min(found, key=lambda one: (len(one["actions"]), one["index"]))
    first = min(one["index"] for one in found)
    return [bug.id, bug.engine, versions, "yes", str(first), str(len(least["actions"])),
            f"{least['check']}: {', '.join(least['actions'])}", str(causes), bug.symptom]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("ids", nargs="*", help="bugs to look for, such as K1; all when none is named")
    parser.add_argument("--contort", default=str(ROOT / "build" / "release" / "contort"), help="the program")
    parser.add_argument("--cache", type=pathlib.Path, default=ROOT / "build" / "known_bugs", help="folder of engines")
    parser.add_argument("--time", type=float, default=60, help="seconds of search for each bug")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    options.cache = options.cache.resolve()
    print("| bug | engine | versions | found | first case | uses | check: minimal case | causes in all | symptom |")
    print("|---|---|---|---|---|---|---|---|---|")
    missed = 0
    for bug in BUGS:
        if not options.ids or bug.id in options.ids:
            row = search(bug, options)
            missed += row[3] != "yes"
            print("| " + " | ".join(row) + " |", flush=True)
    sys.exit(1 if missed else 0)


if __name__ == "__main__":
    main()
