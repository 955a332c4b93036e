#!/usr/bin/env bash
# bench/durability.sh SCENE [RAYS] [ROUNDS] [OPTIONS of submit...]: what durability costs and what it gives, with a
# server and one worker of two slots on this machine.
# 1. The time of a job, from its creation to its end, with --journal off, auto and every, turn by turn; a line a
#    round, and the median of the ratios to off.
# 2. ROUNDS times: the server is killed (kill -9) in the middle of the job and started again; seconds from that
#    start until it listens, until the job goes on (and at which step), and until the worker is back in a session, which leases to it what is
#    open at once.
# Needs the release build (./run makes it).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
bin=$PWD/build/release
scene=$1 rays=${2:-40000000} rounds=${3:-3}
options=("${@:4}")

work=$(mktemp -d)
server= worker=
stop() {
  kill $server $worker 2>/dev/null || true
  wait
  server= worker=
}
trap 'stop; rm -rf "$work"' EXIT

now() { date +%s.%N; }

serve() { # ADDRESS MODE LOG: sets server and address
  rm -f "$3" # of the server before
  "$bin/server/lambert-server" --listen "$1" --data "$work/data" --journal "$2" 2>"$3" &
  server=$!
  until address=$(grep -som1 'on 127.0.0.1:[0-9]*' "$3"); do sleep 0.01; done
  address=${address#on }
}

begin() { # MODE: a server on an empty folder, a worker, and a job; sets job
  rm -rf "$work/data" "$work/worker"
  serve 127.0.0.1:0 "$1" "$work/log"
  "$bin/worker/lambert-worker" --server "$address" --slots 2 2>"$work/worker" &
  worker=$!
  until grep -sq 'at work' "$work/worker"; do sleep 0.01; done
  job=$("$bin/app/lambert" submit "$scene" --server "$address" --max-rays "$rays" "${options[@]}" 2>/dev/null)
}

seconds_of() { # PATTERN LOG: the time of day of the first such line of a log, in seconds
  grep -m1 "$1" "$2" | sed -E 's/^\[[^ ]+ ([0-9:.]+)\].*/\1/' | awk -F: '{ print $1 * 3600 + $2 * 60 + $3 }'
}

median() { sort -n | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }

for ((round = 1; round <= rounds; ++round)); do
  line=
  for mode in off auto every; do
    begin "$mode"
    "$bin/app/lambert" watch "$job" --server "$address" --progress none >/dev/null 2>&1
    stop
    took=$(awk "BEGIN { print $(seconds_of STATE_SUCCEEDED "$work/log") - $(seconds_of ' created ' "$work/log") }")
    [[ $mode == off ]] && off=$took
    ratio=$(awk "BEGIN { printf \"%.3f\", $took / $off }")
    echo "$ratio" >>"$work/$mode.ratios"
    line+="$mode $took s (ratio $ratio, $(grep -o 'kept [0-9].* in [0-9.]* s' "$work/log")); "
  done
  echo "${line%; }"
done
echo "median ratios to off: auto $(median <"$work/auto.ratios"), every $(median <"$work/every.ratios")"

for ((round = 1; round <= rounds; ++round)); do
  begin auto
  sleep "$(awk "BEGIN { print $off * .6 }")"
  kill -9 "$server"
  wait "$server" 2>/dev/null || true
  began=$(now)
  serve "$address" auto "$work/log2"
  listens=$(now)
  until grep -q 'goes on at' "$work/log2"; do sleep 0.01; done
  goes_on=$(now)
  until (($(grep -c 'at work' "$work/worker") > 1)); do sleep 0.01; done
  back=$(now)
  stop
  awk "BEGIN { printf \"killed: listens after %.2f s, goes on after %.2f s, has its worker back after %.2f s; \", $listens - $began, $goes_on - $began, $back - $began }"
  grep -o 'goes on at.* journal' "$work/log2"
done
