#!/usr/bin/env bash
# clang-tidy over armcal's own sources by the checks of .clang-tidy; fails on any
# finding. Some ten seconds a file on each core: name files while you work.
#   FILE...      only these sources; default all of model/ problems/ calib/ tools/
#   --build DIR  has compile_commands.json, default build-tidy, which is not built
set -euo pipefail
cd "$(dirname "$0")/.."

build=build-tidy files=()
while [[ $# -gt 0 ]]; do
  case $1 in
    --build)
      [[ $# -gt 1 ]] || { echo "tidy.sh: $1 needs a value" >&2; exit 2; }
      build=$2
      shift ;;
    *.cc) files+=("$1") ;;
    *) echo "tidy.sh: unknown argument $1; see the head of $0" >&2; exit 2 ;;
  esac
  shift
done

tools/setup.sh --full
if [[ ! -e $build/compile_commands.json ]]; then
  cmake --preset instrumented -B "$build" -DPYTHON=ON >/dev/null
fi
if [[ ${#files[@]} -eq 0 ]]; then
  mapfile -t files < <(find model problems calib tools -name '*.cc' | sort)
fi
found=0
printf '%s\0' "${files[@]}" |
  xargs -0 -n 1 -P "$(nproc)" clang-tidy -p "$build" --quiet \
    2> >(grep -v ' warnings\? generated\.$\|treated as errors\?$' >&2) || found=1
echo "tidy.sh: ${#files[@]} sources, $([[ $found -eq 0 ]] && echo clean || echo 'see above')"
exit $found
