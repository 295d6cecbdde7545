"""Franka Panda with joint torque sensors and true time stamps (SOURCE.md: published
friction and gravity terms of this very trajectory)."""
from checks import names_none, weak_is_differential
from reading import model_parameters
from runs import calibrate, diagnose

PART = "building"
RUNS = {"calibrate": calibrate("--robot=robot.urdf", "--log=log.csv"),
        "weak": calibrate("--robot=robot.urdf", "--log=log.csv", "--estimate=linear"),
        "differential": calibrate("--robot=robot.urdf", "--log=log.csv",
                                  "--estimate=linear",
                                  "--identification=differential"),
        "log": diagnose("--robot=robot.urdf", "--log=log.csv")}
COULOMB = [.2450, .1523, .1827, .3591, .2669, .1658, .2109]
VISCOUS = [.0665, .1987, .0399, .2257, .1023, -.0132, .0638]
SPEED = [.80, .69, .81, .67, .68, .69, .90]  # rms of the log, rad/s
TIMING = {"delay", "time_base", "time_drift"}


def coulomb(runs):
    """calibrate: Coulomb friction of all joints within .06 N m of the published"""
    own = model_parameters(runs["calibrate"], "coulomb", 7)
    return (max(abs(o - t) for o, t in zip(own, COULOMB)) <= .06,
            " ".join(f"{o:.3f}" for o in own))


def friction(runs):
    """calibrate: friction of all joints at their rms speed within .06 N m of the
    published (the two coefficients trade, and the published ones are of a law
    sign(v) beside noisy velocities; their sum where the joints mostly are does not)"""
    own = zip(model_parameters(runs["calibrate"], "coulomb", 7),
              model_parameters(runs["calibrate"], "viscous", 7), SPEED)
    torque = [c + b * v for c, b, v in own]
    truth = [c + b * v for c, b, v in zip(COULOMB, VISCOUS, SPEED)]
    return (max(abs(o - t) for o, t in zip(torque, truth)) <= .06,
            " ".join(f"{o:.3f} ({t:.3f})" for o, t in zip(torque, truth)))


CHECKS = [coulomb, friction, weak_is_differential("weak", "differential"),
          names_none("log", TIMING, "no error of time is named")]
