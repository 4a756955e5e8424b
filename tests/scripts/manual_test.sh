#!/usr/bin/env bash
# manual_test.sh PROGRAM: do the manual page and the completions of shells have every command and option that the help
# of the program tells?
set -euo pipefail

contort=$(readlink -f "$1")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
trap 'echo "failed at line $LINENO of $0" >&2' ERR
fail() { echo "$*" >&2; exit 1; }

"$contort" man >"$scratch/contort.1"
for shell in bash zsh fish; do "$contort" completion "$shell" >"$scratch/$shell"; done
if "$contort" completion elvish 2>/dev/null; then fail "a shell that is not known must be refused"; fi

# The names in a section of a help text, "Options:" or "Subcommands:", one in each line.
names_in() {
  awk -v heading="$1" '$0 == heading { inside = 1; next } /^[^ ]/ || /^$/ { if (!/^$/) inside = 0; next }
    inside && /^  [^ ]/ { print $1 }' | tr ',' '\n'
}
# All options of a help text; those of `serve` are in groups with headings of their own.
options_in() { grep -oE '^  (-[a-z],)?--[a-z0-9-]+' | tr -d ' ' | tr ',' '\n'; }

# One section of the manual page: that of a command, or the options of the program.
section_of() {
  awk -v heading="$1" '/^\.S[HS] / { inside = $0 == heading } inside' "$scratch/contort.1" | sed 's/\\-/-/g'
}

# What bash would offer for these words, of which the last is not complete.
# shellcheck source=/dev/null
source "$scratch/bash"
offered() {
  COMP_WORDS=(contort "$@")
  COMP_CWORD=$#
  _contort
  printf '%s\n' "${COMPREPLY[@]}"
}

commands=0
options=0
# walk COMMAND...: this command, and those below it.
walk() {
  local help section completed below in_fish name heading=".SS contort $*"
  if [ $# -eq 0 ]; then heading=".SH OPTIONS"; fi
  help=$("$contort" help "$@")
  section=$(section_of "${heading//-/\\-}")
  completed=$(offered "$@" -)
  below=$(offered "$@" "")
  in_fish=$(grep -F -- "is_at \"$*\"" "$scratch/fish")
  [ -n "$section" ] || fail "the manual page has no section $heading"
  while read -r name; do
    options=$((options + 1))
    grep -qE -- "^\\\\fB.*$name\\\\fR" <<<"$section" || fail "the manual page of contort $* lacks $name"
    grep -qxF -- "$name" <<<"$completed" || fail "bash does not complete contort $* $name"
    grep -qF -- "'$name:" "$scratch/zsh" || fail "zsh does not complete contort $* $name"
    if [[ $name == --* ]]; then
      grep -qF -- " -l ${name#--} " <<<"$in_fish" || fail "fish does not complete contort $* $name"
    fi
  done < <(options_in <<<"$help")
  for name in $(names_in Subcommands: <<<"$help"); do
    commands=$((commands + 1))
    grep -qxF -- "$name" <<<"$below" || fail "bash does not complete contort $* $name"
    grep -qF -- "'$name:" "$scratch/zsh" || fail "zsh does not complete contort $* $name"
    grep -qF -- " -a $name " <<<"$in_fish" || fail "fish does not complete contort $* $name"
    walk "$@" "$name"
  done
}
walk
if [ "$commands" -lt 30 ] || [ "$options" -lt 150 ]; then fail "only $commands commands and $options options"; fi

# A value is skipped, also where it is a command's name; options of the program may stand before the command.
[ "$(offered --library corpus fuz)" = fuzz ]
[ "$(offered fuzz --character corpus --case-)" = --case-timeout ]
[ "$(offered fuzz --character "")" = "" ]

for shell in bash zsh fish; do
  if command -v "$shell" >/dev/null; then "$shell" -n "$scratch/$shell"; fi
done
if command -v shellcheck >/dev/null; then shellcheck --shell=bash "$scratch/bash"; fi
if command -v groff >/dev/null; then
  warnings=$(groff -man -Tutf8 -ww -z "$scratch/contort.1" 2>&1)
  [ -z "$warnings" ] || fail "$warnings"
fi
echo "$commands commands and $options options are in the manual page and in the completions"
