#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The arrows of docs/architecture.md hold: no part includes what lies above or beside it. And the
# files that CONTRIBUTING.md and docs/ point to exist. Usage: architecture.sh [CHECKOUT]
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"
status=0

std='<[a-z_0-9]+>'
system='<(execinfo|link|spawn|unistd|dlfcn|fcntl|signal|termios|xmmintrin|pmmintrin|immintrin|sys/[a-z]+)\.h>'
sdk='<vestige/[a-z_0-9/]+\.h>'

# includes FOLDER ALLOWED: every #include below FOLDER is one of the extended regex ALLOWED.
declare -A checked
includes() {
  local wrong
  checked[${1%/}]=yes
  [[ -e $1 ]] || return 0
  wrong=$(grep -rnE --include='*.h' --include='*.cpp' '^[[:space:]]*#[[:space:]]*include' "$1" |
    grep -vE "#[[:space:]]*include[[:space:]]+($2)") || return 0
  printf 'These may not be included in %s/ (docs/architecture.md):\n%s\n' "$1" "$wrong"
  status=1
}

includes engine/sdk "$std|$sdk"
# Contracts need no tool. Dual numbers and differences stand in for an author's derivatives: they may.
for header in engine/sdk/vestige/*.h; do
  case ${header##*/} in *dual*.h | *_differences.h | cosine_brdf.h | area_light.h | delta_light.h) continue ;; esac
  includes "$header" "$std|<vestige/(footprint/)?[a-z_0-9]+\.h>"
done
includes engine/trace "$std|$system|$sdk|\"engine/trace/|<embree[34]/"
includes engine/files "$std|$system|\"engine/files/|<fmt/|<OpenImageIO/hash\.h>"
includes engine/colour "$std|\"engine/colour/|<fmt/|<OpenColorIO/"
includes engine/picture "$std|$system|$sdk|\"engine/(picture|colour)/|<fmt/|<OpenImageIO/"
includes engine/texture "$std|$system|$sdk|\"engine/(texture|picture|colour|files)/|<fmt/|<OpenImageIO/"
includes engine/light "$std|$sdk|\"engine/(light|trace)/"
includes engine/film "$std|$system|$sdk|\"engine/film/"
includes engine/scene "$std|$system|$sdk|\"engine/(scene|light|trace|texture|files)/|<fmt/"
includes engine/render "$std|$system|$sdk|\"engine/"
includes judge "$std|$system|$sdk|\"(judge|engine)/|<fmt/"
includes lang "$std|$system|$sdk|\"lang/|<fmt/"
for part in app/*.cpp app/*.h app/templates; do
  includes "$part" "$std|$system|$sdk|\"(app|engine|judge|lang)/|<fmt/|<CLI/|<nlohmann/"
done
includes app/window "$std|$system|$sdk|\"(app|engine|lang)/|<fmt/|<CLI/|<GL/|<GLFW/|<imgui.h>|<backends/"

# Every room has a rule here and a row on the page.
for room in engine/*/ judge/ lang/ app/window/; do
  room=${room%/}
  [[ -n $(find "$room" -name '*.h' -o -name '*.cpp') ]] || continue
  if [[ -z ${checked[$room]:-} ]]; then
    printf 'tests/architecture.sh has no rule for %s/\n' "$room"
    status=1
  fi
  if ! grep -qF "\`$room/" docs/architecture.md; then
    printf 'docs/architecture.md does not list %s/\n' "$room"
    status=1
  fi
done

# A plugin sees the SDK and, if it is a folder, its own files; one of them brings a library.
for kind in plugins/*/; do
  for entry in "$kind"*; do
    library='<>'
    if [[ $entry == plugins/shape/mesh* ]]; then library='<assimp/'; fi
    includes "$entry" "$std|$sdk|\"[a-z_0-9]+\.h\"|$library"
  done
done

# The files that a page names: `path/with.ending`, and [text](path).
# shellcheck disable=SC2016  # backticks of Markdown
named_files() {
  grep -oE '`[a-zA-Z_0-9.]+(/[a-zA-Z_0-9.]+)+\.(h|cpp|md|sh|scene|txt|cmake)`' "$1" | tr -d '`' || true
  grep -oE '\]\([^):]+\)' "$1" | tr -d '()]' | sed 's/#.*//' || true
}

for page in CONTRIBUTING.md README.md docs/*.md docs/adr/*.md docs/plugins/*.md; do
  while IFS= read -r file; do
    if [[ ! -e $file && ! -e $(dirname "$page")/$file ]]; then
      printf '%s names %s, which does not exist\n' "$page" "$file"
      status=1
    fi
  done < <(named_files "$page" | sort -u)
done
exit $status
