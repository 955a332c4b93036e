#!/usr/bin/env bash
# scripts/sanitize.sh [PRESET [TEST...]]: builds test programs with sanitizers and runs them, one after the other. PRESET:
# asan (default) or tsan. Without TEST: the tests of the reader of scenes; those of compressed meshes again and, where
# the corpus of hostile files is there, each of them, in processes of 512 MiB. Ends with 1 where one fails.
# Races in the coordinator: scripts/sanitize.sh tsan service_parts_test, by hand, for it takes many minutes to build.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

preset=${1:-asan}
shift || true
tests=("$@")
hostile=()
if (($# == 0)); then
  tests=(scene_test)
  hostile=(scene_corpus_test)
fi
# What only a sanitized build warns of is no error.
CI=false scripts/build.sh "$preset" "${tests[@]}" "${hostile[@]}"
export ASAN_OPTIONS=quarantine_size_mb=16 UBSAN_OPTIONS=print_stacktrace=1
# run TEST ARGUMENT...
run() {
  local name=$1
  shift
  "$(find "build/$preset/tests" -type f -name "$name" -perm -u+x)" --gtest_brief=1 "$@"
}
for test in "${tests[@]}"; do run "$test"; done
export ASAN_OPTIONS+=:hard_rss_limit_mb=512
if ((${#hostile[@]} > 0)); then run scene_test --gtest_filter='Draco.*:Meshopt.*'; fi
for test in "${hostile[@]}"; do run "$test" --gtest_filter='*Hostile*'; done
