#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What a call costs in our BRDFs and in the same sources built as a stranger's plugins, against the
# installed SDK. Usage: bench/call_cost.sh [COMPILER]     (c++; clang++ for the other one)
set -euo pipefail
home=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$home/build/release
brdfs=(lambert phong rough_conductor principled)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

ninja -C "$build" call_cost >/dev/null
cmake --install "$build" --prefix "$work/vestige" >/dev/null
{
  printf 'cmake_minimum_required(VERSION 3.22)\nproject(theirs CXX)\nfind_package(Vestige 1 REQUIRED)\n'
  for name in "${brdfs[@]}"; do
    printf 'vestige_add_plugin(brdf %s SOURCES %s)\n' "$name" "$home/plugins/brdf/$name.cpp"
  done
} >"$work/CMakeLists.txt"
cmake -S "$work" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/vestige" -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_CXX_COMPILER="${1:-c++}" >/dev/null
cmake --build "$work/build" >/dev/null
pairs=()
for name in "${brdfs[@]}"; do
  pairs+=("$work/vestige/lib/vestige/plugins/brdf_$name.so" "$work/build/brdf_$name.so")
done
"$build/bin/call_cost" "${pairs[@]}"
