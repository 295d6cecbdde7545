"""A folder with an arm and two logs of it, for tests to work in."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import armcal

ARMCAL = os.environ["ARMCAL"]
# Two links that swing, with masses to refine.
ARM = (pathlib.Path(__file__).resolve().parent.parent /
       "swinging_arm.yaml").read_text()


class InFolder(unittest.TestCase):
    """Works in a folder with an arm and two logs of it, of one simulation."""

    @classmethod
    def setUpClass(cls):
        cls.before = os.getcwd()
        cls.folder = tempfile.TemporaryDirectory()
        os.chdir(cls.folder.name)
        pathlib.Path("arm.yaml").write_text(ARM)
        for run in (1, 2):
            cls.armcal("simulate", "--robot=arm.yaml", "--duration=10",
                       "--log_rate=100", "--robot_error=0.02", f"--run={run}",
                       f"--out=run{run}")
        cls.robot = armcal.read_robot("arm.yaml")

    @classmethod
    def tearDownClass(cls):
        os.chdir(cls.before)
        cls.folder.cleanup()

    @staticmethod
    def armcal(*arguments):
        found = subprocess.run([ARMCAL, *arguments], check=False, text=True,
                               capture_output=True)
        if found.returncode > 1:
            raise RuntimeError(found.stderr)
        return found.stdout

    def expect_files(self, result, folder):
        """What the command line wrote there; its report says --out."""
        names = {path.name for path in pathlib.Path(folder).iterdir()}
        self.assertEqual(names, set(result.files))
        for name, content in result.files.items():
            expected = pathlib.Path(folder, name).read_bytes()
            if name == "provenance.json":
                told = json.loads(expected)
                told["arguments"].remove(f"--out={folder}")
                self.assertEqual(json.loads(content), told)
                continue
            if name == "report.html":
                out = f',"--out={folder}"'.encode()
                self.assertIn(out, expected)
                expected = expected.replace(out, b"")
            self.assertEqual(content, expected, name)
