"""An IRB 120 by a draw wire, angles rounded to 0.1 degree: DH leaves 1.473 mm cross-
validated by plain least squares, an offset of the wire over some poses most of it."""
from checks import leaves
from runs import calibrate

PART = "evaluation"
RUNS = {"refine": calibrate("--robot=robot.urdf", "--poses=poses.csv",
                            "--geometry=refine")}


CHECKS = [leaves("refine", 1.473)]
