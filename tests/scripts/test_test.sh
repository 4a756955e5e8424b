#!/usr/bin/env bash
# test_test.sh PROJECT: does `test` count right, and notice what fails? cmake, ctest and the programs that it runs are
# replaced by stand-ins.
set -euo pipefail

project=$(cd "$1" && pwd -P)
scratch=$(cd "$(mktemp -d)" && pwd -P)
trap 'rm -rf "$scratch"' EXIT
trap 'echo "failed at line $LINENO of $0" >&2' ERR
mkdir -p "$scratch/project/cmake" "$scratch/project/tests/golden" "$scratch/bin"
cp "$project/test" "$project/packages.txt" "$scratch/project/"
cp -r "$project/cmake/scripts" "$scratch/project/cmake/"
printf '# comment\nHeavy.Test\n' >"$scratch/project/tests/heavy_tests.txt"
printf 'stairs 0123\nrecoil 4567\n' >"$scratch/project/tests/golden/expected.txt"

fake() { mkdir -p "$(dirname "$1")" && printf '#!/bin/bash\n%s\n' "$2" >"$1" && chmod +x "$1"; }

# A GoogleTest program with the tests Fold.Merges, Fold.Empty (which is skipped) and Of/Ik.Reaches/0; the shell code in
# $1 runs before the results of the suite Fold are printed.
fake_gtest() {
  cat <<END
filter=
for argument in "\$@"; do case "\$argument" in --gtest_filter=*) filter=\${argument#*=} ;; esac; done
if [ "\$1" = --gtest_list_tests ]; then
  case "\$filter" in
    Fold*) printf 'Fold.\n  Merges\n  Empty\n' ;;
    *) printf 'Fold.\n  Merges\n  Empty\nOf/Ik.\n  Reaches/0  # GetParam() = 1\n' ;;
  esac
  exit
fi
case "\$filter" in
  Fold.Merges:Fold.Empty)
    $1
    echo '[ RUN      ] Fold.Merges'
    echo 'text of the test itself[       OK ] Fold.Merges (1 ms)'
    echo '[ RUN      ] Fold.Empty'
    echo '[  SKIPPED ] Fold.Empty (0 ms)' ;;
  Of/Ik.Reaches/0)
    echo '[ RUN      ] Of/Ik.Reaches/0'
    echo '[       OK ] Of/Ik.Reaches/0 (3 ms)' ;;
  *) echo "unexpected filter \$filter"; exit 9 ;;
esac
END
}

