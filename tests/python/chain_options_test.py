"""What is read of a robot's file: options of commands, and of read_robot."""

import os
import pathlib
import subprocess
import unittest

import armcal
from armcal import commands, option_kinds

ARMS = pathlib.Path(os.environ["DATA_DIR"]) / "two_arms/robot.urdf"
CHAIN = {"tip": "left_hand,right_finger",
         "posture": {"left_finger_joint": .04}}


def flags_of_the_chain(command):
    """The command line's own list, from its help."""
    text = subprocess.run([os.environ["ARMCAL"], command, "--help"],
                          check=True, text=True, capture_output=True).stdout
    line, = [line for line in text.split("\n")
             if line.strip().startswith("chain of the robot")]
    return {word[2:] for word in line.split() if word.startswith("--")}


class ChainOptions(unittest.TestCase):

    def test_are_the_flags_of_the_command_line(self):
        for command in ("inspect", "calibrate", "diagnose"):
            self.assertEqual(set(commands._CHAIN_FLAGS),
                             flags_of_the_chain(command), command)
        for command in option_kinds.COMMANDS:
            if command == "compare":
                continue  # its results may be robot files of any chain
            self.assertLessEqual(set(commands._CHAIN_FLAGS),
                                 set(armcal.options(command)), command)

    def test_go_with_a_path(self):
        """As if read_robot had been given them. Both fingers of 0.15 kg are 4 cm
        further out than they are without a posture, along y: by hand."""
        by_path = armcal.inspect(ARMS, **CHAIN)
        by_robot = armcal.inspect(armcal.read_robot(ARMS, **CHAIN))
        told = by_path.to_dict()["robot"]
        self.assertEqual(told, by_robot.to_dict()["robot"])
        self.assertEqual(told["held"]["left_finger_joint"], .04)
        self.assertEqual(armcal.inspect(
            ARMS, tip=CHAIN["tip"], posture="left_finger_joint=0.04",
            gravity="0,0,-3.7").to_dict()["robot"]["gravity"], [0, 0, -3.7])
        self.assertEqual(armcal.inspect(
            str(ARMS), tip="left_hand", gravity=[0, 1, -9]
        ).to_dict()["robot"]["gravity"], [0, 1, -9])

    def test_are_refused_beside_a_robot(self):
        """It has been read, and would take no notice of them."""
        robot = armcal.read_robot(ARMS, **CHAIN)
        values = {"base": "base", "tip": "left_hand", "posture": {"a": 1},
                  "gravity": [0, 0, 1], "robot_folder": "."}
        self.assertEqual(set(values), set(commands._CHAIN_FLAGS))
        for name, value in values.items():
            with self.assertRaisesRegex(ValueError,
                                        f"^{name}: give it to read_robot"):
                armcal.inspect(robot, **{name: value})

    def test_refusals(self):
        for options, text in (
                ({"posture": "left_finger_joint"}, "posture: found"),
                ({"posture": "left_finger_joint=far"}, "posture: found 'far'"),
                ({"gravity": "0,0,down"}, "gravity: found"),
                ({"tip": "no_hand"}, "no_hand")):
            with self.assertRaisesRegex(ValueError, text):
                armcal.inspect(ARMS, **{**CHAIN, **options})
        with self.assertRaisesRegex(TypeError, "^tip: found int 3"):
            armcal.inspect(ARMS, tip=3)


if __name__ == "__main__":
    unittest.main()
