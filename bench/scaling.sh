#!/usr/bin/env bash
# bench/scaling.sh DIR [SIMULATE_FARM]: passes of 10,000 rays a patch on farms of 1 to 10,000 nodes that
# are not there, by simulate_farm, into DIR/scaling.csv and, drawn, DIR/scaling.png (docs/scaling.md).
# Needs gnuplot, and some minutes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
out=$1 simulate=${2:-build/release/bench/simulate_farm}
mkdir -p "$out"

farms() { # SHARDS PATCHES NODES...
  local shards=$1 patches=$2 nodes
  shift 2
  for nodes in "$@"; do
    echo "$shards,$("$simulate" "$nodes" "$patches" rays_per_patch=10000 shards="$shards")"
  done
}
{
  echo "shards,$("$simulate" --header)"
  for patches in 1e5 1e6 1e7 1e8; do
    farms 0 "$patches" 1 2 4 8 16 32 64 128 256
    for shards in 8 64; do
      farms "$shards" "$patches" 1 2 4 8 16 32 64 128 256
      if [[ $patches != 1e8 ]]; then farms "$shards" "$patches" 1024 4096 10000; fi
    done
  done
} >"$out/scaling.csv"

gnuplot -e "out='$out'" - <<'GNUPLOT'
set datafile separator ','
set terminal pngcairo size 900,600 font 'sans,11'
set output out.'/scaling.png'
set logscale xy
set xlabel 'nodes of 16 cores'
set ylabel 'speed, in nodes without any loss'
set key left top
set grid
set yrange [0.3:200]
set xrange [1:10000]
curve(patches, shards) = sprintf("< awk -F, '$1 == %d && $3 == %d' %s/scaling.csv", shards, patches, out)
plot x with lines dashtype 3 lc 'gray' title 'no loss', \
  for [i=5:8] curve(10**i, 0) using 2:($2*$9) with linespoints lc i-4 title sprintf('1e%d patches', i), \
  for [i=5:8] curve(10**i, 8) using 2:($2*$9) with lines dashtype 2 lc i-4 \
    title (i == 5 ? '8 merge shards' : ''), \
  for [i=5:8] curve(10**i, 64) using 2:($2*$9) with lines dashtype 4 lc i-4 \
    title (i == 5 ? '64 merge shards' : '')
GNUPLOT
