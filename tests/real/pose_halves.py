#!/usr/bin/env python3
"""By how many of their stated deviations do the estimates of two halves of real poses
differ? The truth of a real arm is not known, but halves have it in common: the root mean
square of z = (a - b) / hypot(stddev_a, stddev_b) over what is estimated is 1 of right
intervals, and less where halves share a part of their error.

  python3 tests/real/pose_halves.py --armcal=build/armcal [--results=FILE] \
      [--before=OLD/armcal] [--set=NAME=ROBOT:POSES ..]

By default the R-2000 of ../shared/data; --set adds others. Halves are of poses (joint
positions within 1e-4), every second and ten drawn ones. Decides nothing.
"""

import argparse
import csv
import json
import math
import random
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import result_files  # noqa: E402

DATA = HERE.parents[2] / "shared" / "data"
DRAWS = 10
MODES = ("known", "offsets", "refine")


def joint_columns(header):
    """Those before the first of what was measured."""
    measured = ("x", "y", "z", "length", "qw")
    first = next(k for k, name in enumerate(header) if name.strip().startswith(measured))
    return [k for k in range(first) if header[k].strip() not in ("pose", "row")]


def poses_of(rows, joints):
    seen = {}
    return [seen.setdefault(tuple(round(float(row[k]), 4) for k in joints), len(seen))
            for row in rows]


def estimate(armcal, robot, header, rows, mode, work):
    with open(work / "half.csv", "w", newline="", encoding="utf-8") as out:
        csv.writer(out).writerows([header, *rows])
    subprocess.run([armcal, "calibrate", f"--robot={robot}", f"--poses={work}/half.csv",
                    f"--geometry={mode}", f"--out={work}/out", "--quiet"],
                   capture_output=True, check=False)  # a poor fit is a result, too
    result = json.loads((work / "out" / "calibration.json").read_text(encoding="utf-8"))
    return {p["name"]: (p["value"], p["stddev"])
            for p in result["geometry"] + result["observed"] if p["stddev"] is not None}


def mean_square(armcal, robot, header, rows, second, mode, work):
    one, other = (
        estimate(armcal, robot, header, [row for row, is_second in zip(rows, second)
                                         if is_second == half], mode, work)
        for half in (False, True))
    squares = [(one[k][0] - other[k][0]) ** 2 / (one[k][1] ** 2 + other[k][1] ** 2)
               for k in one if k in other]
    return sum(squares) / len(squares)


def halves(armcal, robot, poses, work):
    """Root mean squares of each mode: every second pose, and drawn halves."""
    header, *rows = csv.reader(open(poses, encoding="utf-8"))
    pose_of = poses_of(rows, joint_columns(header))
    count = max(pose_of) + 1
    draw = random.Random(1)
    splits = [[k % 2 == 1 for k in range(count)]]
    for _ in range(DRAWS):
        chosen = set(draw.sample(range(count), count // 2))
        splits.append([k in chosen for k in range(count)])
    found = {}
    for mode in MODES:
        squares = [mean_square(armcal, robot, header, rows, [s[p] for p in pose_of], mode, work)
                   for s in splits]
        found[mode] = [math.sqrt(squares[0]), math.sqrt(sum(squares[1:]) / DRAWS)]
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--armcal", required=True)
    parser.add_argument("--before", help="another armcal, for comparison")
    parser.add_argument("--set", action="append", default=[], help="NAME=ROBOT:POSES")
    result_files.add_flag(parser)
    flags = parser.parse_args()
    fanuc = DATA / "geo_fanuc_r2000"
    sets = {"r2000": (fanuc / "robot.urdf", fanuc / "poses.csv")}
    for given in flags.set:
        name, files = given.split("=", 1)
        sets[name] = files.split(":", 1)
    programs = {"": flags.armcal, **({"_before": flags.before} if flags.before else {})}
    values = {}
    with tempfile.TemporaryDirectory() as work:
        for suffix, armcal in programs.items():
            for name, (robot, poses) in sets.items():
                found = halves(Path(armcal).resolve(), robot, poses, Path(work))
                for mode, both in found.items():
                    values[f"{name}_{mode}{suffix}"] = both
                    print(f"{name + suffix:16} {mode:8} every second pose {both[0]:.2f}, "
                          f"drawn {both[1]:.2f}", flush=True)
    if flags.results:
        result_files.write(flags.results, "halves of real poses: rms of their estimates' "
                           "differences in standard deviations, every second pose and ten "
                           "drawn halves", values)


if __name__ == "__main__":
    main()
