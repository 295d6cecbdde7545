"""Robots of texts and arrays, which are in no file."""

import hashlib
import os
import pathlib
import sys
import unittest

import armcal
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import planar_arm
from arm_folder import ARM, InFolder

MASS, LENGTH, INERTIA = 2.0, 0.5, 0.6  # kg, m, kg m^2 about the axis

MJCF = """<mujoco model="pendulum">
  <option gravity="0 0 -9.81"/>
  <worldbody><body name="bob">
    <joint name="swing" type="hinge" axis="0 1 0" damping="0.3"/>
    <inertial pos="0.5 0 0" mass="2" diaginertia="0.01 0.1 0.1"/>
  </body></worldbody>
</mujoco>"""


def pendulum(**more):
    """A bob on a rod along x, which turns about y: z of the bob falls by
    LENGTH sin q."""
    return armcal.Robot.from_arrays(
        inertial_parameters=[[MASS, MASS * LENGTH, 0, 0,
                              .05, 0, INERTIA, 0, 0, INERTIA]],
        **{"name": "pendulum", "joint_types": ["revolute"],
           "axes": [[0, 1, 0]], **more})


def planar(**more):
    """The arm of planar_arm.py; link frames are at their joints."""
    rows = [[m, m * r, 0, 0, .01, 0, i + m * r**2, 0, 0, i + m * r**2]
            for m, r, i in ((planar_arm.M1, planar_arm.R1, planar_arm.I1),
                            (planar_arm.M2, planar_arm.R2, planar_arm.I2))]
    tool = np.eye(4)
    tool[0, 3] = planar_arm.L2
    return armcal.Robot.from_arrays(
        joint_types=["revolute", "continuous"],
        inertial_parameters=np.array(rows), gravity=[0, -planar_arm.G, 0],
        tool=tool, viscous=[2, 1], coulomb=[3, 2], armature=[.3, .2],
        lower=[-2, -np.inf], upper=[2, np.inf], **{
            "xyz": [[0, 0, 0], [planar_arm.L1, 0, 0]], "name": "planar",
            **more})


class Branches(unittest.TestCase):

    def test_two_arms_on_a_base(self):
        """Each moves as if it were alone."""
        random = np.random.default_rng(3)
        rows = planar().inertial_parameters
        q, qd, qdd = random.uniform(-3, 3, (3, 20, 4))
        both = armcal.Robot.from_arrays(
            joint_types=["revolute"] * 4, parents=[-1, 0, -1, 2],
            xyz=[[0, 0, 0], [planar_arm.L1, 0, 0]] * 2, gravity=[0, -9.81, 0],
            inertial_parameters=np.vstack([rows, rows]))
        self.assertEqual(both.parents, [-1, 0, -1, 2])
        for arm in (slice(0, 2), slice(2, 4)):
            np.testing.assert_allclose(
                both.inverse_dynamics(q, qd, qdd)[:, arm],
                planar_arm.inverse_dynamics(q[:, arm], qd[:, arm],
                                            qdd[:, arm]),
                rtol=1e-12, atol=1e-12)
            np.testing.assert_allclose(both.mass_matrix(q)[:, arm, arm],
                                       planar_arm.mass_matrix(q[:, arm]),
                                       rtol=1e-12, atol=1e-12)
        self.assertFalse(both.mass_matrix(q)[:, :2, 2:].any())
        self.assertEqual(len(both.model_parameters),
                         2 * len(planar().model_parameters))

    def test_a_posture(self):
        path = pathlib.Path(os.environ["DATA_DIR"], "two_arms/robot.urdf")
        closed, opened = (armcal.read_robot(
            path, tip="left_hand,right_finger", posture={"left_finger_joint": x})
            for x in (0, .04))
        self.assertEqual(opened.held, {"left_finger_joint": .04,
                                       "left_finger_2_joint": .04})
        change = (opened.inertial_parameters - closed.inertial_parameters)[4]
        # Both fingers of 0.15 kg are 4 cm further out, along y.
        self.assertAlmostEqual(change[4], 2 * .15 * (.06**2 - .02**2))
        np.testing.assert_allclose(change[:4], 0, atol=1e-15)

    def test_refusals(self):
        for parents, text in (([0, 0], r"parents\[0\]: found 0"),
                              ([-1], "parents: found 1 numbers, expected 2")):
            with self.assertRaisesRegex(ValueError, text):
                planar(parents=parents)


