#!/usr/bin/env python3
"""Twelve kinds of faults planted in ten real logs: how many `armcal inspect` names.

Reads ../shared/data, writes to a temporary folder. Each kind is planted once in each
log that can hold it (a clock is told by recorded velocities, so it is planted where there
are some; a lost sign where a torque has two). Joints and places are drawn from a seed
that is the names of log and kind, and of --seed, with which sizes are drawn, too: .7 to 1.6
times those that the kinds' sentences have. Logs are split: those of BUILD were looked at
while the inspection was written, those of FINAL later; a seed that nobody has used draws
what nobody has looked at.

What is said beside is counted: findings that neither name what was planted nor follow from
it nor are said of the log as it was.

    python3 tests/real/planted_faults.py --armcal=build/armcal --part=final --seed=1
"""
import argparse
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
from planted_log import DATA, UR10E, Log  # noqa: E402

# (folder, log, robot, flags)
BUILD = [("panda", "log.csv", "robot.urdf", ()),
         ("ur10e_free", "id_20s.csv", "robot.urdf", UR10E),
         ("dvrk_psm", "reference.csv.gz", "robot.urdf", ()),
         ("schunk_lwa4p", "run_080.csv.gz", "robot.urdf", ()),
         ("tx40", "log.csv.gz", "robot.urdf", ())]
FINAL = [("ur10e_free", "id_50s.csv", "robot.urdf", UR10E),
         ("dvrk_psm", "log_C.csv.gz", "robot.urdf", ()),
         ("schunk_lwa4p", "run_090.csv.gz", "robot.urdf", ()),
         ("kr300", "log_C.csv.gz", "robot.urdf", ()),
         ("dfki_double_pendulum", "A0_sysid_01.csv", "robot_A.urdf", ())]
LEAST_SHARE = .95


class Draw(random.Random):
    """Draws of a case; sizes are the usual ones where no seed is given."""

    def __init__(self, case, seed):
        super().__init__(f"{case}/{seed}" if seed else case)
        self.seeded = bool(seed)

    def size(self, usual):
        return usual * self.uniform(.7, 1.6) if self.seeded else usual


def negate(x):
    x[:] = [-value for value in x]


def fast_clock(log, draw):
    """Stamps of a clock that is 3 % fast."""
    rate = 1 + draw.size(.03)
    log.t = [rate * t for t in log.t]


def hidden_holes(log, draw):
    """4 % of the rows lost in bursts of 2 to 8, and stamps that go on as if none were."""
    stamps, lost, share = list(log.t), set(), draw.size(.04)
    while len(lost) < share * log.size():
        begin = draw.randrange(1, log.size() - 9)
        lost.update(range(begin, begin + draw.randint(2, 8)))
    log.keep([k for k in range(log.size()) if k not in lost])
    log.t = stamps[:log.size()]


def position_sign(log, draw):
    j = draw.choice(log.moving())
    for signal in ("q", "qd"):
        if signal in log.columns:
            negate(log.columns[signal][j])
    return j


def torque_sign(log, draw):
    j = draw.choice(log.moving())
    negate(log.columns[log.torque][j])
    return j


def exchanged(log, draw):
    a, b = sorted(draw.sample(log.moving(), 2))
    for columns in log.columns.values():
        columns[a], columns[b] = columns[b], columns[a]
    return a


def exchanged_alone(signals):
    """These signals of two joints are exchanged, the others not."""
    def make(log, draw):
        a, b = sorted(draw.sample(log.moving(), 2))
        for signal in signals(log):
            if signal in log.columns:
                columns = log.columns[signal]
                columns[a], columns[b] = columns[b], columns[a]
        return a
    return make


def in_unit(unit, joints):
    """Positions and velocities of these joints in a unit of so many rad or m."""
    def make(log, _):
        for signal in ("q", "qd"):
            for j in joints(log) if signal in log.columns else ():
                log.columns[signal][j] = [x / unit for x in log.columns[signal][j]]
    return make


def turning(log):
    return [j for j in range(log.joints) if j not in log.sliding()]


def late_torques(log, draw):
    columns, delay = log.columns[log.torque], draw.size(.03)
    columns[:] = [log.late(x, delay) for x in columns]


