#!/usr/bin/env bash
# check_parts.sh ROOT FOLDER: each part of cmake/lambert_parts.cmake configures alone, where the packages
# that it must not need cannot be found. Works in FOLDER, which it empties.
set -euo pipefail
root=$1 folder=$2
rm -rf "$folder" && mkdir -p "$folder"

# part NAME PACKAGE...: configures that part without the packages.
part() {
  local name=$1 options=() word
  shift
  for word in SERVER WORKER CLIENT TESTS BENCH; do
    options+=("-DLAMBERT_BUILD_$word=$([[ $word == "$name" ]] && echo ON || echo OFF)")
  done
  for word in "$@"; do options+=("-DCMAKE_DISABLE_FIND_PACKAGE_$word=ON"); done
  if ! cmake -S "$root" -B "$folder/$name" -G Ninja "${options[@]}" >"$folder/$name.log" 2>&1; then
    cat "$folder/$name.log"
    echo "LAMBERT_BUILD_$name does not configure without $*"
    return 1
  fi
}

part WORKER SQLite3 TinyGLTF OpenEXR roaring GTest rapidcheck benchmark
part SERVER OpenEXR GTest rapidcheck benchmark
part CLIENT spdlog prometheus-cpp civetweb SQLite3 GTest rapidcheck benchmark
part BENCH TinyGLTF OpenEXR roaring Protobuf gRPC spdlog CLI11 GTest rapidcheck
part TESTS TinyGLTF OpenEXR embree roaring Protobuf gRPC spdlog CLI11 benchmark
