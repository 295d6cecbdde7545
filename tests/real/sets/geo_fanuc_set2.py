"""The same poses with the controller's J3, which is measured against the ground: no
geometry explains them, q3 - q2 does (TRUTH.md)."""
PART = "building"
RUNS = {"refine": ("calibrate", ["--robot=robot.urdf", "--poses=poses.csv",
                                 "--geometry=refine"], "calibration.json"),
        "frames": ("calibrate", ["--robot=robot.urdf", "--poses=poses.csv"],
                   "calibration.json")}


def not_passed_of(run):
    def check(runs):
        verdict = runs[run]["verdict"]
        return runs.code(run) == 1, f"exit code {runs.code(run)}, {verdict}"[:110]
    check.__doc__ = f"{run}: poses that no geometry explains are no success"
    return check


def coupling(runs):
    """refine: the coupling of joints 2 and 3 is named"""
    said = runs.text("refine")
    return "coupl" in said, said.strip().splitlines()[1][:110]


CHECKS = [not_passed_of("frames"), not_passed_of("refine"), coupling]
