#!/usr/bin/env bash
# bench/workers.sh SCENE [RAYS] [ROUNDS]: the time of a bake over RPC with one worker and with two,
# of one slot each, turn by turn on this machine; prints a line a pair, the median of the ratios,
# and the coordinator's share of the CPU time. Ends with 1 where two results differ in a byte.
# Needs the release build (./run makes it) and two idle processor cores.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
bin=$PWD/build/release
scene=$1 rays=${2:-40000000} rounds=${3:-5}

work=$(mktemp -d)
started=()
trap 'kill "${started[@]}" 2>/dev/null || true; wait; rm -rf "$work"' EXIT

# serve WORKERS: a coordinator with that many workers; sets server_id, address and workers.
serve() {
  "$bin/server/lambert-server" --listen 127.0.0.1:0 2>"$work/server.$1" &
  server_id=$!
  started+=("$server_id")
  until address=$(grep -om1 '127.0.0.1:[0-9]*' "$work/server.$1"); do sleep 0.05; done
  workers=()
  for ((k = 0; k < $1; ++k)); do
    "$bin/worker/lambert-worker" --server "$address" --slots 1 2>/dev/null &
    workers+=($!)
  done
  started+=("${workers[@]}")
}

cpu_ticks() { # of some processes together
  local sum=0 id fields
  for id in "$@"; do
    read -ra fields <"/proc/$id/stat"
    sum=$((sum + fields[13] + fields[14]))
  done
  echo "$sum"
}

bake() { # ADDRESS FOLDER RAYS: prints the seconds from the scene in the server to the last pass
  "$bin/app/lambert" bake "$scene" -o "$2" --server "$1" --max-rays "$3" --progress none --json \
    >/dev/null
  awk -F, 'NR > 1 { seconds = $6 } END { print seconds }' "$2/convergence.csv"
}

serve 1
one=$address
serve 2
two=$address two_server=$server_id two_workers=("${workers[@]}")
bake "$one" "$work/a" 1000000 >/dev/null  # warms both up
bake "$two" "$work/b" 1000000 >/dev/null

ratios=()
for ((round = 1; round <= rounds; ++round)); do
  t1=$(bake "$one" "$work/a" "$rays")
  server_before=$(cpu_ticks "$two_server") worker_before=$(cpu_ticks "${two_workers[@]}")
  t2=$(bake "$two" "$work/b" "$rays")
  server=$(($(cpu_ticks "$two_server") - server_before))
  worker=$(($(cpu_ticks "${two_workers[@]}") - worker_before))
  cmp "$work/a/patches.csv" "$work/b/patches.csv"
  ratio=$(awk "BEGIN { printf \"%.3f\", $t1 / $t2 }")
  ratios+=("$ratio")
  awk "BEGIN { printf \"1 worker %.2f s, 2 workers %.2f s, ratio $ratio, coordinator %.1f %% of the CPU\n\", $t1, $t2, 100 * $server / ($server + $worker) }"
done
echo "median ratio $(printf '%s\n' "${ratios[@]}" | sort -n | sed -n "$(((rounds + 1) / 2))p"), equal bytes"
