#!/usr/bin/env bash
# Installs what is missing, builds armcal in build/ and runs its tests.
#   --full   the long tests too, and all tests under the address and
#            undefined-behaviour sanitizers (in build-sanitize/)
set -euo pipefail
cd "$(dirname "$0")/.."

full=false
for argument in "$@"; do
  case $argument in
    --full) full=true ;;
    *) echo "test.sh: unknown argument $argument; expected --full" >&2; exit 2 ;;
  esac
done

cores=$(nproc)
options=(-G Ninja -DBUILD_TESTING=ON)
if command -v ccache >/dev/null; then
  options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
else
  options+=(-DPRECOMPILE=ON)
fi
# Configures, builds and tests in folder $1 with the CMake options that follow.
run_tests() {
  local folder=$1
  cmake -S . -B "$folder" "${options[@]}" "${@:2}"
  cmake --build "$folder" -j "$cores"
  # Without this ctest succeeds where it finds nothing to run.
  ctest --test-dir "$folder" --output-on-failure --no-tests=error -j "$cores" \
    "${selection[@]}"
}

tools/setup.sh
selection=(-LE long)
if $full; then
  run_tests build-sanitize -DCMAKE_BUILD_TYPE=RelWithDebInfo -DLONG_TESTS=ON \
    -DCMAKE_CXX_FLAGS="-fsanitize=address,undefined -fno-sanitize-recover=all"
  selection=()
  run_tests build -DPYTHON=ON -DLONG_TESTS=ON
else
  run_tests build -DPYTHON=ON
fi
# ctest counts a test that skips all its cases as passed.
if [[ ! -d ../shared ]]; then
  echo "test.sh: there is no ../shared (gold numbers, logs of real robots);" \
    "tests that need it were skipped"
fi
