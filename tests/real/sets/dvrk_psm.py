"""da Vinci PSM, first three joints: weights on the pitch link or on the
parallelogram's bar, which moves with it (TRUTH.md: moments about the remote centre)."""
from math import hypot

from checks import names_only
from reading import claim, told, values
from runs import diagnose

PART = "building"
MOMENT = {"log_A": .0562, "log_B": .0338, "log_C": .1097, "log_D": .0173,
          "slow_log_E": .1097, "slow_log_F": .0562}  # kg m
RUNS = {log: diagnose("--robot=robot.urdf", "--reference=reference.csv.gz",
                      f"--log={log}.csv.gz", "--gravity=0,0,-9.81")
        for log in (*MOMENT, "reference_val")}
MASSES = ["payload", "added_mass", "link_inertia"]


def link_of(run):
    def check(runs):
        found = claim(runs[run], MASSES)
        return found is not None and found["joint_index"] == 2, told(runs[run])
    check.__doc__ = f"{run}: a mass on link 2 (pitch) is named"
    return check


def moment_of(run):
    def check(runs):
        found = claim(runs[run], MASSES)
        if found is None:
            return False, told(runs[run])
        h = [values(found, f"h{axis}") for axis in "xyz"]
        moment = hypot(*[next(iter(v.values()))[0] for v in h if v])
        return abs(moment / MOMENT[run] - 1) <= .2, f"{moment:.4f} kg m"
    check.__doc__ = f"{run}: its first moment is {MOMENT[run]} kg m within 20 %"
    return check


CHECKS = [make(log) for log in MOMENT for make in (link_of, moment_of)]
CHECKS += [names_only("reference_val")]
