"""Acrobot: 38 pushes on single joints in ten runs, ten runs without one
(TRUTH_events.csv: run, joint, start, end, peak)."""
import csv

from checks import names_only
from reading import claim
from runs import DATA, diagnose

PART = "evaluation"
NUMBERS = [f"{k:02}" for k in range(1, 11)]
CALM = NUMBERS[5:]
REFERENCE = ",".join(f"reference_{k}.csv.gz" for k in NUMBERS[:5])
RUNS = {f"{kind}_{k}": diagnose("--robot=robot.urdf", f"--reference={REFERENCE}",
                                f"--log={kind}_{k}.csv.gz")
        for kind, those in (("run", NUMBERS), ("reference", CALM)) for k in those}


def pushes():
    with open(DATA / "dfki_acrobot" / "TRUTH_events.csv", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def contacts(diagnosis):
    """(time, joint, torque) of each contact: the joint with the largest torque."""
    found = claim(diagnosis, ["external_contact"])
    for contact in found["contacts"] if found else []:
        torque = contact["torque"]
        joint = max(range(len(torque)), key=lambda j: abs(torque[j]))
        yield contact["time"], joint, torque[joint]


def in_time(push, contact, tolerance=.2):
    return (float(push["t_start"]) - tolerance <= contact[0]
            <= float(push["t_end"]) + tolerance)


def on_joint(push, contact):
    return contact[1] == int(push["joint"]) - 1


def with_sign(push, contact):
    return contact[2] * float(push["peak_Nm"]) > 0


def matches(push, contact):
    return (in_time(push, contact) and on_joint(push, contact)
            and with_sign(push, contact))


def recall(runs):
    """run_01 to 10: of 38 pushes 60 % are found, in time, joint and sign"""
    every = pushes()
    found = sum(any(matches(p, c) for c in contacts(runs[p["run"]])) for p in every)
    return found >= .6 * len(every), f"{found} of {len(every)}"


def precision(runs):
    """run_01 to 10: of the contacts named 80 % are pushes"""
    every, named, right = pushes(), 0, 0
    for k in NUMBERS:
        for contact in contacts(runs[f"run_{k}"]):
            named += 1
            right += any(p["run"] == f"run_{k}" and matches(p, contact)
                         for p in every)
    return named > 0 and right >= .8 * named, f"{right} of {named}"


CHECKS = [recall, precision] + [names_only(f"reference_{k}") for k in CALM]
