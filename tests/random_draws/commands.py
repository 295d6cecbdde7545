"""What is asked of armcal: a command, its files and its options, at random."""

import re
import typing

import numpy as np

import logs
import robots
from robots import chance


class Draw(typing.NamedTuple):
    files: dict  # by name: text
    commands: list  # of lists of arguments, one after the other
    kinds: dict  # by group: what was drawn, for the table


def option(rng, often, name, *values):
    """--name=value, one of these or of what they draw; often not at all."""
    if rng.random() > often:
        return []
    value = values[rng.integers(len(values))]
    return [f"--{name}={value() if callable(value) else value}"]


def power(rng, low, high):
    return lambda: f"{10 ** rng.uniform(low, high):.6g}"


def of_logs(rng, kinds, span):
    """Which part of the logs, and what stands in them."""
    flags = option(rng, 0.3, "bandwidth", 0, 5, 20, power(rng, -4, 6))
    a, b = sorted(rng.uniform(0, 1.2, 2) * span)
    if b > a:
        flags += option(rng, 0.07, "crop", f"{a:.6g}:{b:.6g}", f"0:{span / 2:.6g}")
    if kinds["columns"] == "currents":
        flags += ["--torque_constants=" + ",".join(
            f"{x:.4g}" for x in rng.uniform(1, 3, kinds["joint count"]))]
    return flags


def equations(rng, kinds):
    flags = []
    if rng.random() < 0.4:
        form = chance(rng, {"weak": 2, "differential": 2, "integral": 2})
        flags.append(f"--identification={form}")
        kinds["identification"] = form
        if form == "weak":
            flags += option(rng, 0.3, "window", 0.1, 1, power(rng, -4, 3))
        if form == "integral":
            flags += option(rng, 0.3, "interval", 0.1, 2, power(rng, -4, 3))
            flags += option(rng, 0.3, "quadrature", "simpson", "trapezoid")
    for name, words in (("solver", ["weighted", "batch", "recursive"]),
                        ("loss", ["huber", "cauchy", "tukey", "squared"])):
        chosen = option(rng, 0.35, name, *words)
        kinds[name] = chosen[0].split("=")[1] if chosen else "default"
        flags += chosen
    flags += option(rng, 0.3, "joint_terms", "none", "viscous", "coulomb,armature",
                    "viscous,coulomb", "offset")
    flags += option(rng, 0.3, "coulomb_width", "0.02rad/s", "0.001rad", "1e-7rad/s", "100rad",
                    "0.01m/s")
    return flags


def priors(rng, kinds):
    flags = option(rng, 0.3, "estimate", "linear", "refined", "refined")
    trust = option(rng, 0.3, "trust", 0.05, power(rng, -12, -3), power(rng, 1, 12))
    kinds["trust"] = ("usual" if not trust or trust[0] == "--trust=0.05" else
                      "next to none" if float(trust[0][8:]) > 1 else "next to all")
    return flags + trust


def calibrate(rng, robot, files, kinds, span, samples):
    flags = of_logs(rng, kinds, span)
    if rng.random() < 0.6:
        flags += equations(rng, kinds) + priors(rng, kinds)
    geometry = chance(rng, {"known": 12, "lengths": 2, "all_lengths": 1, "offsets": 1.5,
                            "refine": 1.5})
    if geometry.endswith("lengths") and kinds["joint count"] > 10:
        geometry = "known"  # unknown lengths of 15 joints take 90 s
    kinds["geometry"] = geometry
    if geometry != "known":
        flags.append(f"--geometry={geometry}")
        flags += option(rng, 0.3, "length_trust", power(rng, -12, 6))
        flags += option(rng, 0.3, "angle_trust", power(rng, -12, 6))
    kinds["poses"] = "none"
    log = ["--log=log.csv"]
    if rng.random() < (0.4 if geometry in ("refine", "offsets") else 0.03):
        files["poses.csv"], kinds["poses"] = logs.poses(rng, robot, int(rng.choice([1, 2, 40])))
        flags.append("--poses=poses.csv")
        if rng.random() < 0.4:
            log = []
    if rng.random() < 0.25 and log:
        files["held.csv"], held, _ = logs.draw(rng, robot, samples)
        same = held["columns"] == kinds["columns"]
        if same:
            flags.append("--validate=held.csv")
    if rng.random() < 0.1 and log:
        files["more.csv"], more, _ = logs.draw(rng, robot, samples)
        if (more["columns"] == "currents") == (kinds["columns"] == "currents"):
            log = ["--log=log.csv,more.csv"]
    if kinds.get("identification", "weak") == "weak" or rng.random() < 0.1:
        flags += option(rng, 0.05, "select", "true") and ["--select", "--segment=1"]
    kinds["trajectory"] = "measured"
    if rng.random() < 0.04:
        kinds["trajectory"] = "corrected"  # of weak rows, weighted, without robot
        flags = [f for f in flags if not re.match("--(identification|solver|estimate|geometry)", f)]
        flags.append("--trajectory=corrected")
    if rng.random() < 0.03:
        files["loaded.csv"], _, _ = logs.draw(rng, robot, samples)
        flags = [f for f in flags if "torque_constants" not in f]
        flags += ["--payload_log=loaded.csv"] + option(rng, 1, "payload_mass", 1, power(rng, -9, 6))
    flags += option(rng, 0.1, "export", "mjcf,sdf,yaml")
    return log + flags


