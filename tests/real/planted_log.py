"""Logs of ../shared/data that can be changed and written again."""

import csv
import gzip
from pathlib import Path
from xml.etree import ElementTree

DATA = Path(__file__).resolve().parents[3] / "shared" / "data"
UR10E = ("--torque_constants=14.87,13.26,11.13,10.62,11.03,11.47",)


class Log:
    """Columns of a log, in rows: t and, per joint, q, qd (or None) and torque."""

    def __init__(self, path):
        opened = gzip.open if path.suffix == ".gz" else open
        with opened(path, "rt", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        header = rows[0]
        table = [[float(x) for x in row] for row in rows[1:]]
        column = {name: [row[k] for row in table] for k, name in enumerate(header)}
        self.torque = "tau" if "tau1" in column else "i"
        self.joints = sum(1 for name in column if name[0] == "q" and name[1:].isdigit())
        self.t = column["t"]
        self.path = path
        self.columns = {s: [column[f"{s}{j + 1}"] for j in range(self.joints)]
                        for s in ("q", "qd", self.torque) if f"{s}1" in column}

    def sliding(self):
        """Joints that slide, of a robot file beside the log (base to tip there)."""
        robot = ElementTree.parse(min(self.path.parent.glob("*.urdf")))
        types = [joint.get("type") for joint in robot.iter("joint")]
        moving = [t for t in types if t in ("revolute", "continuous", "prismatic")]
        return [j for j, t in enumerate(moving[:self.joints]) if t == "prismatic"]

    def size(self):
        return len(self.t)

    def signals(self, j):
        return [self.columns[s][j] for s in self.columns]

    def keep(self, rows):
        self.t = [self.t[k] for k in rows]
        for columns in self.columns.values():
            columns[:] = [[x[k] for k in rows] for x in columns]

    def speed(self, j):
        """rms, of the positions over stretches of about 20 ms"""
        q = self.columns["q"][j]
        reach = max(1, round(.02 * self.size() / (self.t[-1] - self.t[0])))
        slopes = [(q[k + reach] - q[k]) / (self.t[k + reach] - self.t[k])
                  for k in range(0, self.size() - reach, reach)]
        return (sum(s * s for s in slopes) / len(slopes)) ** .5

    def moving(self):
        """Joints that move at a fifth of the fastest one's speed at least."""
        speeds = [self.speed(j) for j in range(self.joints)]
        return [j for j in range(self.joints) if speeds[j] > .2 * max(speeds)]

    def late(self, x, delay):
        """The column as it was `delay` s ago."""
        k, values = 0, []
        for t in self.t:
            at = max(self.t[0], t - delay)
            while k + 2 < self.size() and self.t[k + 1] < at:
                k += 1
            step = self.t[k + 1] - self.t[k]
            share = min(1, max(0, (at - self.t[k]) / step)) if step > 0 else 0
            values.append((1 - share) * x[k] + share * x[k + 1])
        return values

    def write(self, path):
        with open(path, "w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file)
            names = [f"{s}{j + 1}" for s in self.columns for j in range(self.joints)]
            writer.writerow(["t"] + names)
            all_columns = [x for s in self.columns for x in self.columns[s]]
            writer.writerows([format(t, ".9g")] + [format(x[k], ".9g") for x in all_columns]
                             for k, t in enumerate(self.t))
