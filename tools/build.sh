# Sourced by demo.sh and test.sh. build FOLDER TARGET [CMAKE_OPTION..] configures
# and builds, and says how far it is: on a terminal in a line that is written
# over, elsewhere in a line for each tenth. What compilers say is shown where
# they fail.

# What a fresh build in folder $1 is configured with. Clang 14 takes five sixths
# of the time of GCC 12 (docs/speed.md), and its programs are as fast; CXX says
# otherwise, as does a folder that is configured already. GCC is faster by a
# tenth without garbage collection, where there is memory: its compiler of
# several sources has up to 1.5 GB then.
fast_options() {
  local kib
  if [[ -e $1/CMakeCache.txt ]]; then return; fi
  if [[ -z ${CXX:-} ]] && command -v clang++ >/dev/null; then
    echo "-DCMAKE_CXX_COMPILER=clang++"
    return
  fi
  kib=$(awk '/^MemAvailable/ {print $2}' /proc/meminfo)
  if ((kib / $(nproc) > 2500000)); then
    echo "-DCMAKE_CXX_FLAGS=--param=ggc-min-heapsize=1000000"
  fi
}

# ninja's lines on standard input.
show_progress() {
  local line tenth=-1
  while IFS= read -r line; do
    echo "$line" >>"$1"
    [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]] || continue
    if [[ -t 1 ]]; then
      printf '\rbuilding armcal: %s of %s ' "${BASH_REMATCH[@]:1}"
    elif ((10 * BASH_REMATCH[1] / BASH_REMATCH[2] > tenth)); then
      tenth=$((10 * BASH_REMATCH[1] / BASH_REMATCH[2]))
      printf 'building armcal: %s of %s\n' "${BASH_REMATCH[@]:1}"
    fi
  done
  if [[ -t 1 ]]; then printf '\r\033[K'; fi
}

build() {
  local folder=$1 target=$2 log=$1.log
  mapfile -t fast < <(fast_options "$folder")
  if ! cmake -S . -B "$folder" -G Ninja "${fast[@]}" "${@:3}" >"$log" 2>&1 ||
     ! cmake --build "$folder" -j "$(nproc)" --target "$target" 2>&1 |
       show_progress "$log"; then
    cat "$log" >&2
    return 1
  fi
  rm "$log"
}
