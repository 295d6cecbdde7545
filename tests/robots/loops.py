#!/usr/bin/env python3
"""Loops and couplings planted in ten public robot files: all have to be refused.

  python3 tests/robots/loops.py --armcal=build/armcal [--work=DIR]

Packages are fetched from PyPI as in survey.py. Each file is first read as it is,
where every joint that it moves has to be told: as one of the robot's, or as held. Then what rigid chains and
trees do not have is planted: a loop of each kind that URDF, MJCF and SDF know, a coupling of two joints, a joint of
several degrees of freedom within the chain. `inspect` has to refuse it with exit code 3, in a sentence that names the
element, the joints that it ties, and what would be read instead. Exit code 1 where it does not.
"""
import argparse
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import packages  # noqa: E402
import result_files  # noqa: E402

ERD = "cmeel.prefix/share/example-robot-data/robots/"
SUITE = "robosuite/models/assets/robots/"


def before(mark, text):
    """Plants text before the last occurrence of a mark."""
    def plant(content):
        head, found, tail = content.rpartition(mark)
        assert found, mark
        return head + text + found + tail
    return plant


def replaced(pattern, text):
    """Replaces what a pattern finds, which is there once."""
    def plant(content):
        content, count = re.subn(pattern, text, content)
        assert count == 1, (pattern, count)
        return content
    return plant


# (package, file, flags, what is planted, what the refusal has to name)
PLANTED = [
    ("example-robot-data", ERD + "ur_description/urdf/ur5_robot.urdf", "--tip=tool0", before(
        "</robot>", '<loop_joint name="rod" type="revolute"><link1 link="upper_arm_link"/>'
        '<link2 link="wrist_1_link"/></loop_joint>'),
     ["<loop_joint> 'rod'", "elbow_joint", "wrist_1_joint"]),
    ("example-robot-data", ERD + "panda_description/urdf/panda.urdf", "--tip=panda_hand", before(
        "</robot>", '<joint name="strut" type="fixed"><parent link="panda_hand"/>'
        '<child link="panda_link3"/></joint>'),
     ["panda_link3", "panda_joint3", "strut"]),
    ("example-robot-data", ERD + "z1_description/urdf/z1.urdf", "", before(
        "</robot>", '<gazebo><joint name="rod" type="revolute"><parent>link02</parent>'
        '<child>link04</child></joint></gazebo>'),
     ["<joint> 'rod'", "joint3", "joint4"]),
    ("example-robot-data", ERD + "xarm_description/urdf/xarm7.urdf", "--tip=link7", replaced(
        r'(<joint name="joint4" type="revolute">)', r'\1<mimic joint="joint2" multiplier="-1"/>'),
     ["<mimic> of joint 'joint4'", "joint2"]),
    ("robosuite", SUITE + "panda/robot.xml", "", before(
        "</mujoco>", '<equality><connect name="pin" body1="link3" body2="link6" anchor="0 0 0"/></equality>'),
     ["equality <connect> 'pin'", "joint4", "joint5", "joint6"]),
    ("robosuite", SUITE + "sawyer/robot.xml", "--tip=right_hand", before(
        "</mujoco>", '<equality><weld body1="right_hand"/></equality>'),
     ["equality <weld>", "right_j0", "right_j6"]),
    ("robosuite", SUITE + "iiwa/robot.xml", "", before(
        "</mujoco>", '<equality><joint joint1="joint_3" joint2="joint_5" polycoef="0 1 0 0 0"/></equality>'),
     ["equality <joint>", "joint_3", "joint_5"]),
    ("robosuite", SUITE + "ur5e/robot.xml", "", before(
        "</mujoco>", '<tendon><fixed name="belt"><joint joint="elbow_joint" coef="1"/>'
        '<joint joint="wrist_1_joint" coef="-1"/></fixed></tendon><equality><tendon tendon1="belt"/></equality>'),
     ["belt", "elbow_joint", "wrist_1_joint"]),
    ("robosuite", SUITE + "kinova3/robot.xml", "", replaced(
        r'<joint name="Actuator4"[^>]*/>', '<joint name="Actuator4" type="ball"/>'),
     ["joint 'Actuator4'", "ball"]),
    ("pybullet", "pybullet_data/kuka_iiwa/model.sdf", "", before(
        "</model>", '<joint name="rod" type="revolute"><parent>lbr_iiwa_link_2</parent>'
        '<child>lbr_iiwa_link_5</child><axis><xyz>0 0 1</xyz></axis></joint>'),
     ["joint 'rod'", "lbr_iiwa_joint_3", "lbr_iiwa_joint_5"]),
]


def inspect(armcal, robot, flags, *more):
    return subprocess.run([armcal, "inspect", f"--robot={robot}", *flags.split(), *more],
                          capture_output=True, text=True, check=False)


def untold_joints(armcal, robot, flags):
    """Joints of the file that move and that inspect does not name."""
    done = inspect(armcal, robot, flags, "--json")
    if done.returncode not in (0, 1):
        return [done.stderr.strip()]
    told = done.stdout + done.stderr
    content = re.sub(r"<!--.*?-->", "", robot.read_text(encoding="utf-8"), flags=re.S)
    moving = re.findall(r'<joint\b[^>]*\bname="([^"]+)"[^>]*>', content)
    fixed = re.findall(r'<joint\b(?=[^>]*\btype="fixed")[^>]*\bname="([^"]+)"', content)
    json.loads(done.stdout)
    return [name for name in moving if name not in fixed and name not in told]


def try_plant(armcal, source, flags, plant, names):
    """None where the planted file is refused as it should be, else what was said."""
    untold = untold_joints(armcal, source, flags)
    if untold:
        return f"as it is, not told of: {', '.join(untold)}"
    planted = source.with_name("planted_" + source.name)
    planted.write_text(plant(source.read_text(encoding="utf-8")), encoding="utf-8")
    try:
        done = inspect(armcal, planted, flags)
    finally:
        planted.unlink()
    said = done.stderr.strip()
    missing = [name for name in names if name not in said]
    if done.returncode != 3 or missing or "expected" not in said:
        return f"exit code {done.returncode}, not named: {missing}: {said or done.stdout[:300]}"
    print(f"refused {source.parent.name}/{source.name}: {said}")
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--armcal", required=True)
    parser.add_argument("--work", help="where packages are kept")
    result_files.add_flag(parser)
    arguments = parser.parse_args()
    armcal = str(Path(arguments.armcal).resolve())
    with tempfile.TemporaryDirectory() as folder:
        folders = {name.split("==")[0].replace("_", "-"): path for name, path in packages.fetch(
            Path(arguments.work or folder), sorted({p[0] for p in PLANTED})).items()}
        failed = 0
        for package, path, flags, plant, names in PLANTED:
            problem = try_plant(armcal, folders[package] / path, flags, plant, names)
            if problem:
                failed += 1
                print(f"FAILED {path}: {problem}")
    print(f"{len(PLANTED) - failed} of {len(PLANTED)} refused")
    if arguments.results:
        result_files.write(arguments.results, "public robot files with planted loops",
                           {"refused": [len(PLANTED) - failed, len(PLANTED)]})
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
