#!/usr/bin/env bash
# Feeds damaged files to every reader under the address and undefined-behaviour
# sanitizers (libFuzzer), and says how many were read and what was found.
#   --seconds N    for each reader, CPU time; default 60
#   --target NAME  only this reader (tests/fuzz/fuzzed_readers.cc); repeatable
#   --build DIR    where to build, default build-instrumented (CMake's
#                  preset of that name); what was found and the
#                  inputs that reach new code stay there
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=60 build=$PWD/build-instrumented targets=()
while [[ $# -gt 0 ]]; do
  case $1 in
    --seconds|--target|--build)
      [[ $# -gt 1 ]] || { echo "fuzz.sh: $1 needs a value" >&2; exit 2; }
      case $1 in
        --seconds) seconds=$2 ;;
        --target) targets+=("$2") ;;
        --build) build=$(realpath -m "$2") ;;
      esac
      shift ;;
    *) echo "fuzz.sh: unknown argument $1; see the head of $0" >&2; exit 2 ;;
  esac
  shift
done

tools/setup.sh --full
options=(--preset instrumented)
if command -v ccache >/dev/null; then
  options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
fi
mkdir -p "$build"
if ! { cmake -S . -B "$build" "${options[@]}" &&
       cmake --build "$build" -j "$(nproc)" --target fuzz_targets armcal
     } >"$build/build.log" 2>&1; then
  tail -50 "$build/build.log" >&2
  exit 1
fi
# Lines that only damaged files reach are not covered by tests.
export LLVM_PROFILE_FILE=/dev/null
export LSAN_OPTIONS=suppressions=$PWD/tests/fuzz/leaks.txt:print_suppressions=0
python3 tests/fuzz/make_seeds.py "$build/armcal" data "$build/seeds"
if [[ ${#targets[@]} -eq 0 ]]; then
  for target in "$build"/tests/fuzz/*_fuzz; do
    target=${target##*/}
    targets+=("${target%_fuzz}")
  done
fi

found=0
printf '%-12s %12s %10s %8s\n' reader inputs kept found
for target in "${targets[@]}"; do
  corpus=$build/corpus/$target crashes=$build/found/$target log=$build/$target.log
  mkdir -p "$corpus" "$crashes"
  earlier=$build/tests/damaged_files/$target
  FUZZ_CPU_SECONDS=$seconds \
    "$build/tests/fuzz/${target}_fuzz" -timeout=20 -rss_limit_mb=2560 -max_len=65536 \
    -print_final_stats=1 -artifact_prefix="$crashes/" "$corpus" \
    "$build/seeds/$target" $([[ -d $earlier ]] && echo "$earlier") \
    >"$log" 2>&1 || true
  files=("$crashes"/*)
  [[ -e ${files[0]} ]] && here=${#files[@]} || here=0
  found=$((found + here))
  printf '%-12s %12s %10s %8s\n' "$target" \
    "$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")" \
    "$(find "$corpus" -type f | wc -l)" "$here"
done
if [[ $found -gt 0 ]]; then
  echo "fuzz.sh: $found inputs that readers do not stand: $build/found/" >&2
  exit 1
fi
