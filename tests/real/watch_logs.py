#!/usr/bin/env python3
"""What does armcal watch tell of real robots on which nothing was changed?

  watch_logs.py --armcal=build/armcal [--data=../shared/data]

Each robot is calibrated on some logs; others of it are watched. Those of the
same days should tell nothing; "weeks apart" and other motions are told as they
are. Prints the events but for what was learned; decides nothing (docs/watch.md
has the figures).
"""

import argparse
import json
import pathlib
import subprocess
import tempfile

UR = ["--torque_constants=14.87,13.26,11.13,10.62,11.03,11.47"]
CASES = [  # name, robot, calibrated on, watched, flags of both, of watch
    ("UR10e, same week", "ur10e_free/robot.urdf", "ur10e_free/id_[235]0s.csv",
     "ur10e_free/id_40s.csv", UR, ["--learn=15"]),
    ("UR10e, weeks apart", "ur10e_free/robot.urdf", "ur10e_free/id_[235]0s.csv",
     "ur10e_free/val_ptp.csv", UR, ["--learn=15"]),
    ("UR10e, one joint at a time", "ur10e_free/robot.urdf",
     "ur10e_free/id_[235]0s.csv", "ur10e_free/sweep_joint[1-6].csv", UR,
     ["--learn=15"]),
    ("UR10e, a person pushes", "ur10e_free/robot.urdf", "ur10e_free/id_[235]0s.csv",
     "ur10e_free/push_contact_*.csv", UR, ["--learn=5"]),
    ("double pendulum A", "dfki_double_pendulum/robot_A.urdf",
     "dfki_double_pendulum/A0_sysid_0[1-3].csv",
     "dfki_double_pendulum/A0_sysid_0[4-9].csv", [], ["--learn=3"]),
    ("double pendulum C", "dfki_double_pendulum/robot_C.urdf",
     "dfki_double_pendulum/C1_sysid_0[1-3].csv",
     "dfki_double_pendulum/C1_sysid_0[4-9].csv", [], ["--learn=3"]),
    ("Acrobot", "dfki_acrobot/robot.urdf", "dfki_acrobot/reference_0[1-3].csv.gz",
     "dfki_acrobot/reference_0[4-9].csv.gz", [], ["--learn=3"]),
    ("KR300", "kr300/robot.urdf", "kr300/log_A.csv.gz", "kr300/log_[BC].csv.gz", [],
     ["--learn=4"]),
    ("Schunk LWA 4P", "schunk_lwa4p/robot.urdf", "schunk_lwa4p/run_001.csv.gz",
     "schunk_lwa4p/run_002.csv.gz", [], ["--learn=10"]),
]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--armcal", required=True)
    parser.add_argument("--data", type=pathlib.Path,
                        default=pathlib.Path("../shared/data"))
    arguments = parser.parse_args()
    for name, robot, trained, watched, flags, more in CASES:
        robot = f"--robot={arguments.data / robot}"
        with tempfile.TemporaryDirectory() as folder:
            logs = ",".join(map(str, sorted(arguments.data.glob(trained))))
            made = subprocess.run(
                [arguments.armcal, "calibrate", robot, f"--log={logs}", "--quiet",
                 f"--out={folder}/result", *flags], capture_output=True, text=True,
                check=False)
            for log in sorted(arguments.data.glob(watched)):
                found = subprocess.run(
                    [arguments.armcal, "watch", robot, f"--log={log}", "--json",
                     f"--calibration={folder}/result", *flags, *more],
                    capture_output=True, text=True, check=False)
                lines = [json.loads(line) for line in found.stdout.splitlines()]
                if not lines or lines[-1]["event"] != "summary":
                    print(f"{name}, {log.name}: {(found.stderr or made.stderr).strip()}")
                    continue
                told = [f"{e['event']} {','.join(e['joints'])} {e['time_s']:.1f} s"
                        for e in lines[:-1]
                        if e["event"] in ("contact", "payload", "friction",
                                          "cannot tell yet")]
                end = lines[-1]
                print(f"{name}, {log.name}: {end['seconds']:.0f} s, "
                      f"{'learned' if end['learned'] else 'too short to learn'}, "
                      f"{len(told)} told{': ' if told else ''}{'; '.join(told)}",
                      flush=True)


if __name__ == "__main__":
    main()
