#!/usr/bin/env python3
"""commanded_logs.py ARMCAL OUT [ARM ..]: logs of commands and encoders alone.

Of arms 1R, 3R and 6R (default: 1R 3R), each in a folder of its own:

  robot.yaml robot.xml     what is known of the arm: links as they are, armature,
                           damping and dry friction up to half wrong
  controller.yaml          position drives as their data sheet has them: gains up
                           to 15 % wrong, no delay
  known_gains.yaml         the same with the true gains
  train.csv held_out.csv   t, q, qref: 30 s of two motions, 250 Hz, encoders of
                           17 bits with 2e-5 rad of noise
  hidden/                  truth.yaml, controller.yaml, truth.json

Everything is drawn from fixed seeds. Standard library only.
"""

import csv
import json
import math
import pathlib
import random
import subprocess
import sys

DURATION = 30  # s
DELAY = .006  # s
BANDWIDTH = 5  # Hz, of the drives
RESOLUTION = 2 * math.pi / 2 ** 17

# Mass kg, centre of mass m, inertia kg m^2, damping N m s/rad, dry friction N m,
# armature kg m^2, effort N m.
LINKS = {
    "1R": [dict(a=.4, mass=2.5, com=[-.15, .01, 0], inertia=[.004, .03, .03],
                alpha=1.5707963267948966, terms=(.8, 1.2, .15), effort=60)],
    "3R": [dict(d=.3, alpha=1.5707963267948966, mass=4, com=[0, -.05, .01],
                inertia=[.02, .015, .02], terms=(3, 4, .5), effort=150),
           dict(a=.4, mass=5, com=[-.2, 0, .02], inertia=[.01, .08, .08],
                terms=(4, 5, .6), effort=150),
           dict(a=.35, mass=2.5, com=[-.17, .01, 0], inertia=[.004, .03, .03],
                terms=(1.5, 2, .25), effort=80)],
    "6R": [dict(d=.0892, alpha=1.5707963267948966, mass=3.7, com=[0, -.0256, .0019],
                inertia=[.0103, .0103, .0067], terms=(4, 6, .6), effort=150),
           dict(a=-.425, mass=8.393, com=[.2125, 0, .1134],
                inertia=[.0151, .2269, .2269], terms=(4, 6, .6), effort=150),
           dict(a=-.39225, mass=2.275, com=[.15, 0, .0265],
                inertia=[.0041, .0494, .0494], terms=(3, 4, .4), effort=150),
           dict(d=.10915, alpha=1.5707963267948966, mass=1.219, com=[0, -.0018, .0163],
                inertia=[.0019, .0019, .0012], terms=(.6, 1, .08), effort=28),
           dict(d=.09465, alpha=-1.5707963267948966, mass=1.219, com=[0, .0018, .0163],
                inertia=[.0019, .0019, .0012], terms=(.6, 1, .08), effort=28),
           dict(d=.0823, mass=.4, com=[0, 0, -.0116], inertia=[.0002, .0002, .0003],
                terms=(.5, .8, .08), effort=28)],
}
TERMS = ("viscous", "coulomb", "armature")
# 1R turns about the horizontal: gravity lies across its axis.
GRAVITY = {"1R": [0, -9.81, 0]}


def robot_text(arm, factors):
    lines = [f"name: commanded_{arm}", "convention: standard",
             f"gravity: {GRAVITY.get(arm, [0, 0, -9.81])}", "links:"]
    for link, factor in zip(LINKS[arm], factors):
        fields = {k: link[k] for k in ("a", "d", "alpha", "mass", "com", "inertia")
                  if k in link}
        for term, value, f in zip(TERMS, link["terms"], factor):
            fields[term] = value * f
        values = ", ".join(f"{k}: {v}" for k, v in fields.items())
        lines.append(f"  - {{joint: revolute, {values}, limits: {{lower: -2.6, "
                     f"upper: 2.6, velocity: 2.5, effort: {link['effort']}}}}}")
    return "\n".join(lines) + "\n"


def controller_text(kp, kd, delay):
    show = lambda values: "[" + ", ".join(f"{v:.6g}" for v in values) + "]"
    text = f"law: p\nrate: 1000\nkp: {show(kp)}\nkd: {show(kd)}\n"
    return text + (f"delay: {delay}\n" if delay else "")


def gains(arm):
    """Critically damped for the inertia that a joint sees in a middle posture:
    its armature and a part of what it carries."""
    omega, kp, kd = 2 * math.pi * BANDWIDTH, [], []
    links = LINKS[arm]
    for j, link in enumerate(links):
        carried = sum(.1 * other["mass"] * (k - j + 1)
                      * max(abs(other.get("a", 0)), .1) ** 2 * 3
                      for k, other in enumerate(links) if k >= j)
        inertia = link["terms"][2] + carried
        kp.append(omega ** 2 * inertia)
        kd.append(2 * omega * inertia)
    return kp, kd


def write_commanded(log, out):
    """t, q and qref alone."""
    with open(log, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    keep = [i for i, name in enumerate(rows[0])
            if name == "t" or name.startswith("qref") or name[1:].isdigit()
            and name[0] == "q"]
    with open(out, "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows(
            [[row[i] for i in keep] for row in rows])


def make(armcal, arm, folder):
    draw = random.Random(f"commanded {arm}")
    hidden = folder / "hidden"
    hidden.mkdir(parents=True, exist_ok=True)
    n = len(LINKS[arm])
    (hidden / "truth.yaml").write_text(robot_text(arm, [[1] * 3] * n))
    wrong = [[draw.uniform(.5, 1.5) for _ in TERMS] for _ in range(n)]
    (folder / "robot.yaml").write_text(robot_text(arm, wrong))
    kp, kd = gains(arm)
    (hidden / "controller.yaml").write_text(controller_text(kp, kd, DELAY))
    (folder / "known_gains.yaml").write_text(controller_text(kp, kd, 0))
    off = lambda values: [v * draw.uniform(.85, 1.15) for v in values]
    (folder / "controller.yaml").write_text(controller_text(off(kp), off(kd), 0))
    for run, name in ((1, "train"), (2, "held_out")):
        subprocess.run(
            [armcal, "simulate", f"--robot={hidden}/truth.yaml",
             f"--controller={hidden}/controller.yaml", f"--run={run}",
             f"--duration={DURATION}", f"--encoder_resolution={RESOLUTION}",
             "--encoder_noise=2e-5", "--quiet", f"--out={folder}/{name}",
             f"--truth={folder}/{name}"], check=True)
        write_commanded(folder / name / "log.csv", folder / f"{name}.csv")
        (folder / name / "log.csv").unlink()
        (folder / name / "truth.json").rename(hidden / f"{name}.json")
        (folder / name).rmdir()
    subprocess.run([armcal, "inspect", f"--robot={folder}/robot.yaml",
                    "--export=mjcf", "--quiet", f"--out={folder}"],
                   check=False, stdout=subprocess.DEVNULL)
    (folder / "inspect.json").unlink(missing_ok=True)
    truth = {"kp": kp, "kd": kd, "delay": DELAY}
    for k, term in enumerate(("damping", "frictionloss", "armature")):
        truth[term] = [link["terms"][k] for link in LINKS[arm]]
    (hidden / "truth.json").write_text(json.dumps(truth, indent=2) + "\n")


def main():
    armcal, out = sys.argv[1], pathlib.Path(sys.argv[2])
    for arm in sys.argv[3:] or ["1R", "3R"]:
        make(armcal, arm, out / arm)


if __name__ == "__main__":
    main()
