#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Seconds that `cornell` and `pieces` take at 64 samples a pixel on 2 threads (median of three), and,
# where Linux' perf is at hand, the share of them spent inside Embree.
# Usage: bench/render_times.sh [PATH/TO/vestige]
set -euo pipefail
home=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
vestige=${1:-$home/build/release/bin/vestige}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

render() {
  "$@" "$vestige" render "$home/examples/$scene.scene" -o "$folder/out.exr" --spp 64 --threads 2 \
    --progress none --stats "$folder/stats.json"
}

for scene in cornell pieces; do
  for _ in 1 2 3; do
    render
    grep -oE '"render_s": *[0-9.e+-]+' "$folder/stats.json" | grep -oE '[0-9.e+-]+$' >>"$folder/$scene"
  done
  printf '%-8s %8.2f s' "$scene" "$(sort -g "$folder/$scene" | sed -n 2p)"
  if perf --version >/dev/null 2>&1; then
    render perf record -q -o "$folder/perf.data"
    perf report -i "$folder/perf.data" --sort dso --stdio 2>/dev/null |
      awk '/libembree/ { share += $1 } END { printf "   %.0f %% in Embree", share }'
  fi
  echo
done
