#!/usr/bin/env bash
# packages_test.sh PROJECT: what `run` does about packages on machines that we do not have: without packages, network,
# root or Debian. The programs that it asks are replaced by ones that lie.
set -euo pipefail

project=$(cd "$1" && pwd -P)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
trap 'echo "failed at line $LINENO of $0" >&2' ERR
mkdir -p "$scratch/project/cmake"
cp "$project/packages.txt" "$scratch/project/"
cp -r "$project/cmake/scripts" "$scratch/project/cmake/"

fake() { printf '#!/bin/sh\n%s\n' "$2" >"$scratch/bin/$1" && chmod +x "$scratch/bin/$1"; }

# A machine where nothing is installed, apt-get works, and the user is not root but has sudo.
new_machine() {
  rm -rf "${scratch:?}/bin" "$scratch/calls"
  mkdir "$scratch/bin"
  local tool
  for tool in bash awk grep cat mkdir dirname env tail sh; do ln -s "$(command -v "$tool")" "$scratch/bin/$tool"; done
  fake dpkg-query 'echo "ii |libc6"'
  fake apt-get "echo apt-get \"\$@\" >>'$scratch/calls'"
  fake sudo "echo sudo >>'$scratch/calls'; exec \"\$@\""
  fake id 'echo 1000'
}

# install CODE TEXT GROUPS...: ends with CODE, and TEXT is in what it prints.
install() {
  local want=$1 text=$2 code=0 output
  shift 2
  output=$(PATH=$scratch/bin CONTORT_NO_INSTALL=${no_install:-} bash -c 'set -euo pipefail
    source "$1/cmake/scripts/shell.sh"; shift; install_packages "$@"' bash "$scratch/project" "$@" 2>&1) || code=$?
  if [ "$code" -ne "$want" ] || [[ "$output" != *"$text"* ]]; then
    printf 'expected exit code %s and "%s", got %s and:\n%s\n' "$want" "$text" "$code" "$output"
    exit 1
  fi
}
called() { grep -q -- "$1" "$scratch/calls" || { echo "not called: $1"; exit 1; }; }
nothing_called() { [ ! -e "$scratch/calls" ] || { echo "called: $(cat "$scratch/calls")"; exit 1; }; }

# Node 18 is Debian 12's. A package that asks for a later one would end every test that needs it.
for lock in "$project"/renders/page/package-lock.json "$project"/tests/page/package-lock.json; do
  mapfile -t leasts < <(grep -oE '"node": ">= ?[0-9]+' "$lock" | grep -oE '[0-9]+$')
  for least in "${leasts[@]}"; do
    [ "$least" -le 18 ] || { echo "$lock: a package needs Node $least, and Debian 12 has Node 18"; exit 1; }
  done
done

new_machine
install 0 'Missing packages' product
called 'apt-get update'
called 'apt-get install .*--no-install-recommends .*libglm-dev'
called sudo
if grep -q libgtest-dev "$scratch/calls"; then echo "the product does not need libgtest-dev"; exit 1; fi

new_machine
install 0 '' product tests
called 'libglm-dev.* libgtest-dev'

new_machine  # root needs no sudo
fake id 'echo 0'
install 0 '' product
if grep -q sudo "$scratch/calls"; then echo "root needs no sudo"; exit 1; fi

new_machine  # everything is here
awk '/^[^#]/ { print "echo \"ii |" $1 "\"" }' "$project/packages.txt" >"$scratch/all"
fake dpkg-query "$(cat "$scratch/all")"
install 0 '' product tests
nothing_called

new_machine  # one is missing, one was removed but left its settings
fake dpkg-query "$(grep -v '|clang"' "$scratch/all" | sed 's/ii |ccache/rc |ccache/')"
install 0 'Missing packages (2 of ' product tests
called ' ccache clang$'

new_machine  # offline
fake apt-get 'echo "Could not resolve host" >&2; exit 100'
install 2 'apt-get install --no-install-recommends cmake ' product

new_machine
rm "$scratch/bin/sudo"
install 2 'there is no sudo' product
nothing_called

new_machine
rm "$scratch/bin/dpkg-query" "$scratch/bin/apt-get"
install 2 'not a Debian system' product

new_machine
no_install=1 install 0 '' product tests
nothing_called
echo "packages are asked for and installed as they should"
