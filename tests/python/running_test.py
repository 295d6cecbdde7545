"""Commands beside other threads of Python, and beside each other."""

import os
import pathlib
import signal
import sys
import tarfile
import tempfile
import threading
import time
import unittest

import armcal
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from arm_folder import InFolder


class Running(InFolder):

    def test_progress_while_other_threads_run(self):
        count, seen = [0], []

        def spin():
            while not seen or seen[-1][1] < 2:
                count[0] += 1
                time.sleep(1e-4)

        thread = threading.Thread(target=spin, daemon=True)
        thread.start()
        stages = []

        def progress(stage, share):
            stages.append((stage, share))
            seen.append((count[0], 0))

        armcal.calibrate(self.robot, "run1/log.csv", progress=progress)
        seen.append((count[0], 2))
        thread.join()
        self.assertGreater(seen[-1][0], seen[0][0])
        self.assertTrue(all(share <= 1 for _, share in stages))
        self.assertIn("opening the logs", [stage for stage, _ in stages])

    def test_exceptions_of_progress_end_it(self):
        def stop(stage, share):
            raise KeyError(stage)

        with self.assertRaises(KeyError):
            armcal.calibrate(self.robot, "run1/log.csv", progress=stop)

        armcal.calibrate(self.robot, "run1/log.csv")  # all is as before

    def test_progress_may_run_a_command(self):
        inspected = armcal.inspect(self.robot).files
        found = []

        def inspect(stage, share):
            if not found:
                found.append(armcal.inspect(self.robot).files)

        options = dict(log="run1/log.csv", trust=.3, bandwidth=9)
        result = armcal.calibrate(self.robot, progress=inspect, **options)
        self.assertEqual(found, [inspected])
        self.assertEqual(result.files,
                         armcal.calibrate(self.robot, **options).files)

    def test_ctrl_c(self):
        timer = threading.Timer(.05, os.kill, (os.getpid(), signal.SIGINT))
        self.addCleanup(timer.join)  # or it would end another test
        with self.assertRaises(KeyboardInterrupt):
            timer.start()
            # Takes a second; had it gone on to its end, it would have written.
            armcal.excite(self.robot, duration=60, out="design")
        self.assertFalse(os.path.exists("design"))


class AtOnce(InFolder):
    """Commands in several threads give what they give one after the other."""

    def tasks(self):
        one, two = "run1/log.csv", "run2/log.csv"
        yaml, robot = "arm.yaml", self.robot
        return [
            lambda: armcal.calibrate(robot, one, trust=.3, threads=1),
            lambda: armcal.calibrate(robot, two, validate=one, bandwidth=9,
                                     joint_terms=["viscous", "coulomb"]),
            lambda: armcal.diagnose(yaml, two, validate=one, seed=3,
                                    without=["vibration"], threads=2),
            lambda: armcal.simulate(robot, effects="elasticity@1;payload",
                                    seed=5, duration=5, log_rate=200),
            lambda: armcal.simulate(yaml, seed=6, duration=4, log_rate=100),
            lambda: armcal.verify(robot, one, crop=(2, 6), seed=7),
            lambda: armcal.inspect(robot, two, torque_kind="link"),
            lambda: armcal.calibrate(robot, one, crop=(1, 8),
                                     loss="cauchy", geometry="offsets"),
        ]

    @staticmethod
    def all_at_once(tasks):
        found = [None] * len(tasks)
        start = threading.Barrier(len(tasks))

        def run(k):
            start.wait()
            try:
                found[k] = tasks[k]()
            except Exception as error:  # as a result, which differs
                found[k] = error

        threads = [threading.Thread(target=run, args=(k,))
                   for k in range(len(tasks))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        return found

    def test_is_as_one_after_the_other(self):
        expected = [task() for task in self.tasks()]
        for _ in range(3):
            found = self.all_at_once(self.tasks())
            for one, other in zip(expected, found):
                self.assertIs(type(other), type(one), other)
                self.assertEqual(other.report(), one.report())
                self.assertEqual(set(other.files), set(one.files))
                for name, content in one.files.items():
                    self.assertEqual(other.files[name], content,
                                     f"{one!r}: {name}")

    def test_they_run_at_the_same_time(self):
        """Each waits in its progress until the other is there."""
        both = threading.Barrier(2, timeout=60)

        def meet():
            met = []

            def progress(stage, share):
                if not met:
                    met.append(both.wait())

            return progress

        found = self.all_at_once([
            lambda: armcal.calibrate(self.robot, "run1/log.csv",
                                     progress=meet()),
            lambda: armcal.diagnose(self.robot, "run2/log.csv",
                                    progress=meet())])
        self.assertIsInstance(found[0], armcal.Calibration, found[0])
        self.assertIsInstance(found[1], armcal.Diagnosis, found[1])


class Formats(unittest.TestCase):
    """What reads formats by other libraries, some in processes of their own,
    while other threads do the same."""

    YAML = """convention: standard
links:
  - {joint: revolute, mass: 1}
  - {joint: revolute, mass: 1}
"""

    def test_at_once(self):
        archive = (pathlib.Path(os.environ["DATA_DIR"]) /
                   "log_formats/written.tar.xz")
        robot = armcal.Robot.from_text(self.YAML, "yaml")
        names = ["v4.mat", "v5.mat", "v73.mat", "log.db3", "zstd.mcap",
                 "plain.mcap"]
        with tempfile.TemporaryDirectory() as folder:
            with tarfile.open(archive) as files:
                for name in names:
                    files.extract(f"./{name}", folder)
            tasks = [lambda path=os.path.join(folder, name): [
                armcal.read_log(path, robot).tau for _ in range(5)]
                     for name in names]
            expected = [task() for task in tasks]
            found = AtOnce.all_at_once(2 * tasks)
        for one, other in zip(2 * expected, found):
            np.testing.assert_array_equal(other, one)


if __name__ == "__main__":
    unittest.main()
