#!/usr/bin/env python3
"""How soon does armcal watch tell a change that is one, and as what?

  changes.py --armcal=build/armcal --robot=ROBOT --payload=KG [--seeds=20]
             [--first=1]

Each arm's masses, inertias and friction are 5 % off its file; it is calibrated
on three logs of 30 s. Then 40 s of it are followed by 20 s in which something
has changed, in rows of 1 kHz that follow each other: a payload of KG; or more
Coulomb friction in one joint, a fifth of its usual torque; or a hand that pushes
the tool once, F / cosh^2((t - t0) / 30 ms), in a random direction. All act in the
simulated dynamics. Parts begin and end where the arm stands, so the delay
of a payload and of friction counts from the first motion of the changed arm; that
of a push from the time on at which it has a tenth of its force. "Moving": the
payload is there from one row to the next amid a motion, the rest of the log being
that of the same motion with it. Prints a line for each and the delays' quantiles.
"""

import argparse
import json
import subprocess
import tempfile

import numpy

from false_alarms import calibrate, simulate

MOVES = .06  # rad/s, of any joint
CHANGES = ("contact", "payload", "friction")
FORCES = (20, 40)  # N


def read(path):
    with open(path, encoding="ascii") as log:
        names = log.readline().strip().split(",")
    return names, numpy.loadtxt(path, delimiter=",", skiprows=1)


def watch(armcal, robot, calibration, names, rows):
    text = "\n".join([",".join(names)] + [",".join(f"{x:.9g}" for x in row)
                                          for row in rows]) + "\n"
    made = subprocess.run([armcal, "watch", f"--robot={robot}", "--log=-",
                           f"--calibration={calibration}", "--json"],
                          input=text, capture_output=True, text=True, check=False)
    return [json.loads(line) for line in made.stdout.splitlines()]


def joined(before, after):
    later = after.copy()
    later[:, 0] += before[-1, 0] + .001
    return numpy.vstack([before, later])


def columns(names, prefix):
    return [k for k, name in enumerate(names)
            if name.startswith(prefix) and name[len(prefix):].isdigit()]


def first_motion(names, rows, begin):
    moves = numpy.abs(rows[:, columns(names, "qd")]).max(axis=1) > MOVES
    return rows[(rows[:, 0] > begin) & moves][0, 0]


def told(events, kinds, begin):
    found = [e for e in events if e["event"] in kinds and e["time_s"] >= begin]
    return found[0] if found else None


class Trial:
    def __init__(self, arguments, seed, folder):
        self.arguments, self.seed, self.folder = arguments, seed, folder
        self.calibration = calibrate(arguments.armcal, arguments.robot, seed, folder)
        self.names, self.before = read(self.simulate(50, duration=40))

    def simulate(self, run, **options):
        return simulate(self.arguments.armcal, self.arguments.robot, self.seed,
                        run, f"{self.folder}/log", **options)

    def watch(self, rows):
        return watch(self.arguments.armcal, self.arguments.robot,
                     self.calibration, self.names, rows)

    def change(self, effect, kind):
        """Seconds from the first motion to the event, and what was said."""
        _, after = read(self.simulate(51, duration=20, effects=effect))
        rows = joined(self.before, after)
        change = self.before[-1, 0]
        events = self.watch(rows)
        early = [e for e in events if e["event"] in CHANGES and
                 e["time_s"] < change]
        event = told(events, (kind,), change)
        moved = first_motion(self.names, rows, change)
        return (None if event is None else event["time_s"] - moved, event,
                [e["event"] for e in events if e.get("time_s", 0) >= change][:5],
                early)

    def moving(self, mass):
        """Seconds from the first row with a payload to the event."""
        _, without = read(self.simulate(53, duration=50))
        _, loaded = read(self.simulate(53, duration=50,
                                       effects=f"payload:mass={mass}kg"))
        change = 36 + 1.3 * (self.seed % 7)
        rows = numpy.vstack([without[without[:, 0] < change],
                             loaded[loaded[:, 0] >= change]])
        events = self.watch(rows)
        event = told(events, ("payload",), change)
        return None if event is None else event["time_s"] - change

    def push(self, force):
        """Milliseconds from a tenth of the force to the contact."""
        _, after = read(self.simulate(
            52, duration=20, effects=f"external_contact:force={force}N,width=0.03"))
        with open(f"{self.folder}/log/truth.json", encoding="utf-8") as file:
            values = json.load(file)["effects"][0]["values"]
        middle = [v["value"] for v in values if v["name"] == "time"][0]
        begin = self.before[-1, 0] + .001 + middle - .03 * numpy.arccosh(10 ** .5)
        events = self.watch(joined(self.before, after))
        event = told(events, ("contact",), self.before[-1, 0])
        return None if event is None else 1e3 * (event["time_s"] - begin)


def summary(name, delays, unit):
    got = numpy.array([d for d in delays if d is not None])
    text = "none told" if got.size == 0 else (
        f"median {numpy.median(got):.3g} {unit}, largest {got.max():.3g} {unit}")
    print(f"{name}: {got.size} of {len(delays)} told, {text}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--armcal", required=True)
    parser.add_argument("--robot", required=True)
    parser.add_argument("--payload", type=float, required=True)
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--first", type=int, default=1)
    arguments = parser.parse_args()
    payloads, frictions, moving = [], [], []
    pushes = {force: [] for force in FORCES}
    for seed in range(arguments.first, arguments.first + arguments.seeds):
        with tempfile.TemporaryDirectory() as folder:
            trial = Trial(arguments, seed, folder)
            delay, event, what, early = trial.change(
                f"payload:mass={arguments.payload}kg", "payload")
            mass = event and event["values"][0]
            print(f"seed {seed}: payload after {delay} s, "
                  f"{mass and round(mass['value'], 3)} kg "
                  f"{mass and [round(x, 3) for x in mass['ci95']]}; {what}"
                  f"{'; EARLY ' + str(len(early)) if early else ''}", flush=True)
            payloads.append(delay)
            moving.append(trial.moving(arguments.payload))
            print(f"seed {seed}: payload while moving after {moving[-1]} s", flush=True)
            joint = 1 + seed % 6
            delay, event, what, early = trial.change(
                f"coulomb_friction@{joint}:friction=0.2", "friction")
            print(f"seed {seed}: friction of joint {joint} after {delay} s, "
                  f"{event and event['joints']}; {what}", flush=True)
            frictions.append(delay)
            for force in FORCES:
                pushes[force].append(trial.push(force))
            print(f"seed {seed}: pushes of {FORCES} N after "
                  f"{[pushes[force][-1] for force in FORCES]} ms", flush=True)
    summary("payload, moving", moving, "s")
    summary("payload, from first motion", payloads, "s")
    summary("friction, from first motion", frictions, "s")
    for force in FORCES:
        summary(f"push of {force} N", pushes[force], "ms")


if __name__ == "__main__":
    main()
