"""Commands give what the armcal binary gives, from files and from arrays."""

import gzip
import json
import os
import pathlib
import sys
import unittest

import armcal
import numpy as np
from armcal import option_kinds

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from arm_folder import InFolder

SCARA = pathlib.Path(os.environ["DATA_DIR"]) / "scara"


class Calibrate(InFolder):

    def test_refined_as_the_command_line(self):
        printed = self.armcal(
            "calibrate", "--robot=arm.yaml", "--log=run1/log.csv",
            "--validate=run2/log.csv", "--trust=0.3", "--crop=1:9",
            "--out=refined")
        result = armcal.calibrate(self.robot, "run1/log.csv",
                                  validate=pathlib.Path("run2/log.csv"),
                                  trust=0.3, crop=(1, 9))
        self.expect_files(result, "refined")
        self.assertEqual(result.report(), printed)
        expected = json.loads(pathlib.Path(
            "refined/calibration.json").read_text())
        self.assertEqual(result.to_dict(), expected)
        self.assertTrue(result.passed and result.converged)
        self.check_parameters(result, expected)
        # What armcal writes for simulators is what the robot is.
        with open("again.urdf", "w", encoding="utf-8") as file:
            file.write(result.robot.to_urdf())
        self.assertEqual(pathlib.Path("again.urdf").read_bytes(),
                         result.files["robot.urdf"])
        result.write("written")
        self.assertEqual(pathlib.Path("written/calibration.json").read_bytes(),
                         result.files["calibration.json"])

    def check_parameters(self, result, expected):
        self.assertEqual(result.estimate, "refined")
        self.assertEqual(result.names,
                         [p["name"] for p in expected["parameters"]])
        self.assertEqual(result.covariance.shape, 2 * (len(result.names),))
        # Two ways of writing one number.
        np.testing.assert_allclose(
            np.sqrt(np.diag(result.covariance)[result.identifiable]),
            result.stddev[result.identifiable], rtol=1e-12)
        self.assertTrue(np.isinf(result.stddev[~result.identifiable]).all())
        self.assertEqual(result.parameters["joint1.viscous"],
                         result.robot.viscous[0])
        self.assertEqual(len(result.model_parameters),
                         len(expected["model_parameters"]))

    def test_linear_and_its_torques(self):
        logs = [SCARA / "A.csv.gz", SCARA / "B.csv.gz"]
        options = dict(geometry="lengths", bandwidth=0, joint_terms="none")
        result = armcal.calibrate(SCARA / "robot.yaml", logs,
                                  validate=SCARA / "C.csv.gz",
                                  estimate="linear", **options)
        self.assertEqual((result.estimate, result.robot), ("linear", None))
        found = dict(zip(result.names, result.values))
        for name, value in {"Izz[1]": 17.55, "Izz[2]": 7.55, "m[3]": 3.11,
                            "a1*hx[2]": 2.343}.items():  # the paper's
            self.assertAlmostEqual(found[name], value, places=6)
        self.assertIn("scara: 6 model parameters", result.brief_report())
        traces = result.torques()
        self.assertEqual([trace.path for trace in traces],
                         [str(log) for log in logs])
        with gzip.open(logs[1], "rt") as file:
            names = file.readline().strip().split(",")
            rows = np.loadtxt(file, delimiter=",")
        tau = rows[:, [names.index(f"tau{k}") for k in range(1, 5)]]
        np.testing.assert_allclose(traces[1].t, rows[:, 0] - rows[0, 0],
                                   atol=1e-9)
        np.testing.assert_allclose(traces[1].measured, tau, atol=1e-9)
        np.testing.assert_allclose(traces[1].predicted, tau, atol=1e-6)

    def test_torques_are_those_of_the_residual_figures(self):
        # Without filters, which differ for the two.
        result = armcal.calibrate(self.robot, "run1/log.csv", bandwidth=0,
                                  validate="run2/log.csv")
        for log, prefix in ((None, ""), ("run2/log.csv", "validation_")):
            (trace,) = result.torques(log)
            rms = np.sqrt(np.mean((trace.measured - trace.predicted)**2, 0))
            np.testing.assert_allclose(
                rms, [joint[prefix + "whole_log_residual_rms"]
                      for joint in result.joints], rtol=1e-9)

    def test_arrays_as_the_file(self):
        rows = np.genfromtxt("run1/log.csv", delimiter=",", names=True)
        signals = {name: np.stack([rows[f"{name}{k}"] for k in (1, 2)], -1)
                   for name in ("q", "tau")}
        log = armcal.Log(t=rows["t"], name="log.csv", simulated=True, **signals)
        from_arrays = armcal.calibrate(self.robot, log)
        from_file = armcal.calibrate(self.robot, "run1/log.csv")
        self.assertEqual(
            from_arrays.files["calibration.json"],
            from_file.files["calibration.json"].replace(b"run1/log.csv",
                                                        b"log.csv"))
        for name in ("covariance.csv", "parameters_covariance.csv"):
            self.assertEqual(from_arrays.files[name], from_file.files[name])
        (trace,) = from_arrays.torques()
        self.assertGreater(len(trace.t), 900)
        read = armcal.read_log("run1/log.csv", self.robot)
        np.testing.assert_array_equal(read.q, signals["q"])
        np.testing.assert_allclose(read.t, rows["t"] - rows["t"][0],
                                   atol=1e-12)

    def test_a_force_torque_sensor_in_arrays_as_in_the_file(self):
        read = armcal.read_log("run1/log.csv", self.robot)
        wrench = np.outer(np.sin(read.t), np.arange(1.0, 7.0))
        log = armcal.Log(t=read.t, q=read.q, tau=read.tau, wrench=wrench)
        log.savez("sensor.npz")
        np.testing.assert_array_equal(
            armcal.read_log("sensor.npz", self.robot, wrench=True).wrench,
            wrench)
        self.assertIsNone(armcal.read_log("sensor.npz", self.robot).wrench)
        with self.assertRaisesRegex(ValueError, r"wrench: found shape .*, 5\)"):
            armcal.Log(t=read.t, q=read.q, tau=read.tau, wrench=wrench[:, :5])

    def test_refusals(self):
        log = "run1/log.csv"
        short = armcal.Log(t=[0, 1], q=np.zeros((2, 3)), tau=np.zeros((2, 3)),
                           name="monday")
        for options, text in (
                (dict(log=log, geometry="round"),
                 "--geometry: found 'round', expected one of"),
                (dict(log=log, geometri="known"), "did you mean --geometry"),
                (dict(log=log, gravity="0,0,1"), "gravity: give it to read"),
                (dict(log=log, validate=log), "--validate names run1/log.csv"),
                (dict(log="a,b.csv"), "log: found 'a,b.csv'"),
                (dict(log=log, crop=(1, 2, 3)), "crop: found 3 numbers"),
                (dict(log="nowhere.csv"), "nowhere.csv"),
                (dict(log=None), "--log=FILE is needed"),
                (dict(log=short), "^monday: ")):
            with self.assertRaisesRegex(ValueError, text):
                armcal.calibrate(self.robot, **options)
        for arrays, text in (
                (dict(t=[0, 1], q=[[1, 2]]), r"q: found shape \(1, 2\)"),
                (dict(t=[0, 1], q=np.zeros((2, 3)), tau=np.zeros((2, 2))),
                 r"tau: found shape \(2, 2\), expected \(2, 3\)"),
                (dict(t=[[0]], q=[[1]]), r"t: found shape \(1, 1\)")):
            with self.assertRaisesRegex(ValueError, text):
                armcal.Log(**arrays)

    def test_refuses_other_types(self):
        for option, value, expected in (
                ("trust", object(), "a number"), ("trust", True, "a number"),
                ("trust", [1], "a number"), ("bandwidth", (1, 2), "a number"),
                ("threads", 1.5, "a whole number"),
                ("select", 1, "True or False"), ("geometry", 3, "'known'"),
                ("crop", 3, "a pair of numbers"), ("poses", 3, "a path"),
                ("joint_terms", ["viscous", 1], "'viscous'"),
                ("torque_constants", [1, None], "a list of numbers"),
                ("validate", [3], "a path, a Log")):
            with self.assertRaisesRegex(
                    TypeError, f"^{option}: found .*, expected .*{expected}"):
                armcal.calibrate(self.robot, "run1/log.csv",
                                 **{option: value})
        for option, value, text in (
                ("trust", "much", "--trust: found 'much', expected a number"),
                ("threads", -1, "--threads: found '-1'"),
                ("intervals", [(0, 1, 2)], "intervals: found 3 numbers")):
            with self.assertRaisesRegex(ValueError, text):
                armcal.calibrate(self.robot, "run1/log.csv",
                                 **{option: value})

    def test_takes_numpy_and_pairs(self):
        text = option_kinds.option_text
        for name, value, expected in (
                ("trust", np.float32(.5), "0.5"), ("trust", 1, "1"),
                ("threads", np.int64(2), "2"), ("select", np.bool_(1), "true"),
                ("torque_constants", np.array([11., .5]), "11.0,0.5"),
                ("crop", (2, None), "2:"), ("crop", [None, 3.5], ":3.5"),
                ("position_limits", (-1, 1), "-1:1"),
                ("position_limits", [(-1, 1), (0, 2)], "-1:1,0:2"),
                ("tool_box", ((0, 1), (0, 1), (0, 2)), "0:1,0:1,0:2"),
                ("obstacles", [((0, 1), (0, 1), (0, 2))] * 2,
                 "0:1,0:1,0:2;0:1,0:1,0:2"),
                ("without", ("backlash", "delay"), "backlash,delay"),
                ("validate", [pathlib.Path("a"), "b"], "a,b")):
            self.assertEqual(text(name, value), expected)


