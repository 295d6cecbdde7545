#!/usr/bin/env bash
# Installs what is missing, builds armcal and shows it at work on a robot and
# logs that come with it.
set -euo pipefail
cd "$(dirname "$0")/.."

tools/setup.sh
source tools/build.sh
build build armcal

say() { printf '\n\033[1m%s\033[0m\n' "$*" | fold -s -w 80; }
run() { echo "\$ $*"; echo; "$@"; }
if [[ ! -t 1 ]]; then say() { printf '\n%s\n' "$*" | fold -s -w 80; }; fi

say "1. A SCARA arm whose two link lengths nobody told us. From one log of joint \
positions and torques armcal finds the six numbers that fix its dynamics, and \
checks them on another motion, which it has not seen. The log was generated \
with 17.55 7.55 2.343 0.176 3.11 0.35, without noise."
run build/armcal calibrate --robot=data/scara/robot.yaml \
  --log=data/scara/B.csv.gz --validate=data/scara/A.csv.gz \
  --geometry=lengths --joint_terms=none --bandwidth=0 --out=armcal-out/scara

say "2. The same arm from three intervals of a motion that looks the same forwards \
and backwards in time. Joint by joint this cannot work, and armcal says what it \
cannot see instead of printing a wrong number:"
run build/armcal calibrate --robot=data/scara/robot.yaml \
  --log=data/scara/A.csv.gz --geometry=lengths --joint_terms=none \
  --bandwidth=0 --identification=integral --solver=recursive \
  --intervals=1:1.5,1.5:2,2.5:3 || [[ $? -eq 1 ]]

say "3. Two logs of that arm, simulated with numbers 2 % off its file; before the \
second one the elbow's friction has changed. Diagnosing the second against the \
first tells which effect it is, on which joint, and how far it closes the gap:"
for run in 1 2; do
  effect=()
  if [[ $run -eq 2 ]]; then effect=(--effects=stribeck@2); fi
  build/armcal simulate --robot=data/scara/robot.yaml --duration=40 \
    --robot_error=0.02 --run=$run "${effect[@]}" \
    --out=armcal-out/log$run --truth=armcal-out/secret$run >/dev/null
done
run build/armcal diagnose --robot=data/scara/robot.yaml \
  --log=armcal-out/log2/log.csv --reference=armcal-out/log1/log.csv \
  --out=armcal-out/diagnosis

say "The result of 1 is in $PWD/armcal-out/scara: calibration.json for programs \
(docs/calibrate.md explains every key) and covariance.csv, how the errors of the \
numbers hang together; report.html there and in armcal-out/diagnosis is to be looked at \
in a browser. What 3 was to find is in armcal-out/secret2/truth.json, what it \
found in armcal-out/diagnosis (docs/diagnose.md)."
