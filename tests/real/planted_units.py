#!/usr/bin/env python3
"""Torques of real logs multiplied by factors: how many `armcal inspect` names.

All joints by 1000 (mN m), 1/1000 (kN m), 1/100 (the motors' side), or each by 1/constant
(currents); then one joint after the other by 1000, 20 and 1/100. Of joints whose torque is
mostly friction, and where other inertias would explain it as well, nothing is to be said.

    python3 tests/real/planted_units.py --armcal=build/armcal
"""
import argparse
import collections
import csv
import json
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from planted_faults import result_files
from planted_log import DATA, UR10E, Log

LOGS = [("panda", "log.csv", ()), ("ur10e_free", "id_20s.csv", UR10E),
        ("dvrk_psm", "reference.csv.gz", ()), ("schunk_lwa4p", "run_080.csv.gz", ()),
        ("tx40", "log.csv.gz", ()), ("kr300", "log_C.csv.gz", ())]
CONSTANTS = (15, 13, 11, 9, 8, 7, 6)


def cases(joints):
    """(name, joint or None for all, factors)"""
    yield "as it is", None, [1] * joints
    for name, factor in (("x 1000", 1e3), ("/ 1000", 1e-3), ("/ 100", 1e-2)):
        yield f"all {name}", None, [factor] * joints
    yield "all, currents", None, [1 / k for k in CONSTANTS[:joints]]
    for joint in range(joints):
        for factor in (1000, 20, .01):
            yield f"one x {factor}", joint, [factor if k == joint else 1 for k in range(joints)]


def names(armcal, work, folder, flags, log, factors):
    """The joints whose torque is said to be in another unit, from 1; 0: all."""
    path = Path(tempfile.mkdtemp(dir=work)) / "log.csv"
    signals = {s: list(columns) for s, columns in log.columns.items()}
    signals[log.torque] = [[x * factors[j] for x in column]
                           for j, column in enumerate(signals[log.torque])]
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["t", *(f"{s}{j + 1}" for s in signals for j in range(log.joints))])
        writer.writerows(zip(log.t, *(c for s in signals.values() for c in s)))
    answer = subprocess.run([armcal, "inspect", f"--robot={DATA / folder / 'robot.urdf'}",
                             f"--log={path}", "--json", *flags], capture_output=True,
                            text=True, check=False)
    path.unlink()
    return [f["joint_index"] for f in json.loads(answer.stdout)["logs"][0]["findings"]
            if f["finding"] in ("torque_unit", "torque_is_current")]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--armcal", required=True)
    result_files.add_flag(parser)
    arguments = parser.parse_args()
    armcal = Path(arguments.armcal).resolve()
    if not DATA.exists():
        print("no ../shared/data: skipped")
        return 77
    counts = collections.defaultdict(lambda: [0, 0, 0])
    with tempfile.TemporaryDirectory() as work, ThreadPoolExecutor(2) as pool:
        jobs = []
        for folder, name, flags in LOGS:
            log = Log(DATA / folder / name)
            jobs += [(case, joint, pool.submit(names, armcal, work, folder, flags, log, factors))
                     for case, joint, factors in cases(log.joints)]
        for case, joint, job in jobs:
            said, right = job.result(), 0 if joint is None else joint + 1
            if case == "as it is":
                right = None
            count = counts[case]
            count[0] += 1
            count[1] += right in said if right is not None else not said
            count[2] += sum(k != right for k in said)
    for case, (total, right, wrong) in counts.items():
        print(f"{case}: {right} of {total} right, {wrong} wrong claims")
    if arguments.results:
        single = [count for case, count in counts.items() if case.startswith("one")]
        result_files.write(arguments.results, "real logs whose torques were multiplied: right, "
                           "of; wrong claims", {
            **{case: count[1::-1] for case, count in counts.items()},
            "single": [sum(c[1] for c in single), sum(c[0] for c in single)],
            "wrong": sum(c[2] for c in counts.values())})
    return 1 if any(wrong for _, _, wrong in counts.values()) else 0


if __name__ == "__main__":
    raise SystemExit(main())
