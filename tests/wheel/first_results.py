"""The first calibration of someone new, and whether two of them are the same."""

import filecmp
import pathlib
import shutil
import subprocess

DATA = pathlib.Path(__file__).resolve().parents[2] / "data" / "scara"
# In a folder that has scara/; both write result/.
PROGRAM = ("{armcal} simulate --robot=scara/robot.yaml --out=log >log.txt && "
           "{armcal} calibrate --robot=scara/robot.yaml --log=log/log.csv "
           "--out=result >result.txt")
MODULE = """
import armcal
robot = armcal.read_robot("scara/robot.yaml")
armcal.simulate(robot, out="log")
armcal.calibrate(robot, "log/log.csv", out="result")
"""


def calibrated(folder, armcal):
    """The new folder, with the results of the program `armcal`."""
    folder.mkdir()
    shutil.copytree(DATA, folder / "scara")
    subprocess.run(PROGRAM.format(armcal=armcal), shell=True, check=True,
                   cwd=folder)
    return folder


def files(folder):
    return sorted(path.relative_to(folder) for part in ("log", "result")
                  for path in (folder / part).rglob("*") if path.is_file())


def compare(folder, expected, what):
    if files(folder) != files(expected):
        raise SystemExit(f"{what}: files {files(folder)}, "
                         f"expected {files(expected)}")
    for file in files(expected):
        if not filecmp.cmp(folder / file, expected / file, shallow=False):
            raise SystemExit(f"{what}: {file} is not what the build writes")
