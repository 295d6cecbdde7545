"""Staubli TX40: joints 5 and 6 share a drive, whose friction follows qd5 + qd6
(TRUTH.md: published friction of every joint)."""
from checks import names_none, weak_is_differential
from reading import claim, claims, held_out_share, model_parameters, told
from runs import calibrate, diagnose

PART = "building"
RUNS = {"log": diagnose("--robot=robot.urdf", "--log=log.csv.gz"),
        "log_40_hz": diagnose("--robot=robot.urdf", "--log=log.csv.gz",
                              "--bandwidth=40"),
        "calibrate": calibrate("--robot=robot.urdf", "--log=log.csv.gz",
                               "--bandwidth=40"),
        "weak": calibrate("--robot=robot.urdf", "--log=log.csv.gz",
                          "--estimate=linear"),
        "differential": calibrate("--robot=robot.urdf", "--log=log.csv.gz",
                                  "--estimate=linear",
                                  "--identification=differential")}
VISCOUS = [8.05, 5.53, 1.97, 1.11]
COULOMB = [7.14, 8.26, 6.34, 2.48]
GIVEN = ["viscous_friction", "coulomb_friction", "armature", "torque_offset"]


def coupled_of(run):
    def check(runs):
        beyond = [e for e in claims(runs[run]) if e["effect"] not in GIVEN]
        first = bool(beyond) and beyond[0]["effect"] == "coupled_friction"
        return first and beyond[0]["joint_index"] in (5, 6), told(runs[run])
    check.__doc__ = (f"{run}: beyond what the file gives no joint, coupled friction "
                     "of joints 5 and 6 is named first")
    return check


def size(runs):
    """log_40_hz: its Coulomb part is 1.95 N m within 15 %"""
    found = claim(runs["log_40_hz"], ["coupled_friction"])
    if found is None:
        return False, told(runs["log_40_hz"])
    value = abs(found["estimates"][0]["value"])
    return abs(value - 1.95) <= .15 * 1.95, f"{value:.2f} N m"


def removed(runs):
    """log_40_hz: it removes 75 % of J5's held-out mean square"""
    share = held_out_share(runs["log_40_hz"], 5)
    return share is not None and share ** 2 <= .25, f"{share and round(share ** 2, 3)}"


def friction_of(quantity, truth):
    def check(runs):
        own = model_parameters(runs["calibrate"], quantity, 4)
        worst = max(abs(o / t - 1) for o, t in zip(own, truth))
        return worst <= .1, " ".join(f"{o:.2f}" for o in own)
    check.__doc__ = f"calibrate: {quantity} of joints 1 to 4 within 10 % of {truth}"
    return check


CHECKS = [coupled_of("log"), coupled_of("log_40_hz"), size, removed,
          names_none("log_40_hz", {"delay"}, "no delay is named (one rig, one clock)"),
          friction_of("viscous", VISCOUS), friction_of("coulomb", COULOMB),
          weak_is_differential("weak", "differential")]
