#!/usr/bin/env bash
# fetch.sh DIR: a Python environment in DIR with the packages of
# requirements.txt, from PyPI (1 GB). Does nothing where it is there.
set -euo pipefail
wanted=$(dirname "$(realpath "$0")")/requirements.txt
if ! cmp -s "$wanted" "$1/requirements.txt"; then
  python3 -m venv "$1"
  "$1/bin/pip" install --quiet --disable-pip-version-check -r "$wanted"
  cp "$wanted" "$1/requirements.txt"
fi
