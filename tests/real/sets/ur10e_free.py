"""UR10e without payload (SOURCE.md): four excitations and a validation motion of some
weeks, in two logs of which a person pushes."""
from reading import claim, claims, told

PART = "building"
COMMON = ["--robot=robot.urdf",
          "--torque_constants=14.87,13.26,11.13,10.62,11.03,11.47"]
FREE = ["id_20s", "id_30s", "id_40s", "val_ptp"]
PUSHED = ["push_contact_1", "push_contact_2"]
RUNS = {log: ("diagnose", [*COMMON, "--reference=id_50s.csv", f"--log={log}.csv"],
              "diagnosis.json") for log in FREE + PUSHED}
FRICTION = {"viscous_friction", "coulomb_friction", "thermal_friction", "friction"}


def free_of(run):
    def check(runs):
        other = [e for e in claims(runs[run]) if e["effect"] not in FRICTION]
        return not other, told(runs[run])
    check.__doc__ = (f"{run}: nothing is named but friction, which scatters by a "
                     "fifth from day to day")
    return check


def pushed_of(run):
    def check(runs):
        found = claim(runs[run], ["external_contact"])
        return found is not None, told(runs[run])
    check.__doc__ = f"{run}: contacts are named"
    return check


def nothing_else_of(run):
    def check(runs):
        other = [e for e in claims(runs[run])
                 if e["effect"] not in FRICTION | {"external_contact"}]
        return not other, told(runs[run])
    check.__doc__ = f"{run}: nothing is named beside contacts and friction"
    return check


CHECKS = [free_of(log) for log in FREE]
CHECKS += [make(log) for log in PUSHED for make in (pushed_of, nothing_else_of)]
