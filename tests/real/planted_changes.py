#!/usr/bin/env python3
"""Changes of known size put into real logs: which does a diagnosis by a reference name?

  python3 tests/real/planted_changes.py --armcal=build/armcal [--kinds=delay,...]
      [--pairs=NAME,...] [--work=DIR] [--results=FILE]

Pairs of logs of one real robot in one state (or halves of its only log): the first is the
reference, the second is changed (plants.py) and diagnosed. What is named when it is small has to
be named when it is large. Counted are, by size, the logs in which the change is named above 50 %
on its joint; other names beside it; and intervals of three deviations that hold what was put in.
Ten minutes on two cores; decides nothing.
"""

import argparse
import json
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import plants  # noqa: E402
import result_files  # noqa: E402
from planted_log import DATA, UR10E, Log  # noqa: E402
from reading import claims, told  # noqa: E402

PAIRS = {  # name: set, robot file, reference, log (None: halves of the first), flags
    "ur20": ("ur10e_free", "robot.urdf", "id_20s.csv", "id_30s.csv", UR10E),
    "ur40": ("ur10e_free", "robot.urdf", "id_40s.csv", "id_50s.csv", UR10E),
    "kr300": ("kr300", "robot.urdf", "log_A.csv.gz", "log_B.csv.gz", ()),
    "schunk80": ("schunk_lwa4p", "robot.urdf", "run_080.csv.gz", "run_081.csv.gz", ()),
    "schunk1": ("schunk_lwa4p", "robot.urdf", "run_001.csv.gz", "run_002.csv.gz", ()),
    "dvrk": ("dvrk_psm", "robot.urdf", "reference.csv.gz", "reference_val.csv.gz",
             ("--gravity=0,0,-9.81",)),
    "acrobot1": ("dfki_acrobot", "robot.urdf", "reference_01.csv.gz", "reference_02.csv.gz", ()),
    "acrobot5": ("dfki_acrobot", "robot.urdf", "reference_05.csv.gz", "reference_06.csv.gz", ()),
    "double_A": ("dfki_double_pendulum", "robot_A.urdf", "A0_sysid_01.csv", "A0_sysid_02.csv", ()),
    "double_C": ("dfki_double_pendulum", "robot_C.urdf", "C1_sysid_01.csv", "C1_sysid_02.csv", ()),
    "pendubot1": ("innopolis_pendubot", "robot.urdf", "position_A_1p2_v_0p1.csv",
                  "position_A_1p2_v_0p2.csv", ()),
    "pendubot3": ("innopolis_pendubot", "robot.urdf", "position_A_1p2_v_0p3.csv",
                  "position_A_1p2_v_0p5.csv", ()),
    "pendulum": ("dfki_simple_pendulum", "robot.urdf", "swing_A.csv", "swing_B.csv", ()),
    "tx40": ("tx40", "robot.urdf", "log.csv.gz", None, ()),
    "panda": ("panda", "robot.urdf", "log.csv", None, ()),
    "panda2": ("panda_set2", "robot.urdf", "log.csv.gz", None, ()),
}
KINDS = {  # how a change is planted, its sizes, the effects that are right, the estimate's name
    "none": (plants.none, (0,), (), None),
    "delay": (plants.delay, (5, 10, 20, 40, 80), ("delay",), "delay"),
    "gain": (plants.gain, (5, 10, 20, 40), ("torque_gain",), "gain"),
    "scale": (plants.scale_all, (5, 10, 20, 40), ("torque_gain_of_all_joints",), "gain"),
    "coulomb": (plants.coulomb, (5, 10, 20, 40), ("coulomb_friction",), "coulomb"),
    "viscous": (plants.viscous, (5, 10, 20, 40), ("viscous_friction",), "viscous"),
    "encoder": (plants.encoder, (.5, 2, 8), ("encoder_offset",), "offset"),
    "pulse": (plants.pulse, (20, 40, 80), ("external_contact",), None),
    "push": (plants.push, (20, 40, 80), ("external_contact",), None),
    "payload": (plants.payload, (5, 10, 20, 40), ("payload", "added_mass"), "mass"),
}


def constants(flags, joints):
    given = [f.split("=")[1] for f in flags if f.startswith("--torque_constants=")]
    return np.array([float(x) for x in given[0].split(",")] if given else [1] * joints)


def half(log, first):
    middle = log.size() // 2
    log.keep(range(middle) if first else range(middle, log.size()))
    return log


def prepared(work, name, tag=""):
    """(reference's file, log to be changed, flags) of a pair. `tag`: whose the file is, where
    several jobs write one at a time."""
    folder, robot, reference, other, flags = PAIRS[name]
    flags = (f"--robot={DATA / folder / robot}", *flags)
    if other:
        return DATA / folder / reference, Log(DATA / folder / other), flags
    path = work / f"{name}{tag}_reference.csv"
    half(Log(DATA / folder / reference), True).write(path)
    return path, half(Log(DATA / folder / reference), False), flags


