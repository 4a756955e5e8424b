#!/usr/bin/env bash
# golden_test.sh PROJECT BINARIES: builds the preset wasm and compares its golden hashes under Node with those that are
# expected of every build. Left out is the one line about threads, of which WebAssembly has none.
set -euo pipefail

project=$1
binaries=$2
for needed in em++ node; do
  command -v "$needed" >/dev/null || { echo "skipped: there is no $needed (Debian: package emscripten)"; exit 77; }
done

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$project"
cmake --preset wasm >"$scratch/configure.log" || { cat "$scratch/configure.log"; exit 1; }
cmake --build build/wasm >"$scratch/build.log" || { tail -n 50 "$scratch/build.log"; exit 1; }

"$binaries/tests/contort_golden" --drawn-specs >"$scratch/specs"
node build/wasm/contort_golden.js "$scratch/specs" >"$scratch/hashes"
grep -v ' jobs=4 ' tests/golden/expected.txt >"$scratch/expected"
diff -u --label expected --label WebAssembly "$scratch/expected" "$scratch/hashes"
echo "$(wc -l <"$scratch/hashes") golden lines are the same"
