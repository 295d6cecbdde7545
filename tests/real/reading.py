"""What checks of the scoreboard read out of a diagnosis.json."""


def claims(diagnosis, above=.5):
    """Effects named with more than this probability, the likeliest first."""
    named = [e for e in diagnosis["effects"] if e["probability"] > above]
    return sorted(named, key=lambda e: -e["probability"])


def alike(diagnosis):
    """Of what is named as one of a few effects that the data cannot tell apart: each one's
    names, and how probable it is that it is one of them."""
    return [([e["effect"], *(other["effect"] for other in e["equivalent"])],
             e["any_probability"])
            for e in diagnosis["fitted_not_named"] if e["one_of_few"]]


def told(diagnosis):
    """The claims in a few words."""
    words = [f"{e['effect']} {e['joint']} {e['probability']:.2f}".replace("  ", " ")
             for e in claims(diagnosis)]
    words += [f"one of {', '.join(names)} {probability:.2f}"
              for names, probability in alike(diagnosis)]
    return ", ".join(words) or f"nothing ({diagnosis['verdict']})"


def claim(diagnosis, effects, joint=None):
    """The likeliest claim of one of these effects (on `joint`, from 1), or None."""
    for entry in claims(diagnosis):
        if entry["effect"] not in effects:
            continue
        if joint is None or entry["joint_index"] == joint:
            return entry
    return None


def values(entry, quantity):
    """{name: (value, stddev)} of an effect's estimates whose name ends so."""
    return {e["name"]: (e["value"], e["stddev"]) for e in entry["estimates"]
            if e["name"].split(".")[-1] == quantity}


def held_out_share(diagnosis, joint):
    """After over refit of a joint's torque on held-out data, by rms; None where
    nothing was held out. Joints from 1."""
    entry = diagnosis["where"]["joints"][joint - 1]
    if not entry["refit_rms"] or entry["after_rms"] is None:
        return None
    return entry["after_rms"] / entry["refit_rms"]


def model_parameters(calibration, quantity, count):
    """Of joints 1 to `count`: "coulomb[1]", ..."""
    found = {p["name"]: p["value"] for p in calibration["model_parameters"]}
    return [found[f"{quantity}[{j + 1}]"] for j in range(count)]


def friction_of(calibration):
    """{name: (value, stddev)} of Coulomb and viscous friction that the log tells."""
    return {p["name"]: (p["value"], p["stddev"])
            for p in calibration["model_parameters"]
            if p["name"].split("[")[0] in ("coulomb", "viscous") and p["stddev"]}
