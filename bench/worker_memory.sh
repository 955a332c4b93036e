#!/usr/bin/env bash
# bench/worker_memory.sh SCENE [METHOD...]: what a worker of one slot holds at most while it shoots
# SCENE, less what it holds idle, in bytes a patch: peak resident memory (VmHWM), a new worker for each
# method (pmcr and phs where none is named). LAMBERT_RAYS: rays of each run (4,000,000).
# Needs the release build (./run makes it).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
bin=$PWD/build/release
scene=$1 rays=${LAMBERT_RAYS:-4000000}
shift
(($# > 0)) || set -- pmcr phs

work=$(mktemp -d)
started=()
trap 'kill "${started[@]}" 2>/dev/null || true; wait; rm -rf "$work"' EXIT

"$bin/server/lambert-server" --listen 127.0.0.1:0 2>"$work/server" &
started+=($!)
until address=$(grep -om1 '127.0.0.1:[0-9]*' "$work/server"); do sleep 0.05; done

peak_bytes() { # of a process
  awk '/^VmHWM/ { print $2 * 1024 }' "/proc/$1/status"
}

for method in "$@"; do
  "$bin/worker/lambert-worker" --server "$address" --slots 1 2>"$work/worker" &
  worker=$!
  started+=("$worker")
  until grep -q "at work" "$work/worker"; do sleep 0.05; done
  idle=$(peak_bytes "$worker")
  "$bin/app/lambert" bake "$scene" -o "$work/out" --server "$address" --method "$method" \
    --max-rays "$rays" --progress none --json >/dev/null
  busy=$(peak_bytes "$worker")
  kill "$worker"
  patches=$(($(wc -l <"$work/out/patches.csv") - 1))
  echo "$method: $patches patches, idle $((idle >> 20)) MiB, peak $((busy >> 20)) MiB," \
    "$(((busy - idle) / patches)) bytes a patch"
done
