#!/usr/bin/env python3
"""Pushes on simulated arms: how many `armcal diagnose` finds, and what it takes for one.

Each arm is drawn anew: three to seven joints, lengths, masses, friction. The robot differs
from its file by 3 %. A reference log of 20 s is free of pushes, a log of another motion has one
to four, 3 s apart. Half of the arms are pushed at the tool while Simbody simulates them (force
along any direction, sech^2 in time), half on one joint: that torque, a raised cosine or a hold
with ramps, is taken from the log's torque as a stiff controller would give it. The joint that feels a push
most feels 5 to 30 % of its rms torque (logarithmically even).

    python3 tests/blind/contacts_bench.py --armcal=build/armcal --arms=100 --seed=1

A push is found where a contact's window, or .3 s around its time, holds the push's middle. A contact that
holds no push is false.
"""
import argparse
import csv
import json
import math
import random
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import result_files  # noqa: E402

DURATION = 20.0
WIDTHS = (.1, .5)  # s, from the middle to where most is over


def arm_yaml(draw):
    """A serial arm with joints that turn across each other as those of most arms do."""
    n = draw.randint(3, 7)
    lines = ["name: arm", "gravity: [0, 0, -9.81]", "convention: standard", "links:"]
    mass, reach = draw.uniform(4, 14), draw.uniform(.25, .5)
    torque = 2.5 * mass * reach * 9.81 / 3
    for j in range(n):
        alpha = draw.choice((-1, 1)) * math.pi / 2 if j != 1 or n < 4 else 0
        a = reach if j in (1, 2) else 0
        d = 0 if j in (1, 2) else .8 * reach
        m = mass * .7 ** j
        size = max(a, d, .1)
        com = [-a / 2, -d / 2 if a == 0 else 0, 0]
        bar = m * size * size / 12
        friction = torque * draw.uniform(.04, .15)
        lines.append(
            f"  - {{joint: revolute, a: {a:.4f}, d: {d:.4f}, alpha: {alpha:.6f}, mass: {m:.3f}, "
            f"com: [{com[0]:.4f}, {com[1]:.4f}, 0], "
            f"inertia: [{bar:.5f}, 0, {bar:.5f}, 0, 0, {bar:.5f}], "
            f"viscous: {friction * draw.uniform(.3, 1.2):.4f}, coulomb: {friction:.4f}, "
            f"armature: {bar * draw.uniform(2, 8) + torque * .004:.5f}, "
            f"limits: {{lower: -2.2, upper: 2.2, velocity: {2 + .25 * j:.2f}, "
            f"effort: {6 * torque:.1f}}}}}")
        torque *= .55
    return "\n".join(lines) + "\n"


def read(path):
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return rows[0], [[float(x) for x in row] for row in rows[1:]]


def torques(path):
    header, rows = read(path)
    columns = [k for k, name in enumerate(header) if name.startswith("tau")]
    return [[row[k] for row in rows] for k in columns]


def rms(x):
    return (sum(v * v for v in x) / len(x)) ** .5


def times_of(draw):
    """Of one to four pushes, at least 3 s apart."""
    count = draw.randint(1, 4)
    while True:
        times = sorted(draw.uniform(1.5, DURATION - 1.5) for _ in range(count))
        if all(b - a > 3 for a, b in zip(times, times[1:])):
            return times


def course(kind, width, t):
    """A raised cosine over 2 width, or a hold of width with ramps of half of that."""
    if kind == "cosine":
        return .5 * (1 + math.cos(math.pi * t / width)) if abs(t) < width else 0
    return min(1, max(0, (width - abs(t)) / (.5 * width)))


