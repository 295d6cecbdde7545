"""The commands of a set of the scoreboard, and their answers."""

import json
import os
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

DATA = Path(__file__).resolve().parents[3] / "shared" / "data"


class Runs:
    """The answers of one set's commands, made when a check asks for them."""

    def __init__(self, armcal, name, commands, work):
        self.armcal, self.commands = armcal, commands
        self.folder, self.work = DATA / name, work / name

    def start(self, run):
        command, flags, answer = self.commands[run]
        out = self.work / run
        (self.work).mkdir(parents=True, exist_ok=True)
        result = subprocess.run(
            [self.armcal, command, *flags, f"--out={out}"], cwd=self.folder,
            capture_output=True, text=True)
        (self.work / f"{run}.txt").write_text(result.stdout + result.stderr)
        return result.returncode, out / answer

    def all(self):
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            self.done = dict(zip(self.commands, pool.map(self.start, self.commands)))

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
