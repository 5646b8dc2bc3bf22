#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What a plugin's author meets: an installation that was moved, a new plugin, the examples. Builds
# against the installation only. Usage: install_test.sh BUILD SOURCE
set -euo pipefail
build=$(readlink -f "$1") source=$(readlink -f "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export HOME=$work/home CCACHE_DIR=$work/ccache
unset VESTIGE_PLUGIN_PATH CMAKE_PREFIX_PATH
mkdir "$work/home"
warnings="-Wall -Wextra -Wpedantic -Werror"

fail() { printf 'install_test: %s\n' "$*" >&2; exit 1; }
quietly() {
  local log
  log=$(mktemp -p "$work" log.XXXXXX)
  "$@" >"$log" 2>&1 || { cat "$log" >&2; fail "failed: $*"; }
  mv "$log" "$work/log"
}
# Must fail, saying $1.
refuses() {
  local words=$1
  shift
  if "$@" >"$work/log" 2>&1; then fail "should have been refused: $*"; fi
  tr '\n' ' ' <"$work/log" | tr -s ' ' | grep -qF -- "$words" ||
    { cat "$work/log" >&2; fail "did not say '$words': $*"; }
}
# build_plugin FOLDER: found by the PATH alone, then built in FOLDER/build.
build_plugin() {
  quietly cmake -S "$1" -B "$1/build" -DCMAKE_CXX_FLAGS="$warnings"
  quietly cmake --build "$1/build"
}
# The same for several folders, as many at once as there are processors.
build_plugins() {
  printf '%s\0' "$@" | xargs -0 -n 1 -P "$(nproc)" bash -euo pipefail -c 'build_plugin "$1"' -- ||
    fail "a plugin could not be built"
}
export -f build_plugin quietly fail
export work warnings
# render FOLDER NAME: one sample, and a picture that was written.
render() {
  quietly vestige check "$1/$2.scene" --werror --plugin-path "$1/build"
  quietly vestige render "$1/$2.scene" --spp 1 --width 48 --plugin-path "$1/build" -o "$work/$2.png"
  [[ -s $work/$2.png ]] || fail "no picture of $2"
}

quietly cmake --install "$build" --prefix "$work/first"
# No two rules write the same file: one of the two would be lost.
sed -nE 's/^-- (Installing|Up-to-date): //p' "$work/log" | sort | uniq -d | while IFS= read -r path; do
  if [[ ! -d $path || -L $path ]]; then printf '%s\n' "$path"; fi
done >"$work/twice"
[[ ! -s $work/twice ]] || { cat "$work/twice" >&2; fail "these files are installed twice"; }
mv "$work/first" "$work/second"  # nothing in it may know where it was
prefix=$work/second
PATH=$prefix/bin:$PATH
if grep -rlF -e "$build" -e "$source" -e "$work/first" "$prefix/lib/cmake" "$prefix/lib/pkgconfig" \
  "$prefix/include"; then
  fail "these files name a folder of the machine that built them"
fi

# Links between the installed pages work: guides, reference, headers, examples.
if command -v python3 >/dev/null; then quietly python3 "$source/tests/links.py" "$prefix"; fi

# It finds its own plugins, and no others.
vestige plugin list >"$work/list"
grep -qxF "$prefix/lib/vestige/plugins" "$work/list" || fail "plugins are not those of the installation"
[[ $(grep -c '\.so$' "$work/list") == $(find "$prefix/lib/vestige/plugins" -name '*.so' | wc -l) ]] ||
  fail "not every installed plugin is listed"
quietly vestige render "$prefix/share/vestige/examples/hello.scene" --spp 1 --width 32 -o "$work/hello.png"

# A new plugin of each kind; that of two kinds of brdf.
cd "$work"
kinds=(brdf light camera pigment shape integrator)
for kind in "${kinds[@]}"; do quietly vestige plugin new "$kind" "my_$kind"; done
for kind in light camera; do quietly vestige plugin new "$kind" "twin_$kind" --dual; done
quietly vestige plugin new brdf soft_fur --dual --into "$work/home"
build_plugins "${kinds[@]/#/my_}" twin_light twin_camera home/soft_fur
for kind in "${kinds[@]}"; do
  [[ -f my_$kind/build/${kind}_my_$kind.so ]] || fail "no library of my_$kind"
  render "my_$kind" "my_$kind"
done
render home/soft_fur soft_fur
for kind in light camera; do render "twin_$kind" "twin_$kind"; done

# One symbol is exported, whatever is in the library.
exported=$(nm -D --defined-only home/soft_fur/build/brdf_soft_fur.so | awk '$2 ~ /[DRTB]/ { print $3 }')
[[ $exported == vestige_plugin ]] || fail "exported: $exported"

# Its own tests, where this program has them.
if vestige plugin --help | grep -q '^ *test '; then
  quietly ctest --test-dir home/soft_fur/build --output-on-failure
  for plugin in my_light twin_light my_camera twin_camera; do
    quietly ctest --test-dir "$plugin/build" --output-on-failure
  done
else
  quietly ctest --test-dir home/soft_fur/build --output-on-failure -R scene
fi

# Installed for the user, it needs no option any more.
refuses "no brdf is called 'soft_fur'" vestige check home/soft_fur/soft_fur.scene
quietly cmake --install home/soft_fur/build --prefix "$HOME/.local"
quietly vestige check home/soft_fur/soft_fur.scene

# By pkg-config, without CMake.
export PKG_CONFIG_PATH=$prefix/lib/pkgconfig
mkdir by_hand
# shellcheck disable=SC2046  # several words are meant
quietly c++ -O1 -shared $(pkg-config --cflags vestige) my_pigment/my_pigment.cpp \
  -o by_hand/pigment_my_pigment.so
quietly vestige check my_pigment/my_pigment.scene --plugin-path by_hand

# The other compiler understands the headers too.
if command -v clang++ >/dev/null; then
  for header in "$prefix"/include/vestige/*.h "$prefix"/include/vestige/*/*.h; do
    if [[ -f $header ]]; then printf '#include "%s"\n' "$header"; fi
  done >all_headers.cpp
  # shellcheck disable=SC2046
  quietly clang++ $(pkg-config --cflags vestige) -fsyntax-only all_headers.cpp
fi

# The package refuses what it does not have.
printf 'cmake_minimum_required(VERSION 3.22)\nproject(p CXX)\nfind_package(Vestige %s REQUIRED)\n%s\n' \
  2 "" >by_hand/CMakeLists.txt
refuses 'compatible with requested version "2"' cmake -S by_hand -B by_hand/b2
printf 'cmake_minimum_required(VERSION 3.22)\nproject(p CXX)\nfind_package(Vestige 1 REQUIRED)\n%s\n' \
  'vestige_add_plugin(bsdf p SOURCES p.cpp)' >by_hand/CMakeLists.txt
refuses "there is no kind 'bsdf'" cmake -S by_hand -B by_hand/b3

# The examples, from the installation's own copy.
examples=()
for example in "$prefix"/share/vestige/examples/plugins/*/; do
  name=$(basename "$example")
  cp -r "$example" "$work/$name"
  examples+=("$name")
done
build_plugins "${examples[@]}"
for name in "${examples[@]}"; do
  render "$work/$name" "$name"
  if vestige plugin --help | grep -q '^ *test '; then
    quietly ctest --test-dir "$work/$name/build" --output-on-failure
  fi
done
