#!/usr/bin/env bash
# scripts/format.sh [--check]: formats every C++ file by .clang-format, or only says which are not.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

mode=(-i)
if [[ ${1:-} == --check ]]; then
  mode=(--dry-run --Werror)
fi
# bad_sample is meant to look as it does.
find radiosity net telemetry server worker client local app bench examples tests \
  -path tests/layering/bad_sample -prune -o \( -name '*.h' -o -name '*.cc' \) -print0 2>/dev/null |
  xargs -0 -r -n 16 -P "$(nproc)" clang-format --style=file "${mode[@]}"
