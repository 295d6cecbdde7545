"""Franka Panda with joint torque sensors and true time stamps (SOURCE.md: published
friction and gravity terms of this very trajectory)."""
from checks import names_none
from reading import model_parameters
from runs import calibrate, diagnose

PART = "building"
RUNS = {"calibrate": calibrate("--robot=robot.urdf", "--log=log.csv"),
        "log": diagnose("--robot=robot.urdf", "--log=log.csv")}
COULOMB = [.2450, .1523, .1827, .3591, .2669, .1658, .2109]
TIMING = {"delay", "time_base", "time_drift"}


def coulomb(runs):
    """calibrate: Coulomb friction of all joints within .06 N m of the published"""
    own = model_parameters(runs["calibrate"], "coulomb", 7)
    return (max(abs(o - t) for o, t in zip(own, COULOMB)) <= .06,
            " ".join(f"{o:.3f}" for o in own))


CHECKS = [coulomb, names_none("log", TIMING, "no error of time is named")]
