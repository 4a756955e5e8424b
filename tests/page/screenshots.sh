#!/usr/bin/env bash
# screenshots.sh PROJECT BINARIES: makes the pictures of docs/reference/report.md and docs/reference/server.md, in
# docs/images: a short search of a stock character, its report, and what a browser shows of it. Beforehand the page's
# tests have to have run: they fetch what drives the browser.
set -euo pipefail

project=$1
binaries=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

"$binaries/contort" fuzz --profile stress --character human --seed 3 --cases 4 --shrink-evaluations 60 --corpus "$scratch/corpus" \
  >/dev/null || [ $? -eq 1 ]
"$binaries/contort" report "$scratch/corpus" -o "$scratch/report"
CONTORT_PAGE_TEST=$(printf '{"modules": "%s", "report": "%s", "contort": "%s", "chromium": "%s"}' \
  "$binaries/page_test_modules/node_modules" "$scratch/report" "$binaries/contort" "${CHROMIUM:-/usr/bin/chromium}") \
  node "$project/tests/page/screenshots.mjs" "$project/docs/images"
