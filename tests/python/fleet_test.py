"""Fleets: what is planted is found, whoever reduces the logs."""

import hashlib
import os
import pathlib
import pickle
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import armcal
from armcal.fleet import read_table, reduce_logs

import fleet_units

try:
    import distributed
except ImportError:
    distributed = None
ARMCAL = os.environ["ARMCAL"]
TOOL = pathlib.Path(__file__).parents[2] / "tools" / "fleet.py"
SETTINGS = [f"{name}={value}" for name, value in fleet_units.MODEL.items()]


def digest(path):
    return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()


class Deadly(distributed.WorkerPlugin if distributed else object):
    """A worker that tries to reduce this log ends without a word, as one does
    that the system stops for want of memory."""

    def __init__(self, log):
        self.log = log

    def setup(self, worker):
        from armcal import fleet
        reduce_one = fleet.reduce_one

        def deadly(robot, recording, *how):
            if recording.log == self.log:
                os._exit(9)
            return reduce_one(robot, recording, *how)

        fleet.reduce_one = deadly


class Fleet(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        cls.truth = fleet_units.write_units(cls.folder, 24, long_s=8)
        cls.robot = armcal.read_robot(cls.folder / "arm.yaml")
        # By xargs, as docs/fleet.md has it.
        lines = [f"{r.log} {r.unit} {r.date}"
                 for r in read_table(cls.folder / "units.csv")]
        subprocess.run(
            ["xargs", "-P2", "-L1", "sh", "-c",
             f"{ARMCAL} reduce --robot=arm.yaml --log=$0 --unit=$1 --date=$2 "
             "--quiet --out=factors " + " ".join("--" + s for s in SETTINGS)],
            input="\n".join(lines), text=True, cwd=cls.folder, check=True)
        cls.merged = armcal.merge(cls.robot, cls.folder / "factors",
                                  out=cls.folder / "merged")

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def test_workers_read_the_same_chain(self):
        """They had the file's gravity, and fingers at 0 whatever the posture."""
        from armcal import fleet
        arms = pathlib.Path(os.environ["DATA_DIR"]) / "two_arms/robot.urdf"
        chain = {"tip": "left_hand,right_finger", "gravity": (0, 0, -3.7),
                 "posture": {"left_finger_joint": .04}}
        texts = {"text": arms.read_text(), "name": "arms"}
        for robot in (armcal.read_robot(arms, **chain),
                      armcal.Robot.from_text(**texts, **chain)):
            again = fleet._robot_of(pickle.loads(pickle.dumps(
                fleet._place_of(robot))))
            self.assertEqual(list(again.gravity), [0, 0, -3.7])
            self.assertEqual(again.posture, {"left_finger_joint": .04})
            self.assertEqual(again.source, robot.source)
            self.assertTrue((again.inertial_parameters ==
                             robot.inertial_parameters).all())

    def test_outliers_and_drift(self):
        fleet = self.merged.fleet
        found = {(o["unit"], o["parameter"]) for o in fleet["outliers"]}
        self.assertEqual(found, {(f"u{unit:03d}", name) for unit, (name, _)
                                 in fleet_units.OUTLIERS.items()})
        self.assertEqual([p["name"] for p in fleet["parameters"]
                          if p["drifts"]], [fleet_units.DRIFT[0]])

    def test_units_are_near_their_truth(self):
        fleet = self.merged.fleet
        names = [p["name"] for p in fleet["parameters"]]
        squares = []
        for unit, truth in zip(fleet["units"], self.truth):
            for term in ("viscous", "coulomb"):
                for joint in range(2):
                    k = names.index(f"{term}[{joint + 1}]")
                    squares.append(((unit["values"][k] - truth[term][joint]) /
                                    unit["stddev"][k]) ** 2)
        # 96 squares, mean 1 +- 0.14.
        self.assertLess(sum(squares) / len(squares), 1.7)

    def test_from_python_as_by_xargs(self):
        first = read_table(self.folder / "units.csv")[0]
        made = armcal.reduce(self.robot, first.log, unit=first.unit,
                             date=first.date, **fleet_units.MODEL)
        (name, content), = made.files.items()
        self.assertEqual(content, (self.folder / "factors" / name).read_bytes())
        self.assertEqual(made.to_dict()["logs"][0]["unit"], first.unit)
        alone = armcal.merge(self.robot, made)
        self.assertIsNone(alone.fleet)
        self.assertEqual(len(alone.model_parameters), 13)

    @unittest.skipIf(distributed is None, "python3-distributed is not here")
    def test_by_dask(self):
        made = subprocess.run(
            [sys.executable, TOOL, "--robot=arm.yaml", "--table=units.csv",
             "--out=dask", "--workers=2", *(f"--set={s}" for s in SETTINGS)],
            cwd=self.folder, check=False, capture_output=True, text=True)
        self.assertEqual((made.returncode, made.stderr), (0, ""))
        self.assertEqual(made.stdout, self.merged.report())
        for name in ("fleet.json", "calibration.json", "merged.factor"):
            self.assertEqual(digest(self.folder / "dask" / name),
                             digest(self.folder / "merged" / name), name)

    @unittest.skipIf(distributed is None, "python3-distributed is not here")
    def test_worker_killed(self):
        recordings = read_table(self.folder / "units.csv")
        (self.folder / "bad.csv").write_text("t,q1\n0,0\n")
        recordings.append(type(recordings[0])(str(self.folder / "bad.csv")))
        killed = []

        def kill(count, _total):
            if count >= 4 and not killed:
                pid = next(iter(client.run(os.getpid).values()))
                killed.append(pid)
                os.kill(pid, 9)

        with fleet_units.cluster_of(2) as client:
            files, refused = reduce_logs(
                client, self.robot, recordings, str(self.folder / "killed"),
                like=sorted(map(str, self.folder.glob("factors/*")))[0],
                done=kill)
        self.assertEqual(len(killed), 1)
        self.assertEqual([pathlib.Path(log).name for log in refused],
                         ["bad.csv"])
        self.assertEqual(
            {pathlib.Path(path).name: digest(path) for path in files},
            {path.name: digest(path)
             for path in self.folder.glob("factors/*")})

    @unittest.skipIf(distributed is None, "python3-distributed is not here")
    def test_goes_on_after_an_interruption(self):
        folder = self.folder / "resumed"
        recordings = read_table(self.folder / "units.csv")

        def stop(count, _total):
            if count == 9:
                raise KeyboardInterrupt

        def reduce_all(client, done=None, **changed):
            told = []
            files, refused = reduce_logs(
                client, self.robot, recordings, str(folder),
                done=done or (lambda count, total: told.append(count)),
                **{**fleet_units.MODEL, **changed})
            self.assertEqual((len(files), refused), (24, {}))
            self.assertEqual(told, list(range(1, 25)))
            return {pathlib.Path(path).name: digest(path) for path in files}

        def times():
            return {path.name: path.stat().st_mtime_ns
                    for path in folder.glob("*.factor")}

        expected = {path.name: digest(path)
                    for path in self.folder.glob("factors/*")}
        with fleet_units.cluster_of(2) as client:
            with self.assertRaises(KeyboardInterrupt):
                reduce_all(client, stop)
            early = times()
            self.assertEqual(len(early), 9)
            # As if the power had failed while the last line was written.
            manifest = folder / "manifest.jsonl"
            manifest.write_bytes(manifest.read_bytes()[:-20])
            self.assertEqual(reduce_all(client), expected)
            late = times()
            self.assertEqual(sum(late[name] == early[name] for name in early), 8)
            # All are there; then a log changes, and a factor file is damaged.
            self.assertEqual(reduce_all(client), expected)
            self.assertEqual(times(), late)
            os.utime(recordings[3].log)
            damaged = sorted(folder.glob("*.factor"))[5]
            damaged.write_bytes(damaged.read_bytes()[:-1])
            self.assertEqual(reduce_all(client), expected)
            made_again = [name for name in late if times()[name] != late[name]]
            self.assertEqual(len(made_again), 2)
            # With another setting nothing is taken over.
            reduce_all(client, window=.4)
            self.assertFalse(set(times().values()) & set(late.values()))

    @unittest.skipIf(distributed is None, "python3-distributed is not here")
    def test_a_log_that_kills_is_refused_alone(self):
        recordings = read_table(self.folder / "units.csv")
        with unittest.mock.patch("armcal.fleet._in_tasks",
                                 lambda todo, _: [todo[:12], todo[12:]]):
            with fleet_units.cluster_of(2) as client:
                client.register_worker_plugin(Deadly(recordings[5].log))
                files, refused = reduce_logs(
                    client, self.robot, recordings, str(self.folder / "lost"),
                    **fleet_units.MODEL)
        self.assertEqual(len(files), 23)
        self.assertEqual(list(refused), [recordings[5].log])
        self.assertIn("died", refused[recordings[5].log])


if __name__ == "__main__":
    unittest.main()