def late_velocity(log, draw):
    j = draw.choice(log.moving())
    log.columns["qd"][j] = log.late(log.columns["qd"][j], draw.size(.03))
    return j


def repeated_rows(log, draw):
    """3 rows of 10 are the row before."""
    rows, share = [0], draw.size(.3)
    for k in range(1, log.size()):
        rows.append(rows[-1] if draw.random() < share else k)
    stamps = log.t
    log.keep(rows)
    log.t = stamps


def held_torque(log, draw):
    """One joint's torque is new in every fourth row."""
    j = draw.choice(log.moving())
    x = log.columns[log.torque][j]
    every = round(draw.size(4))
    x[:] = [x[k - k % every] for k in range(log.size())]
    return j


def stuck_position(log, draw):
    """2.5 s, or four tenths of a shorter log, while the joint moves as it mostly does."""
    j = draw.choice(log.moving())
    q = log.columns["q"][j]
    rows = round(min(draw.size(2.5), .4 * (log.t[-1] - log.t[0])) * log.size() /
                 (log.t[-1] - log.t[0]))
    begins = [draw.randrange(log.size() - rows) for _ in range(9)]
    travel = sorted((max(q[b:b + rows]) - min(q[b:b + rows]), b) for b in begins)
    begin = travel[draw.randint(4, 8)][1]
    q[begin:begin + rows] = [q[begin]] * rows
    return j


def two_signs(log):
    """Moving joints whose torque has either sign for a fifth of the time."""
    def share(x):
        return sum(1 for value in x if value < 0) / len(x)
    columns = log.columns[log.torque]
    return [j for j in log.moving() if .2 < share(columns[j]) < .8]


def lost_sign(log, draw):
    j = draw.choice(two_signs(log))
    x = log.columns[log.torque][j]
    x[:] = [abs(value) for value in x]
    return j


def holes(log, draw):
    """Four stretches of .15 to .3 s are missing, and the stamps say so."""
    lost = [(at, at + draw.uniform(.15, .3)) for at in
            (draw.uniform(log.t[0], log.t[-1] - .3) for _ in range(4))]
    log.keep([k for k in range(log.size())
              if not any(begin < log.t[k] < end for begin, end in lost)])


# What is true, too, of a log with a fault: repeated rows are not of their stamps' time, a
# position that stands still is not that of its velocity.
FOLLOWS = {"rows repeated": {"clock"}, "a position stuck": {"velocity"},
           "holes in the stamps": {"lost_samples"}}


def has_velocity(log):
    return "qd" in log.columns


def any_log(_):
    return True


def has_two(log):
    return len(log.moving()) > 1


# kind: (what plants it, where it can be, findings that name it)
KINDS = {
    "clock 3 % fast": (fast_clock, lambda log: has_velocity(log) and has_two(log), {"clock"}),
    "holes that stamps hide": (hidden_holes,
                               lambda log: has_velocity(log) and has_two(log), {"clock"}),
    "sign of a position": (position_sign, any_log, {"position_sign"}),
    "sign of a torque": (torque_sign, any_log, {"torque_sign"}),
    "two joints exchanged": (exchanged, has_two, {"joint_order"}),
    "torques 30 ms late": (late_torques, any_log, {"delay"}),
    "a velocity 30 ms late": (late_velocity, has_velocity, {"velocity", "velocity_delay"}),
    "rows repeated": (repeated_rows, any_log, {"repeated_rows"}),
    "a torque held": (held_torque, any_log, {"held"}),
    "a position stuck": (stuck_position, any_log, {"stuck"}),
    "a torque without its sign": (lost_sign, lambda log: bool(two_signs(log)),
                                  {"unsigned_torque"}),
    "holes in the stamps": (holes, any_log, {"holes"}),
}
# Which were thought of when the inspection had been built on those above.
LATER = {
    "positions exchanged": (exchanged_alone(lambda log: ("q", "qd")), has_two,
                            {"position_order"}),
    "torques exchanged": (exchanged_alone(lambda log: (log.torque,)), has_two,
                          {"torque_order"}),
    "degrees": (in_unit(math.pi / 180, turning), lambda log: bool(turning(log)),
                {"position_unit"}),
    "mm": (in_unit(1e-3, Log.sliding), lambda log: bool(log.sliding()), {"position_unit"}),
}


