#!/usr/bin/env python3
"""piped_logs.py [--cases 6:1e7,2:1e8] --armcal BINARY --write WRITE_GROWTH_LOG
              [--json=FILE]

Time and memory of `armcal calibrate`, as it is by default, on logs that come out of a pipe:
JOINTS:ROWS of tests/speed/write_growth_log.cc, 1 kHz, written while they are read. Prints
for each the seconds by the clock, from the first row that is written to the result, and the
peak memory in GB as the kernel says it; 1e8 rows of two joints need 17 GB in $TMPDIR.
Python's standard library only.
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from limited_process import wait_for  # noqa: E402


def measure(armcal, write, joints, rows):
    with tempfile.TemporaryDirectory() as folder:
        log = pathlib.Path(folder, "log.csv")
        os.mkfifo(log)
        writer = subprocess.Popen([write, str(joints), str(rows), folder])
        robot = pathlib.Path(folder, "robot.urdf")
        while not (robot.exists() and robot.stat().st_size > 0):
            time.sleep(.1)
        begin = time.monotonic()
        child = subprocess.Popen(
            [armcal, "calibrate", f"--robot={robot}", f"--log={log}",
             f"--out={folder}/out", "--quiet"])
        _, memory = wait_for(child)
        seconds = time.monotonic() - begin
        writer.wait()
        if child.returncode not in (0, 1) or writer.returncode != 0:
            sys.exit(f"piped_logs.py: exit codes {child.returncode}, {writer.returncode}")
    return {"joints": joints, "rows": rows, "seconds": round(seconds, 1),
            "gb": round(memory / 1e9, 3)}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--cases", default="6:1e7,2:1e8")
    parser.add_argument("--armcal", required=True)
    parser.add_argument("--write", required=True)
    parser.add_argument("--json")
    flags = parser.parse_args()
    values = {}
    for case in flags.cases.split(","):
        joints, rows = case.split(":")
        result = measure(flags.armcal, flags.write, int(joints), round(float(rows)))
        values[f"{joints}_joints_{rows}"] = result
        print(f"{joints} joints, {rows} rows: {result['seconds']} s, {result['gb']} GB",
              flush=True)
    if flags.json:
        pathlib.Path(flags.json).write_text(json.dumps(values, indent=1) + "\n")


if __name__ == "__main__":
    main()
