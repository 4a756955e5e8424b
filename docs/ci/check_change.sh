#!/usr/bin/env bash
# check_change.sh KNOWN FOUND COMMENT [OPTIONS OF CONTORT]: judges a change in a few minutes. KNOWN is the corpus of
# earlier runs; it may be missing. New failures go to the corpus FOUND, and COMMENT gets their causes as Markdown. Exits
# with 0 only if nothing is new, nothing that was fixed fails again, and both could be judged.
#   CONTORT_TIME   how long to look for failures (5m)
#   CONTORT_SEED   another one looks elsewhere (1)
set -euo pipefail
known=$1 found=$2 comment=$3
shift 3

baseline=()
late=0
if [ -d "$known/buckets" ]; then
  baseline=(--baseline "$known")
  contort replay "$known" --baseline "$known" --time "${CONTORT_TIME:-5m}" "$@" || late=$?
fi
# That something was found is the report's to judge.
contort fuzz --profile pr --time "${CONTORT_TIME:-5m}" --seed "${CONTORT_SEED:-1}" --corpus "$found" "$@" ||
  [ $? -eq 1 ]

gate=0
contort report "$found" -o report --gate --junit contort.xml --markdown "$comment.table" "${baseline[@]}" "$@" ||
  gate=$?
causes=$(contort causes "$found" "${baseline[@]}" "$@")
{
  # comment.py looks for the first line, so that a merge request has one comment.
  printf '<!-- contort-causes -->\n'
  cat "$comment.table"
  printf '\nCauses of what this change shows:\n\n'
  # Indented lines are code in Markdown, whatever names of strangers are in them.
  printf '%s\n' "$causes" | sed 's/^/    /'
} >"$comment"
rm "$comment.table"
if [ "$gate" -ne 0 ]; then exit "$gate"; fi
exit "$late"
