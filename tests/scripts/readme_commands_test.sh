#!/usr/bin/env bash
# Does readme_commands.sh find the commands, run them, and notice when they fail?
set -euo pipefail

script=$(dirname "${BASH_SOURCE[0]}")/readme_commands.sh
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
trap 'echo "failed at line $LINENO of $0" >&2' ERR
mkdir "$scratch/bin" "$scratch/project"
cat >"$scratch/bin/contort" <<'END'
#!/bin/sh
echo "contort got: $*"
exit "${1:-0}"
END
chmod +x "$scratch/bin/contort"

# expect CODE TEXT README: the script ends with CODE, and TEXT is in what it prints.
expect() {
  printf '%s\n' "$3" >"$scratch/project/README.md"
  local code=0 output
  output=$(bash "$script" "$scratch/project" "$scratch/bin" 2>&1) || code=$?
  if [ "$code" -ne "$1" ] || [[ "$output" != *"$2"* ]]; then
    printf 'README:\n%s\nexpected exit code %s and "%s", got %s and:\n%s\n' "$3" "$1" "$2" "$code" "$output"
    exit 1
  fi
}

fence='```'
block() { printf '<!-- test%s -->\n%ssh\n%s\n%s\n' "$1" "$fence" "$2" "$fence"; }

expect 0 'contort got: 0 a b' "$(block '' 'contort 0 a b')"
expect 0 'contort got: 0 a b c' "$(block '' $'contort 0 a \\\n  b c')"
expect 0 'contort got: 0 here' "$(block '' $'# a comment\n$ build/release/contort 0 here')"
expect 1 'exit code 1, allowed are 0' "$(block '' 'contort 1')"
expect 0 'contort got: 1' "$(block ' exit=0,1' 'contort 1')"
expect 1 'exit code 2, allowed are 0,1' "$(block ' exit=0,1' 'contort 2')"
expect 1 'exit code 1, allowed are 0' "$(block '' $'contort 1\ncontort 0')"
expect 1 'no commands' $'```sh\ncontort 0\n```'
expect 1 'does not end' $'<!-- test -->\n```sh\ncontort 0'
expect 1 'A line between' $'<!-- test -->\nsome text\n```sh\ncontort 0\n```'

# What a command writes stays in the scratch copy.
expect 0 '' "$(block '' 'touch written')"
[ ! -e "$scratch/project/written" ]
echo "readme_commands.sh works"
