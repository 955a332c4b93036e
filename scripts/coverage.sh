#!/usr/bin/env bash
# Runs the tests of radiosity/ in a build that counts calls, and lists every function of radiosity/
# outside of anonymous namespaces (so: of a header) that no test calls. Ends with 1 where there is
# one. Uses gcov of the compiler's package; a build folder of its own, build/coverage.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=$PWD/build/coverage

cmake --preset coverage >/dev/null
tests=()
for room in radiosity/*/; do
  room=$(basename "$room")
  if [[ ! -d tests/$room ]]; then
    echo "radiosity/$room has no tests"
    exit 1
  fi
  tests+=("tests/$room/all")
done
mkdir -p "$build" && find "$build" -name '*.gcda' -delete
ninja -C "$build" -j "$(nproc)" "${tests[@]/#tests/radiosity}" "${tests[@]}" >&2

# Slow tests call no function that others do not: they would take most of the time.
for program in "${tests[@]}"; do
  find "$build/${program%/all}" -maxdepth 1 -type f -executable \
    ! -name '*_slow_test' ! -name '*_corpus_test' -print0
done | xargs -0 -P "$(nproc)" -I{} sh -c '"$1" --gtest_brief=1 >&2 || exit 255' run {}

# gcov prints, for each object file, `Function 'NAME'` and `Lines executed:P% of N`. A name with a space
# before its arguments begins with a result type: an instance of a template of the standard library.
# One file at a time: of a function in several, gcov would only show the first.
functions() {
  find "$@" -name '*.gcno' -print0 |
    xargs -0 -n 1 gcov --no-output --function-summaries --demangled-names 2>/dev/null |
    awk '/^Function / { name = substr($0, 11, length($0) - 11); next }
         /^File /     { name = "" }
         /^Lines executed:/ && name ~ /^lambert::/ && name !~ /\(anonymous namespace\)|^[^(]* / {
           print ($0 ~ /executed:0[.]00%/ ? "-" : "+") name; name = "" }'
}
# Inline functions that nothing calls are in no object; a file that includes every header has them.
rm -rf "$build/headers" && mkdir "$build/headers"
printf '#include "%s"\n' radiosity/*/*.h |
  g++ -std=c++20 -march=x86-64-v3 -I. --coverage -fkeep-inline-functions -x c++ -c - \
    -o "$build/headers/all.o"
# What counts is named by the library and its headers; what runs is in the tests' objects too.
functions "$build/radiosity" "$build/headers" >"$build/library.txt"
functions "$build/tests" >"$build/tests.txt"
awk -v library="$build/library.txt" '
  { name = substr($0, 2); if (FILENAME == library) known[name] = 1; if (/^[+]/) called[name] = 1 }
  END {
    for (name in known) {
      ++total
      if (!(name in called)) { ++missing; print "not called by any test: " name | "sort" }
    }
    close("sort")
    printf "%d of %d public functions of radiosity/ are called by tests\n", total - missing, total
    exit missing > 0 || total == 0
  }' "$build/library.txt" "$build/tests.txt"
