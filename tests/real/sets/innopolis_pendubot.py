"""A planar arm with a passive elbow; ten logs of one motion, slow to fast (SOURCE.md):
nothing changes between them but the speed."""
from checks import names_only
from runs import diagnose

PART = "evaluation"
SPEEDS = ["0p15", "0p2", "0p25", "0p3", "0p4", "0p5"]
RUNS = {speed: diagnose("--robot=robot.urdf",
                        "--reference=position_A_1p2_v_0p1.csv",
                        f"--log=position_A_1p2_v_{speed}.csv")
        for speed in SPEEDS}


CHECKS = [names_only(speed) for speed in SPEEDS]
