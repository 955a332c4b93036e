#!/usr/bin/env bash
# bench/scaling.sh DIR [SIMULATE_FARM]: passes of 10,000 rays a patch on farms of 1 to 256 nodes that
# are not there, by simulate_farm, into DIR/scaling.csv and, drawn, DIR/scaling.png (docs/scaling.md).
# Needs gnuplot, and a quarter of an hour.
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
  farms 0 1e5 1 2 4 8 16 32 64 128 256
  for patches in 1e6 1e7 1e8; do
    farms 0 "$patches" 1 2 4 8 16 32 64 128 256
    farms 8 "$patches" 8 16 32 64 128 256
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
set yrange [0.5:100]
curve(patches, shards) = sprintf("< awk -F, '$1 == %d && $3 == %d' %s/scaling.csv", shards, patches, out)
plot x with lines dashtype 3 lc 'gray' title 'no loss', \
  curve(1e5, 0) using 2:($2*$9) with linespoints lc 1 title '1e5 patches', \
  curve(1e6, 0) using 2:($2*$9) with linespoints lc 2 title '1e6', \
  curve(1e7, 0) using 2:($2*$9) with linespoints lc 3 title '1e7', \
  curve(1e8, 0) using 2:($2*$9) with linespoints lc 4 title '1e8', \
  curve(1e6, 8) using 2:($2*$9) with lines dashtype 2 lc 2 title '8 merge shards', \
  curve(1e7, 8) using 2:($2*$9) with lines dashtype 2 lc 3 notitle, \
  curve(1e8, 8) using 2:($2*$9) with lines dashtype 2 lc 4 notitle
GNUPLOT