def named(finding, names, joint):
    """Or said to be one of some that explain the log alike."""
    return any(one["finding"] in names and (joint is None or one["joint_index"] == joint + 1)
               for one in [finding] + finding["alternatives"])


def inspect(armcal, case, path, work):
    folder, _, robot, flags = case
    out = work / (path.stem + "_out")
    result = subprocess.run(
        [armcal, "inspect", f"--robot={DATA / folder / robot}", f"--log={path}", *flags,
         f"--out={out}"], capture_output=True, text=True, check=False)
    if result.returncode > 1:
        raise RuntimeError(f"{path.name}: {result.stderr.strip()}")
    return json.loads((out / "inspect.json").read_text())["logs"][0]["findings"]


def said(finding):
    return f"{finding['finding']}@{finding['joint_index']}"


def words(findings):
    return ", ".join(said(f) for f in findings) or "nothing"


def untouched(armcal, case, work):
    """What is said of the log as it is."""
    path = work / f"{case[0]}_{case[1].split('.')[0]}.csv"
    Log(DATA / case[0] / case[1]).write(path)
    return {said(f) for f in inspect(armcal, case, path, work)}


def plant(job):
    armcal, case, kind, seed, before, work = job
    make, can, names = {**KINDS, **LATER}[kind]
    log = Log(DATA / case[0] / case[1])
    if not can(log):
        return case, kind, None, 0, ""
    joint = make(log, Draw(f"{case[0]}/{case[1]}/{kind}", seed))
    path = work / f"{case[0]}_{case[1].split('.')[0]}_{kind.replace(' ', '_')}.csv"
    log.write(path)
    findings = inspect(armcal, case, path, work)
    found = any(named(f, names, joint) for f in findings)
    beside = [f for f in findings if said(f) not in before and
              not named(f, names, joint) and
              f["finding"] not in FOLLOWS.get(kind, set())]
    place = "" if joint is None else f"@{joint + 1}"
    also = f"; beside it {words(beside)}" if beside else ""
    return case, kind, found, len(beside), f"{place}: {words(findings)}{also}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--armcal", required=True)
    parser.add_argument("--part", choices=("build", "final", "all"), default="all")
    parser.add_argument("--later", action="store_true", help="the kinds of LATER instead")
    parser.add_argument("--kind", default="", help="only kinds whose name holds this")
    parser.add_argument("--log", default="", help="only logs whose name holds this")
    parser.add_argument("--seed", default="", help="draws other joints, places and sizes")
    result_files.add_flag(parser)
    arguments = parser.parse_args()
    if not DATA.exists():
        print("no ../shared/data: skipped")
        return 77
    cases = {"build": BUILD, "final": FINAL, "all": BUILD + FINAL}[arguments.part]
    armcal = Path(arguments.armcal).resolve()
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(2) as pool:
        cases = [case for case in cases if arguments.log in "/".join(case[:2])]
        work = Path(folder)
        before = pool.map(lambda case: untouched(armcal, case, work), cases)
        jobs = [(armcal, case, kind, arguments.seed, said_before, work)
                for case, said_before in zip(cases, before)
                for kind in (LATER if arguments.later else KINDS)
                if arguments.kind in kind]
        results = [r for r in pool.map(plant, jobs) if r[2] is not None]
    for case, kind, found, _, text in results:
        print(f"{'found ' if found else 'MISSED'} {case[0]}/{case[1]}, {kind}{text}")
    found = sum(r[2] for r in results)
    beside = sum(r[3] for r in results)
    print(f"{found} of {len(results)} found ({100 * found / max(1, len(results)):.1f} %), "
          f"{beside} findings beside them")
    if arguments.results:
        by_log = {part: [r[2] for r in results if r[0] in of]
                  for part, of in (("build", BUILD), ("final", FINAL))}
        result_files.write(
            arguments.results, "real logs with planted faults, built on and others: "
            "found, of; findings beside", {
                **{part: [sum(found), len(found)] for part, found in by_log.items()},
                "all": [found, len(results)],
                "missed": len(results) - found, "beside": beside})
    return 0 if found >= LEAST_SHARE * len(results) else 1


if __name__ == "__main__":
    sys.exit(main())