def true_value(kind, size, log):
    """In the estimate's unit, or None where the truth has another form."""
    if kind in ("gain", "scale"):
        return 1 / (1 + size / 100) - 1
    return {"delay": -1e-3 * size, "encoder": np.radians(size),
            "payload": getattr(log, "planted", None)}.get(kind)


def joints_of(claim):
    """Those that a claim is of, from 1: of contacts the ones that felt them."""
    return {claim["joint_index"], *(c["joint_index"] for c in claim.get("contacts", []))}


def run(job):
    """One diagnosis: {named, beside, right interval or None, words}; None: that log cannot have
    this change."""
    armcal, work, name, kind, size = job
    reference, log, flags = prepared(work / "references", name, f"_{kind}_{size}")
    plant, _, effects, estimate = KINDS[kind]
    robot = {"file": flags[0].split("=")[1], "gravity": np.array([0, 0, -9.81]),
             "constants": constants(flags, log.joints)}
    joint = plant(log, size, robot)
    if joint is None:
        return None
    path = work / f"{name}_{kind}_{size}.csv"
    log.write(path)
    out = path.with_suffix("")
    done = subprocess.run([armcal, "diagnose", *flags, f"--reference={reference}", f"--log={path}",
                           "--forward=false", f"--out={out}"], capture_output=True, text=True,
                          check=False)
    (work / f"{out.name}.txt").write_text(done.stdout + done.stderr)
    path.unlink()
    if done.returncode > 1 or not (out / "diagnosis.json").exists():
        return {"named": False, "beside": 0, "interval": None,
                "words": (done.stderr.strip().splitlines() or ["no answer"])[-1]}
    found = json.loads((out / "diagnosis.json").read_text())
    right = [c for c in claims(found) if c["effect"] in effects and
             (not joint or joint in joints_of(c))]
    truth, interval = true_value(kind, size, log), None
    for entry in right[:1]:
        for e in entry["estimates"]:
            if truth is not None and re.search(rf"\b{estimate}\b", e["name"]) and e["stddev"]:
                interval = abs(e["value"] - truth) <= 3 * e["stddev"]
    return {"named": bool(right), "beside": len(claims(found)) - len(right), "interval": interval,
            "words": told(found)}


def report(results, sizes, kind):
    """Prints a kind's table, pair by pair; sizes rise to the right. Returns its counts."""
    counts = {"logs": 0, "named": {s: 0 for s in sizes}, "beside": 0, "lost_when_larger": 0,
              "intervals": [0, 0]}
    for name in dict.fromkeys(n for n, k, _ in results if k == kind):
        row = [results[name, kind, s] for s in sizes]
        if None in row:
            continue
        counts["logs"] += 1
        marks = "".join("#" if r["named"] else "." for r in row)
        counts["lost_when_larger"] += marks.count("#.")
        for size, r in zip(sizes, row):
            counts["named"][size] += r["named"]
            counts["beside"] += r["beside"]
            if r["interval"] is not None:
                counts["intervals"][0] += r["interval"]
                counts["intervals"][1] += 1
            print(f"  {name:10} {kind} {size:<4} {'named ' if r['named'] else 'missed'} "
                  f"{'' if r['interval'] in (None, True) else '(interval) '}{r['words']}")
        print(f"{name:10} {kind:9} {marks}", flush=True)
    return counts


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--armcal", required=True)
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--pairs", default=",".join(PAIRS))
    parser.add_argument("--work")
    result_files.add_flag(parser)
    flags = parser.parse_args()
    if not DATA.exists():
        print("no ../shared/data: skipped")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        work = Path(flags.work or folder)
        (work / "references").mkdir(parents=True, exist_ok=True)
        armcal = Path(flags.armcal).resolve()
        for name in flags.pairs.split(","):
            prepared(work / "references", name)
        jobs = [(armcal, work, name, kind, size) for kind in flags.kinds.split(",")
                for name in flags.pairs.split(",") for size in KINDS[kind][1]]
        with ThreadPoolExecutor(2) as pool:
            results = dict(zip((job[2:] for job in jobs), pool.map(run, jobs)))
        figures = {kind: report(results, KINDS[kind][1], kind)
                   for kind in flags.kinds.split(",")}
    for kind, counts in figures.items():
        named = " ".join(f"{size}:{count}" for size, count in counts["named"].items())
        print(f"{kind:9} named of {counts['logs']}: {named}; beside "
              f"{counts['beside']}, lost when larger {counts['lost_when_larger']}, intervals "
              f"{counts['intervals'][0]} of {counts['intervals'][1]}")
    if flags.results:
        result_files.write(flags.results, "changes put into real logs: named, by size; names "
                           "beside them; lost when larger; intervals of 3 deviations that hold",
                           figures)
    return 0


if __name__ == "__main__":
    sys.exit(main())
