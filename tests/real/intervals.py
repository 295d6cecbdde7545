#!/usr/bin/env python3
"""Whether repeated estimates of one quantity in different real logs scatter as their
intervals claim.

  python3 tests/real/intervals.py --armcal=build/armcal [--work=FOLDER] [--json=FILE]

Every log is calibrated by itself. Of a quantity in n logs, x_i +- s_i, with the mean
weighted by 1 / s_i^2,
  chi^2 = sum_i (x_i - mean)^2 / s_i^2
has n - 1 degrees of freedom; the table has sqrt(sum chi^2 / sum (n - 1)), 1 where
the claim is true. Torque constants are the same in all logs of a robot and cancel:
they are taken as exact. Friction, and the offsets that go with it, of logs of
different days are listed apart: it does change (REPEATS says which logs are of one
day). Exit code 1 where a figure of a quantity that stays is not within 0.8 to 1.25.
"""

import argparse
import json
import math
import os
import sys
from collections import defaultdict
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import result_files  # noqa: E402
from runs import Runs, calibrate  # noqa: E402

TORQUE = "--torque_constants_stddev=0"
KINDS = {"viscous": "viscous", "coulomb": "Coulomb", "offset": "offset",
         "armature": "armature"}
LEAST, MOST = .8, 1.25
UR10E = ("--robot=robot.urdf",
         "--torque_constants=14.87,13.26,11.13,10.62,11.03,11.47")
# Logs of the same robot in the same state: (set, logs, flags, whether of one day).
REPEATS = [
    ("kr300", ["log_A.csv.gz", "log_B.csv.gz", "log_C.csv.gz"],
     ("--robot=robot.urdf",), True),
    ("ur10e_free", ["id_20s.csv", "id_30s.csv", "id_40s.csv", "id_50s.csv"], UR10E,
     False),
    ("schunk_lwa4p", ["run_091.csv.gz", "run_092.csv.gz"], ("--robot=robot.urdf",),
     True),
    ("schunk_lwa4p", ["run_016.csv.gz", "run_017.csv.gz"], ("--robot=robot.urdf",),
     True),
    ("dvrk_psm", ["reference.csv.gz", "reference_val.csv.gz"],
     ("--robot=robot.urdf", "--gravity=0,0,-9.81"), True),
]


def kind_of(name, one_day):
    """Of a model parameter. What lumps a joint term with an inertia is inertia."""
    lumped = "inertia and gravity"
    kind = lumped if "+" in name else KINDS.get(name.split("[")[0], lumped)
    changes = kind in ("viscous", "Coulomb", "offset")
    return f"{kind}, other days" if changes and not one_day else kind


def told(calibration):
    """{name: (value, stddev)} of what the log tells."""
    return {p["name"]: (p["value"], p["stddev"])
            for p in calibration["model_parameters"]
            if p["stddev"] and math.isfinite(p["stddev"]) and p["stddev"] > 0}


def chi_square(estimates):
    weights = [1 / s ** 2 for _, s in estimates]
    mean = sum(w * x for w, (x, _) in zip(weights, estimates)) / sum(weights)
    return sum(w * (x - mean) ** 2 for w, (x, _) in zip(weights, estimates))


def study(arguments, repeat):
    """Rows (set, kind, name, chi^2, degrees of freedom)."""
    set_name, logs, flags, one_day = repeat
    commands = {log: calibrate(*flags, f"--log={log}", "--estimate=linear", TORQUE)
                for log in logs}
    runs = Runs(os.path.abspath(arguments.armcal), set_name, commands,
                Path(arguments.work).resolve())
    found = [told(runs[log]) for log in logs]
    rows = []
    for name in sorted(set().union(*found)):
        estimates = [f[name] for f in found if name in f]
        if len(estimates) > 1:
            rows.append((set_name, kind_of(name, one_day), name, chi_square(estimates),
                         len(estimates) - 1))
    return rows


def table(rows, key):
    sums = defaultdict(lambda: [0., 0, []])
    for row in rows:
        entry = sums[key(row)]
        entry[0] += row[3]
        entry[1] += row[4]
        entry[2].append(row[3] / row[4])
    figures = {}
    for name, (chi, degrees, ratios) in sorted(sums.items()):
        figures[name] = math.sqrt(chi / degrees)
        median = math.sqrt(sorted(ratios)[len(ratios) // 2])
        print(f"{name:42} rms {figures[name]:6.2f}  median {median:5.2f}  of "
              f"{degrees} differences")
    return figures


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--armcal", default="build/armcal")
    parser.add_argument("--work", default="/tmp/intervals")
    parser.add_argument("--json")
    result_files.add_flag(parser)
    arguments = parser.parse_args()
    rows = [row for repeat in REPEATS for row in study(arguments, repeat)]
    table(rows, lambda row: f"{row[0]}: {row[1]}")
    print()
    figures = table(rows, lambda row: row[1])
    if arguments.json:
        Path(arguments.json).write_text(json.dumps(rows, indent=1))
    if arguments.results:
        others = table([row for row in rows if row[0] != "dvrk_psm"], lambda row: row[1])
        values = {kind.replace(",", "").replace(" ", "_"): v for kind, v in figures.items()}
        values["without_the_pair"] = [others["armature"], others["offset"]]
        result_files.write(arguments.results, "real robots, their logs in ../shared/data: rms "
                           "of differences over claimed deviations; armature and offset "
                           "without the pair of logs of the da Vinci arm", values)
    stays = [v for kind, v in figures.items() if "other days" not in kind]
    return 0 if all(LEAST <= v <= MOST for v in stays) else 1


if __name__ == "__main__":
    sys.exit(main())
