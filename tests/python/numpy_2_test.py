"""The module with NumPy 2, whose descriptors of types lie otherwise in memory
than those that Debian 12's pybind11 knows: arrays come and go as with NumPy 1."""

import os
import pathlib
import subprocess
import sys
import unittest

HERE = pathlib.Path(__file__).parent
#: tools/python_extras.sh puts it beside what is on the path.
NUMPY = [folder for place in sys.path
         if (folder := pathlib.Path(place) / "numpy-2").is_dir()]


@unittest.skipUnless(NUMPY, "NumPy 2 is not here")
class NumPy2(unittest.TestCase):

    def test_arrays_both_ways(self):
        path = os.pathsep.join([str(NUMPY[0]), os.environ["PYTHONPATH"]])
        version = "import numpy; print(numpy.__version__)"
        for arguments, expected in ((["-c", version], "2."),
                                    (["-m", "unittest", "robot_test",
                                      "log_memory_test"], "OK")):
            with self.subTest(arguments):
                run = subprocess.run(
                    [sys.executable, "-B", *arguments], cwd=HERE, text=True,
                    env={**os.environ, "PYTHONPATH": path}, check=False,
                    capture_output=True)
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assertIn(expected, run.stdout + run.stderr)


if __name__ == "__main__":
    unittest.main()
