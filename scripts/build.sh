#!/usr/bin/env bash
# scripts/build.sh PRESET [TARGET...]: configures and builds a preset of CMakePresets.json in
# build/PRESET; all targets where none is named. Warnings are errors where CI=true.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

preset=$1
shift
werror=OFF
if [[ ${CI:-} == true ]]; then
  werror=ON
fi
if ! log=$(cmake --preset "$preset" -DLAMBERT_WERROR=$werror 2>&1 </dev/null); then
  echo "$log" >&2
  exit 1
fi
ninja -C "build/$preset" -j "$(nproc)" "$@" >&2
