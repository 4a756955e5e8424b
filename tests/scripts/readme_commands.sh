#!/usr/bin/env bash
# readme_commands.sh PROJECT BIN_DIR [PAGE]: do the commands of a page work, typed one after the other?
#
# PAGE is README.md or another Markdown file, from PROJECT. The commands run in a scratch copy of the project, with
# BIN_DIR on the PATH and as build/release, without a terminal. A command may go on after a backslash. Each command has
# a shell of its own, so `cd` and `export` do not last.
#
# In README.md the ```sh blocks that follow a line "<!-- test -->" are run; in all other pages every ```sh block is.
# These lines before a block change this:
#   <!-- test exit=0,1 -->    allows other exit codes than 0
#   <!-- no test: REASON -->  leaves the block out
#   <!-- file PATH -->        writes the block to PATH instead; the block may be in any language
# A ```text block after a ```sh block shows output: each of its lines must be among the lines that the commands of the
# block printed. "…" stands for any text.
set -euo pipefail

project=$(cd "$1" && pwd -P)
bin=$(cd "$2" && pwd -P)
page=${3:-README.md}
scratch=$(mktemp -d)
output=$(mktemp)
trap 'rm -rf "$scratch" "$output"' EXIT

# Prints one step in each line, with three fields: "run" CODES COMMAND; "file" PATH ""; "line" PATH TEXT; "begin" of a
# block of commands; "expect" "" LINE.
steps_of() {
  awk -v all="$([ "$page" = README.md ] || echo 1)" '
    function step(kind, what, text) { print kind "\037" what "\037" text }
    function forget() { codes = "0"; marked = left_out = 0; path = "" }
    function fail(text) { print text > "/dev/stderr"; failed = 1; exit 1 }
    BEGIN { forget() }
    inside == "" && /^<!-- (test|no test:|file) .*-->$/ {
      marked = 1
      if (match($0, /exit=[0-9,]+/)) codes = substr($0, RSTART + 5, RLENGTH - 5)
      if (/^<!-- no test: /) left_out = 1
      if (/^<!-- file /) path = $3
      marker = $0
      next
    }
    inside == "" && /^```/ {
      if (left_out) inside = "other"
      else if (path != "") { inside = "file"; step("file", path, "") }
      else if ($0 == "```sh" && (all || marked)) { inside = "sh"; step("begin", "", "") }
      else if ($0 == "```text" && all) inside = "text"
      else if (marked) fail("A block of another language after " marker)
      else inside = "other"
      block = inside; file = path; block_codes = codes
      forget()
      next
    }
    inside == "" && marked && NF { fail("A line between " marker " and its block: " $0) }
    inside == "" { next }
    /^```$/ { inside = ""; next }
    inside == "file" { step("line", file, $0) }
    inside == "text" && NF { step("expect", "", $0) }
    inside == "sh" && (command != "" || !/^[ \t]*(#|$)/) {
      sub(/^\$ /, "")
      command = command $0
      if (sub(/\\$/, "", command)) next
      step("run", block_codes, command)
      command = ""
    }
    END { if (!failed && (inside != "" || marked)) { print "A block does not end." > "/dev/stderr"; exit 1 } }
  ' "$1"
}

# Is the line, in which "…" stands for any text, among the lines of the output?
is_printed() {
  local pattern
  pattern=$(sed -e 's/[][\.*^$+?(){}|]/\\&/g' -e 's/…/.*/g' <<<"$1")
  grep -qxE -- "$pattern" "$output"
}

list=$(steps_of "$project/$page")
if ! grep -q '^run' <<<"$list"; then
  echo "$page has no commands that can be run." >&2
  exit 1
fi

tar -C "$project" --exclude=./build --exclude=./contort-out --exclude=./.git -cf - . | tar -C "$scratch" -xf -
mkdir "$scratch/build"
ln -s "$bin" "$scratch/build/release"
export PATH="$bin:$PATH" NO_COLOR=1
cd "$scratch"

failed=0
while IFS=$'\037' read -r kind what text; do
  case $kind in
    begin) : >"$output" ;;
    file) mkdir -p "$(dirname "$what")" && : >"$what" ;;
    line) printf '%s\n' "$text" >>"$what" ;;
    run)
      printf '$ %s\n' "$text"
      code=0
      bash -euo pipefail -c "$text" </dev/null 2>&1 | tee -a "$output" || code=$?
      if [[ ",$what," != *",$code,"* ]]; then
        echo "$page: exit code $code, allowed are $what: $text" >&2
        failed=1
      fi ;;
    expect)
      if ! is_printed "$text"; then
        echo "$page: not printed: $text" >&2
        failed=1
      fi ;;
  esac
done <<<"$list"
exit "$failed"
