"""Franka Panda with joint torque sensors and true time stamps (SOURCE.md: published
friction and gravity terms of this very trajectory)."""
from reading import claims, model_parameters, told

PART = "building"
RUNS = {"calibrate": ("calibrate", ["--robot=robot.urdf", "--log=log.csv"],
                      "calibration.json"),
        "log": ("diagnose", ["--robot=robot.urdf", "--log=log.csv"], "diagnosis.json")}
COULOMB = [.2450, .1523, .1827, .3591, .2669, .1658, .2109]
TIMING = {"delay", "time_base", "time_drift"}


def coulomb(runs):
    """calibrate: Coulomb friction of all joints within .06 N m of the published"""
    own = model_parameters(runs["calibrate"], "coulomb", 7)
    return (max(abs(o - t) for o, t in zip(own, COULOMB)) <= .06,
            " ".join(f"{o:.3f}" for o in own))


def no_timing(runs):
    """log: no error of time is named"""
    wrong = [e for e in claims(runs["log"]) if e["effect"] in TIMING]
    return not wrong, told(runs["log"])


CHECKS = [coulomb, no_timing]
