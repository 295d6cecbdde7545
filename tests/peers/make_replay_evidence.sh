#!/usr/bin/env bash
# make_replay_evidence.sh ARMCAL OUT [PYTHON]
# Simulated arms, 3 % off their file, with one effect hidden in each and three
# seeds: diagnosed on logs 1 and 2, calibrated on 1, replayed in MuJoCo on 3.
# Prints a line of JSON per case: effect, seed, replay_in_mujoco.py's figures.
set -euo pipefail
armcal=$(realpath "$1")
out=$2
python=${3:-python3}
here=$(dirname "$(realpath "$0")")
robot=$here/arm.yaml

"$armcal" inspect --robot="$robot" --export=mjcf --out="$out/original" >/dev/null
for seed in 1 2 3; do
  for effect in payload:mass=2kg spring@2 armature@2 stribeck@2 elasticity@2; do
    name=${effect%%[:@]*}
    case=$out/${name}_$seed
    for run in 1 2 3; do
      "$armcal" simulate --robot="$robot" --duration=30 --robot_error=0.03 \
        --seed=$seed --run=$run --effects="$effect" --out="$case/log$run" \
        --truth="$case/truth$run" >"$case.txt"
    done
    "$armcal" diagnose --robot="$robot" --log="$case/log1/log.csv" \
      --validate="$case/log2/log.csv" --forward=false --export=mjcf_plain \
      --out="$case/diagnosed" >>"$case.txt" 2>/dev/null
    "$armcal" calibrate --robot="$robot" --log="$case/log1/log.csv" \
      --export=mjcf --out="$case/calibrated" >>"$case.txt" 2>/dev/null
    echo "$name $seed $("$python" "$here/replay_in_mujoco.py" \
      --original="$out/original/robot.xml" \
      --corrected="$case/diagnosed/robot_plain.xml" \
      --refitted="$case/calibrated/robot.xml" \
      --train="$case/log1/log.csv" --held_out="$case/log3/log.csv")"
  done
done
