"""The Panda's log with a clock that is 2.2 % fast and hides holes (TRUTH.md)."""
from reading import claims, told
from runs import diagnose, inspect

PART = "evaluation"
RUNS = {"log": diagnose("--robot=robot.urdf", "--log=log.csv.gz"),
        "inspect": inspect("--robot=robot.urdf", "--log=log.csv.gz")}
TIMING = {"delay", "time_base", "time_drift", "clock"}
GIVEN = {"viscous_friction", "coulomb_friction", "armature", "torque_offset"}


def timing(runs):
    """log: the stamps are said to be wrong first, and nothing is named beyond the terms the file lacks but an error of time"""
    beyond = [e for e in claims(runs["log"]) if e["effect"] not in GIVEN]
    first = runs["log"]["data"][:1]
    said = any("the stamps are not when the samples were taken" in d["finding"]
               for d in first)
    return (said and all(e["effect"] in TIMING for e in beyond),
            f"{'stamps, ' if said else ''}{told(runs['log'])}")


def findings(runs):
    return [f["finding"] for log in runs["inspect"]["logs"] for f in log["findings"]]


def clock(runs):
    """inspect: the time of the samples is found wrong, with their mean period (1.022 ms)"""
    said = findings(runs)
    period = (runs["inspect"]["logs"][0].get("clock") or {}).get("period", 0)
    return ("clock" in said and abs(period - 1.0222e-3) < 4e-6,
            f"{said}, {1e3 * period:.4f} ms")


def no_torque_delay(runs):
    """inspect: no delay of the torques is found"""
    said = findings(runs)
    return "delay" not in said, f"{said}"


CHECKS = [timing, clock, no_torque_delay]
