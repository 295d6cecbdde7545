#!/usr/bin/env python3
"""fit_commands.py PYTHON ARMCAL FOLDER ..: three fits of the same commands.

Each FOLDER is one of commanded_logs.py. `armcal calibrate --controller` (gains
estimated, as with sysid), MuJoCo's sysid and an evolution strategy in PACE's
form, one after the other in this run, each in a process of its own on one
thread: CPU seconds of the whole process, and rms of simulated minus recorded
positions of the held-out log, each by the tool's own simulation. For armcal the
least of three runs. Python's standard library only; PYTHON is that of fetch.sh's
environment.
"""

import json
import math
import pathlib
import sys
import tempfile

from run import HERE, root_sum, run

RUNS = 3


def armcal_fit(armcal, folder):
    with tempfile.TemporaryDirectory() as out:
        _, seconds, _ = run(
            [armcal, "calibrate", f"--robot={folder}/robot.yaml",
             f"--controller={folder}/controller.yaml", "--gains_trust=.15",
             f"--log={folder}/train.csv", f"--validate={folder}/held_out.csv",
             "--threads=1", f"--out={out}/result"], out, RUNS)
        joints = json.loads(pathlib.Path(out, "result", "calibration.json")
                            .read_text(encoding="utf-8"))["joints"]
    rms = [joint["validation_position_residual_rms"] for joint in joints]
    return root_sum(rms) / math.sqrt(len(rms)), seconds


def peer_fit(python, script, folder):
    with tempfile.TemporaryDirectory() as out:
        text, seconds, _ = run([python, HERE / script, folder], out)
    return json.loads(text.strip().splitlines()[-1])["held_out_rms"], seconds


def main():
    python, armcal, *folders = sys.argv[1:]
    for folder in folders:
        rms, seconds = armcal_fit(armcal, folder)
        print(f"{folder}\n  armcal  {rms:.3g} rad  {seconds:.2f} s", flush=True)
        for script in ("sysid_from_commands.py", "cma_from_commands.py"):
            peer_rms, peer_seconds = peer_fit(python, script, folder)
            print(f"  {script}  {peer_rms:.3g} rad  {peer_seconds:.1f} s, "
                  f"{peer_rms / rms:.2f} times the error, "
                  f"{peer_seconds / seconds:.0f} times the time", flush=True)


if __name__ == "__main__":
    main()
