"""What docs/python.md and docs/scara.ipynb tell their readers runs as it stands,
in plain Python: no jupyter, and without figures where matplotlib is missing."""

import contextlib
import io
import json
import os
import pathlib
import re
import tempfile
import unittest

import armcal

try:
    import matplotlib
    matplotlib.use("Agg")
except ImportError:
    matplotlib = None

ROOT = pathlib.Path(os.environ["DATA_DIR"]).parent


def run(cells):
    """Runs cells of code in a copy of the folders that they are in; returns
    what they print."""
    names, printed = {}, io.StringIO()
    for k, cell in enumerate(cells):
        if matplotlib is None and "armcal.plot." in cell:
            continue
        with contextlib.redirect_stdout(printed):
            exec(compile(cell, f"cell {k + 1}", "exec"), names)
    return printed.getvalue(), names


class Examples(unittest.TestCase):

    def setUp(self):
        self.before = os.getcwd()
        self.folder = tempfile.TemporaryDirectory()
        root = pathlib.Path(self.folder.name)
        (root / "data").symlink_to(ROOT / "data")
        (root / "docs").mkdir()
        os.chdir(root)

    def tearDown(self):
        os.chdir(self.before)
        self.folder.cleanup()

    def test_page(self):
        text = (ROOT / "docs/python.md").read_text(encoding="utf-8")
        cells = re.findall(r"^```python\n(.*?)^```$", text, re.M | re.S)
        self.assertGreater(len(cells), 3)
        printed, _ = run(cells)
        self.assertIn("scara: 20 model parameters, residual ", printed)
        self.assertRegex(printed, r"Izz\[4\] +0\.3(5|499)\d* \+- ")

    def test_notebook(self):
        os.chdir("docs")
        notebook = json.loads((ROOT / "docs/scara.ipynb").read_text(
            encoding="utf-8"))
        for cell in notebook["cells"]:
            self.assertEqual(cell.get("outputs", []), [])  # kept out of git
        printed, names = run(["".join(cell["source"])
                              for cell in notebook["cells"]
                              if cell["cell_type"] == "code"])
        self.assertIn("scara: 6 model parameters", printed)
        (payload,) = names["diagnosis"].effects
        self.assertEqual(payload["effect"], "payload")
        self.assertAlmostEqual(payload["estimates"][0]["value"], .5, delta=.02)
        self.assertTrue(pathlib.Path("calibrated/robot.urdf").exists())

    @unittest.skipIf(matplotlib is None, "matplotlib is not here")
    def test_figures(self):
        robot = ROOT / "data/scara/robot.yaml"
        result = armcal.calibrate(robot, ROOT / "data/scara/A.csv.gz",
                                  geometry="lengths")
        lines = armcal.plot.torques(result).axes[0].get_lines()
        self.assertEqual([line.get_label() for line in lines],
                         ["measured", "predicted", "difference"])
        figure = armcal.plot.torques(result, joints=["elbow"])
        self.assertEqual(len(figure.axes), 1)
        with self.assertRaisesRegex(ValueError, "knee.*shoulder"):
            armcal.plot.torques(result, joints=["knee"])
        labels = armcal.plot.parameters(result).axes[0].get_yticklabels()
        self.assertEqual(len(labels), result.identifiable.sum())


if __name__ == "__main__":
    unittest.main()
