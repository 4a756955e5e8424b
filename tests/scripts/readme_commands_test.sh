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

# expect CODE TEXT CONTENTS: for a page with these contents the script ends with CODE, and TEXT is in what it prints.
page=README.md
expect() {
  printf '%s\n' "$3" >"$scratch/project/$page"
  local code=0 output
  output=$(bash "$script" "$scratch/project" "$scratch/bin" "$page" 2>&1) || code=$?
  if [ "$code" -ne "$1" ] || [[ "$output" != *"$2"* ]]; then
    printf 'page:\n%s\nexpected exit code %s and "%s", got %s and:\n%s\n' "$3" "$1" "$2" "$code" "$output"
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

# In other pages every block of commands is run, unless it says that it cannot be.
page=guide.md
sh() { printf '%ssh\n%s\n%s\n' "$fence" "$1" "$fence"; }
text() { printf '%stext\n%s\n%s\n' "$fence" "$1" "$fence"; }
expect 0 'contort got: 0 a' "$(sh 'contort 0 a')"
expect 1 'exit code 1, allowed are 0' "$(sh 'contort 1')"
expect 0 'contort got: 1' $'<!-- test exit=1 -->\n'"$(sh 'contort 1')"
expect 1 'exit code 1, allowed are 0' $'<!-- test exit=1 -->\n'"$(sh 'contort 1')"$'\n'"$(sh 'contort 1')"
expect 1 'no commands' $'<!-- no test: it needs a network -->\n'"$(sh 'contort 0')"
expect 1 'no commands' "$(text 'contort 0')"

# A page can hold the files that its commands read.
file="<!-- file made/a.py -->"$'\n'"${fence}python"$'\nif x:\n    y = "\\n"\n\n# end\n'"$fence"
expect 0 '    y = "\n"' "$file"$'\n'"$(sh 'cat made/a.py')"
expect 0 '4 made/a.py' "$file"$'\n'"$(sh 'wc -l made/a.py')"
expect 1 'A line between' $'<!-- file a.py -->\nsome text\n'"$(sh 'contort 0')"

# A page is held to the output that it shows.
expect 0 '' "$(sh 'contort 0 a.b')"$'\n'"$(text 'contort got: 0 a.b')"
expect 0 '' "$(sh 'contort 0 took 17 s')"$'\n'"$(text $'contort got: 0 took … s\n…')"
expect 1 'not printed: contort got: 0 a.b' "$(sh 'contort 0 aXb')"$'\n'"$(text 'contort got: 0 a.b')"
expect 1 'not printed: got: 0' "$(sh 'contort 0')"$'\n'"$(text 'got: 0')"
expect 1 'not printed: contort got: 0 first' "$(sh 'contort 0 first')"$'\n'"$(sh 'contort 0')"$'\n'"$(text 'contort got: 0 first')"
expect 0 '' "$(sh 'contort 0')"$'\n<!-- no test: the clock is in it -->\n'"$(text 'now')"
page=README.md

# Files that a command writes stay in the scratch copy.
expect 0 '' "$(block '' 'touch written')"
[ ! -e "$scratch/project/written" ]
echo "readme_commands.sh works"