all_is_well() {
  rm -rf "$scratch/project/build"
  fake "$scratch/bin/cmake" 'echo "cmake got: $*"'
  fake "$scratch/bin/ctest" 'echo "ctest got: $*"
echo " 1/2 Test  #1: Scripts.Run ......................   Passed    0.01 sec"
echo "10/30 Test #10: Scripts.Slurm ......................***Skipped   0.01 sec"'
  local preset
  for preset in release dev; do
    fake "$scratch/project/build/$preset/tests/contort_tests" "$(fake_gtest '')"
    for program in server/contort_server_tests renders/raster/contort_raster_tests; do
      fake "$scratch/project/build/$preset/tests/$program" 'exit 0'
    done
  done
  for preset in release golden-clang golden-O0; do
    fake "$scratch/project/build/$preset/tests/contort_golden" 'echo "stairs 0123"; echo "recoil 4567"'
  done
  local fuzzers=$scratch/project/build/dev/tests/libfuzzer name
  # shellcheck disable=SC2016  # the variables are the stand-ins'
  fake "$fuzzers/contort_seeds" 'mkdir -p "$1"'
  for name in spec case description gltf bvh asf_amc joint_table generator aim_table robot; do
    # shellcheck disable=SC2016
    fake "$fuzzers/fuzz_$name" 'echo "got: $*"; echo "Done 12 runs in 30 second(s)"'
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
last_line_is() { [ "${output##*$'\n'}" = "$1" ] || { printf 'last line: %s\nexpected: %s\n' "${output##*$'\n'}" "$1"; exit 1; }; }

all_is_well  # two tests, one script, one golden build; one test and one script are skipped
expect 0 '--label-exclude'
last_line_is '4 passed, 0 failed, 2 skipped'
[[ "$output" == *'--preset release -DCONTORT_TESTS=ON'* ]]
[[ "$output" != *build/dev* ]]
[[ "$output" == *'Slow.\*:Heavy.Test'* ]]

# Everything: the fast build again as on a foreign CPU, the sanitized tests, two more golden builds, ten formats.
expect 0 'Done 12 runs' --all
last_line_is '21 passed, 0 failed, 3 skipped'
[[ "$output" != *--label-exclude* ]]
[[ "$output" == *'--exclude-regex ^Page\.Small$'* ]]
grep -q -- '-max_total_time=30 .*-rss_limit_mb=2048' "$scratch/project/build/dev/libfuzzer/bvh.log"

expect 0 'Fold' 'Fold.*'
last_line_is '1 passed, 0 failed, 1 skipped'
[[ "$output" != *'ctest got'* ]]

expect 2 'There is no option --slow' --slow

# A test that fails, one with a parameter, and one that ends its process.
fake "$scratch/project/build/release/tests/contort_tests" "$(fake_gtest \
  "echo '[ RUN      ] Fold.Merges'; echo '[  FAILED  ] Fold.Merges (1 ms)'; echo '[  FAILED  ] Fold.Merges'; exit 1")"
expect 1 'failed: Fold.Merges' 'Fold.*'
last_line_is '0 passed, 1 failed'
fake "$scratch/project/build/release/tests/contort_tests" "$(fake_gtest \
  "echo '[  FAILED  ] Of/Ik.Reaches/0, where GetParam() = 1 (2 ms)'; exit 1")"
expect 1 'failed: Of/Ik.Reaches/0' 'Fold.*'
fake "$scratch/project/build/release/tests/contort_tests" "$(fake_gtest "echo '[ RUN      ] Fold.Merges'; kill -ABRT \$\$")"
expect 1 'failed: Fold.Merges (exit code 134)' 'Fold.*'
last_line_is '0 passed, 1 failed'
fake "$scratch/project/build/release/tests/contort_tests" 'exit 3'
expect 1 'lists no tests' 'Fold.*'

all_is_well
fake "$scratch/bin/ctest" 'echo " 1/3 Test  #1: Scripts.Run ....***Failed    0.01 sec"
echo " 2/3 Test  #2: Page.Browser ....***Timeout  60.01 sec"
echo " 3/3 Test  #3: Scripts.Zero ....Subprocess aborted***Exception:   0.01 sec"; exit 8'
expect 1 'failed: Page.Browser'
last_line_is '3 passed, 3 failed, 1 skipped'
fake "$scratch/bin/ctest" 'echo "cannot start" >&2; exit 8'
expect 1 'failed: ctest (exit code 8)'

all_is_well
fake "$scratch/project/build/golden-clang/tests/contort_golden" 'echo "stairs 0123"; echo "recoil 4568"'
expect 1 '+recoil 4568' --all
last_line_is '19 passed, 2 failed, 3 skipped'

all_is_well  # other bits as on another CPU
# shellcheck disable=SC2016  # the variable is the stand-in's
fake "$scratch/project/build/release/tests/contort_golden" 'case "$GLIBC_TUNABLES" in
*-AVX2,-FMA*) echo "stairs 0124" ;; *) echo "stairs 0123" ;; esac; echo "recoil 4567"'
expect 1 'failed: release-foreign-cpu' --all
expect 0 'passed'

all_is_well
fake "$scratch/project/build/release/tests/contort_golden" 'exit 3'
expect 1 'the program itself failed'

all_is_well
rm "$scratch/project/build/golden-O0/tests/contort_golden"
expect 1 'failed: golden-O0' --all
fake "$scratch/project/build/dev/tests/libfuzzer/fuzz_case" 'echo "ERROR: AddressSanitizer: stack-overflow" >&2; exit 77'
expect 1 'failed: libfuzzer: case (exit code 77' --all

all_is_well
fake "$scratch/bin/cmake" 'exit 1'
expect 1 'failed: release: does not build'
last_line_is '0 passed, 1 failed'
echo "test counts and fails as it should"
