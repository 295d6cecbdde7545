#!/usr/bin/env python3
"""How long after a sample's arrival is a contact told, and what does it cost?

  latency.py --armcal=build/armcal --robot=ROBOT --calibration=DIR --log=CSV
             [--seconds=60]

Writes the log's rows into the pipe of `armcal watch --log=- --learn=15` at 1 kHz
by the clock, the torques of all joints pushed by half of their usual size for a
tenth of a second, every three seconds from the 20th on. Prints when the contacts
were told, after the first pushed row was written, and the share of a core that
the process took.
"""

import argparse
import json
import pathlib
import subprocess
import threading
import time

import numpy

FIRST, EVERY = 20, 3  # s


def rows_of(path):
    with open(path, encoding="ascii") as log:
        names = log.readline().strip().split(",")
    rows = numpy.loadtxt(path, delimiter=",", skiprows=1)
    tau = [k for k, name in enumerate(names)
           if name.startswith("tau") and name[3:].isdigit()]
    size = .5 * rows[:, tau].std(axis=0)
    pushes = []
    for begin in range(FIRST, int(rows[-1, 0]) - 1, EVERY):
        pushed = (rows[:, 0] >= begin) & (rows[:, 0] < begin + .1)
        rows[numpy.ix_(pushed, tau)] += size
        pushes.append(begin)
    return names, rows, pushes


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("armcal", "robot", "calibration", "log"):
        parser.add_argument("--" + name, required=True)
    parser.add_argument("--seconds", type=float, default=60)
    arguments = parser.parse_args()
    names, rows, pushes = rows_of(arguments.log)
    lines = [",".join(f"{x:.9g}" for x in row) + "\n" for row in rows]
    process = subprocess.Popen(
        [arguments.armcal, "watch", f"--robot={arguments.robot}", "--learn=15",
         f"--calibration={arguments.calibration}", "--log=-", "--json"],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    told = []

    def listen():
        for line in process.stdout:
            event = json.loads(line)
            if event["event"] == "contact":
                told.append((time.monotonic(), event["time_s"]))
    listener = threading.Thread(target=listen)
    listener.start()
    process.stdin.write(",".join(names) + "\n")
    begin = time.monotonic()
    written = {}
    for row, line in zip(rows, lines):
        if row[0] > arguments.seconds:
            break
        wait = begin + row[0] - time.monotonic()
        if wait > 0:
            time.sleep(wait)
        process.stdin.write(line)
        process.stdin.flush()
        written[round(row[0], 3)] = time.monotonic()
    stat = pathlib.Path(f"/proc/{process.pid}/stat").read_text("ascii").split()
    cpu = (int(stat[13]) + int(stat[14])) / 100
    took = time.monotonic() - begin
    process.stdin.close()
    listener.join()
    for push in (p for p in pushes if p < arguments.seconds - 1):
        found = [(wall, t) for wall, t in told if push <= t < push + .2]
        print(f"push at {push} s: " + ("not told" if not found else
              f"told {1e3 * (found[0][0] - written[push]):.0f} ms after its first "
              f"row was written, {1e3 * (found[0][1] - push):.0f} ms by the log's time, "
              f"{1e3 * (found[0][0] - written[round(found[0][1], 3)]):.1f} ms after "
              "the row that it was told at"))
    print(f"CPU {100 * cpu / took:.1f} % of a core, {len(rows[0])} columns")


if __name__ == "__main__":
    main()
