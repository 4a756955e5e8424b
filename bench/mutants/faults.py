"""Planted faults, and binaries of them."""

import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
PROFILES = HERE / "profiles"
CLEAN = "clean"


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