class Closed(unittest.TestCase):

    def close(self, found, expected):
        np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-12)

    def test_pendulum(self):
        q = np.linspace(-3, 3, 50)[:, None]
        holds = -MASS * 9.81 * LENGTH * np.cos(q)
        self.close(pendulum().gravity_torque(q), holds)
        self.close(pendulum().mass_matrix(q)[:, 0], INERTIA + 0 * q)
        self.close(armcal.Robot.from_text(MJCF, "mjcf").gravity_torque(q),
                   holds)

    def test_pendulum_elsewhere(self):
        """Turned about its axis by a quarter, which is the same as q."""
        q = np.linspace(-3, 3, 50)[:, None]
        turned = pendulum(xyz=[[.3, -2, 1]], rpy=[[0, np.pi / 2, 0]])
        self.close(turned.gravity_torque(q),
                   pendulum().gravity_torque(q + np.pi / 2))
        pose = turned.link_poses(0 * q[:1])[0]  # at q = 0 the joint's
        self.close(pose[0, :3, 3], [.3, -2, 1])
        again = pendulum(poses=pose)
        self.close(again.gravity_torque(q), turned.gravity_torque(q))

    def test_two_links(self):
        robot = planar()
        q, qd, qdd = np.random.default_rng(2).uniform(-3, 3, (3, 50, 2))
        self.close(robot.inverse_dynamics(q, qd, qdd),
                   planar_arm.inverse_dynamics(q, qd, qdd))
        self.close(robot.tool_pose(q)[:, :2, 3], planar_arm.tip(q))
        self.assertEqual(robot.joint_types, ["revolute", "continuous"])
        self.assertEqual(list(robot.viscous), [2, 1])
        self.assertEqual(list(robot.upper), [2, np.inf])
        self.assertEqual((robot.name, robot.path, robot.source),
                         ("planar", "", "planar.yaml"))

    def test_refusals(self):
        for more, text in (
                (dict(joint_types="revolute"), "joint_types: found 'revolute'"),
                (dict(joint_types=["ball"]), "ball"),
                (dict(axes=[[0, 0, 0]]), r"axis.*not zero"),
                (dict(axes=[0, 0, 1]), r"axes: found shape \(3,\)"),
                (dict(gravity=[0, 0, np.nan]), "gravity: expected finite"),
                (dict(poses=[2 * np.eye(4)]), r"poses\[0\]: found last row"),
                (dict(poses=[np.diag([2, 1, 1, 1])]), "expected a rotation"),
                (dict(xyz=[[0, 0, 0]], poses=[np.eye(4)]), "either poses"),
                (dict(joint_names=["a", "b"]), "expected 1 texts")):
            with self.assertRaisesRegex(ValueError, text):
                pendulum(**more)
        for text, more, said in (
                ("<robot", {}, "^arm.urdf: line 1"),
                ("", {}, "^arm.urdf: the text is empty"),
                (MJCF, dict(format="xml"), "format: found 'xml'"),
                ("links: [", dict(format="yaml"), "^arm.yaml: line")):
            with self.assertRaisesRegex(ValueError, said):
                armcal.Robot.from_text(text, name="arm", **more)


class Commands(InFolder):

    def test_a_text_is_as_its_file(self):
        """But for where it is named, and a report's line that names it."""
        pathlib.Path("made.urdf").write_text(self.robot.to_urdf())
        for path in ("arm.yaml", "made.urdf"):
            text = pathlib.Path(path).read_text()
            name, ending = path.split(".")
            in_memory = armcal.Robot.from_text(text, ending, name=name)
            for command in (armcal.calibrate, armcal.diagnose):
                of_file = command(path, "run1/log.csv")
                of_text = command(in_memory, "run1/log.csv")
                self.assertEqual(of_text.files, of_file.files)
            self.assertIn(hashlib.sha256(text.encode()).hexdigest(),
                          of_text.files["report.html"].decode())
            self.assertEqual(in_memory.text, text)

    def test_every_command(self):
        robot = planar()
        simulated = armcal.simulate(robot, duration=8, log_rate=200, seed=3)
        log = simulated.log
        result = armcal.calibrate(robot, log)
        self.assertTrue(result.passed, result.report())
        self.assertEqual(result.files["robot.urdf"].decode(),
                         result.robot.to_urdf())
        np.testing.assert_allclose(result.robot.viscous, [2, 1], atol=.2)
        self.assertTrue(armcal.verify(robot, log,
                                      calibration=result).passed)
        self.assertTrue(armcal.diagnose(robot, log, forward=False).verdict)
        self.assertTrue(armcal.inspect(robot, log).report())
        self.assertEqual(armcal.excite(
            robot, duration=4, harmonics=2, position_limits=(-1, 1),
            velocity_limits=2).trajectory.q.shape[1], 2)
        reduced = armcal.reduce(robot, log)
        self.assertEqual(
            reduced.to_dict()["model"]["robot_sha256"],
            hashlib.sha256(robot.text.encode()).hexdigest())
        self.assertTrue(armcal.merge(robot, reduced).passed)
        self.assertEqual(ARM, self.robot.text)


if __name__ == "__main__":
    unittest.main()
