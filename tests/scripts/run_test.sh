#!/usr/bin/env bash
# run_test.sh PROJECT: what `run` makes of contort's exit codes and files. contort and cmake are replaced by stand-ins.
set -euo pipefail

project=$(cd "$1" && pwd -P)
scratch=$(cd "$(mktemp -d)" && pwd -P)
trap 'rm -rf "$scratch"' EXIT
trap 'echo "failed at line $LINENO of $0" >&2' ERR
mkdir -p "$scratch/project/cmake" "$scratch/project/build/release" "$scratch/bin" "$scratch/elsewhere"
cp "$project/run" "$project/packages.txt" "$scratch/project/"
cp -r "$project/cmake/scripts" "$scratch/project/cmake/"
printf '#!/bin/sh\necho "cmake was here"\n' >"$scratch/bin/cmake"
# contort SUBCOMMAND ends with the code in $SUBCOMMAND_CODE; fuzz fills the corpus with four buckets of three families.
cat >"$scratch/project/build/release/contort" <<'END'
#!/bin/bash
echo "contort got: $*"
bucket() {
  mkdir -p "contort-out/corpus/buckets/$1"
  printf '{\n  "count": 1,\n  "family": "%s"\n}\n' "$2" >"contort-out/corpus/buckets/$1/bucket.json"
}
if [ "$1" = fuzz ] && [ -z "${FIND_NOTHING:-}" ]; then
  bucket a 'joint_range|human|arm_left/elbow max'
  bucket b 'joint_range|human|arm_left/elbow max'
  bucket c 'joint_range|human|leg_left/knee min'
  bucket d 'self_collision|mech|arm_left/forearm ~ torso/chest'
fi
code=${1^^}_CODE
exit "${!code:-0}"
END
chmod +x "$scratch/bin/cmake" "$scratch/project/build/release/contort"

# expect CODE TEXT ARGS...: `run ARGS...` ends with CODE, and TEXT is in what it prints. Leaves all that in `output`.
expect() {
  local want=$1 text=$2 code=0
  shift 2
  rm -rf "$scratch/project/contort-out"
  output=$(cd "$scratch/elsewhere" && PATH=$scratch/bin:$PATH CONTORT_NO_INSTALL=1 "$scratch/project/run" "$@" 2>&1) || code=$?
  if [ "$code" -ne "$want" ] || [[ "$output" != *"$text"* ]]; then
    printf 'expected exit code %s and "%s", got %s and:\n%s\n' "$want" "$text" "$code" "$output"
    exit 1
  fi
}

FUZZ_CODE=1 expect 0 'what this demo expects'
[[ "$output" == *'contort got: replay contort-out/corpus'*'contort got: report contort-out/corpus -o '* ]]
[[ "$output" == *$'  2 joint_range\n'*$'  1 self_collision\n'* ]]
[[ "${output##*$'\n'}" == "Report: $scratch/project/contort-out/report/index.html" ]]

expect 0 'nothing new'
FIND_NOTHING=1 expect 0 'nothing to replay'
FIND_NOTHING=1 FUZZ_CODE=4 expect 4 'nothing to replay'
FUZZ_CODE=1 REPLAY_CODE=1 REPORT_CODE=1 expect 0 'Report: '
FUZZ_CODE=2 expect 2 'could not do its work'
FUZZ_CODE=4 expect 4 'Report: '
FUZZ_CODE=75 expect 75 'start again to continue'
FUZZ_CODE=1 REPLAY_CODE=3 expect 3 'did not replay'
FUZZ_CODE=1 REPORT_CODE=2 expect 2 'no report'

expect 0 'contort got: list checks --json' list checks --json
LIST_CODE=2 expect 2 'contort got: list' list
expect 0 'installs what is missing' --help

# What contort prints is alone on stdout, so that it can be piped.
output=$(PATH=$scratch/bin:$PATH CONTORT_NO_INSTALL=1 "$scratch/project/run" list --json 2>/dev/null)
[ "$output" = 'contort got: list --json' ]

# A build that fails ends it.
printf '#!/bin/sh\necho "no compiler" >&2\nexit 1\n' >"$scratch/bin/cmake"
expect 1 'no compiler'
[[ "$output" != *'contort got'* ]]
echo "run reads exit codes and corpora as it should"
