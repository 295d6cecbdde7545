"""KUKA KR300 with 151 kg of tooling and a hydraulic counterbalance on axis 2, of
which the robot file has neither (TRUTH.md)."""
from reading import claim, held_out_share, told, values
from runs import diagnose

PART = "building"
LOGS = "ABC"
RUNS = {log: diagnose("--robot=robot.urdf", f"--log=log_{log}.csv.gz") for log in LOGS}
RUNS["all"] = diagnose("--robot=robot.urdf",
                       "--log=" + ",".join(f"log_{log}.csv.gz" for log in LOGS))
RUNS["control"] = diagnose("--robot=robot.urdf", "--reference=log_A.csv.gz",
                           "--log=log_B.csv.gz")


def mass(diagnosis):
    found = claim(diagnosis, ["payload", "added_mass"])
    return None if found is None else next(iter(values(found, "mass").values()))


def payload_of(run):
    def check(runs):
        found = mass(runs[run])
        if found is None:
            return False, told(runs[run])
        return abs(found[0] - 151) <= 15, f"{found[0]:.1f} +- {found[1]:.1f} kg"
    check.__doc__ = f"{run}: a mass of 151 +- 15 kg at the flange is named"
    return check


def interval_of(run):
    def check(runs):
        found = mass(runs[run])
        if found is None:
            return False, told(runs[run])
        return (abs(found[0] - 151) <= 1.96 * found[1],
                f"{found[0]:.1f} +- {found[1]:.1f} kg")
    check.__doc__ = f"{run}: the mass's 95 % interval holds 151 kg"
    return check


def spring_of(run):
    def check(runs):
        found = claim(runs[run], ["spring", "counterbalance"], joint=2)
        return found is not None, told(runs[run])
    check.__doc__ = f"{run}: a spring or counterbalance on axis 2 is named"
    return check


def held_out(runs):
    """all: J2's held-out residual falls to 25 % of the refit's"""
    share = held_out_share(runs["all"], 2)
    return share is not None and share <= .25, f"{share and round(share, 3)}"


def control(runs):
    """B against A: no mass and no spring has changed"""
    wrong = [claim(runs["control"], ["payload", "added_mass", "link_inertia"]),
             claim(runs["control"], ["spring", "counterbalance"])]
    return wrong == [None, None], told(runs["control"])


CHECKS = [make(run) for run in (*LOGS, "all")
          for make in (payload_of, spring_of)] + [interval_of("all"), held_out, control]
