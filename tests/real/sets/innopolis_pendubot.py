"""A planar arm with a passive elbow; ten logs of one motion, slow to fast (SOURCE.md):
nothing changes between them but the speed."""
from reading import claims, told

PART = "evaluation"
SPEEDS = ["0p15", "0p2", "0p25", "0p3", "0p4", "0p5"]
RUNS = {speed: ("diagnose", ["--robot=robot.urdf",
                             "--reference=position_A_1p2_v_0p1.csv",
                             f"--log=position_A_1p2_v_{speed}.csv"], "diagnosis.json")
        for speed in SPEEDS}


def control_of(speed):
    def check(runs):
        return not claims(runs[speed]), told(runs[speed])
    check.__doc__ = f"{speed}: nothing is named"
    return check


CHECKS = [control_of(speed) for speed in SPEEDS]
