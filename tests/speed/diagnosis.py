#!/usr/bin/env python3
"""diagnosis.py ARMCAL OUT.json: how long a whole diagnosis takes.

`armcal simulate` writes 60 s of the six-axis arm of data/ at 250 Hz, with
effects hidden in it or none; where the shared data are there, a log each of the
UR10e (50 s) and of the Panda (21 s at 1 kHz) is added. `armcal diagnose` reads
the CSV and does all that it does: the screen, the threshold that chance gives on
these very data, the refinement of what was chosen and of its rivals, the
held-out parts, forward simulation, the report. Seconds of wall clock on two
cores, the median of some runs, and CPU seconds; machines with other cores pin
it to two (taskset). Python's standard library only.
"""

import json
import os
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile
import time

ROBOT = pathlib.Path(__file__).parents[2] / "data/six_axis/real.yaml"
# With nothing to be found there is no threshold to tell; elasticity and
# backlash are the dearest to refine.
CASES = {"none": None, "stribeck": "stribeck@2", "elasticity": "elasticity@2",
         "backlash": "backlash@3", "two": "stribeck@2;torque_ripple@3"}
SHARED = pathlib.Path(__file__).parents[3] / "shared/data"
REAL = {"ur10e": ("ur10e_free/robot.urdf", "ur10e_free/id_50s.csv",
                  "--torque_constants=14.87,13.26,11.13,10.62,11.03,11.47"),
        "panda": ("panda/robot.urdf", "panda/log.csv")}
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


def simulated(armcal, folder):
    """Flags of a diagnosis for each simulated kind, by its name."""
    for seed, (name, effects) in enumerate(CASES.items(), 1):
        logs = folder / name
        run([armcal, "simulate", f"--robot={ROBOT}", "--robot_error=0.02",
             "--duration=60", f"--run={seed}", f"--out={logs}",
             f"--truth={logs}.truth",
             *([f"--effects={effects}"] if effects else [])])
        yield name, [f"--robot={ROBOT}", f"--log={logs}/log.csv"]


def real():
    """The same of those real logs that are there."""
    for name, (robot, log, *flags) in REAL.items():
        if (SHARED / log).exists():
            yield name, [f"--robot={SHARED / robot}", f"--log={SHARED / log}",
                         *flags]


def cpu_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def main():
    armcal, out = sys.argv[1:]
    pin_to_two_cores()
    values, cpu = {}, {}
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for name, flags in [*simulated(armcal, folder), *real()]:
            before = cpu_seconds()
            seconds = [run([armcal, "diagnose", "--threads=2", *flags,
                            f"--out={folder}/out"], (0, 1))
                       for _ in range(REPETITIONS)]
            values[f"Diagnosis/{name}_s"] = statistics.median(seconds)
            cpu[f"Diagnosis/{name}_cpu_s"] = (cpu_seconds() - before) / REPETITIONS
            print(f"diagnosis.py: {name}: {statistics.median(seconds):.2f} s, "
                  f"{cpu[f'Diagnosis/{name}_cpu_s']:.2f} CPU s", file=sys.stderr)
    values["Diagnosis/whole_s"] = max(values.values())
    values.update(cpu)
    with open(out, "w", encoding="utf-8") as file:
        json.dump({"values": values}, file, indent=1)
        file.write("\n")


if __name__ == "__main__":
    main()
