"""An IRB 120 by a draw wire, angles rounded to 0.1 degree: DH leaves 1.473 mm cross-
validated by plain least squares, an offset of the wire over some poses most of it."""
PART = "evaluation"
RUNS = {"refine": ("calibrate", ["--robot=robot.urdf", "--poses=poses.csv",
                                 "--geometry=refine"], "calibration.json")}


def residual(runs):
    """refine: at most 1.473 mm are left, cross-validated"""
    rms = 1e3 * runs["refine"]["poses"]["cross_validated_rms"]
    return rms <= 1.473, f"{rms:.3f} mm"


CHECKS = [residual]
