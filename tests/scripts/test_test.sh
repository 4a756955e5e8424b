#!/usr/bin/env bash
# test_test.sh PROJECT: does `test` count right, and notice what fails? cmake, ctest and the golden program are
# replaced by stand-ins.
set -euo pipefail

project=$(cd "$1" && pwd -P)
scratch=$(cd "$(mktemp -d)" && pwd -P)
trap 'rm -rf "$scratch"' EXIT
trap 'echo "failed at line $LINENO of $0" >&2' ERR
mkdir -p "$scratch/project/cmake" "$scratch/project/tests/golden" "$scratch/project/build/dev" "$scratch/bin"
cp "$project/test" "$project/packages.txt" "$scratch/project/"
cp -r "$project/cmake/scripts" "$scratch/project/cmake/"
printf 'stairs 0123\nrecoil 4567\n' >"$scratch/project/tests/golden/expected.txt"

fake() { printf '#!/bin/sh\n%s\n' "$2" >"$1" && chmod +x "$1"; }

all_is_well() {
  fake "$scratch/bin/cmake" 'exit 0'
  fake "$scratch/bin/ctest" 'echo "got: $*"
cat <<END
    Start  1: Fold.Merges
 1/3 Test  #1: Fold.Merges ......................   Passed    0.01 sec
10/30 Test #10: Fold.Empty ......................***Skipped   0.01 sec
 3/3 Test  #3: Fold.NaN .........................   Passed   11.01 sec
100% tests passed, 0 tests failed out of 3
END'
  local preset
  for preset in golden golden-clang golden-O0; do
    mkdir -p "$scratch/project/build/$preset/tests"
    fake "$scratch/project/build/$preset/tests/contort_golden" 'echo "stairs 0123"; echo "recoil 4567"'
  done
}

# expect CODE TEXT ARGS...: `test ARGS...` ends with CODE, and TEXT is in what it prints. Leaves all that in `output`.
expect() {
  local want=$1 text=$2 code=0
  shift 2
  output=$(PATH=$scratch/bin:$PATH CONTORT_NO_INSTALL=1 "$scratch/project/test" "$@" 2>&1) || code=$?
  if [ "$code" -ne "$want" ] || [[ "$output" != *"$text"* ]]; then
    printf 'expected exit code %s and "%s", got %s and:\n%s\n' "$want" "$text" "$code" "$output"
    exit 1
  fi
}
last_line_is() { [ "${output##*$'\n'}" = "$1" ] || { printf 'last line: %s\n' "${output##*$'\n'}"; exit 1; }; }

all_is_well
expect 0 '--label-exclude'
last_line_is '8 passed, 0 failed, 1 skipped'
expect 0 'got: --test-dir build/dev' --slow
[[ "$output" != *--label-exclude* ]]
expect 0 ' -R Fold' -R Fold
last_line_is '2 passed, 0 failed, 1 skipped'

fake "$scratch/bin/ctest" 'echo " 1/3 Test  #1: Fold.Merges ....***Failed    0.01 sec"
echo " 2/3 Test  #2: Fold.NaN ....***Timeout  60.01 sec"
echo " 3/3 Test  #3: Fold.Zero ....Subprocess aborted***Exception:   0.01 sec"; exit 8'
expect 1 'failed: Fold.NaN'
last_line_is '6 passed, 3 failed'

fake "$scratch/bin/ctest" 'echo "cannot start" >&2; exit 8'
expect 1 'failed: ctest (exit code 8)'
last_line_is '6 passed, 1 failed'

all_is_well
fake "$scratch/project/build/golden-clang/tests/contort_golden" 'echo "stairs 0123"; echo "recoil 4568"'
expect 1 '+recoil 4568'
last_line_is '6 passed, 2 failed, 1 skipped'

all_is_well  # other bits as on another CPU
# shellcheck disable=SC2016  # the variable is the stand-in's
fake "$scratch/project/build/golden/tests/contort_golden" 'case "$GLIBC_TUNABLES" in
*-AVX2,-FMA*) echo "stairs 0124" ;; *) echo "stairs 0123" ;; esac; echo "recoil 4567"'
expect 1 'failed: golden-foreign-cpu'
last_line_is '7 passed, 1 failed, 1 skipped'

all_is_well
fake "$scratch/project/build/golden/tests/contort_golden" 'exit 3'
expect 1 'the program itself failed'

all_is_well
rm "$scratch/project/build/golden-O0/tests/contort_golden"
expect 1 'failed: golden-O0'

# libFuzzer, where it is asked for: formats that are clean pass, and one that is not fails with its file.
all_is_well
mkdir -p "$scratch/project/build/libfuzzer/tests/libfuzzer"
fuzzers=$scratch/project/build/libfuzzer/tests/libfuzzer
# shellcheck disable=SC2016  # the variables are the stand-ins'
fake "$fuzzers/contort_seeds" 'mkdir -p "$1"'
for name in spec case description gltf bvh asf_amc aim_table; do
  fake "$fuzzers/fuzz_$name" 'echo "got: $*"; echo "Done 12 runs in 30 second(s)"'
done
expect 0 'Done 12 runs' --libfuzzer
last_line_is '15 passed, 0 failed, 1 skipped'
grep -q -- '-max_total_time=30 .*-rss_limit_mb=2048' "$scratch/project/build/libfuzzer/bvh.log"
expect 0 'Done 12 runs' --libfuzzer=7
grep -q -- '-max_total_time=7 ' "$scratch/project/build/libfuzzer/gltf.log"
fake "$fuzzers/fuzz_case" 'echo "ERROR: AddressSanitizer: stack-overflow" >&2; exit 77'
expect 1 'failed: libfuzzer: case (exit code 77' --libfuzzer
last_line_is '14 passed, 1 failed, 1 skipped'
expect 0 'got: --test-dir'  # only where it is asked for
last_line_is '8 passed, 0 failed, 1 skipped'

all_is_well
fake "$scratch/bin/cmake" 'exit 1'
expect 1 'failed: dev: does not build'
last_line_is '0 passed, 4 failed'
echo "test counts and fails as it should"
