"""The same poses with the controller's J3, which is measured against the ground: no
geometry explains them, q3 - q2 does (TRUTH.md)."""
from checks import no_success
from runs import calibrate

PART = "building"
RUNS = {"refine": calibrate("--robot=robot.urdf", "--poses=poses.csv",
                            "--geometry=refine"),
        "frames": calibrate("--robot=robot.urdf", "--poses=poses.csv")}


def coupling(runs):
    """refine: the coupling of joints 2 and 3 is named"""
    said = runs.text("refine")
    return "coupl" in said, said.strip().splitlines()[1][:110]


CHECKS = [no_success(run, "poses that no geometry explains are no success")
          for run in RUNS] + [coupling]
