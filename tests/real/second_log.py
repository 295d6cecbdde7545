#!/usr/bin/env python3
"""Does a second log confirm what a diagnosis without a reference claims?

  second_log.py --armcal=build/armcal [--work=DIR] [--results=FILE]

Pairs of logs of one real robot in one state are diagnosed against its file
alone. What is claimed of one log (an effect on its joint, above 50 %, beyond the
terms that the file gives no joint) is a fact about the robot only if the other
log says the same. Prints all claims; decides nothing.
"""

import argparse
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

import result_files  # noqa: E402
from reading import claims, told  # noqa: E402
from runs import Runs, diagnose  # noqa: E402

PAIRS = {
    "dvrk_psm": ("robot.urdf", [("reference.csv.gz", "reference_val.csv.gz")]),
    "ur10e_free": ("robot.urdf", [("id_20s.csv", "id_30s.csv"),
                                  ("id_40s.csv", "id_50s.csv")]),
    "dfki_double_pendulum": ("robot_C.urdf",
                             [("C1_sysid_01.csv", "C1_sysid_02.csv"),
                              ("C1_sysid_05.csv", "C1_sysid_09.csv")]),
    "dfki_acrobot": ("robot.urdf",
                     [("reference_01.csv.gz", "reference_02.csv.gz"),
                      ("reference_05.csv.gz", "reference_06.csv.gz")]),
    "innopolis_pendubot": ("robot.urdf",
                           [("position_A_1p2_v_0p1.csv", "position_A_1p2_v_0p2.csv"),
                            ("position_A_1p2_v_0p3.csv", "position_A_1p2_v_0p5.csv")]),
    "dfki_simple_pendulum": ("robot.urdf", [("swing_A.csv", "swing_B.csv"),
                                            ("energy_ref.csv", "swing_C.csv")]),
    "kr300": ("robot.urdf", [("log_A.csv.gz", "log_B.csv.gz")]),
    "schunk_lwa4p": ("robot.urdf", [("run_080.csv.gz", "run_081.csv.gz"),
                                    ("run_092.csv.gz", "run_093.csv.gz")]),
}
FLAGS = {"ur10e_free": ["--torque_constants=14.87,13.26,11.13,10.62,11.03,11.47"]}
TERMS = {"viscous_friction", "coulomb_friction", "armature", "torque_offset"}


def places(diagnosis):
    """{(effect, joint)} that are claimed, but for terms that the file lacks."""
    found = set()
    for entry in claims(diagnosis):
        if entry["effect"] in TERMS and not entry["joint"]:
            continue
        found.add((entry["effect"], entry["joint"]))
    return found


def negative(diagnosis):
    """Joints whose friction or armature is told as negative by three deviations."""
    return sum(e["value"] < -3 * e["stddev"]
               for entry in claims(diagnosis)
               if entry["effect"] in TERMS - {"torque_offset"} and not entry["joint"]
               for e in entry["estimates"] if e["stddev"])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--armcal", required=True)
    parser.add_argument("--work")
    result_files.add_flag(parser)
    flags = parser.parse_args()
    count = confirmed = below = logs = 0
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(flags.work or folder)
        for name, (robot, pairs) in PAIRS.items():
            commands = {log: diagnose(f"--robot={robot}", f"--log={log}",
                                      "--forward=false", *FLAGS.get(name, []))
                        for pair in pairs for log in pair}
            runs = Runs(str(pathlib.Path(flags.armcal).resolve()), name, commands, work)
            for pair in pairs:
                found = [places(runs[log]) for log in pair]
                for log, own, other in zip(pair, found, found[::-1]):
                    logs += 1
                    count += len(own)
                    confirmed += len(own & other)
                    below += negative(runs[log])
                    print(f"{name} {log}: {told(runs[log])}")
    print(f"{confirmed} of {count} claims beyond joints' terms in {logs} logs are those of "
          f"the second log as well; {below} terms are negative by three deviations")
    if flags.results:
        result_files.write(flags.results, "real robots, their logs in ../shared/data",
                           {"confirmed": [confirmed, count], "logs": logs,
                            "negative": below})


if __name__ == "__main__":
    main()
