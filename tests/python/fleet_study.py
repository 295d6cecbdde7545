#!/usr/bin/env python3
"""A fleet of 200 simulated units, as docs/fleet.md tells of it; takes minutes.

  PYTHONPATH=build/python tests/python/fleet_study.py FOLDER [UNITS [ROUNDS]]

Prints whether what was planted is found, how far merging is from one pass over
all logs, whether 1, 2 and 4 workers (and 2 of which one is killed) give the
same bits, what 2 workers take of the time of 1 (medians of ROUNDS, in turns),
and what units with short logs gain.
"""

import hashlib
import os
import pathlib
import shutil
import statistics
import sys
import time

import armcal
import numpy as np
from armcal.fleet import calibrate_fleet, read_table

import fleet_units

SQUARED = {**fleet_units.MODEL, "loss": "squared"}
FILES = ("fleet.json", "calibration.json", "merged.factor")


def run(folder, robot, recordings, workers, kill_at=None):
    """The result, its hash, and how long it took beyond starting workers: s,
    and CPU s of this process and of the worker that worked most, which on cores
    of their own would be that time."""
    out = folder / "out"
    shutil.rmtree(out, ignore_errors=True)
    with fleet_units.cluster_of(workers) as client:
        pids = list(client.run(os.getpid).values())
        client.run(__import__, "armcal.fleet")

        def done(count, _total):
            if count == kill_at:
                os.kill(pids[0], 9)

        before = client.run(time.process_time)
        started, own = time.monotonic(), time.process_time()
        result, refused = calibrate_fleet(client, robot, recordings, str(out),
                                          done=done, **SQUARED)
        took = time.monotonic() - started
        if kill_at is None:
            after = client.run(time.process_time)
            busy = time.process_time() - own + max(
                after[worker] - before[worker] for worker in after)
        else:
            busy = 0
    assert not refused, refused
    bits = hashlib.sha256()
    for name in FILES:
        bits.update((out / name).read_bytes())
    return result, bits.hexdigest(), (took, busy)


def show_planted(fleet):
    for outlier in fleet["outliers"]:
        print("outlier", outlier["unit"], outlier["parameter"],
              f"{outlier['deviation']:+.3g}, {outlier['sigmas']:.1f} sigma")
    print("planted", fleet_units.OUTLIERS)
    for p in fleet["parameters"]:
        if p["drifts"]:
            print(f"drift {p['name']} {p['drift_per_day']:+.3g} +- "
                  f"{p['drift_stddev']:.2g} a day; planted", fleet_units.DRIFT)


def show_units(fleet, truth):
    names = [p["name"] for p in fleet["parameters"]]
    for short in (True, False):
        units = [k for k in range(len(truth)) if (k % 3 == 2) == short]
        ratios = [fleet["units"][k]["stddev_ratio"] for k in units]
        errors = {"values": [], "own_values": []}
        squares = []
        for k in units:
            unit = fleet["units"][k]
            for term in ("viscous", "coulomb"):
                for joint in range(2):
                    at = names.index(f"{term}[{joint + 1}]")
                    for key, list_of in errors.items():
                        list_of.append(unit[key][at] - truth[k][term][joint])
                    squares.append((errors["values"][-1] /
                                    unit["stddev"][at]) ** 2)
        rms = {key: np.sqrt(np.mean(np.square(e))) for key, e in errors.items()}
        print(f"{'short' if short else 'long'} logs: standard deviations "
              f"{np.median(ratios):.2f} of those alone (median); friction's "
              f"errors {rms['values'] / rms['own_values']:.2f} of those alone; "
              f"mean square of errors over standard deviations "
              f"{np.mean(squares):.2f}")


def show_times(folder, rounds):
    """A thousand logs of a minute."""
    fleet_units.write_units(folder, 1000, long_s=60, short_s=60)
    robot = armcal.read_robot(folder / "arm.yaml")
    recordings = read_table(str(folder / "units.csv"))
    taken = {1: [], 2: []}
    for _ in range(rounds):
        for workers in (1, 2):
            taken[workers].append(run(folder, robot, recordings, workers)[2])
    for k, what in enumerate(("s", "CPU s on the longest path")):
        one, two = (statistics.median(t[k] for t in taken[w]) for w in (1, 2))
        print(f"1 worker {one:.1f}, 2 workers {two:.1f} {what}: "
              f"{two / one:.2f}")


def main():
    folder = pathlib.Path(sys.argv[1])
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 200
    rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 3
    truth = fleet_units.write_units(folder, count)
    robot = armcal.read_robot(folder / "arm.yaml")
    recordings = read_table(str(folder / "units.csv"))
    hashes = set()
    for workers in (1, 2, 4):
        result, bits, _ = run(folder, robot, recordings, workers)
        hashes.add(bits)
    hashes.add(run(folder, robot, recordings, 2, kill_at=count // 2)[1])
    print("results that differ in bits:", len(hashes) - 1)
    show_planted(result.fleet)
    show_units(result.fleet, truth)
    single = armcal.calibrate(robot, [r.log for r in recordings],
                              estimate="linear", **SQUARED)
    x = single.model_parameters.values
    error = np.linalg.norm(result.model_parameters.values - x)
    print(f"merged from a single pass: {error / np.linalg.norm(x):.1e}")
    if rounds > 0:
        show_times(folder / "timed", rounds)


if __name__ == "__main__":
    main()
