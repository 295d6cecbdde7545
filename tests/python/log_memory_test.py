"""Logs of arrays: commands read them where they are, and do as with files."""

import hashlib
import json
import pathlib
import sys
import unittest
from unittest import mock

import armcal
import numpy as np
from armcal import inputs

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from arm_folder import InFolder

CONTROLLER = "law: pd\nrate: 1000\nbandwidth: 8\n"


def log_of(path, name, *signals):
    """What a CSV of two joints holds, number for number."""
    rows = np.genfromtxt(path, delimiter=",", names=True)
    return armcal.Log(t=rows["t"], name=name, simulated=True, **{
        signal: np.stack([rows[f"{signal}{k}"] for k in (1, 2)], -1)
        for signal in signals})


class InMemory(InFolder):

    def setUp(self):
        self.one = log_of("run1/log.csv", "monday", "q", "tau", "qref")
        self.two = log_of("run2/log.csv", "tuesday", "q", "tau", "qref")
        pathlib.Path("drives.yaml").write_text(CONTROLLER)

    def both(self, command, names, **options):
        """The results of a command of files, and of the same in memory."""
        of_file = command(self.robot, **{
            name: f"run{number}/log.csv" for name, number in names.items()},
            **options)
        with mock.patch.object(inputs, "tempfile"), mock.patch.object(
                armcal.Log, "savez", side_effect=AssertionError("written")):
            in_memory = command(self.robot, **{
                name: [self.one, self.two][number - 1]
                for name, number in names.items()}, **options)
        return of_file, in_memory

    @staticmethod
    def renamed(content):
        return content.replace(b"run1/log.csv", b"monday").replace(
            b"run2/log.csv", b"tuesday")

    def test_every_command_does_as_with_files(self):
        for command, names, options in (
                (armcal.calibrate, {"log": 1, "validate": 2}, {}),
                (armcal.calibrate, {"log": 1}, dict(select=True)),
                (armcal.calibrate, {"log": 1, "torque_log": 2},
                 dict(controller="drives.yaml")),
                (armcal.calibrate, {"log": 1, "validate": 2},
                 dict(controller="drives.yaml")),
                (armcal.diagnose, {"log": 1, "reference": 2},
                 dict(forward=False)),
                (armcal.diagnose, {"log": 1, "validate": 2},
                 dict(controller="drives.yaml")),
                (armcal.inspect, {"log": 1}, {}),
                (armcal.verify, {"log": 1}, dict(controller="drives.yaml")),
                (armcal.excite, {"given": 1}, dict(duration=4, harmonics=2))):
            if command is armcal.excite:
                options |= dict(position_limits=(-1, 1), velocity_limits=2)
            with self.subTest(command=command.__name__, **options):
                self.check(*self.both(command, names, **options))

    def check(self, of_file, in_memory):
        self.assertEqual(set(in_memory.files), set(of_file.files))
        self.assertEqual(in_memory.report().encode(),
                         self.renamed(of_file.report().encode()))
        for name, content in of_file.files.items():
            if name in ("report.html", "provenance.json"):  # have hashes of what was read
                continue
            self.assertEqual(in_memory.files[name], self.renamed(content),
                             name)

    def test_reduce(self):
        reduced = armcal.reduce(self.robot, [self.one, self.two])
        self.assertEqual([name.split("-")[0] for name in reduced.files],
                         ["monday", "tuesday"])
        merged = armcal.merge(self.robot, reduced).model_parameters
        of_files = armcal.reduce(self.robot, ["run1/log.csv", "run2/log.csv"])
        # They are added in the order of their hashes.
        np.testing.assert_allclose(
            merged.values,
            armcal.merge(self.robot, of_files).model_parameters.values,
            rtol=1e-11)

    def test_report_has_the_hash_of_the_numbers(self):
        log = armcal.Log(t=self.one.t, q=self.one.q, tau=self.one.tau,
                         name="monday")
        page = armcal.calibrate(self.robot, log).files["report.html"].decode()
        expected = hashlib.sha256()
        for name in ("q", "t", "tau"):
            array = getattr(log, name)
            columns = 1 if array.ndim == 1 else array.shape[1]
            expected.update(f"{name} {len(array)} {columns}\n".encode())
            expected.update(array.astype("<f8").tobytes())
        self.assertIn(expected.hexdigest(), page)
        self.assertIn("--log=monday", page)

    def test_names(self):
        """Logs of one name are numbered; a file is not mistaken for one."""
        def named(log, name):
            return armcal.Log(t=log.t, q=log.q, tau=log.tau, name=name)

        result = armcal.calibrate(
            self.robot, [named(self.one, "log"), named(self.two, "log")])
        self.assertEqual([log["file"] for log in result.to_dict()["logs"]],
                         ["log", "log 2"])
        self.assertEqual([trace.path for trace in result.torques()],
                         ["log", "log 2"])
        pathlib.Path("log").write_bytes(
            pathlib.Path("run2/log.csv").read_bytes())
        beside = armcal.calibrate(self.robot, [named(self.one, "log"), "log"])
        self.assertEqual([log["file"] for log in beside.to_dict()["logs"]],
                         ["log 2", "log"])
        np.testing.assert_array_equal(beside.values, result.values)
        with self.assertRaisesRegex(armcal.UsageError, "names monday twice"):
            armcal.calibrate(self.robot, [self.one, self.one])

    def test_orders_and_views_of_arrays(self):
        """A Log keeps values, whatever memory they lay in."""
        one = self.one
        both = np.hstack([one.q, one.tau]).astype(">f8")
        strange = armcal.Log(t=one.t, q=both[:, :2],
                             tau=np.asfortranarray(both[:, 2:]),
                             qref=one.qref[::-1][::-1], simulated=True,
                             name="monday")
        self.assertEqual(
            armcal.calibrate(self.robot, strange).files,
            armcal.calibrate(self.robot, one).files)
        self.assertTrue(json.loads(armcal.inspect(
            self.robot, strange).files["inspect.json"]))


if __name__ == "__main__":
    unittest.main()
