"""What notebooks show of results."""

import pathlib
import sys
import unittest
from html.parser import HTMLParser

import armcal
import numpy as np
from armcal.html import MOST_ROWS, Table, page

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from arm_folder import InFolder


class Tables(HTMLParser):
    """Captions and rows of cells; refuses tags that are not closed."""

    def __init__(self, text):
        super().__init__()
        self.open, self.captions, self.rows, self.text = [], [], [], ""
        self.feed(text)
        if self.open:
            raise AssertionError(f"not closed: {self.open}")

    def handle_starttag(self, tag, attrs):
        self.open.append(tag)
        if tag == "tr":
            self.rows.append([])
        elif tag in ("td", "th"):
            self.rows[-1].append("")

    def handle_endtag(self, tag):
        if self.open.pop() != tag:
            raise AssertionError(tag)

    def handle_data(self, data):
        self.text += data
        if "caption" in self.open:
            self.captions.append(data)
        elif self.open and self.open[-1] in ("td", "th"):
            self.rows[-1][-1] += data


class Pages(unittest.TestCase):

    def test_numbers_and_names(self):
        shown = Tables(page("a <b>", True, "x & y < z", [
            Table("<i>", ("", "v"), [("<script>", 1 / 3), ("b", np.inf),
                                     ("c", None), ("d", float("nan")),
                                     ("e", True)]),
            Table("nothing", ("",), [])]))
        self.assertEqual(shown.captions, ["<i>"])
        self.assertEqual(shown.rows[1:], [["<script>", "0.3333"], ["b", "∞"],
                                          ["c", ""], ["d", ""], ["e", "yes"]])
        self.assertIn("x & y < z", shown.text)

    def test_long_tables_end(self):
        shown = Tables(page("a", False, "", [
            Table("t", ("k",), [(k,) for k in range(MOST_ROWS + 3)])]))
        self.assertEqual(len(shown.rows), 1 + MOST_ROWS)
        self.assertIn("and 3 more", shown.text)


class Results(InFolder):

    def test_calibration(self):
        result = armcal.calibrate(self.robot, "run1/log.csv",
                                  validate="run2/log.csv")
        shown = Tables(result._repr_html_())
        self.assertEqual(shown.captions, ["joints", "parameters"])
        self.assertIn(result.brief_report(), shown.text)
        rows = {row[0]: row for row in shown.rows}
        for name, value, unit in zip(result.names, result.values,
                                     result.units):
            self.assertEqual(rows[name][1], f"{value:.4g}")
            self.assertEqual(rows[name][-1], unit)
        joint = result.joints[0]
        self.assertIn(f"{joint['validation_residual_rms']:.4g}",
                      rows[joint["name"]])
        self.assertIn("viscous", Tables(
            result.model_parameters._repr_html_()).text)

    def test_diagnosis_and_the_others(self):
        result = armcal.diagnose(self.robot, "run1/log.csv", forward=False)
        shown = Tables(result._repr_html_())
        self.assertIn("joints", shown.captions)
        for effect in result.effects:
            self.assertIn(effect["effect"], shown.text)
        for other in (armcal.inspect(self.robot), armcal.verify(self.robot),
                      armcal.simulate(self.robot, duration=1)):
            text = Tables(other._repr_html_()).text
            self.assertIn(other.report(), text)

    def test_names_are_texts(self):
        robot = armcal.Robot.from_arrays(
            joint_types=["revolute"], joint_names=["<img src=x>"],
            inertial_parameters=[[1, .1, 0, 0, .1, 0, .1, 0, 0, .1]],
            axes=[[0, 1, 0]])
        log = armcal.simulate(robot, duration=5, log_rate=100).log
        html = armcal.calibrate(robot, log)._repr_html_()
        self.assertNotIn("<img", html)
        self.assertIn("&lt;img src=x&gt;", html)


if __name__ == "__main__":
    unittest.main()
