#!/usr/bin/env bash
# scripts/fuzz.sh [SECONDS [TARGET...]]: fuzzes each target of tests/fuzz for so long (5 s unless told), one after
# the other, and ends with 1 where one crashes, hangs or takes more than 1 GiB. Corpora grow in
# build/fuzz/corpus; what is found is kept in build/fuzz/found. Needs clang-14 and
# libclang-rt-14-dev, and skips without them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

seconds=${1:-5}
shift || true
if ! command -v clang++-14 >/dev/null || ! compgen -G '/usr/lib/llvm-14/lib/clang/*/lib/linux/libclang_rt.fuzzer-*.a' >/dev/null; then
  echo "fuzz: skipped, clang-14 or libclang-rt-14-dev is not here"
  exit 0
fi
targets=("$@")
if ((${#targets[@]} == 0)); then
  for file in tests/fuzz/*_fuzz.cc; do
    file=${file##*/}
    targets+=("${file%_fuzz.cc}")
  done
fi
seeds=(fuzz_seeds fuzz_request_seeds)
# What only clang warns of is no error.
CI=false scripts/build.sh fuzz "${seeds[@]}" "${targets[@]/#/fuzz_}"
build=build/fuzz
for program in "${seeds[@]}"; do "$build/tests/fuzz/$program" "$build/seeds"; done
mkdir -p "$build/found"
for target in "${targets[@]}"; do
  mkdir -p "$build/corpus/$target"
  log=$build/$target.log
  if ! "$build/tests/fuzz/fuzz_$target" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=1024 \
    -malloc_limit_mb=512 -artifact_prefix="$build/found/$target-" -print_final_stats=1 \
    "$build/corpus/$target" "$build/seeds/$target" >"$log" 2>&1; then
    tail -n 60 "$log"
    echo "fuzz: $target FAILED; its input is in $build/found, its log in $log"
    exit 1
  fi
  echo "fuzz: $target: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") inputs," \
    "$seconds s, no finding"
done
