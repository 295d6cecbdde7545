"""Robots and their dynamics against closed forms."""

import gzip
import os
import pathlib
import sys
import tempfile
import threading
import time
import unittest

import armcal
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import planar_arm

DATA = pathlib.Path(os.environ["DATA_DIR"])


def read_text(text, name="arm.yaml", **options):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, name)
        path.write_text(text)
        return armcal.read_robot(path, **options)


class PlanarArm(unittest.TestCase):

    def setUp(self):
        self.robot = read_text(planar_arm.YAML)
        random = np.random.default_rng(1)
        self.q, self.qd, self.qdd = random.uniform(-3, 3, (3, 50, 2))

    def close(self, found, expected):
        self.assertEqual(found.shape, expected.shape)
        np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-12)

    def test_inverse_dynamics(self):
        self.close(self.robot.inverse_dynamics(self.q, self.qd, self.qdd),
                   planar_arm.inverse_dynamics(self.q, self.qd, self.qdd))

    def test_mass_matrix_and_gravity(self):
        self.close(self.robot.mass_matrix(self.q),
                   planar_arm.mass_matrix(self.q))
        self.close(self.robot.gravity_torque(self.q),
                   planar_arm.gravity_torque(self.q))

    def test_forward_dynamics_has_the_armature(self):
        armature = np.array([.3, .2])
        tau = planar_arm.inverse_dynamics(self.q, self.qd, self.qdd)
        self.close(self.robot.forward_dynamics(self.q, self.qd,
                                               tau + armature * self.qdd),
                   self.qdd)

    def test_forward_kinematics(self):
        self.close(self.robot.tool_pose(self.q)[:, :2, 3],
                   planar_arm.tip(self.q))
        self.close(self.robot.link_poses(self.q)[:, 1], self.robot.tool_pose(
            self.q))

    def test_regressor(self):
        Y = self.robot.regressor(self.q, self.qd, self.qdd)
        self.assertEqual(Y.shape, (50, 2, 20))
        V = self.robot.inertial_parameters
        self.close(Y @ V.ravel(),
                   planar_arm.inverse_dynamics(self.q, self.qd, self.qdd))
        # Link 1's inertia about its end: m r^2 further, by the parallel axes.
        self.assertAlmostEqual(V[0, 9], .07 + 5 * .2**2, places=12)
        self.assertEqual(armcal.INERTIAL_NAMES[9], "Izz")

    def test_one_sample_has_no_first_axis(self):
        one = self.robot.inverse_dynamics(self.q[3], self.qd[3], self.qdd[3])
        self.close(one, planar_arm.inverse_dynamics(self.q, self.qd,
                                                    self.qdd)[3])
        self.assertEqual(self.robot.mass_matrix(self.q[0]).shape, (2, 2))
        self.assertEqual(self.robot.link_poses(self.q[0]).shape, (2, 4, 4))

    def test_any_memory_order_and_type(self):
        expected = self.robot.inverse_dynamics(self.q, self.qd, self.qdd)
        for change in (np.asfortranarray, lambda a: a.tolist(),
                       lambda a: np.repeat(a, 2, axis=0)[::2]):
            np.testing.assert_array_equal(self.robot.inverse_dynamics(
                change(self.q), change(self.qd), change(self.qdd)), expected)
        single = [a.astype(np.float32) for a in (self.q, self.qd, self.qdd)]
        np.testing.assert_array_equal(
            self.robot.inverse_dynamics(*single),
            self.robot.inverse_dynamics(*[a.astype(float) for a in single]))

    def test_wrong_shapes(self):
        q = self.q
        for call, text in (
                (lambda: self.robot.gravity_torque(np.zeros((100, 5))),
                 r"q: found shape \(100, 5\), expected \(N, 2\)"),
                (lambda: self.robot.gravity_torque(0.5), r"q: found shape \(\)"),
                (lambda: self.robot.gravity_torque(np.zeros((2, 2, 2))),
                 r"q: found shape \(2, 2, 2\)"),
                (lambda: self.robot.inverse_dynamics(q, q[:7], q),
                 r"qd: found shape \(7, 2\), expected \(50, 2\)"),
                (lambda: self.robot.inverse_dynamics(q, q, q[0]),
                 r"qdd: found shape \(2,\), expected \(50, 2\)"),
                (lambda: self.robot.mass_matrix(["a", "b"]),
                 "q: expected an array of numbers"),
                (lambda: self.robot.mass_matrix(None), "q: "),
                (lambda: self.robot.replace(inertial_parameters=q),
                 r"inertial_parameters: found shape \(50, 2\)"),
                (lambda: self.robot.replace(viscous=[1, -1]),
                 r"viscous\[1\]: found -1"),
                (lambda: self.robot.replace(gravity=np.ones((2, 3))),
                 "gravity")):
            with self.assertRaisesRegex(ValueError, text):
                call()
        self.assertEqual(self.robot.mass_matrix(np.zeros((0, 2))).shape,
                         (0, 2, 2))
        self.assertTrue(np.isnan(self.robot.gravity_torque([np.nan, 0])).any())

    def test_replace_leaves_the_robot_alone(self):
        V = self.robot.inertial_parameters
        V[1] = 0
        other = self.robot.replace(inertial_parameters=V, viscous=[5, 6],
                                   gravity=[0, 0, -9.81])
        self.assertEqual(self.robot.inertial_parameters[1, 0], 3)
        self.assertEqual(other.inertial_parameters[1, 0], 0)
        self.assertEqual(list(other.viscous), [5, 6])
        np.testing.assert_allclose(other.gravity_torque(self.q), 0, atol=1e-12)

    def test_other_threads_run_meanwhile(self):
        q = np.zeros((20_000, 2))  # some tenths of a second
        counted, running = [], threading.Event()

        def count():
            running.wait()
            for _ in range(3):
                time.sleep(1e-3)
                counted.append(1)

        thread = threading.Thread(target=count)
        thread.start()
        running.set()
        self.robot.regressor(q, q, q)
        self.assertEqual(len(counted), 3)
        thread.join()


