#!/usr/bin/env bash
# page_test.sh PROJECT BINARIES [NAMES]: the report's page in a browser. First a made-up report that has everything; then
# one of real failures as contort writes it, the same as a single file, and one of a fixed failure for its film strip.
# NAMES: a regular expression; only the tests of the made-up report whose names match it.
set -euo pipefail

project=$1
binaries=$2
names=${3:-}
# shellcheck source=tests/page/browser.sh
source "$project/tests/page/browser.sh" npm node
browse() { node --test-reporter=spec ${names:+--test-name-pattern="$names"} "$project/tests/page/run.mjs" --modules "$modules/node_modules" --chromium "$chromium" "$@"; }

browse --contort "$binaries/contort" --viewer "$binaries/page" | tee "$scratch/log"
grep -qE '^[^ ]+ pass [1-9]' "$scratch/log" || { echo "no test ran"; exit 1; }
if [ -n "$names" ]; then exit 0; fi

# Seed 13 of the profile stress: a dozen and a half failures of the human in six cases.
"$binaries/contort" fuzz --profile stress --character human --seed 13 --cases 6 --shrink-evaluations 30 \
  --shrinks-per-case 6 --corpus "$scratch/corpus" >/dev/null || [ $? -eq 1 ]
"$binaries/contort" report "$scratch/corpus" -o "$scratch/report" --single-file "$scratch/report.html"
"$binaries/contort" fuzz --profile smoke --cases 0 --seeds "$project/tests/page/seeds" --corpus "$scratch/seeds" >/dev/null ||
  [ $? -eq 1 ]
"$binaries/contort" report "$scratch/seeds" -o "$scratch/strip"
grep -q 'contort replay' "$scratch/report/index.html" || { echo "the report of the search has no bucket"; exit 1; }
browse --report "$scratch/report" --single "$scratch/report.html" --strip "$scratch/strip"
