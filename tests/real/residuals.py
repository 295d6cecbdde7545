#!/usr/bin/env python3
"""What calibrations leave of real robots' torques and poses: the figures of
docs/accuracy.md.

  python3 tests/real/residuals.py --armcal=build/armcal [--results=FILE]

Half a minute. Torque: 100 |tau - tau_hat| / |tau| per joint in 2-norm, both low-passed;
poses: mm. Prints them; decides nothing (tests/real/robots_test.cc has bars).
"""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import result_files  # noqa: E402

DATA = HERE.parents[2] / "shared" / "data"
UR10E = ("--torque_constants=14.87,13.26,11.13,10.62,11.03,11.47", "--bandwidth=6")
PANDA = ("--log={}/log.csv", "--bandwidth=8")
BANDWIDTHS = (2, 4, 8, 16, 32)
HELD_OUT = ("--crop=0:14", "--validate={}/log.csv", "--validate_crop=14:21")
POINTS = ("--log={}/id_30s.csv", "--validate={}/val_ptp.csv")


class Calibrations:
    def __init__(self, armcal, data, work):
        self._armcal, self._data, self._work = Path(armcal).resolve(), data, work

    def __call__(self, folder, *flags):
        """calibration.json of a robot in data."""
        data = self._data / folder
        subprocess.run([self._armcal, "calibrate", f"--robot={data}/robot.urdf", "--quiet",
                        f"--out={self._work}", *(flag.format(data) for flag in flags)],
                       check=True, capture_output=True)
        return json.loads((self._work / "calibration.json").read_text(encoding="utf-8"))


def percents(calibration, key):
    return [joint[key] for joint in calibration["joints"]]


def torques(calibrate):
    own = calibrate("ur10e_free", "--log={}/id_50s.csv", "--estimate=linear", *UR10E)
    points = calibrate("ur10e_free", *POINTS, "--estimate=linear", *UR10E)
    left = percents(points, "validation_residual_percent")
    rms = points["joints"][5]["validation_residual_rms"]
    held_out = {}
    for name, folder, flags in (("ur10e", "ur10e_free", (*POINTS, *UR10E)),
                                ("panda", "panda", (*PANDA, *HELD_OUT))):
        both = calibrate(folder, *flags)
        held_out[name] = both["validation_stacked_residual_percent"]
        held_out[name + "_model"] = both["linear"]["validation_stacked_residual_percent"]
    refined = calibrate("panda", *PANDA, *HELD_OUT, "--geometry=refine")
    panda = {hz: calibrate("panda", PANDA[0], f"--bandwidth={hz}", "--estimate=linear")[
        "stacked_residual_percent"] for hz in BANDWIDTHS}
    return {"ur10e_itself": percents(own, "residual_percent"),
            "ur10e_stacked": own["stacked_residual_percent"],
            "ur10e_points": left[:5],
            "ur10e_joint6": [left[5], rms, 100 * rms / left[5]],
            "ur10e_range": [min(left[:5]), max(left[:5])],
            "panda": panda[8], "panda_bandwidths": [x for pair in panda.items() for x in pair],
            "panda_held_out": held_out["panda_model"],
            "robots": [held_out["ur10e"], held_out["panda"],
                       refined["validation_stacked_residual_percent"]],
            "models": [held_out["ur10e_model"], held_out["panda_model"]]}


def poses(calibrate, loss):
    left = []
    for geometry in ("offsets", "refine"):
        found = calibrate("geo_fanuc_r2000", "--poses={}/poses.csv", f"--loss={loss}",
                          f"--geometry={geometry}")["poses"]
        left += [1e3 * found["rms"], 1e3 * found["cross_validated_rms"]]
    return left, 1e3 * found["before_rms"]


def read_flags(description):
    """--armcal, --data and --results; without the data the exit code of a skip."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--armcal", required=True)
    parser.add_argument("--data", type=Path, default=DATA)
    result_files.add_flag(parser)
    flags = parser.parse_args()
    if not flags.data.exists():
        print("no ../shared/data: skipped")
        sys.exit(77)
    return flags


def main():
    flags = read_flags(__doc__)
    with tempfile.TemporaryDirectory() as folder:
        calibrate = Calibrations(flags.armcal, flags.data, Path(folder))
        values = torques(calibrate)
        squared, before = poses(calibrate, "squared")
        values |= {"fanuc_before": before, "fanuc_squared": squared,
                   "fanuc_auto": poses(calibrate, "auto")[0]}
    for name, value in values.items():
        print(name, *(f"{x:.4g}" for x in result_files.numbers(value)))
    if flags.results:
        result_files.write(flags.results, "real robots, their logs in ../shared/data", values)
    return 0


if __name__ == "__main__":
    sys.exit(main())
