#!/usr/bin/env bash
# Measures how fast armcal is, as ratios (tests/speed/goals.py), and says which
# goals are reached.
#   --json FILE    the same for programs
#   --quick        fewer repetitions
#   --filter RE    only benchmarks whose names match
#   --peers        beside other engines (tests/peers), fetched from PyPI
#   --growth       growth with samples and joints: minutes, 4 GB of /tmp
#   --build DIR    where to build, default build-bench
set -euo pipefail
from=$PWD
cd "$(dirname "$0")/.."

json= build=$PWD/build-bench filter=. peers=false growth=false repetitions=11 time=.02
while [[ $# -gt 0 ]]; do
  case $1 in
    --json|--filter|--build)
      [[ $# -gt 1 ]] || { echo "bench.sh: $1 needs a value" >&2; exit 2; }
      case $1 in
        --json) json=$(cd "$from" && realpath -m "$2") ;;
        --build) build=$(cd "$from" && realpath -m "$2") ;;
        --filter) filter=$2 ;;
      esac
      shift ;;
    --quick) repetitions=3 time=.005 ;;
    --peers) peers=true ;;
    --growth) growth=true ;;
    *) echo "bench.sh: unknown argument $1; see the head of $0" >&2; exit 2 ;;
  esac
  shift
done

tools/setup.sh
if ! dpkg-query -W libbenchmark-dev >/dev/null 2>&1; then
  echo "bench.sh: needs Google Benchmark: apt-get install libbenchmark-dev" >&2
  exit 1
fi
options=(-G Ninja -DBENCHMARKS=ON -DPEERS=)
if command -v ccache >/dev/null; then
  options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
fi
if $peers; then
  venv=${PEERS:-$build/peers}
  tests/peers/fetch.sh "$venv"
  options+=(-DPEERS="$venv")
fi
mkdir -p "$build"
if ! { cmake -S . -B "$build" "${options[@]}" &&
       cmake --build "$build" -j "$(nproc)" --target benchmarks armcal \
         write_growth_log
     } >"$build/bench.log" 2>&1; then
  tail -50 "$build/bench.log" >&2
  exit 1
fi

results=("$build/benchmarks.json")
# In random turns, so that what else the machine does meets both parts of a
# ratio alike.
"$build/tests/benchmarks" --benchmark_filter="$filter" \
  --benchmark_repetitions=$repetitions --benchmark_min_time=$time \
  --benchmark_enable_random_interleaving=true \
  --benchmark_out="${results[0]}" --benchmark_out_format=json \
  --benchmark_display_aggregates_only=true >"$build/benchmarks.txt"
tests/speed/diagnosis.py "$build/armcal" "$build/diagnosis.json" >&2
results+=("$build/diagnosis.json")
if $peers; then
  robot=../shared/data/ur10e_free/robot.urdf
  [[ -f $robot ]] || robot=data/six_axis/robot.urdf
  tests/peers/run.py "$venv/bin/python" "$build/armcal" "$robot" \
    "$build/peers.json" >&2
  results+=("$build/peers.json")
fi
if $growth; then
  python3 tests/speed/growth.py --armcal "$build/armcal" \
    --write "$build/tests/write_growth_log" \
    --benchmarks "$build/tests/benchmarks" --out "$build/growth" >&2
  results+=("$build/growth/growth.json")
fi
python3 tests/speed/goals.py ${json:+--json "$json"} "${results[@]}"
