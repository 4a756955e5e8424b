#!/usr/bin/env bash
# readme_commands.sh PROJECT BIN_DIR: do the commands of PROJECT/README.md work, typed one after the other?
#
# Takes the ```sh blocks that follow a line "<!-- test -->", and runs each of their commands in a scratch copy of the
# project, with BIN_DIR on the PATH and as build/release, without a terminal. A command may go on after a backslash.
# A command must exit with 0; "<!-- test exit=0,1 -->" allows other codes in its block.
set -euo pipefail

project=$(cd "$1" && pwd -P)
bin=$(cd "$2" && pwd -P)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# "CODES<tab>COMMAND" for each command.
commands_of() {
  awk '
    /^<!-- test( exit=[0-9,]+)? -->$/ {
      codes = "0"
      if (match($0, /exit=[0-9,]+/)) codes = substr($0, RSTART + 5, RLENGTH - 5)
      marked = 1
      next
    }
    marked && /^```sh$/ { inside = 1; marked = 0; next }
    marked && NF { print "A line between <!-- test --> and its ```sh: " $0 > "/dev/stderr"; exit 1 }
    inside && /^```$/ { inside = 0; next }
    inside && /^[ \t]*(#|$)/ { next }
    inside {
      sub(/^\$ /, "")
      command = command $0
      if (sub(/\\$/, "", command)) next
      print codes "\t" command
      command = ""
    }
    END { if (inside || marked) { print "A block does not end." > "/dev/stderr"; exit 1 } }
  ' "$1"
}

list=$(commands_of "$project/README.md")
if [ -z "$list" ]; then
  echo "README.md has no commands under <!-- test -->." >&2
  exit 1
fi

tar -C "$project" --exclude=./build --exclude=./contort-out --exclude=./.git -cf - . | tar -C "$scratch" -xf -
mkdir "$scratch/build"
ln -s "$bin" "$scratch/build/release"
export PATH="$bin:$PATH" NO_COLOR=1
cd "$scratch"

failed=0
while IFS=$'\t' read -r codes command; do
  printf '$ %s\n' "$command"
  code=0
  bash -euo pipefail -c "$command" </dev/null || code=$?
  if [[ ",$codes," != *",$code,"* ]]; then
    echo "README: exit code $code, allowed are $codes: $command" >&2
    failed=1
  fi
done <<<"$list"
exit "$failed"
