#!/usr/bin/env python3
"""What calibrations by one program leave of held-out real logs, over another's.

  held_out_ratios.py --armcal=build/armcal --before=OTHER_ARMCAL [--results=FILE]

A minute. Each robot is calibrated on one log, or on a half of its only one, and the
residual (rms, linear model) is of another or the other half. A ratio below 1 says that
the first program's model predicts better. Prints ratios per joint; decides nothing.
"""

import argparse
import concurrent.futures
import json
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import result_files  # noqa: E402
from planted_log import UR10E  # noqa: E402
from runs import DATA  # noqa: E402

SLOW = ("--bandwidth=2",)


def pairs():
    """(set, flags): which logs are fitted and held out, and how."""
    def two(name, fitted, held_out, *flags, robot="robot.urdf"):
        return name, (f"--robot={robot}", f"--log={fitted}", f"--validate={held_out}", *flags)
    for fitted, held_out in ((1, 2), (2, 1), (3, 4), (5, 6), (7, 8)):
        for arm, log in ("A", "A0"), ("C", "C1"):
            yield two("dfki_double_pendulum", f"{log}_sysid_0{fitted}.csv",
                      f"{log}_sysid_0{held_out}.csv", robot=f"robot_{arm}.urdf")
    for fitted in 1, 3, 5:
        yield two("dfki_acrobot", f"reference_0{fitted}.csv.gz",
                  f"reference_0{fitted + 1}.csv.gz")
    yield two("ur10e_free", "id_20s.csv", "id_30s.csv", *UR10E, *SLOW)
    yield two("ur10e_free", "id_40s.csv", "id_50s.csv", *UR10E, *SLOW)
    yield two("kr300", "log_A.csv.gz", "log_B.csv.gz", *SLOW)
    yield two("dvrk_psm", "reference.csv.gz", "reference_val.csv.gz", *SLOW)
    yield two("dfki_simple_pendulum", "swing_A.csv", "swing_B.csv", *SLOW)
    for name, log, middle in (("panda", "log.csv", "10"), ("panda_set2", "log.csv.gz", "10"),
                              ("tx40", "log.csv.gz", "4.5")):
        halves = f"0:{middle}", f"{middle}:100"
        for hz in 4, 8, 16:
            for fitted, held_out in (halves, halves[::-1]):
                yield two(name, log, log, f"--crop={fitted}", f"--validate_crop={held_out}",
                          f"--bandwidth={hz}")


def left(armcal, name, flags):
    """rms of the held-out residual of each joint, N m."""
    with tempfile.TemporaryDirectory() as out:
        subprocess.run([armcal, "calibrate", *flags, "--estimate=linear", "--quiet",
                        f"--out={out}"], cwd=DATA / name, check=True, capture_output=True)
        joints = json.loads((Path(out) / "calibration.json").read_text())["joints"]
    return [joint["validation_residual_rms"] for joint in joints]


def geometric_mean(values):
    return math.exp(sum(map(math.log, values)) / len(values))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--armcal", required=True)
    parser.add_argument("--before", required=True)
    result_files.add_flag(parser)
    flags = parser.parse_args()
    programs = [Path(p).resolve() for p in (flags.armcal, flags.before)]
    cases = list(pairs())
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        of_both = [list(pool.map(lambda case, p=p: left(p, *case), cases)) for p in programs]
    ratios = {}
    for (name, options), now, before in zip(cases, *of_both):
        of_joints = [a / b for a, b in zip(now, before) if b]
        ratios.setdefault(name, []).append(geometric_mean(of_joints))
        print(name, *options[1:], f"{ratios[name][-1]:.3f}:",
              *(f"{ratio:.3f}" for ratio in of_joints))
    values = {name: geometric_mean(of_set) for name, of_set in ratios.items()}
    every = [ratio for of_set in ratios.values() for ratio in of_set]
    values |= {"all": geometric_mean(every), "least": min(every), "largest": max(every),
               "fits": len(every)}
    print(*(f"{name} {value:.4g}" for name, value in values.items()), sep="\n")
    if flags.results:
        result_files.write(flags.results, "held-out residuals of real logs over those by "
                           "the program before, geometric means over joints and fits",
                           values)
    return 0


if __name__ == "__main__":
    sys.exit(main())
