#!/bin/sh
# Cases a second by one process and by two at once, each drawing what bench/strip_bench.cpp calls a whole case; on an idle
# machine with two cores or more. Usage: bench/strip_processes.sh BUILD_FOLDER [SECONDS]
set -eu
bench=$1/bench/contort_strip_bench
seconds=${2:-10}

# One process; prints cases a second of wall time. Each has a folder of its own to write to.
run() {
  mkdir -p "$TMP/$1"
  TMPDIR=$TMP/$1 "$bench" --benchmark_filter='^whole_case/real_time$' --benchmark_min_time="$seconds" \
    --benchmark_format=csv 2>/dev/null | awk -F, '/^"whole_case/ { print 1000 / $3 }' >"$TMP/$1/rate"
}

TMP=$(mktemp -d)
trap 'rm -rf "$TMP"' EXIT
run one
run first & run second
wait
cat "$TMP/one/rate" "$TMP/first/rate" "$TMP/second/rate" |
  awk '{ rate[NR] = $1 }
       END { printf "one process: %.1f cases/s; two: %.1f cases/s, %.2f times as many\n",
             rate[1], rate[2] + rate[3], (rate[2] + rate[3]) / rate[1] }'
