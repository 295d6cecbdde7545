#!/usr/bin/env python3
"""How far a law of friction that is not the model's moves calibrations.

  python3 tests/blind/wrong_friction.py --armcal=build/armcal [--runs=20] [--results=FILE]

The six-axis arm of data/ is simulated, whose friction changes sign along
v / sqrt(v^2 + w^2), and calibrated, whose model has tanh(v / w). Prints the rms over joints
and logs of estimate less truth in the estimates' standard deviations, of viscous and of
Coulomb friction, and the largest. 1 is what noise alone makes.
"""

import argparse
import json
import math
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import result_files  # noqa: E402

ARM = Path(__file__).resolve().parents[2] / "data" / "six_axis"
KINDS = ("viscous", "coulomb")


def deviations(armcal, folder, run):
    """{kind: error in standard deviations of each joint} of one log."""
    out = Path(folder) / str(run)
    for flags in (["simulate", f"--robot={ARM}/real.yaml", f"--run={run}", "--duration=20",
                   f"--truth={out}/truth"],
                  ["calibrate", f"--robot={ARM}/robot.urdf", f"--log={out}/log.csv"]):
        subprocess.run([armcal, *flags, "--quiet", f"--out={out}"], check=True,
                       capture_output=True)
    truth = {p["name"]: p["value"] for p in json.loads(
        (out / "truth" / "truth.json").read_text(encoding="utf-8"))["parameters"]}
    found = {kind: [] for kind in KINDS}
    for p in json.loads((out / "calibration.json").read_text(encoding="utf-8"))["parameters"]:
        kind = p["name"].split(".")[-1]
        if kind in KINDS and p["stddev"]:
            found[kind].append((p["value"] - truth[p["name"]]) / p["stddev"])
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--armcal", required=True)
    parser.add_argument("--runs", type=int, default=20)
    result_files.add_flag(parser)
    flags = parser.parse_args()
    armcal = Path(flags.armcal).resolve()
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(2) as pool:
        runs = list(pool.map(lambda run: deviations(armcal, folder, run),
                             range(1, flags.runs + 1)))
    values = {}
    for kind in KINDS:
        errors = [x for run in runs for x in run[kind]]
        values[kind] = [math.sqrt(sum(x * x for x in errors) / len(errors)),
                        max(map(abs, errors))]
        print(f"{kind}: rms {values[kind][0]:.2f}, at most {values[kind][1]:.1f} deviations, "
              f"{len(errors)} estimates")
    if flags.results:
        result_files.write(flags.results, "a simulated six-axis arm: rms and largest error of "
                           "friction in its standard deviations", values)


if __name__ == "__main__":
    main()