class Files(unittest.TestCase):

    def test_scara_has_the_papers_torques(self):
        # data/scara/make_logs.py: the paper's closed form.
        robot = armcal.read_robot(DATA / "scara/robot.yaml")
        with gzip.open(DATA / "scara/B.csv.gz", "rt") as file:
            names = file.readline().strip().split(",")
            rows = np.loadtxt(file, delimiter=",")
        signal = {s: rows[:, [names.index(f"{s}{k}") for k in range(1, 5)]]
                  for s in ("q", "qd", "qdd", "tau")}
        found = robot.inverse_dynamics(signal["q"], signal["qd"],
                                       signal["qdd"])
        np.testing.assert_allclose(found, signal["tau"], atol=1e-9)
        self.assertEqual(robot.joint_names,
                         ["shoulder", "elbow", "lift", "wrist"])
        self.assertEqual(robot.effort_units, ["N m", "N m", "N", "N m"])

    def test_urdf_and_back(self):
        robot = armcal.read_robot(DATA / "scara/robot.yaml")
        again = read_text(robot.to_urdf(), "arm.urdf", gravity=robot.gravity)
        q, qd, qdd = np.random.default_rng(2).uniform(-1, 1, (3, 20, 4))
        np.testing.assert_allclose(again.inverse_dynamics(q, qd, qdd),
                                   robot.inverse_dynamics(q, qd, qdd),
                                   rtol=1e-9, atol=1e-9)
        self.assertTrue(robot.urdf_losses())  # gravity along z

    def test_bad_files(self):
        with self.assertRaisesRegex(armcal.InputError, "nowhere.urdf"):
            armcal.read_robot("nowhere.urdf")
        with self.assertRaisesRegex(ValueError, "arm.yaml.*expected"):
            read_text(planar_arm.YAML.replace("revolute", "ball", 1))
        with self.assertRaises(TypeError):
            armcal.read_robot(3)


if __name__ == "__main__":
    unittest.main()