class OtherCommands(InFolder):

    def test_diagnose(self):
        flags = ["--validate=run2/log.csv", "--forward=false",
                 "--without=vibration,presliding"]
        self.armcal("diagnose", "--robot=arm.yaml", "--log=run1/log.csv",
                    "--out=diagnosed", *flags)
        result = armcal.diagnose(self.robot, "run1/log.csv",
                                 validate="run2/log.csv", forward=False,
                                 without=["vibration", "presliding"])
        self.expect_files(result, "diagnosed")
        self.assertEqual(result.verdict, result.to_dict()["verdict"])
        self.assertTrue(result.brief_report())
        self.assertEqual(result.robot.num_joints, 2)

    def test_compare_and_samples(self):
        first = armcal.calibrate(self.robot, "run1/log.csv",
                                 export=["samples:2"])
        self.assertIn("samples/robot_2.urdf", first.files)
        samples = pathlib.Path("sampled/samples")
        samples.mkdir(parents=True)
        for name in ("robot_3.urdf", "mine.urdf"):
            (samples / name).touch()
        first.write("sampled")
        self.assertEqual({path.name for path in samples.iterdir()},
                         {"robot_1.urdf", "robot_2.urdf", "mine.urdf"})
        self.armcal("calibrate", "--robot=arm.yaml", "--log=run2/log.csv",
                    "--out=second")
        compared = armcal.compare([first, "second"], robot=self.robot,
                                  log="run2/log.csv")
        found = compared.to_dict()
        self.assertEqual(compared.passed, found["agrees"])
        self.assertEqual(bool(compared.disagreements), not compared.passed)
        self.assertEqual(len(found["held_out"]["results"]), 2)
        of_files = json.loads(self.armcal(
            "compare", "sampled", "second", "--robot=arm.yaml",
            "--log=run2/log.csv", "--json"))
        self.assertEqual(of_files["pairs"], found["pairs"])

    def test_simulate_inspect_verify_excite(self):
        result = armcal.simulate(self.robot, duration=10, log_rate=100,
                                 robot_error=0.02, run=1)
        self.expect_files(result, "run1")
        self.assertEqual(result.log.tau.shape, (len(result.log), 2))

        self.armcal("inspect", "--robot=arm.yaml", "--log=run1/log.csv",
                    "--out=inspected")
        inspected = armcal.inspect(self.robot, "run1/log.csv")
        self.assertEqual(
            inspected.files["inspect.json"],
            pathlib.Path("inspected/inspect.json").read_bytes())

        calibration = armcal.calibrate(self.robot, result.log)
        verified = armcal.verify(self.robot, calibration=calibration)
        self.assertTrue(verified.passed, verified.report())
        self.assertEqual(verified.to_dict()["calibration"],
                         "calibration.json")

        diagnosed = armcal.diagnose(self.robot, result.log,
                                    calibration=calibration, forward=False)
        self.assertEqual(diagnosed.to_dict()["calibration"],
                         "calibration.json")
        self.assertEqual(diagnosed.to_dict()["effects"], [])
        self.assertIn("the calibration was fitted to", diagnosed.report())

        excited = armcal.excite(self.robot, duration=4, harmonics=2,
                                position_limits="-1:1", velocity_limits=2)
        self.assertEqual(excited.trajectory.q.shape,
                         excited.trajectory.qd.shape)
        self.assertLessEqual(np.abs(excited.trajectory.q).max(), 1 + 1e-9)

    def test_a_robot_that_is_in_no_file(self):
        gone = self.robot.replace(gravity=[0, 0, -9.81])
        self.assertLess(
            np.abs(armcal.simulate(gone, duration=2, torque_noise=0,
                                   coloured_noise=0).log.tau).max(), 60)
        found = armcal.calibrate(gone, "run1/log.csv").robot
        self.assertEqual(list(found.gravity), [0, 0, -9.81])


if __name__ == "__main__":
    unittest.main()
