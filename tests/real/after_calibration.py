#!/usr/bin/env python3
"""What a calibrated UR10e still lacks on other logs: figures of docs/diagnose.md.

  python3 tests/real/after_calibration.py --armcal=build/armcal [--results=FILE]

Calibrates on one log and diagnoses three others, by the robot file and by the calibrated
robot. Prints the gap of both in the noise's mean square and what is named (above 50 %).
Some minutes; decides nothing.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import result_files  # noqa: E402
from reading import claims  # noqa: E402
from residuals import UR10E, read_flags  # noqa: E402

TRAINING, OTHERS = "id_20s", ("id_30s", "id_40s", "id_50s")


def run(armcal, command, out, *flags):
    subprocess.run([armcal, command, UR10E[0], "--quiet", f"--out={out}", *flags],
                   capture_output=True, check=False)


def main():
    flags = read_flags(__doc__)
    armcal, folder = Path(flags.armcal).resolve(), flags.data / "ur10e_free"
    robot = f"--robot={folder}/robot.urdf"
    values = {"before": [], "after": [], "named": 0, "probabilities": []}
    with tempfile.TemporaryDirectory() as work:
        run(armcal, "calibrate", f"{work}/calibrated", robot, f"--log={folder}/{TRAINING}.csv")
        for log in OTHERS:
            for kind, more in (("before", ()),
                               ("after", (f"--calibration={work}/calibrated",))):
                out = f"{work}/{log}_{kind}"
                run(armcal, "diagnose", out, robot, f"--log={folder}/{log}.csv",
                    "--forward=false", *more)
                found = json.loads(Path(out, "diagnosis.json").read_text(encoding="utf-8"))
                values[kind].append(found["gap"]["torque"]["nominal"])
                named = claims(found, .5)
                if kind == "after":
                    values["named"] += bool(named)
                    values["probabilities"] += [100 * e["probability"] for e in named]
                print(f"{log} {kind}: {values[kind][-1]:.1f} times the noise, "
                      f"{found['verdict']}", *(f"{e['effect']}@{e['joint_index']} "
                      f"{e['probability']:.2f}" for e in named), flush=True)
    if flags.results:
        result_files.write(flags.results, "real UR10e, calibrated on one log: gap of three "
                           "others in the noise's mean square by the file and by the calibrated "
                           "robot; of how many of them an effect is named, and how likely, %", values)
    return 0


if __name__ == "__main__":
    sys.exit(main())
