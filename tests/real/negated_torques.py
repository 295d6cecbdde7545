#!/usr/bin/env python3
"""Real logs with all torques (or all positions) negated: how many `armcal inspect` tells.

Reads ../shared/data, writes to a temporary folder. A log counts as told where a finding, or
one that it says would do as well, is the sign of all joints' torques or positions: an arm that
is its own mirror image tells no difference between the two. Counted beside are signs, orders
and lost signs of single joints, which are false. Logs of which nothing is asked are those
whose first finding says why (a torque that is 0 throughout), and those of one joint.

    python3 tests/real/negated_torques.py --armcal=build/armcal
"""
import argparse
import json
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import result_files  # noqa: E402
from inspection_claims import logs  # noqa: E402
from planted_log import DATA, Log  # noqa: E402

SIGNS = {"torque_sign", "position_sign"}
OF_SINGLE_JOINTS = SIGNS | {"joint_sign", "unsigned_torque", "joint_order", "position_order",
                            "torque_order"}


def negate(log, signals):
    for signal in signals & set(log.columns):
        log.columns[signal] = [[-x for x in column] for column in log.columns[signal]]


def is_of_all(one):
    return one["finding"] in SIGNS and one["joint_index"] == 0


def run(job):
    armcal, work, signals, (folder, path, robot, flags) = job
    log = Log(path)
    negate(log, signals or {log.torque})
    name = f"{folder.name}_{path.name.split('.csv')[0]}"
    log.write(work / f"{name}.csv")
    result = subprocess.run(
        [armcal, "inspect", f"--robot={folder / robot}", f"--log={work / name}.csv", *flags,
         f"--out={work / name}"], capture_output=True, text=True, check=False)
    if result.returncode > 1:
        raise RuntimeError(f"{name}: {result.stderr.strip()}")
    (work / f"{name}.csv").unlink()
    findings = json.loads((work / name / "inspect.json").read_text())["logs"][0]["findings"]
    told = any(is_of_all(one) for f in findings for one in [f] + f["alternatives"])
    first = any(is_of_all(f) for f in findings)
    asked = log.joints > 1 and all(f["finding"] != "no_torque" for f in findings)
    beside = [f for f in findings if f["finding"] in OF_SINGLE_JOINTS and not is_of_all(f)]
    return name, asked, first, told, beside


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--armcal", required=True)
    parser.add_argument("--positions", action="store_true", help="positions, not torques")
    result_files.add_flag(parser)
    arguments = parser.parse_args()
    if not DATA.exists():
        print("no ../shared/data: skipped")
        return 77
    armcal = Path(arguments.armcal).resolve()
    signals = {"q", "qd"} if arguments.positions else set()
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(2) as pool:
        results = list(pool.map(run, [(armcal, Path(folder), signals, log) for log in logs()]))
    for name, asked, first, told, beside in results:
        word = "told " if first else "beside" if told else "MISSED" if asked else "not asked"
        print(f"{word:9} {name}" + "".join(f"; {f['sentence']}" for f in beside))
    figures = {"logs": len(results), "asked": sum(r[1] for r in results),
               "told_first": sum(r[2] for r in results), "told": sum(r[3] for r in results),
               "beside": sum(r[3] and not r[2] for r in results),
               "single_joints": sum(len(r[4]) for r in results)}
    print("{told_first} of {asked} logs told, {told} with alternatives (of {logs}); {single_joints} "
          "claims of single joints".format(**figures))
    if arguments.results:
        result_files.write(arguments.results, "real logs with all torques negated", figures)
    return 0


if __name__ == "__main__":
    sys.exit(main())
