#!/usr/bin/env bash
# Installs the Debian 12 packages that armcal needs. Does nothing, and needs no
# rights, where all of them are there.
#   --full   those of tools/test.sh --full too: clang's sanitizers, clang-tidy,
#            llvm-cov, debootstrap
set -euo pipefail

packages=(
  clang g++ cmake ninja-build python3 dpkg-dev file groff-base locales
  libeigen3-dev libgflags-dev libgoogle-glog-dev libtinyxml2-dev libyaml-cpp-dev
  nlohmann-json3-dev zlib1g-dev libsqlite3-dev libzstd-dev liblz4-dev
  libmatio-dev libceres-dev libsimbody-dev libtbb-dev libboost-dev
  libssl-dev libcpp-httplib-dev libjs-dygraphs libgtest-dev libgmock-dev libmujoco-dev
  pybind11-dev python3-dev python3-numpy python3-pip python3-distributed
  python3-setuptools python3-venv python3-wheel
)
for argument in "$@"; do
  case $argument in
    --full) packages+=(clang-tidy debootstrap libclang-rt-14-dev lld llvm) ;;
    *) echo "setup.sh: unknown argument $argument; expected --full" >&2; exit 2 ;;
  esac
done

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $status == installed ]] || missing+=("$package")
done
if [[ ${#missing[@]} -eq 0 ]]; then
  exit 0
fi

as_root=()
if [[ $(id -u) -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "setup.sh: these packages are missing: ${missing[*]}" >&2
    echo "setup.sh: installing them needs root or sudo; as root, run:" >&2
    echo "  apt-get update && apt-get install ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

echo "installing ${missing[*]}"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
apt() { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq "$@"; }
# An install may work where an update does not (a mirror that is down), so only
# the install decides.
if ! { apt update; apt install -y --no-install-recommends "${missing[@]}"; } \
    >"$log" 2>&1 </dev/null; then
  cat "$log" >&2
  echo "setup.sh: apt-get could not install ${missing[*]}" >&2
  exit 1
fi
