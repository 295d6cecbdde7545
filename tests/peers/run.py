#!/usr/bin/env python3
"""run.py PYTHON ARMCAL URDF OUT.json: command lines and scripts on one log.

A log of 1e5 rows and a held-out one of 2e4, made by Pinocchio, calibrated by
`armcal calibrate`, FIGAROH and SciPy, each in a process of its own: seconds of
CPU of the whole process, peak memory, held-out residual relative to the torque.
One finite-difference Jacobian of MuJoCo's sysid beside. Python's standard
library only; PYTHON is that of fetch.sh's environment.
"""

import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from limited_process import wait_for  # noqa: E402

ROWS, HELD_OUT_ROWS = 100_000, 20_000
HERE = pathlib.Path(__file__).resolve().parent


def run(command, folder, repetitions=1):
    """Its output, the least CPU seconds of some runs, peak memory in MB."""
    best, peak = math.inf, 0
    # Numerical libraries' threads would only add CPU time.
    environment = dict(os.environ, OMP_NUM_THREADS="1",
                       OPENBLAS_NUM_THREADS="1")
    for _ in range(repetitions):
        path = pathlib.Path(folder) / "output"
        with open(path, "w", encoding="utf-8") as output:
            child = subprocess.Popen(command, stdout=output, env=environment)
            seconds, memory = wait_for(child)
        if child.returncode not in (0, 1):
            sys.exit(f"run.py: exit code {child.returncode}: "
                     f"{' '.join(map(str, command))}")
        best = min(best, seconds)
        peak = max(peak, memory / 2**20)
    return path.read_text(encoding="utf-8"), best, peak


def without_meshes(urdf, out):
    """The robot alone: FIGAROH loads shapes, and a published file may name
    meshes that are not here."""
    tree = xml.etree.ElementTree.parse(urdf)
    for link in tree.getroot().findall("link"):
        for shape in link.findall("visual") + link.findall("collision"):
            link.remove(shape)
    tree.write(out)
    return out


def root_sum(values):
    return math.sqrt(sum(v * v for v in values))


def armcal_calibration(armcal, urdf, logs, folder):
    """`armcal calibrate` on data taken as they are, as the others take them, to
    base parameters and their standard deviations; and as it is by default, on
    smoothed motion and weak-form rows."""
    command = [armcal, "calibrate", f"--robot={urdf}", f"--log={logs[0]}",
               "--estimate=linear", "--threads=1"]
    as_they_are = ["--identification=differential", "--bandwidth=0"]
    _, seconds, peak = run(command + as_they_are + ["--quiet"], folder,
                           repetitions=3)
    _, default_seconds, _ = run(command + ["--quiet"], folder, repetitions=5)
    output, _, _ = run(
        command + as_they_are + [f"--validate={logs[1]}", "--json"], folder)
    joints = json.loads(output)["joints"]
    # validation_residual_percent is relative to each joint's own torque.
    residual = [j["validation_residual_rms"] for j in joints]
    torque = [100 * j["validation_residual_rms"] /
              j["validation_residual_percent"] for j in joints]
    return {"Command/calibrate_s": seconds, "Command/peak_mb": peak,
            "Command/default_s": default_seconds,
            "Command/held_out": root_sum(residual) / root_sum(torque)}


def main():
    python, armcal, urdf, out = sys.argv[1:]
    values = {}
    with tempfile.TemporaryDirectory() as folder:
        urdf = without_meshes(urdf, os.path.join(folder, "robot.urdf"))
        logs = [os.path.join(folder, name) for name in ("log.csv", "held.csv")]
        for seed, (rows, log) in enumerate(zip((ROWS, HELD_OUT_ROWS), logs)):
            run([python, HERE / "write_log.py", urdf, str(rows), str(seed), log],
                folder)
        values.update(armcal_calibration(armcal, urdf, logs, folder))
        for name in "figaroh", "scipy":
            output, seconds, peak = run(
                [python, HERE / f"{name}_calibration.py", urdf, *logs], folder)
            values.update(json.loads(output.splitlines()[-1])["values"])
            values[f"{name.capitalize()}/process_s"] = seconds
            values[f"{name.capitalize()}/peak_mb"] = peak
        output, _, peak = run([python, HERE / "mujoco_sysid.py", urdf], folder)
        values.update(json.loads(output.splitlines()[-1])["values"])
        values["Sysid/peak_mb"] = peak
    with open(out, "w", encoding="utf-8") as file:
        json.dump({"values": values}, file, indent=1)
        file.write("\n")


if __name__ == "__main__":
    main()
