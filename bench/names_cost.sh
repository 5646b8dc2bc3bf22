#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Times a loop that uses global names, flat and 190 macros deep: both should take the same time.
# Usage: bench/names_cost.sh [VESTIGE...]     (several programs are compared in one run)
set -euo pipefail
home=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
[ $# -gt 0 ] || set -- "$home/build/release/bin/vestige"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

globals='#declare A = 0; #declare I = 0;'
loop='#while (I < 200000) #declare A = I*2 + A - I; #declare I = I + 1; #end'
echo "$globals $loop" >"$work/flat.scene"
echo "$globals #macro M(N) #if (N > 0) M(N - 1) #else $loop #end #end M(190)" >"$work/deep.scene"
TIMEFORMAT='%U'
for program in "$@"; do
  for text in flat deep; do # without a camera the check fails, but only at the end
    best=$(for _ in 1 2 3; do { time "$program" check "$work/$text.scene" >/dev/null 2>&1 || true; } 2>&1; done | sort -n | head -1)
    printf '%s %s: %s s\n' "$program" "$text" "$best"
  done
done
