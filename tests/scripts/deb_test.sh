#!/usr/bin/env bash
# deb_test.sh PROJECT BUILD: does cpack make the same package twice, can it be installed, and does nothing stay behind
# when it is removed? Exit code 77 where Debian's tools are missing.
set -euo pipefail

project=$(cd "$1" && pwd -P)
build=$(cd "$2" && pwd -P)
for tool in dpkg dpkg-deb dpkg-shlibdeps; do
  if ! command -v "$tool" >/dev/null; then echo "skipped: there is no $tool"; exit 77; fi
done
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
trap 'echo "failed at line $LINENO of $0" >&2' ERR
fail() { echo "$*" >&2; exit 1; }
cd "$scratch"

for run in first second; do
  cpack --config "$build/CPackConfig.cmake" -G DEB -B "$scratch/$run" >log 2>&1 || { cat log; exit 1; }
done
package=$(ls first/*.deb)
cmp "$package" "second/$(basename "$package")"

field() { dpkg-deb --field "$package" "$1"; }
[ "$(field Package)" = contort ]
[[ $(field Version) == "$("$build/contort" --version | cut -d ' ' -f 2)"-* ]]
[[ $(field Depends) == *libc6* && $(field Depends) == *openimageio* ]]
[[ $(field Recommends) == *fonts-dejavu-core* ]]

# The administration of a machine where nothing is installed. A user who is not root cannot give files away.
mkdir -p root/var/lib/dpkg/{info,updates,triggers}
touch root/var/lib/dpkg/status root/var/lib/dpkg/available
on_machine() { dpkg --root="$scratch/root" --force-depends --force-not-root --force-bad-path --log=/dev/null "$@"; }
if ! on_machine --install "$package" >log 2>&1; then
  if [ "$(id -u)" -ne 0 ]; then echo "skipped: installing needs root here"; exit 77; fi
  cat log
  exit 1
fi
[ "$(root/usr/bin/contort --version)" = "$("$build/contort" --version)" ]
doc=root/usr/share/doc/contort
gzip -dc "$doc/changelog.Debian.gz" | grep -q "^contort ($(field Version)) "
gzip -dc "$doc/changelog.gz" | cmp - "$project/CHANGELOG.md"
grep -q '^License: Expat' "$doc/copyright"
if [ -e root/usr/share/contort/page ]; then grep -q 'three.js authors' "$doc/copyright"; fi
if [ -e root/usr/share/contort/page/engine.js ]; then grep -q 'The Emscripten Authors' "$doc/copyright"; fi
if [ -n "$(find root/usr -perm /022 -not -type l)" ]; then fail "others may write: $(find root/usr -perm /022)"; fi

on_machine --remove contort >log 2>&1 || { cat log; exit 1; }
left=$(find root -mindepth 1 -not -path 'root/var*')
[ -z "$left" ] || fail "left behind: $left"

if command -v lintian >/dev/null; then
  found=$(lintian --allow-root --fail-on none "$package")
  [ -z "$found" ] || fail "$found"
fi
echo "$(basename "$package"): the same twice, and gone without a trace"
