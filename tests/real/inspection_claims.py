#!/usr/bin/env python3
"""Every finding of `armcal inspect` on every log of ../shared/data, judged.

TRUE lists the findings that SOURCE.md, TRUTH.md or the numbers of the log itself prove,
with that proof. Any other finding is counted as false. And what --fix offers to read otherwise
has to lower what a fit leaves of torques that it has not seen (`held_out` of the finding).

    python3 tests/real/inspection_claims.py --armcal=build/armcal
"""
import argparse
import json
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import result_files  # noqa: E402

DATA = Path(__file__).resolve().parents[3] / "shared" / "data"
UR10E = "--torque_constants=14.87,13.26,11.13,10.62,11.03,11.47"

# (log, finding with joint, why it is true)
TRUE = [
    ("dfki_acrobot/.*", "saturated@1",
     "TRUTH: tau is the command of a controller; it is 0.5 N m exactly, its largest value"),
    ("dfki_double_pendulum/C1_sysid_0[568]", "quantised@[12]",
     "SOURCE: the torque's quantum is 5.9e-3 N m, and this drive idles at .03 N m rms"),
    ("dfki_simple_pendulum/handguided", "computed_torque@0",
     "SOURCE: the torque is computed from q"),
    ("dfki_simple_pendulum/swing_C", "outliers@1",
     "the log: single rows of 3 to 18 N m between rows of about .5"),
    ("innopolis_pendubot/.*", "no_torque@2", "SOURCE: joint 2 passive, tau2 = 0, column kept"),
    ("innopolis_pendubot/position_A_1p2_v_0p05", "holes@0", "SOURCE: one 0.24 s hole"),
    ("innopolis_pendubot/position_A_1p2_v_0p(01|4|5)", "holes@0",
     "the log: steps of 32 ms and more in its own stamps, of 10 ms"),
    ("innopolis_pendubot/.*", "velocity_delay@[12]",
     "the log: qd is most like the slope of q 30 to 32 ms before (cross-correlation)"),
    ("innopolis_pendubot/position_A_1p2_v_0p1", "position_spike@1",
     "the log: q1 is -.458, .330, -.459 in three rows at 1.78 s, qd1 -.08 rad/s all along"),
    ("innopolis_pendubot/position_A_1p2_v_0p3", "position_spike@1",
     "the log: q1 is -1.650, -1.235, -1.609 in three rows at 2.93 s, qd1 2.1 rad/s all along"),
    ("innopolis_pendubot/position_A_1p2_v_0p5", "position_spike@2",
     "the log: q2 is .641, 2.167, .530 in three rows at 2.65 s, qd2 -1.1 to -2.9 rad/s"),
    ("innopolis_pendubot/position_A_1p2_v_0p7", "position_spike@2",
     "the log: q2 is -.865, -.263, -.732 in three rows at 9.41 s, qd2 1.6 to 3.1 rad/s"),
    ("innopolis_pendubot/position_A_1p2_v_0p05", "missing_time@0",
     "the log: q1 and q2 go -.083 and .075 rad in 11 ms at 9.14 s, qd -.1 and -.2 rad/s before"),
    ("panda_set2/log", "clock@0", "TRUTH: mean period 1.022 ms, stamps of 1 ms, holes"),
]


def logs():
    for folder in sorted(DATA.iterdir()):
        if folder.name.startswith("geo_"):
            continue
        for log in sorted(folder.glob("*.csv*")):
            if re.match("TRUTH|sealed", log.name):
                continue
            robot = {"A": "robot_A.urdf", "C": "robot_C.urdf"}.get(log.name[0], "robot.urdf")
            if folder.name != "dfki_double_pendulum":
                robot = "robot.urdf"
            flags = [UR10E] if folder.name == "ur10e_free" else []
            yield folder, log, robot, flags


def run(job):
    armcal, work, (folder, log, robot, flags) = job
    out = work / folder.name / log.name
    result = subprocess.run(
        [armcal, "inspect", f"--robot={folder / robot}", f"--log={log}", *flags, "--fix",
         f"--out={out}"], capture_output=True, text=True, check=False)
    if result.returncode > 1:
        raise RuntimeError(f"{log}: {result.stderr.strip()}")
    answer = json.loads((out / "inspect.json").read_text())
    return f"{folder.name}/{log.name.split('.csv')[0]}", answer["logs"][0]["findings"]


def proof(log, finding):
    claim = f"{finding['finding']}@{finding['joint_index']}"
    for where, what, why in TRUE:
        if re.fullmatch(where, log) and re.fullmatch(what, claim):
            return why
    return ""


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--armcal", required=True)
    result_files.add_flag(parser)
    arguments = parser.parse_args()
    if not DATA.exists():
        print("no ../shared/data: skipped")
        return 77
    armcal = Path(arguments.armcal).resolve()
    claims = wrong = fixes = worse = 0
    with tempfile.TemporaryDirectory() as work, ThreadPoolExecutor(2) as pool:
        answers = list(pool.map(run, [(armcal, Path(work), log) for log in logs()]))
    for log, findings in answers:
        for finding in findings:
            why = proof(log, finding)
            claims += 1
            wrong += not why
            print(f"{'true  ' if why else 'FALSE '} {log}: {finding['sentence']} "
                  f"({finding['evidence']}){'; ' + why if why else ''}")
            mends = finding["finding"] in ("position_spike", "position_wrap")
            if "fixed_1.csv" not in finding["flag"] or mends:
                continue  # of these the proof is that they are wrong
            fixes += 1
            held_out = finding["held_out"]
            if not held_out or held_out["after"] >= held_out["before"]:
                worse += 1
                print("       and what --fix writes lowers nothing that was held out")
    print(f"{len(answers)} logs, {claims} findings, {wrong} of them not proven; "
          f"{fixes} fixes offered, {worse} that lower nothing")
    if arguments.results:
        result_files.write(arguments.results, "real robots, their logs in ../shared/data", {
            "logs": len(answers), "findings": claims, "not_proven": wrong, "fixes": fixes,
            "fixes_that_lower_nothing": worse})
    return 1 if wrong or worse else 0


if __name__ == "__main__":
    sys.exit(main())
