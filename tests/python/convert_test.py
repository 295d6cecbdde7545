"""Bags of ROS 1 and Parquet, converted, hold what the log held."""

import pathlib
import subprocess
import sys
import unittest
from unittest import mock

import armcal
import numpy as np
from armcal.convert import convert

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from arm_folder import InFolder

try:
    import pyarrow as pa
    import pyarrow.parquet as pq
except ImportError:
    pa = None
try:
    from rosbags.rosbag1 import Writer
    from rosbags.typesys import Stores, get_typestore
    ROS1 = get_typestore(Stores.ROS1_NOETIC)
except ImportError:
    Writer = None
NEEDS_PYARROW = unittest.skipIf(
    pa is None, "pyarrow is not here (tools/python_extras.sh)")
NEEDS_ROSBAGS = unittest.skipIf(
    Writer is None, "rosbags is not here (tools/python_extras.sh)")
STATE = "sensor_msgs/msg/JointState"
NAMES = ["joint1", "joint2"]


class Convert(InFolder):

    def setUp(self):
        rows = np.genfromtxt("run1/log.csv", delimiter=",", names=True)
        self.ns = np.round(1e9 * rows["t"]).astype(np.int64) + 17 * 10**17
        self.q, self.tau = (np.stack([rows[f"{s}1"], rows[f"{s}2"]], -1)
                            for s in ("q", "tau"))

    def expect_log(self, path, q, tau, **options):
        log = armcal.read_log(path, self.robot, **options)
        np.testing.assert_array_equal(log.q, q)
        np.testing.assert_array_equal(log.tau, tau)
        np.testing.assert_allclose(log.t, 1e-9 * (self.ns - self.ns[0]),
                                   atol=1e-12)
        return log

    def expect_refusal(self, words, *arguments):
        with self.assertRaises(armcal.InputError) as caught:
            convert(*arguments)
        self.assertIn(words, str(caught.exception))

    # -- Parquet -----------------------------------------------------------

    def write_parquet(self, path, columns):
        pq.write_table(pa.table(columns), path, row_group_size=300)

    @NEEDS_PYARROW
    def test_columns_by_their_names(self):
        self.write_parquet("named.parquet", {
            "time": pa.array(self.ns.astype("datetime64[ns]")),
            "note": ["text"] * len(self.ns),
            "joint2": pa.array([{"position": q, "effort": e} for q, e in
                                zip(self.q[:, 1], self.tau[:, 1])]),
            "q1": self.q[:, 0], "tau1": self.tau[:, 0]})
        said = convert("named.parquet", "named.npz")
        self.assertEqual(said[1], "left out: note (of string)")
        self.expect_log("named.npz", self.q, self.tau)

    @NEEDS_PYARROW
    def test_lists_in_the_order_of_their_names(self):
        turned = [list(row) for row in self.q[:, ::-1]]
        self.write_parquet("lists.parquet", {
            "t [ns]": self.ns, "position": turned,
            "effort": [list(row) for row in self.tau[:, ::-1]],
            "name": [NAMES[::-1]] * len(self.ns),
            "ragged": [[1.0]] * (len(self.ns) - 1) + [[1.0, 2.0]]})
        said = convert("lists.parquet", "lists.npz")
        self.assertEqual(said[1],
                         "left out: ragged (lists of different lengths)")
        self.expect_log("lists.npz", self.q, self.tau)

    @NEEDS_PYARROW
    def test_parquet_that_is_refused(self):
        self.write_parquet("texts.parquet", {"a": ["x"], "b": ["y"]})
        self.expect_refusal("texts.parquet: found 1 rows of a, b: expected "
                            "columns of numbers; left out: a (of string), "
                            "b (of string)", "texts.parquet", "texts.npz")
        self.assertFalse(pathlib.Path("texts.npz").exists())
        whole = pathlib.Path("texts.parquet").read_bytes()
        pathlib.Path("cut.parquet").write_bytes(whole[:len(whole) // 2])
        self.expect_refusal("cut.parquet: ", "cut.parquet", "cut.npz")

    # -- bags of ROS 1 -----------------------------------------------------

    def write_wrench(self, bag, values):
        if values is None:
            return
        kind = "geometry_msgs/msg/WrenchStamped"
        stamped, wrench, vector, header, time = (ROS1.types[name] for name in (
            kind, "geometry_msgs/msg/Wrench", "geometry_msgs/msg/Vector3",
            "std_msgs/msg/Header", "builtin_interfaces/msg/Time"))
        to = bag.add_connection("/ft", kind, typestore=ROS1)
        for k, ns in enumerate(self.ns.tolist()):
            six = [float(v) for v in values[k]]
            message = stamped(
                header=header(seq=k, stamp=time(*divmod(ns, 10**9)),
                              frame_id="tool"),
                wrench=wrench(force=vector(*six[:3]), torque=vector(*six[3:])))
            bag.write(to, ns + 10**6, ROS1.serialize_ros1(message, kind))

    def write_bag(self, path, topics, stamped=True, wrench=None):
        """topics: {topic: (names, positions, efforts)}; wrench: (N, 6)."""
        state, header, time, text = (ROS1.types[f"{name}"] for name in (
            STATE, "std_msgs/msg/Header", "builtin_interfaces/msg/Time",
            "std_msgs/msg/String"))
        with Writer(path) as bag:
            for topic, (names, positions, efforts) in topics.items():
                to = bag.add_connection(topic, STATE, typestore=ROS1)
                for k, ns in enumerate(self.ns.tolist()):
                    stamp = divmod(ns, 10**9) if stamped else (0, 0)
                    message = state(
                        header=header(seq=k, stamp=time(*stamp), frame_id=""),
                        name=names, position=positions[k],
                        velocity=np.zeros(0), effort=efforts[k])
                    bag.write(to, ns + 10**6,
                              ROS1.serialize_ros1(message, STATE))
            self.write_wrench(bag, wrench)
            chatter = bag.add_connection("/chatter", "std_msgs/msg/String",
                                         typestore=ROS1)
            bag.write(chatter, int(self.ns[-1]), ROS1.serialize_ros1(
                text(data="x"), "std_msgs/msg/String"))

    @NEEDS_ROSBAGS
    def test_topics_are_joined_by_stamps(self):
        self.write_bag("arm.bag", {
            f"/{name}/states": ([name], self.q[:, [k]], self.tau[:, [k]])
            for k, name in enumerate(NAMES)})
        said = convert("arm.bag", "arm_ros2")
        self.assertEqual(said, [
            f"arm_ros2: {len(self.ns)} messages of /joint1/states",
            f"arm_ros2: {len(self.ns)} messages of /joint2/states",
            "left out: /chatter (std_msgs/String)"])
        self.expect_log("arm_ros2", self.q, self.tau)

    @NEEDS_ROSBAGS
    def test_a_force_torque_sensor(self):
        wrench = self.q[:, :1] * np.arange(1.0, 7.0)
        self.write_bag("sensor.bag", {"/states": (NAMES, self.q, self.tau)},
                       wrench=wrench)
        said = convert("sensor.bag", "sensor_ros2")
        self.assertIn(f"sensor_ros2: {len(self.ns)} messages of /ft", said)
        log = self.expect_log("sensor_ros2", self.q, self.tau,
                              topics="wrench:/ft", wrench=True)
        np.testing.assert_array_equal(log.wrench, wrench)
        self.assertIsNone(self.expect_log("sensor_ros2", self.q, self.tau,
                                          wrench=True).wrench)

    @NEEDS_ROSBAGS
    def test_bags_that_are_refused(self):
        self.write_bag("chatter.bag", {})
        self.expect_refusal(
            "chatter.bag: has no messages of sensor_msgs/JointState or "
            "control_msgs/JointTrajectoryControllerState; it has /chatter "
            "(std_msgs/String)", "chatter.bag", "none")
        self.write_bag("still.bag", {"/states": (NAMES, self.q, self.tau)},
                       stamped=False)
        self.expect_refusal("still.bag: topic /states: the stamps in the "
                            "headers are all 0", "still.bag", "none")
        whole = pathlib.Path("still.bag").read_bytes()
        pathlib.Path("cut.bag").write_bytes(whole[:len(whole) // 2])
        self.expect_refusal("cut.bag: ", "cut.bag", "none")
        self.assertFalse(pathlib.Path("none").exists())

    # -- without any package -----------------------------------------------

    def test_what_needs_no_conversion_or_is_there(self):
        self.expect_refusal("absent.bag: cannot be read", "absent.bag", "new")
        self.expect_refusal("run1/log.csv: expected a bag of ROS 1 or a "
                            "Parquet file", "run1/log.csv", "new")
        pathlib.Path("some.bag").write_bytes(b"#ROSBAG V2.0\n")
        self.expect_refusal("run1: is there already", "some.bag", "run1")

    def test_a_missing_package_is_named(self):
        for first, package in ((b"#ROSBAG V2.0\n", "rosbags"),
                               (b"PAR1", "pyarrow")):
            pathlib.Path("any.log").write_bytes(first)
            hidden = {name: None for name in list(sys.modules)
                      if name.split(".")[0] == package}
            with mock.patch.dict(sys.modules, {**hidden, package: None}):
                with self.assertRaises(ImportError) as caught:
                    convert("any.log", "new")
            self.assertIn(f"`pip install {package}`", str(caught.exception))

    def test_the_command_line(self):
        done = subprocess.run(
            [sys.executable, "-m", "armcal.convert", "run1/log.csv", "new"],
            capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 3)
        self.assertTrue(done.stderr.startswith("armcal.convert: run1/log.csv"))


if __name__ == "__main__":
    program = unittest.main(exit=False)
    skipped = len(program.result.skipped)
    if skipped:
        print(f"{skipped} of {program.result.testsRun} tests skipped")
    sys.exit(not program.result.wasSuccessful())
