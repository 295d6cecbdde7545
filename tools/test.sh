#!/usr/bin/env bash
# Installs what is missing, builds armcal in build/ and runs its tests.
#   --full   more, for hours: clang-tidy (tools/tidy.sh), the long tests, all
#            others as GCC builds them (in build-gcc/) and under the address and
#            undefined-behaviour sanitizers (in build-instrumented/), the lines
#            they cover (tools/coverage.py), damaged files for every reader
#            (tools/fuzz.sh), the documentation as a site (tools/site.sh), and as
#            root packages on bare systems (tests/wheel/try.sh)
set -euo pipefail
cd "$(dirname "$0")/.."

full=false
for argument in "$@"; do
  case $argument in
    --full) full=true ;;
    *) echo "test.sh: unknown argument $argument; expected --full" >&2; exit 2 ;;
  esac
done

source tools/build.sh
cores=$(nproc)
mapfile -t options < <(fast_options build)
options+=(-G Ninja -DBUILD_TESTING=ON)
if command -v ccache >/dev/null; then
  options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  # Else it finds nothing again of what has a precompiled header.
  export CCACHE_SLOPPINESS=pch_defines,time_macros
fi
# What only tests of the Python package need, in build/python-extras; where PyPI
# cannot be reached these tests skip.
install_extras() {
  tools/python_extras.sh build/python-extras ||
    echo "test.sh: nothing from PyPI; conversions of ROS 1 and Parquet are not tested"
}
# The documentation as a site, whose broken links are errors. Exit code 75: PyPI
# cannot be reached.
build_site() {
  local code=0
  tools/site.sh || code=$?
  if [[ $code -eq 75 ]]; then
    echo "test.sh: nothing from PyPI; the site of the documentation is not built"
  elif [[ $code -ne 0 ]]; then
    return "$code"
  fi
}
# Configures, builds and tests in folder $1 with the CMake options that follow.
run_tests() {
  local folder=$1
  cmake -S . -B "$folder" "${options[@]}" "${@:2}"
  cmake --build "$folder" -j "$cores"
  # Without this ctest succeeds where it finds nothing to run.
  ctest --test-dir "$folder" --output-on-failure --no-tests=error -j "$cores" \
    "${selection[@]}"
}

# One build by clang for sanitizers, coverage, clang-tidy and fuzzing. Without
# the Python module, which would need an interpreter with the sanitizers in it;
# the commands that it calls are tested as programs.
run_instrumented() {
  local folder=$PWD/build-instrumented
  options=(--preset instrumented) selection=()
  if command -v ccache >/dev/null; then
    options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  fi
  rm -rf "$folder/profiles"
  # Ceres' and Simbody's static data are not freed at the end.
  ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1 \
    LLVM_PROFILE_FILE=$folder/profiles/%4m.profraw run_tests "$folder"
  tools/coverage.py "$folder"
  tools/fuzz.sh --build "$folder"
}

if $full; then
  tools/setup.sh --full
  install_extras
  build_site
  tools/tidy.sh
  selection=()
  run_tests build -DPYTHON=ON -DLONG_TESTS=ON
  if [[ $(id -u) -eq 0 ]]; then
    tests/wheel/try.sh
  else
    echo "test.sh: tests/wheel/try.sh needs root; it was not run"
  fi
  selection=(-LE long)
  run_tests build-gcc -DPYTHON=ON -DCMAKE_CXX_COMPILER=g++
  run_instrumented
else
  tools/setup.sh
  install_extras
  selection=(-LE long)
  run_tests build -DPYTHON=ON
fi
# ctest counts a test that skips all its cases as passed.
if [[ ! -d ../shared ]]; then
  echo "test.sh: there is no ../shared (gold numbers, logs of real robots);" \
    "tests that need it were skipped"
fi
