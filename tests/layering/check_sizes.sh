#!/usr/bin/env bash
# check_sizes.sh ROOT: no source file is longer than 350 lines. Prints those that are.
set -euo pipefail
cd "$1"
find . \( -path './build*' -o -path './.*' -o -name node_modules \) -prune -o \
  -type f \( -name '*.h' -o -name '*.cc' -o -name '*.proto' -o -name '*.sh' \) -print0 |
  xargs -0 -r wc -l |
  awk '$2 != "total" && $1 > 350 { print $2 ": " $1 " lines"; bad = 1 } END { exit bad }'
