# shellcheck shell=bash disable=SC2154  # the test sets `project` and `binaries`
# Prepares tests in a browser. It is sourced after `project` and `binaries` are set, with the names of the programs that
# the test needs: it ends the test as skipped if one of them is missing, and sets `chromium`, `modules` and
# `scratch`.
chromium=${CHROMIUM:-/usr/bin/chromium}
for needed in "$@" "$chromium"; do
  command -v "$needed" >/dev/null || { echo "skipped: there is no $needed"; exit 77; }
done

modules=$binaries/page_test_modules
mkdir -p "$modules"
cp "$project"/tests/page/package*.json "$modules/"
(cd "$modules" && npm ci --include=dev --ignore-scripts --no-audit --no-fund)

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
