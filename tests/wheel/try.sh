#!/usr/bin/env bash
# Makes wheels and the Debian package of build/, and tries them on bare Debian 12
# and 13 (bare_systems.py), which are kept in build/bare_systems/. As root, with
# a network and debootstrap.
set -euo pipefail
cd "$(dirname "$0")/../.."

if [[ $(id -u) -ne 0 ]] || ! command -v debootstrap >/dev/null; then
  echo "try.sh: needs root and debootstrap (tools/setup.sh --full)" >&2
  exit 1
fi
ARMCAL_BUILD=build tools/wheel.sh
rm -rf build/packages
cpack --config build/CPackConfig.cmake -G DEB -B build/packages \
  -D CPACK_COMPONENTS_ALL=runtime
python3 -B tests/wheel/bare_systems.py --armcal=build/armcal \
  --wheels=build/wheels --deb="$(ls build/packages/armcal_*.deb)" \
  --systems=build/bare_systems
