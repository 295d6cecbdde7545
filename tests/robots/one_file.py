"""Robot files by the reference and by armcal: takes lines of format, path
and the folder of the package, prints a line of JSON for each. Run by survey.py in a process of its own: a
reader may crash, or hang until the alarm ends it."""

import json
import signal
import sys

import numpy as np

import armcal
import reference

SECONDS = 120  # for one file
STATES = 20
LARGEST = 1e-9  # relative difference of torques
# MuJoCo turns an inertia that the file does not give along principal axes (full
# matrices, shapes, meshes) onto these, found to about the square root of a
# double's rounding, 1.5e-8 rad; a few such angles are in a torque.
LARGEST_BY_AXES = 1e-7


def longest(chains):
    return max(chains, key=lambda c: len(c.joints), default=None)


def read(path, chain, gravity, folder):
    """The robot, and whether it needed --robot_folder."""
    options = {"base": chain.base, "tip": chain.tip}
    if gravity is not None:
        options["gravity"] = gravity
    try:
        return armcal.read_robot(path, **options), False
    except armcal.InputError as error:
        if "robot_folder" not in str(error):
            raise
    return armcal.read_robot(path, robot_folder=folder, **options), True


def differences(source, chain, robot):
    """Largest relative difference of torques at random states, and of what
    the file says of the joints themselves."""
    random = np.random.default_rng(0)
    q, qd, qdd = random.uniform(-2, 2, (3, STATES, len(chain.joints)))
    expected = source.torques(chain, q, qd, qdd)
    found = robot.inverse_dynamics(q, qd, qdd)
    scale = np.abs(expected).max()
    worst = {"torque": np.abs(found - expected).max() / (scale or 1)}
    for term, value in source.joint_terms(chain).items():
        worst[term] = np.abs(getattr(robot, term) - value).max() / (
            np.abs(value).max() or 1)
    return {term: float(value) for term, value in worst.items()}


def compare(source, path, chain, folder):
    """What armcal makes of the chain: {verdict: read, refused or wrong}."""
    said = {"base": chain.base, "tip": chain.tip, "joints": len(chain.joints),
            "coupled": sorted(set(chain.coupled.values()))}
    gravity = source.gravity(chain.base) if chain.base else None
    try:
        robot, elsewhere = read(path, chain, gravity, folder)
    except armcal.InputError as error:
        return said | {"verdict": "refused", "message": str(error)}
    names = [source.joint_name(j) for j in chain.joints]
    if len(names) != robot.num_joints or any(
            name and name != ours for name, ours in
            zip(names, robot.joint_names)):
        return said | {"verdict": "wrong", "message":
                       f"joints {robot.joint_names}, expected {names}"}
    worst = differences(source, chain, robot)
    allowed = LARGEST_BY_AXES if source.version == "mujoco" else LARGEST
    good = all(value <= allowed for value in worst.values())
    return said | {"verdict": "read" if good else "wrong",
                   "message": "" if good else str(worst), "notes": robot.notes,
                   "coarse": max(worst.values()) > LARGEST,
                   "elsewhere": elsewhere, "differences": worst}


def without_base(path, chain, folder):
    """What armcal says of a chain from a trunk that floats unless it is told to
    begin there: the name of the base, or the robot that it makes of it."""
    whole = reference.Chain("", chain.tip, [], {})
    try:
        robot, _ = read(path, whole, None, folder)
    except armcal.InputError as error:
        return {"verdict": "refused", "tip": chain.tip, "message": str(error)}
    return {"verdict": "wrong", "tip": chain.tip,
            "message": f"reads {robot.joint_names}"}


def survey(kind, path, folder):
    source, why = reference.load(kind, path)
    if source is None:
        return {"class": "no reference loads it", "message": why}
    chains = list(source.chains())
    if not chains:
        return {"class": "no chain"}
    result = {"reference": source.version}
    # The longest chains: whatever they hold; without couplings; from a trunk
    # that does not float.
    anything = longest(chains)
    free = longest(c for c in chains if not c.coupled)
    fixed = longest(c for c in chains if not c.coupled and not c.base)
    if anything.coupled:
        result["coupled"] = compare(source, path, anything, folder)
        source, _ = reference.load(kind, path)
    if fixed is not None:
        result["class"] = "serial"
        result["chain"] = compare(source, path, fixed, folder)
    elif free is not None:
        result["class"] = "floating"
        result["without_base"] = without_base(path, free, folder)
        result["chain"] = compare(source, path, free, folder)
    else:
        result["class"] = "coupled"
    return result


if __name__ == "__main__":
    for line in sys.stdin:
        signal.alarm(SECONDS)
        print("RESULT " + json.dumps(survey(*line.rstrip("\n").split("\t"))),
              flush=True)
