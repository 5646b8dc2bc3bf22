# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# What a Debian machine needs to build Vestige (the names are the same on Debian 12 and 13), and how
# ./run and ./test install and build. Sourced by both, with the checkout's folder in `home`.

packages=(
  g++ cmake ninja-build make pkg-config       # tools; make: for plugins, by "cmake -B build"
  libembree-dev                               # rays meet triangles
  libopenimageio-dev libopencolorio-dev       # pictures and colours
  libassimp-dev                               # meshes
  libfmt-dev libcli11-dev nlohmann-json3-dev  # text, command line, JSON
  libglfw3-dev libimgui-dev                   # the window
  catch2                                      # tests
)
build=${home:?}/build/release

say() { printf 'vestige: %s\n' "$*" >&2; }

# Those of `packages` that are not installed, one a line.
missing_packages() {
  local installed
  # dpkg-query fails where one of the names is unknown, but still prints the others.
  installed=$(dpkg-query --show --showformat='${Package} ${db:Status-Status}\n' \
    "${packages[@]}" 2>/dev/null | awk '$2 == "installed" { print $1 }') || true
  comm -23 <(printf '%s\n' "${packages[@]}" | sort) <(sort -u <<<"$installed")
}

as_root() {
  if ((EUID == 0)); then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    say "installing needs root, and there is no sudo here. As root, run"
    say "  apt-get install --no-install-recommends ${packages[*]}"
    exit 3
  fi
}

# Runs a command quietly; shows what it said if it fails.
quietly() {
  local log status=0
  log=$(mktemp)
  "$@" >"$log" 2>&1 || status=$?
  if ((status)); then cat "$log" >&2; fi
  rm -f "$log"
  return $status
}

# An empty or outdated package index is renewed, but only where it is in the way.
apt_install() {
  local install=(env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$@")
  if as_root "${install[@]}" >/dev/null 2>&1; then return; fi
  say "renewing the list of packages (apt-get update) ..."
  if ! quietly as_root apt-get update -qq || ! quietly as_root "${install[@]}"; then
    say "apt-get could not install what is missing; its own words are above."
    exit 3
  fi
}

# Installs what is missing, saying what and why. Where there is no apt: a list, and the end.
install_packages() {
  local missing
  if command -v apt-get >/dev/null && command -v dpkg-query >/dev/null; then
    mapfile -t missing < <(missing_packages)
    ((${#missing[@]})) || return 0
    if ((EUID)) && command -v sudo >/dev/null; then say "sudo may ask for your password:"; fi
    say "installing with apt-get what building needs (a minute or two): ${missing[*]}"
    apt_install "${missing[@]}"
  elif [[ ! -f $build/build.ninja ]]; then
    say "there is no apt here. Please install, by the names this system has for them:"
    say "  a C++20 compiler, cmake >= 3.22, ninja, pkg-config, Embree 3 or 4, OpenImageIO >= 2.4,"
    say "  OpenColorIO >= 2.1, Assimp >= 5.2, fmt, CLI11, nlohmann-json, GLFW 3, Dear ImGui, Catch2 2 or 3"
    say "  (on Debian: ${packages[*]})"
    say "then run 'cmake --preset release' and this script again."
    exit 3
  fi
}

# Configures and builds the targets $@ of preset `release`: a line of progress on a
# terminal, silence elsewhere, everything the compiler said if it fails.
build_release() {
  local log=$build/build.log
  mkdir -p "$build"
  touch "$build/started"
  if [[ ! -f $build/build.ninja ]]; then
    say "configuring ..."
    (cd "$home" && quietly cmake --preset release) || { say "configuring failed, see above."; exit 1; }
  fi
  if [[ -x $build/bin/vestige ]]; then
    say "building what has changed ..."
  else
    say "building in build/release; this first time takes some minutes ..."
  fi
  if ! ninja -C "$build" -j "$(nproc)" "$@" 2>&1 | tee "$log" | progress; then
    grep -av '^\[[0-9]*/[0-9]*\]' "$log" >&2 || true
    say "the build failed, see above (all of it: build/release/build.log)."
    exit 1
  fi
  mv "$build/started" "$build/built"  # sources edited meanwhile are newer than it
}

# Ninja's [done/all] on one line.
progress() {
  local line
  while IFS= read -r line; do
    if [[ -t 2 && $line =~ ^\[([0-9]+/[0-9]+)\] ]]; then printf '\r  %s ' "${BASH_REMATCH[1]}" >&2; fi
  done
  if [[ -t 2 ]]; then printf '\r\033[K' >&2; fi
}
