"""A pendulum of 0.676 kg at 0.5 m (SOURCE.md); energy_changed carries 1 kg in place of
0.5 kg; a hand pushes it out of its upper rest; one torque was computed from q."""
from checks import names_only
from reading import claim, told, values
from runs import diagnose

PART = "building"
LOGS = {"swing_B": "swing_B.csv", "energy_ref": "energy_ref.csv",
        "energy_changed": "energy_changed.csv"}
RUNS = {run: diagnose("--robot=robot.urdf", "--reference=swing_A.csv",
                      f"--log={log}")
        for run, log in LOGS.items()}
RUNS["handguided"] = diagnose("--robot=robot.urdf", "--log=handguided.csv")


def no_payload(runs):
    """energy_ref: no payload of .1 kg or more is named"""
    found = claim(runs["energy_ref"], ["payload", "added_mass"])
    return (found is None or next(iter(values(found, "mass").values()))[0] < .1,
            told(runs["energy_ref"]))


def contact_of(run, time):
    def check(runs):
        found = claim(runs[run], ["external_contact"])
        if found is None:
            return False, told(runs[run])
        times = [round(c["time"], 2) for c in found["contacts"]]
        return any(abs(t - time) < .3 for t in times), f"at {times}"
    check.__doc__ = f"{run}: a contact at {time} s is named"
    return check


def payload(runs):
    """energy_changed: a payload of .5 kg within 40 % is named"""
    found = claim(runs["energy_changed"], ["payload", "added_mass"])
    if found is None:
        return False, told(runs["energy_changed"])
    mass = next(iter(values(found, "mass").values()))[0]
    return abs(mass - .5) <= .2, f"{mass:.2f} kg"


def computed(runs):
    """handguided: not testable, the torque was computed from the position"""
    return runs["handguided"]["verdict"] == "not_testable", told(runs["handguided"])


CHECKS = [names_only("swing_B"), no_payload, contact_of("energy_ref", 16.),
          contact_of("energy_changed", 17.2), payload, computed]
