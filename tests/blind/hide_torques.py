#!/usr/bin/env python3
"""hide_torques.py CASES OUT: cases of the blind bench without their torques.

Of each case's logs only times, positions and commands are left; case.json asks
the diagnoser to make torques of them by controller.yaml, which has the bandwidth
that all arms of the bench are controlled with (kUsualBandwidthHz) and leaves the
gains to the robot file, as the bench does. Standard library only.
"""

import csv
import json
import pathlib
import shutil
import sys

HIDDEN = ("tau", "i", "qd", "qdd")


def without_torques(source, target):
    with open(source, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    keep = [k for k, name in enumerate(rows[0]) if name.rstrip("0123456789") not in HIDDEN]
    with open(target, "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows(
            [row[k] for k in keep] for row in rows)


def main():
    cases, out = map(pathlib.Path, sys.argv[1:])
    for case in sorted(path.parent for path in cases.glob("*/case.json")):
        folder = out / case.name
        folder.mkdir(parents=True, exist_ok=True)
        for log in case.glob("*.csv"):
            without_torques(log, folder / log.name)
        shutil.copy(case / "robot.yaml", folder)
        (folder / "controller.yaml").write_text("law: pd\nbandwidth: 8\n")
        content = json.loads((case / "case.json").read_text())
        content["flags"] = content.get("flags", []) + ["--controller=controller.yaml"]
        (folder / "case.json").write_text(json.dumps(content, indent=2) + "\n")


if __name__ == "__main__":
    main()