def draw(seed, index, samples):
    """The draw of this number."""
    rng = np.random.default_rng([seed, index])
    command = chance(rng, {"calibrate": 85, "diagnose": 2, "inspect": 4, "verify": 2,
                           "reduce": 5, "excite": 0.2, "simulate": 1})
    robot = robots.draw(rng, 7 if command in ("excite", "diagnose") else 20)
    long = 3 if command == "diagnose" else 1  # it compares stretches of seconds
    text, of_log, _ = logs.draw(rng, robot, long * samples(rng), 0.8 if long > 1 else 0.4)
    kinds = robot.kinds | of_log | {"joint count": len(robot.links)}
    name, content = robot.file()
    files = {name: content, "log.csv": text}
    rows = text.rstrip("\n").split("\n")[1:]
    span = float(rows[-1].split(",")[0] or 0) - float(rows[0].split(",")[0] or 0) if rows else 0
    span = span if np.isfinite(span) else 1.0
    given = [f"--robot={name}"]
    kinds["command"] = command
    out = ["--threads=1", "--out=out"]
    log = ["--log=log.csv"]
    if command == "calibrate":
        commands = [["calibrate"] + given + calibrate(
            rng, robot, files, kinds, span, samples(rng)) + out]
        if rng.random() < 0.08:
            commands.append(["inspect", "--robot=out/robot.urdf"] + out[:1])
        if rng.random() < 0.03:
            commands.append(["verify"] + given + ["--calibration=out/calibration.json"] + out)
    elif command == "inspect":
        commands = [["inspect"] + given + log * (rng.random() < 0.7) +
                    option(rng, 0.5, "export", "urdf,mjcf,sdf,yaml") +
                    option(rng, 0.5, "fix", "true") + out]
    elif command == "verify":
        commands = [["verify"] + given + log * (rng.random() < 0.3) + out]
    elif command == "diagnose":
        flags = of_logs(rng, kinds, span) + option(rng, 0.3, "trust", 0.05, power(rng, -9, 9))
        if rng.random() < 0.3:
            files["before.csv"], _, _ = logs.draw(rng, robot, long * samples(rng), 0.8)
            flags.append("--reference=before.csv")
        commands = [["diagnose"] + given + log + flags + out]
    elif command == "reduce":
        flags = of_logs(rng, kinds, span) + option(rng, 0.3, "identification", "differential",
                                                   "integral")
        files["more.csv"], _, _ = logs.draw(rng, robot, samples(rng))
        commands = [["reduce"] + given + log + flags + ["--threads=1", "--out=factors"],
                    ["merge"] + given + ["--factors=factors"] + out]
    elif command == "excite":
        commands = [["excite"] + given + ["--duration=4"] + out]
        if rng.random() < 0.5:
            commands[0].insert(2, "--static_poses=5")
    else:
        commands = [["simulate"] + given + ["--duration=1", "--log_rate=50"] + out]
    kinds.pop("joint count")
    return Draw(files, commands, kinds)
