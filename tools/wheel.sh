#!/usr/bin/env bash
# Makes the wheels of armcal in build/wheels/. Each holds the program, the Python
# module and the libraries that both need, so that pip installs all there is:
# for the Python of this machine (Debian 12's 3.11), for that of Debian 13 and
# for those named, and one of the program alone for any other Python.
#   tools/wheel.sh [PYTHON..]   interpreters that have their headers
# ARMCAL_BUILD is the folder of the build (build/), which is used if it is there.
# Takes headers of Debian 13's Python from Debian and tools from PyPI.
set -euo pipefail
cd "$(dirname "$0")/.."
source tools/build.sh

build=$(realpath -m "${ARMCAL_BUILD:-build}")
work=$PWD/build/wheel
wheels=$PWD/build/wheels
mkdir -p "$work"

# Prints the folder of the headers of Debian 13's Python. They are taken out of
# their package; nothing is installed.
debian_headers() {
  local root=$work/trixie version=3.13
  if [[ ! -e $root/usr/include/python$version/Python.h ]]; then
    mkdir -p "$root/lists/partial" "$root/cache/archives/partial"
    local keys=/usr/share/keyrings/debian-archive-keyring.gpg
    echo "deb [signed-by=$keys] http://deb.debian.org/debian trixie main" \
      >"$root/sources.list"
    local options=(-qq -o Dir::State::Lists="$root/lists"
      -o Dir::Cache="$root/cache" -o Dir::Etc::SourceList="$root/sources.list"
      -o Dir::Etc::SourceParts=/dev/null)
    apt-get "${options[@]}" update >&2
    (cd "$root" && apt-get "${options[@]}" download "libpython$version-dev" >&2)
    dpkg-deb --fsys-tarfile "$root/libpython$version-dev"*.deb |
      tar -x -C "$root" ./usr/include
  fi
  echo "$root/usr/include/python$version"
}

/usr/bin/python3 -m venv "$work/tools"
"$work/tools/bin/pip" install --quiet --disable-pip-version-check \
  -r tools/wheel/requirements.txt
PATH=$work/tools/bin:$PATH

headers=$(debian_headers)
for python in /usr/bin/python3 "$@"; do
  headers+=";$("$python" -c 'import sysconfig
print(sysconfig.get_path("include"))')"
done
rm -f "$build"/python/_armcal.*.so
for target in armcal python_modules; do
  build "$build" $target -DPYTHON=ON -DOTHER_PYTHONS="$headers" \
    -DOTHER_PYBIND11="$(python -c 'import pybind11
print(pybind11.get_include())')"
done

# One wheel with the modules of all Pythons becomes one for each.
rm -rf "$work/plain" "$build/wheel_files"
ARMCAL_BUILD=$build pip wheel --quiet --no-deps --no-build-isolation \
  --disable-pip-version-check --wheel-dir "$work/plain" .
python -B tools/wheel/wheels.py --plain="$work/plain" \
  --modules="$build/python" --work="$work" --out="$wheels"
ls -sh1 "$wheels"
