#!/usr/bin/env bash
# check_names.sh ROOT: no two headers define a type of one name in one namespace. The linker would take
# either's inline functions for both. Prints such names with their headers.
set -euo pipefail
cd "$1"
find . \( -path './build*' -o -path ./tests/layering/bad_sample -o -path './.*' -o -name node_modules \) -prune -o -type f -name '*.h' -print0 |
  sort -z | xargs -0 -r awk '
  FNR == 1 { space = "" }
  /^namespace [a-z_:]+ \{/ { space = $2 }
  /^(struct|class|enum class) [A-Za-z]+/ && !/^[a-z ]+[A-Za-z]+;/ {
    sub(/^enum /, ""); sub(/alignas\([0-9]+\) /, ""); name = space "::" $2
    if (name in first && first[name] != FILENAME) { print name ": " first[name] ", " FILENAME; bad = 1 }
    first[name] = FILENAME
  }
  END { exit bad }'
