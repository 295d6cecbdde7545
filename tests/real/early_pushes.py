#!/usr/bin/env python3
"""Pushes on an acrobot before 2.75 s, while it still follows the motion of its
references (../shared/data/dfki_acrobot, TRUTH_events.csv): how many are found in
time, on their joint and with their sign, how many of the windows that are told hold
one, and how many calm runs have a contact.

    python3 tests/real/early_pushes.py --armcal=build/armcal [--before=2.75]
        [--work=FOLDER] [--results=FILE]

A push is found in time where a contact is told within .2 s of it. Exit code 1 where
a share is below its bar.
"""
import argparse
import os
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import result_files  # noqa: E402
from runs import Runs  # noqa: E402
from sets import dfki_acrobot as acrobot  # noqa: E402

BARS = {"time": .9, "joint": .8, "sign": .75, "windows": .85}


def counts(runs, before):
    """{what: [right, of]}: of pushes that begin, and of contacts that are, before
    that time."""
    every = acrobot.pushes()
    found = {what: [0, 0] for what in BARS}
    for k in acrobot.NUMBERS:
        run = f"run_{k}"
        pushes = [p for p in every if p["run"] == run]
        contacts = list(acrobot.contacts(runs[run]))
        for push in pushes:
            if float(push["t_start"]) >= before:
                continue
            near = [c for c in contacts if acrobot.in_time(push, c)]
            joint = [c for c in near if acrobot.on_joint(push, c)]
            sign = [c for c in joint if acrobot.with_sign(push, c)]
            for what, those in (("time", near), ("joint", joint), ("sign", sign)):
                found[what][0] += bool(those)
                found[what][1] += 1
        for contact in contacts:
            if contact[0] < before:
                found["windows"][0] += any(acrobot.in_time(p, contact) for p in pushes)
                found["windows"][1] += 1
    return found


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--armcal", default="build/armcal")
    parser.add_argument("--before", type=float, default=2.75)
    parser.add_argument("--work", default="/tmp/scoreboard")
    result_files.add_flag(parser)
    arguments = parser.parse_args()
    runs = Runs(os.path.abspath(arguments.armcal), "dfki_acrobot", acrobot.RUNS,
                Path(arguments.work).resolve())
    found = counts(runs, arguments.before)
    found["calm"] = [sum(bool(list(acrobot.contacts(runs[f"reference_{k}"])))
                         for k in acrobot.CALM), len(acrobot.CALM)]
    for what, (right, of) in found.items():
        print(f"{what:8} {right} of {of}")
    if arguments.results:
        result_files.write(
            arguments.results,
            f"pushes on an acrobot that begin before {arguments.before} s and are told in "
            "time, of; on their joint; with their sign; windows told before that hold one, "
            "of; calm runs in which one is told, of", found)
    missed = [what for what, bar in BARS.items()
              if found[what][0] < bar * found[what][1]]
    return 1 if missed or found["calm"][0] else 0


if __name__ == "__main__":
    sys.exit(main())