class Case:
    def __init__(self, armcal, work, index, seed):
        self.draw = random.Random(f"{seed}/{index}")
        self.armcal, self.index, self.folder = armcal, index, work / f"arm{index}"
        self.folder.mkdir()
        self.robot = self.folder / "arm.yaml"
        self.robot.write_text(arm_yaml(self.draw), encoding="utf-8")
        self.at_tool = index % 2 == 0
        self.motion = self.draw.choice(("fourier", "fourier", "points"))

    def simulate(self, name, run, effects=""):
        out = self.folder / name
        subprocess.run(
            [self.armcal, "simulate", f"--robot={self.robot}", "--robot_error=.03",
             f"--seed={self.index}", f"--run={run}", f"--duration={DURATION}",
             f"--motion={self.motion}", f"--effects={effects}", f"--out={out}", "--quiet"],
            check=True, capture_output=True, text=True)
        return out / "log.csv"

    def felt(self, free, time, width, path):
        """Of the joint that feels a push most, over its rms torque; and that joint."""
        scale = [rms(x) for x in free]
        pushed = torques(path)
        rate = 250
        rows = range(max(0, int((time - 2 * width) * rate)),
                     min(len(free[0]), int((time + 2 * width) * rate)))
        largest = [max(abs(pushed[j][k] - free[j][k]) for k in rows) / scale[j]
                   for j in range(len(free))]
        return max(largest), largest.index(max(largest))

    def push_tool(self):
        """(log, pushes): the forces are scaled to what is to be felt."""
        free = torques(self.simulate("free", 2))
        forces = [.05] * len(self.pushes)
        for _ in range(2):
            effects = ";".join(
                f"external_contact:force={f:.6g},time={p['time']:.6g}s,"
                f"width={p['width']:.6g}s" for f, p in zip(forces, self.pushes))
            log = self.simulate("pushed", 2, effects)
            for k, p in enumerate(self.pushes):
                share, p["joint"] = self.felt(free, p["time"], p["width"], log)
                p["felt"] = share
                forces[k] = min(1, max(1e-3, forces[k] * p["share"] / share))
        return log

    def push_joints(self):
        log = self.simulate("pushed", 2)
        header, rows = read(log)
        for p in self.pushes:
            column = header.index(f"tau{p['joint'] + 1}")
            torque = p["sign"] * p["share"] * rms([row[column] for row in rows])
            for row in rows:
                row[column] -= torque * course(p["course"], p["width"], row[0] - p["time"])
        with open(log, "w", encoding="utf-8", newline="") as file:
            csv.writer(file).writerows([header] + [[format(x, ".9g") for x in r] for r in rows])
        return log

    def run(self):
        joints = self.robot.read_text(encoding="utf-8").count("joint: revolute")
        draw = self.draw
        self.pushes = [
            {"time": t, "share": math.exp(draw.uniform(math.log(.05), math.log(.3))),
             "width": draw.uniform(*WIDTHS), "joint": draw.randrange(joints),
             "sign": draw.choice((-1, 1)), "course": draw.choice(("cosine", "hold"))}
            for t in times_of(draw)]
        reference = self.simulate("reference", 1)
        log = self.push_tool() if self.at_tool else self.push_joints()
        out = self.folder / "out"
        result = subprocess.run(
            [self.armcal, "diagnose", f"--robot={self.robot}", f"--log={log}",
             f"--reference={reference}", f"--out={out}", "--quiet"],
            capture_output=True, text=True, check=False)
        if not (out / "diagnosis.json").exists():
            raise RuntimeError(f"arm {self.index}: {result.stderr.strip()}")
        effects = json.loads((out / "diagnosis.json").read_text())["effects"]
        contacts = [c for e in effects for c in e.get("contacts") or []]
        others = [e["effect"] for e in effects
                  if e["effect"] != "external_contact" and e["probability"] > .5]
        return self.judge(contacts, others)

    def judge(self, contacts, others):
        def holds(contact, time):
            return (contact["begin"] <= time <= contact["end"] or
                    abs(contact["time"] - time) < .3)
        for p in self.pushes:
            near = [c for c in contacts if holds(c, p["time"])]
            p["found"] = bool(near)
            p["on_joint"] = any(c["joint_index"] == p["joint"] + 1 for c in near)
        right = sum(any(holds(c, p["time"]) for p in self.pushes) for c in contacts)
        return {"index": self.index, "kind": "tool" if self.at_tool else "joint",
                "motion": self.motion, "pushes": self.pushes, "contacts": len(contacts),
                "right": right, "others": others}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--armcal", required=True)
    parser.add_argument("--arms", type=int, default=100)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--json", help="writes all pushes and answers there")
    parser.add_argument("--keep", help="folder that logs and answers are kept in")
    result_files.add_flag(parser)
    arguments = parser.parse_args()
    armcal = str(Path(arguments.armcal).resolve())
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(2) as pool:
        work = Path(arguments.keep or folder)
        work.mkdir(exist_ok=True)
        indices = range(arguments.first, arguments.first + arguments.arms)
        results = list(pool.map(lambda k: Case(armcal, work, k, arguments.seed).run(), indices))
    for r in results:
        for p in r["pushes"]:
            print(f"{'found ' if p['found'] else 'MISSED'} arm {r['index']} ({r['kind']}, "
                  f"{r['motion']}): {100 * p['share']:.0f} % on joint {p['joint'] + 1} at "
                  f"{p['time']:.1f} s, {p['width']:.2f} s")
        if r["right"] < r["contacts"] or r["others"]:
            print(f"  arm {r['index']}: {r['contacts'] - r['right']} false contacts, "
                  f"also named {', '.join(r['others']) or 'nothing'}")
    if arguments.json:
        Path(arguments.json).write_text(json.dumps(results, indent=1), encoding="utf-8")
    pushes = [(r["kind"], p) for r in results for p in r["pushes"]]
    values = {}
    for kind in ("tool", "joint"):
        of = [p for k, p in pushes if k == kind]
        values[kind] = [sum(p["found"] for p in of), len(of), sum(p["on_joint"] for p in of)]
        print(f"{kind}: {sum(p['found'] for p in of)} of {len(of)} pushes found, "
              f"{sum(p['on_joint'] for p in of)} on the joint")
    found, contacts = sum(p["found"] for _, p in pushes), sum(r["contacts"] for r in results)
    right = sum(r["right"] for r in results)
    print(f"recall {found} of {len(pushes)}, precision {right} of {contacts}; "
          f"{sum(bool(r['others']) for r in results)} arms with another effect named")
    if arguments.results:
        result_files.write(arguments.results, "simulated arms that are pushed", {
            **values, "found": [found, len(pushes)], "right": [right, contacts],
            "others": sum(bool(r["others"]) for r in results)})
    return 0 if found >= .9 * len(pushes) and right >= .95 * contacts else 1


if __name__ == "__main__":
    sys.exit(main())
