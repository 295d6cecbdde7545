"""The Panda's log with a clock that is 2.2 % fast and hides holes (TRUTH.md)."""
from reading import claims, told
from runs import diagnose, inspect

PART = "evaluation"
RUNS = {"log": diagnose("--robot=robot.urdf", "--log=log.csv.gz"),
        "inspect": inspect("--robot=robot.urdf", "--log=log.csv.gz")}
TIMING = {"delay", "time_base", "time_drift", "clock"}
GIVEN = {"viscous_friction", "coulomb_friction", "armature", "torque_offset"}


def timing(runs):
    """log: what is named beyond the terms the file lacks is an error of time"""
    beyond = [e for e in claims(runs["log"]) if e["effect"] not in GIVEN]
    return (bool(beyond) and all(e["effect"] in TIMING for e in beyond),
            told(runs["log"]))


def findings(runs):
    return [f["finding"] for log in runs["inspect"]["logs"] for f in log["findings"]]


def clock(runs):
    """inspect: the time of the samples is found wrong"""
    said = findings(runs)
    return any("time" in s or "clock" in s for s in said), f"{said}"


def no_torque_delay(runs):
    """inspect: no delay of the torques is found"""
    said = findings(runs)
    return "delay" not in said, f"{said}"


CHECKS = [timing, clock, no_torque_delay]
