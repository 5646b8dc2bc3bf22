#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Times the reading of texts, also beside POV-Ray where it is installed; user seconds without those
# of an empty text, the least of three.
# Usage: bench/language_speed.sh [VESTIGE...]     (several programs are compared in one run)
set -euo pipefail
home=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
[ $# -gt 0 ] || set -- "$home/build/release/bin/vestige"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
body='sqrt(X*X + Y*Y + Z*Z) - 1 + sin(X*3)*0.1'
declare -A texts=(
  [empty]=''
  [loop]='#declare I = 0; #while (I < 1000000) #declare A = sin(I)*2 + I/3 - max(I,5); #declare I = I + 1; #end'
  [for]='#for (I, 1, 1000000) #declare A = sin(I)*2 + I/3 - max(I,5); #end'
  [macros]='#macro M(A, B) #local C = A + B; #declare D = C*2; #end #for (I, 1, 500000) M(I, 3) #end'
  [calls]="#declare F = function(X, Y, Z) { $body } #for (I, 1, 500000) #declare A = F(I, 1, 2); #end"
  [no_calls]='#for (I, 1, 500000) #declare A = <I, 1, 2>; #end'
)
TIMEFORMAT='%U'
seconds() { # the least of three
  for _ in 1 2 3; do { time "$@" >/dev/null 2>&1 || true; } 2>&1; done | sort -n | head -1
}
reading() { # program text
  case $1 in
    *povray) seconds "$1" "+I$work/$2.scene" +W1 +H1 -F -D +WT1 ;;
    *) seconds "$1" check --max-tokens 2000000000 --max-loop-iterations 100000000 "$work/$2.scene" ;;
  esac
}
for text in "${!texts[@]}"; do echo "${texts[$text]}" >"$work/$text.scene"; done
if povray=$(command -v povray); then set -- "$@" "$povray"; fi
for program in "$@"; do
  empty=$(reading "$program" empty)
  for text in loop for macros calls no_calls; do
    awk -v program="$program" -v text="$text" -v all="$(reading "$program" "$text")" -v empty="$empty" \
      'BEGIN { printf "%s %s: %.2f s\n", program, text, all - empty }'
  done
done
