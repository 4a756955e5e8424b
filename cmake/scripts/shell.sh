# Sourced by `run` and `test`: packages, builds, and commands that are shown.
# shellcheck shell=bash

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd -P)

say() { printf '%s\n' "$*"; }
warn() { printf '%s\n' "$*" >&2; }

# Prints a command as one could type it.
show() {
  local line
  printf -v line ' %q' "$@"
  say "\$$line"
}

show_and_run() {
  show "$@"
  "$@"
}

# The packages of the named groups of packages.txt, one per line.
packages_of() {
  local groups=" $* "
  awk -v groups="$groups" '
    /^# group:/ { wanted = index(groups, " " $3 " ") > 0; next }
    /^#/ || NF == 0 { next }
    wanted { print $1 }' "$root/packages.txt"
}

# A program of the package's name that came from elsewhere (npm often does) is as good.
missing_packages() {
  local installed package
  installed=$(dpkg-query --show --showformat='${db:Status-Abbrev}|${Package}\n' | awk -F '|' '$1 ~ /^.i/ { print $2 }')
  packages_of "$@" | { grep -vxF -f <(printf '%s\n' "$installed") || true; } | while read -r package; do
    command -v "$package" >/dev/null || printf '%s\n' "$package"
  done
}

# Ends the script: we cannot install, so the user has to.
give_up_on_packages() {
  local why=$1
  shift
  warn ""
  warn "$why"
  warn "Contort is built from these Debian 12 packages (packages.txt says why each):"
  warn ""
  warn "    apt-get install --no-install-recommends $*"
  warn ""
  warn "Where you have their equivalents already, set CONTORT_NO_INSTALL=1 and start again."
  exit 2
}

# Installs what is missing of the named groups; says nothing and takes no time when nothing is.
install_packages() {
  if [ -n "${CONTORT_NO_INSTALL:-}" ]; then return; fi
  local all missing as_root=() log="$root/build/packages.log"
  mapfile -t all < <(packages_of "$@")
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    give_up_on_packages "This is not a Debian system, so packages are not installed automatically." "${all[@]}"
  fi
  mapfile -t missing < <(missing_packages "$@")
  if [ "${#missing[@]}" -eq 0 ]; then return; fi

  say "Missing packages (${#missing[@]} of ${#all[@]}): ${missing[*]}"
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      give_up_on_packages "They cannot be installed: you are not root and there is no sudo." "${missing[@]}"
    fi
    as_root=(sudo)
  fi
  mkdir -p "$root/build"
  say "Installing them takes about a minute; details go to build/packages.log."
  local update=("${as_root[@]}" apt-get update)
  local install=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive
    apt-get install -y -o DPkg::Lock::Timeout=300 --no-install-recommends "${missing[@]}")
  show "${update[@]}"
  if ! "${update[@]}" >"$log" 2>&1; then
    warn "The package lists could not be refreshed; trying with those that are here."
  fi
  show "${install[@]}"
  if ! "${install[@]}" >>"$log" 2>&1; then
    tail -n 5 "$log" >&2
    give_up_on_packages "They could not be installed: no network, no permission, or a system other than Debian 12." \
      "${missing[@]}"
  fi
}

# Configures build/PRESET unless that is done already, for this folder, these presets and the option in
# CONTORT_CONFIGURE (such as -DCONTORT_TESTS=ON); then builds the targets.
build_preset() {
  local preset=$1 cache="$root/build/$1/CMakeCache.txt" targets=() fresh=() option=${CONTORT_CONFIGURE:-}
  shift
  if [ "$#" -gt 0 ]; then targets=(--target "$@"); fi
  if [ -f "$cache" ]; then fresh=(--fresh); fi
  if [ ! -f "$root/build/$preset/build.ninja" ] ||
    [ "$root/CMakePresets.json" -nt "$root/build/$preset/build.ninja" ] ||
    ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$cache"; then
    (cd "$root" && show_and_run cmake --preset "$preset" ${option:+"$option"} "${fresh[@]}") || return
  elif [ -n "$option" ] && ! grep -qxF "$(sed -E 's/^-D([^=]*)=/\1:BOOL=/' <<<"$option")" "$cache"; then
    (cd "$root" && show_and_run cmake --preset "$preset" "$option") || return
  fi
  (cd "$root" && show_and_run cmake --build "build/$preset" --parallel "$(nproc)" "${targets[@]}")
}
