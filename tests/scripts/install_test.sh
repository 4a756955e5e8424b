#!/usr/bin/env bash
# install_test.sh PROJECT BUILD: is all there in an installation that was moved, and can other projects use it?
set -euo pipefail

project=$(cd "$1" && pwd -P)
build=$(cd "$2" && pwd -P)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
trap 'echo "failed at line $LINENO of $0" >&2' ERR
fail() { echo "$*" >&2; exit 1; }

DESTDIR='' cmake --install "$build" --prefix "$scratch/first" >"$scratch/log" || { cat "$scratch/log"; exit 1; }
root=$scratch/moved
mv "$scratch/first" "$root"
# Neither the build nor the source folder: what other tests find beside the program must not help here.
export PATH=$root/bin:/usr/local/bin:/usr/bin:/bin NO_COLOR=1
cd "$scratch"

[ "$(contort --version)" = "$("$build/contort" --version)" ]
contort man | cmp - <(gzip -dc "$root/share/man/man1/contort.1.gz")
contort completion bash | cmp - "$root/share/bash-completion/completions/contort"
contort completion zsh | cmp - "$root/share/zsh/site-functions/_contort"
contort completion fish | cmp - "$root/share/fish/vendor_completions.d/contort.fish"
[ "$(contort schema spec)" = "$(cat "$root/share/doc/contort/schema/spec.schema.json")" ]
diff -r --exclude=__pycache__ "$project/adapters" "$root/share/contort/adapters"
diff -r --exclude=__pycache__ "$project/docs/guide" "$root/share/doc/contort/guide"
[ -f "$root/share/contort/adapters/cpp/../../docs/reference/guests.md" ]
"$root/libexec/contort/contort-render" --version >version
[ "$(cut -d " " -f 2 version)" = "$(contort --version | cut -d " " -f 2)" ]

# No file may remember where it was built. Debug information does, and so do programs with sanitizers.
binaries=(--binary-files=without-match)
if grep -qx 'CMAKE_BUILD_TYPE:STRING=Release' "$build/CMakeCache.txt"; then binaries=(); fi
for folder in "$project" "$build" "$scratch/first"; do
  if found=$(grep -rlF "${binaries[@]}" "$folder" "$root"); then fail "$folder is named in $found"; fi
done

# The list of parts: every package that the product is built from, and those that are bundled.
sbom=$root/share/doc/contort/contort.spdx.json
python3 - "$sbom" "$project/packages.txt" <<'END'
import json, sys
sbom = json.load(open(sys.argv[1], encoding="utf-8"))
names = {package["name"]: package["SPDXID"] for package in sbom["packages"]}
group, wanted = None, []
for line in open(sys.argv[2], encoding="utf-8"):
    if line.startswith("# group:"):
        group = line.split()[2]
    elif group == "product" and line.strip() and not line.startswith("#"):
        wanted.append(line.split()[0])
assert len(wanted) > 15 and set(wanted) <= set(names), set(wanted) - set(names)
related = {(r["spdxElementId"], r["relationshipType"], r["relatedSpdxElement"]) for r in sbom["relationships"]}
for name in ("three", "uplot"):
    assert (names["contort"], "CONTAINS", names[name]) in related, name
for name in ("libglm-dev", "librapidcheck-dev"):
    assert (names["contort"], "STATIC_LINK", names[name]) in related, name
ids = [package["SPDXID"] for package in sbom["packages"]]
assert len(ids) == len(set(ids)), "an id is there twice"
assert all(a in ids + ["SPDXRef-DOCUMENT"] and b in ids for a, _, b in related)
assert sbom["spdxVersion"] == "SPDX-2.3" and sbom["creationInfo"]["created"].endswith("Z")
END

# With engine.js, the list and the licences name what is in that, too.
mkdir -p "$scratch/engine/share/contort/page"
[ -f "$build/page/engine.js" ] || echo '// the engine' >"$scratch/engine/share/contort/page/engine.js"
DESTDIR='' cmake --install "$build" --prefix "$scratch/engine" >"$scratch/log" || { cat "$scratch/log"; exit 1; }
documents=$scratch/engine/share/doc/contort
python3 - "$documents/contort.spdx.json" <<'END'
import json, sys
sbom = json.load(open(sys.argv[1], encoding="utf-8"))
names = [package["name"] for package in sbom["packages"]]
assert len(names) == len(set(names)), "a package is there twice"
linked = {r["relatedSpdxElement"] for r in sbom["relationships"] if r["relationshipType"] == "STATIC_LINK"}
assert {"SPDXRef-deb-emscripten", "SPDXRef-deb-libtinygltf-dev"} <= linked, linked
END
for name in emscripten libtinygltf-dev; do
  [ ! -d "/usr/share/doc/$name" ] || grep -qi copyright "$documents/licences/$name.txt"
done
if [ ! -f "$build/page/engine.js" ] && grep -q emscripten "$sbom"; then fail "Emscripten is named without engine.js"; fi

# Whose code is in the programs and pages, their licences are there, too.
inside="libcli11-dev libglm-dev librapidcheck-dev libxxhash-dev nlohmann-json3-dev"
if [ -f "$build/page/viewer.js" ]; then inside="$inside three uplot"; fi
for name in $inside; do
  if [ -d "/usr/share/doc/$name" ] || [ "${name%-dev}" = "$name" ]; then
    grep -qi copyright "$root/share/doc/contort/licences/$name.txt"
  fi
done

# A project that finds it: a generator, what Contort finds in it, and a game that asks the rules.
project_of_user() { cmake -S "$project/docs/examples/sdk" -B user -DCMAKE_PREFIX_PATH="$root" "$@" >log || { cat log; exit 1; }; }
build_of_user() { cmake --build user >log 2>&1 || { cat log; exit 1; }; }
project_of_user
build_of_user
code=0
contort --generator user/arm fuzz --cases 40 --corpus corpus --gl none >fuzz.txt || code=$?
[ "$code" -eq 1 ] || fail "$(cat fuzz.txt)"
contort --generator user/arm explain corpus >/dev/null
project_of_user -DCORPUS="$scratch/corpus"
build_of_user
user/game >game.txt
grep -qx 'bend 60 deg: played' game.txt
grep -q '^bend 175 deg: skipped, Elbow leaves its range during bend: .*bend.angle_deg > ' game.txt

# The header is written again when the rules have changed.
sed -i 's/Elbow leaves its range/The elbow is broken/' corpus/rules.json
build_of_user
user/game >game.txt
grep -q 'skipped, The elbow is broken' game.txt

# The same header by pkg-config.
export PKG_CONFIG_PATH=$root/share/pkgconfig
[ "$(pkg-config --modversion contort)" = "$(contort --version | cut -d ' ' -f 2)" ]
read -ra flags <<<"$(pkg-config --cflags contort)"
"${CXX:-c++}" -std=c++17 -fsyntax-only "${flags[@]}" "$project/docs/examples/sdk/arm.cpp"
"$(pkg-config --variable=contort contort)" --version >/dev/null

# The report's viewer, where npm could build it.
if [ -f "$build/page/viewer.js" ]; then
  mkdir "$root/bin/page"  # somebody else's
  contort --generator user/arm --gl none report corpus -o report >/dev/null
  cmp "$build/page/viewer.js" report/viewer/viewer.js
fi
echo "an installation can be moved, and other projects find it"
