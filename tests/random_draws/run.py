#!/usr/bin/env python3
"""Gives armcal random robots and logs, and judges how each run ends.

  run.py --armcal=BINARY --work=SCRATCH [--first=0] [--count=10000] [--seed=1]
         [--jobs=2] [--quick] [--table] [--sentences] [--keep]

Every run must end in a verdict (verdicts.py): a result, whose every published
number is one, or a refusal that says what is wrong. None may crash or take more
than 60 s. A draw is told by --seed and its number alone: --first=N --count=1
--keep repeats it and leaves its files in SCRATCH. --quick leaves out commands that take seconds. Prints each fault, how the
runs ended, and with --table what was drawn; exit code 1 if there is any fault.
"""

import argparse
import collections
import concurrent.futures
import os
import pathlib
import re
import resource
import shutil
import sys
import time
import traceback

# Matrices of a few rows are not shared out.
os.environ |= {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
import commands
import verdicts
from limited_process import LimitedProcess

HANGS = 600  # s by the clock, where cores are shared
MOST_ADDRESSES = 2 << 30
QUICK = ("calibrate", "inspect", "reduce", "merge")


class Outcome(LimitedProcess):
    """How armcal ended in a folder."""

    def __init__(self, armcal, arguments, folder):
        limits = {resource.RLIMIT_CPU: verdicts.LONGEST, resource.RLIMIT_AS: MOST_ADDRESSES}
        super().__init__([armcal] + arguments, folder,
                         [folder / name for name in ("stdout", "stderr")], limits, HANGS)


def run_draw(arguments, index):
    """(kinds, [(command, how it ended, its sentence, s, bytes)], faults)"""
    samples = lambda rng: int(10 ** rng.uniform(1.5, 1.5 + arguments.log_size))
    folder = arguments.work / str(index)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    start = time.process_time()
    draw = commands.draw(arguments.seed, index, samples)
    for name, text in draw.files.items():
        (folder / name).write_text(text)
    drawing = time.process_time() - start
    runs, faults = [], []
    for command in draw.commands:
        if arguments.quick and command[0] not in QUICK:
            continue
        outcome = Outcome(str(arguments.armcal), command, folder)
        try:
            faults += [f"armcal {' '.join(command)}\n    {fault}"
                       for fault in verdicts.judged(outcome, folder)]
        except Exception:  # such as JSON that is none
            faults.append(f"armcal {' '.join(command)}\n    {traceback.format_exc()}")
        if index % 25 == 0 and command[0] == "calibrate" and outcome.code < 2:
            faults += differences(arguments, command, folder)
        runs.append((command[0], verdicts.ENDED.get(outcome.code, f"exit {outcome.code}"),
                     sentence(outcome, folder), outcome.seconds, outcome.bytes))
        if outcome.code >= 2 or outcome.code < 0 or not (folder / "out/robot.urdf").exists():
            if command[0] != "reduce" or outcome.code > 1:
                break
    if arguments.keep:
        (folder / "commands").write_text("\n".join(" ".join(c) for c in draw.commands) + "\n")
    else:
        shutil.rmtree(folder)
    return draw.kinds, runs, faults, drawing


def differences(arguments, command, folder):
    """What three threads, which work in batches of their own, change."""
    threaded = [{"--threads=1": "--threads=3", "--out=out": "--out=threaded"}.get(x, x)
                for x in command]
    Outcome(str(arguments.armcal), threaded, folder)
    for name in ("calibration.json", "covariance.csv", "outliers.csv"):
        one, three = (folder / out / name for out in ("out", "threaded"))
        if one.exists() and one.read_bytes() != three.read_bytes():
            yield f"armcal {' '.join(threaded)}\n    {name} depends on the number of threads"


def sentence(outcome, folder):
    """What it says of a refusal or a negative verdict, without its numbers."""
    if outcome.code == 1:
        said = [line for line in (outcome.out + outcome.err).splitlines()
                if re.match(r"\s*(failed|not (verified|converged))|.*: not calibrated", line)]
        text = said[0] if said else "its text says so"
    else:
        text = outcome.err.splitlines()[-1] if outcome.err else ""
    return re.sub(r"[-+]?\d[\d.]*(e[-+]?\d+)?", "#", text)[:200]


def main():
    parser = argparse.ArgumentParser()
    for name in ("armcal", "work"):
        parser.add_argument(f"--{name}", type=lambda p: pathlib.Path(p).resolve(), required=True)
    for name, default in (("first", 0), ("count", 10000), ("seed", 1), ("jobs", 2)):
        parser.add_argument(f"--{name}", type=int, default=default)
    parser.add_argument("--log_size", type=float, default=0.8, help="decades above 30 rows")
    for name in ("quick", "table", "sentences", "keep"):
        parser.add_argument(f"--{name}", action="store_true")
    arguments = parser.parse_args()
    kinds = collections.defaultdict(collections.Counter)
    ended, said = collections.Counter(), collections.defaultdict(list)
    slowest, drawing, faulty = [], 0, 0
    with concurrent.futures.ProcessPoolExecutor(arguments.jobs) as pool:
        indices = range(arguments.first, arguments.first + arguments.count)
        for index, (drawn, runs, faults, seconds) in zip(indices, pool.map(
                run_draw, [arguments] * len(indices), indices, chunksize=4)):
            drawing += seconds
            for group, kind in drawn.items():
                kinds[group][kind] += 1
            for command, end, text, seconds, _ in runs:
                ended[command, end] += 1
                if end != "result":
                    said[command, end, text].append(index)
                slowest.append((seconds, index, command))
            for fault in faults:
                print(f"draw {index}: {fault}", flush=True)
            faulty += bool(faults)
    if arguments.table:
        for group, counts in sorted(kinds.items()):
            print(f"{group}: " + ", ".join(f"{kind} {n}" for kind, n in counts.most_common()))
    if arguments.sentences:
        for (command, end, text), where in sorted(said.items(), key=lambda x: -len(x[1])):
            print(f"{len(where):5} {command}, {end} (draw {where[0]}): {text}")
    for command in sorted({c for c, _ in ended}):
        print(f"{command}: " + ", ".join(f"{n} {end}" for (c, end), n in sorted(ended.items())
                                         if c == command))
    slowest.sort(reverse=True)
    print("slowest: " + ", ".join(f"{s:.1f} s (draw {k}, {c})" for s, k, c in slowest[:5]) +
          f"; all {sum(s for s, _, _ in slowest):.0f} s of CPU, drawing {drawing:.0f} s")
    print(f"seed {arguments.seed}: {arguments.count} draws from {arguments.first} on, "
          f"{len(slowest)} runs, {faulty} with faults")
    return faulty > 0 or not slowest


if __name__ == "__main__":
    sys.exit(main())
