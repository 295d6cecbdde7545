#!/usr/bin/env python3
"""diagnosis.py ARMCAL OUT.json: how long a whole diagnosis takes.

`armcal simulate` writes 60 s of the six-axis arm of data/ at 250 Hz, with
effects hidden in it or none; `armcal diagnose` reads the CSV and does all that
it does: the screen, the threshold that chance gives on these very data, the
refinement of what was chosen and of its rivals, the held-out parts, forward
simulation, the report. Seconds of wall clock on two cores, the median of some
runs; machines with other cores pin it to two (taskset). Python's standard
library only.
"""

import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

ROBOT = pathlib.Path(__file__).parents[2] / "data/six_axis/real.yaml"
# With nothing to be found there is no threshold to tell; elasticity and
# backlash are the dearest to refine.
CASES = {"none": None, "stribeck": "stribeck@2", "elasticity": "elasticity@2",
         "backlash": "backlash@3"}
REPETITIONS = 3


def pin_to_two_cores():
    cores = sorted(os.sched_getaffinity(0))[:2]
    os.sched_setaffinity(0, cores)


def run(command, allowed=(0,)):
    begin = time.monotonic()
    done = subprocess.run(list(map(str, command)), stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL, check=False)
    if done.returncode not in allowed:
        sys.exit(f"diagnosis.py: exit code {done.returncode}: "
                 f"{' '.join(map(str, command))}")
    return time.monotonic() - begin


def main():
    armcal, out = sys.argv[1:]
    pin_to_two_cores()
    values = {}
    with tempfile.TemporaryDirectory() as folder:
        for seed, (name, effect) in enumerate(CASES.items(), 1):
            logs = pathlib.Path(folder) / name
            run([armcal, "simulate", f"--robot={ROBOT}", "--robot_error=0.02",
                 "--duration=60", f"--run={seed}", f"--out={logs}",
                 f"--truth={logs}.truth",
                 *([f"--effects={effect}"] if effect else [])])
            seconds = [
                run([armcal, "diagnose", f"--robot={ROBOT}", "--threads=2",
                     f"--log={logs}/log.csv", f"--out={logs}/out"], (0, 1))
                for _ in range(REPETITIONS)]
            values[f"Diagnosis/{name}_s"] = statistics.median(seconds)
            print(f"diagnosis.py: {name}: {statistics.median(seconds):.2f} s",
                  file=sys.stderr)
    values["Diagnosis/whole_s"] = max(values.values())
    with open(out, "w", encoding="utf-8") as file:
        json.dump({"values": values}, file, indent=1)
        file.write("\n")


if __name__ == "__main__":
    main()
