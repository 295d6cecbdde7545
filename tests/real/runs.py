"""The commands of a set of the scoreboard, and their answers."""

import json
import os
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

DATA = Path(__file__).resolve().parents[3] / "shared" / "data"


def diagnose(*flags):
    """(command, flags, file of the answer), as RUNS of a set have them."""
    return "diagnose", flags, "diagnosis.json"


def calibrate(*flags):
    return "calibrate", flags, "calibration.json"


def inspect(*flags):
    return "inspect", flags, "inspect.json"


class Runs:
    """Runs the commands of one set, {run: (command, flags, file of the answer)},
    and has their answers: runs[run]."""

    def __init__(self, armcal, name, commands, work):
        self.armcal, self.commands = armcal, commands
        self.folder, self.work = DATA / name, work / name
        self.work.mkdir(parents=True, exist_ok=True)
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            self.done = dict(zip(commands, pool.map(self.start, commands)))

    def start(self, run):
        """(exit code, file of the answer)"""
        command, flags, answer = self.commands[run]
        out = self.work / run
        result = subprocess.run(
            [self.armcal, command, *flags, f"--out={out}"], cwd=self.folder,
            capture_output=True, text=True)
        (self.work / f"{run}.txt").write_text(result.stdout + result.stderr)
        return result.returncode, out / answer

    def code(self, run):
        return self.done[run][0]

    def text(self, run):
        return (self.work / f"{run}.txt").read_text()

    def __getitem__(self, run):
        code, answer = self.done[run]
        if code > 1 or not answer.exists():
            lines = self.text(run).strip().splitlines() or ["no answer"]
            raise LookupError(f"{run}: {lines[-1]}")
        return json.loads(answer.read_text())
