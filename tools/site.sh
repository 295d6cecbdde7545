#!/usr/bin/env bash
# Renders the documentation as a site in FOLDER (default: build/site) that can be
# read and searched from files, without a server and without the network:
#   tools/site.sh [FOLDER], then open FOLDER/index.html
# Fails where a link or an anchor leads nowhere, and where a page would load
# something from the network. Needs PyPI once, for build/site-venv; exit code 75
# where it cannot be had.
set -euo pipefail
folder=$(realpath -m "${1:-$(dirname "$0")/../build/site}")
cd "$(dirname "$0")/.."

environment=$PWD/build/site-venv pages=$PWD/build/site-pages
if ! cmp -s tools/site/requirements.txt "$environment/installed.txt"; then
  python3 -m venv --clear "$environment"
  "$environment/bin/pip" install --quiet --disable-pip-version-check \
    --requirement tools/site/requirements.txt || exit 75
  cp tools/site/requirements.txt "$environment/installed.txt"
fi

# The pages lie as in the repository, so that their links hold as they are.
rm -rf "$pages"
mkdir -p "$pages"
find README.md CHANGELOG.md CONTRIBUTING.md SECURITY.md LICENSE docs data tests \
  -type f \( -name '*.md' -o -name LICENSE -o -path 'docs/*.svg' \
  -o -path 'docs/*.png' \) -exec cp --parents {} "$pages" \;

# --strict: warnings, as of links that lead nowhere, are errors. Not --quiet, with
# which mkdocs does not count them.
if ! said=$(NO_MKDOCS_2_WARNING=1 "$environment/bin/mkdocs" build --strict \
    --config-file tools/site/mkdocs.yml --site-dir "$folder" 2>&1); then
  echo "$said" >&2
  exit 1
fi
python3 tools/site/check_offline.py "$folder"
echo "$folder/index.html"
