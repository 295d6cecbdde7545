#!/usr/bin/env bash
# Installs from PyPI, into the folder $1, what armcal.convert reads bags of ROS
# 1 and Parquet files with, for its tests; does nothing where it is there. The
# versions are those that run with Debian 12's NumPy, which is not replaced. The
# NumPy that pip gives people today goes into $1/numpy-2, beside it.
set -euo pipefail

folder=$1
packages=(
  pyarrow==17.0.0
  rosbags==0.10.11 lz4==4.4.5 ruamel.yaml==0.18.6 typing_extensions==4.12.2
  zstandard==0.23.0
)
numpy=numpy==2.3.5
done=$folder/installed.txt
if [[ -f $done && $(cat "$done") == "${packages[*]} $numpy" ]]; then exit 0; fi
install() {
  /usr/bin/python3 -m pip install --quiet --disable-pip-version-check \
    --no-deps --upgrade --target "$@"
}
install "$folder" "${packages[@]}"
install "$folder/numpy-2" "$numpy"
echo "${packages[*]} $numpy" >"$done"
