"""Schunk LWA 4P: one torque sequence replayed while friction falls (TRUTH.md: warm-up,
viscous friction of several joints by a fifth to a quarter)."""
import re

from checks import names_only
from reading import claims, told
from runs import diagnose

PART = "building"
PAIRS = {"080_092": ("run_080", "run_092"), "001_017": ("run_001", "run_017")}
CONTROLS = {"091_092": ("run_091", "run_092"), "016_017": ("run_016", "run_017")}
RUNS = {run: diagnose("--robot=robot.urdf", f"--reference={a}.csv.gz",
                      f"--log={b}.csv.gz")
        for run, (a, b) in {**PAIRS, **CONTROLS}.items()}
FRICTION = {"viscous_friction", "coulomb_friction", "thermal_friction",
            "viscous_friction_of_all_joints", "friction"}


def named_of(run):
    def check(runs):
        friction = [e for e in claims(runs[run]) if e["effect"] in FRICTION]
        return bool(friction), told(runs[run])
    check.__doc__ = f"{run}: changed friction is named"
    return check


def headline_of(run):
    def check(runs):
        first = runs[run]["sentence"]
        said = r"friction has changed|changed since the reference: [^;,.]*friction"
        return bool(re.search(said, first.lower())), first[:110]
    check.__doc__ = f"{run}: the first sentence says that friction changed"
    return check


CHECKS = [make(run) for run in PAIRS for make in (named_of, headline_of)]
CHECKS += [names_only(run, FRICTION, "no mass, gain or other effect is named")
           for run in PAIRS]
CHECKS += [names_only(run) for run in CONTROLS]
