"""UR10e without payload (SOURCE.md): four excitations and a validation motion of some
weeks, in two logs of which a person pushes."""
from checks import names_only
from reading import claim, told
from runs import diagnose

PART = "building"
COMMON = ["--robot=robot.urdf",
          "--torque_constants=14.87,13.26,11.13,10.62,11.03,11.47"]
FREE = ["id_20s", "id_30s", "id_40s", "val_ptp"]
PUSHED = ["push_contact_1", "push_contact_2"]
RUNS = {log: diagnose(*COMMON, "--reference=id_50s.csv", f"--log={log}.csv")
        for log in FREE + PUSHED}
FRICTION = {"viscous_friction", "coulomb_friction", "thermal_friction",
            "viscous_friction_of_all_joints", "friction"}


def pushed_of(run):
    def check(runs):
        found = claim(runs[run], ["external_contact"])
        return found is not None, told(runs[run])
    check.__doc__ = f"{run}: contacts are named"
    return check


CHECKS = [names_only(log, FRICTION, "nothing is named but friction, which scatters "
                     "by a fifth from day to day") for log in FREE]
CHECKS += [pushed_of(log) for log in PUSHED]
CHECKS += [names_only(log, FRICTION | {"external_contact"},
                      "nothing is named beside contacts and friction")
           for log in PUSHED]
