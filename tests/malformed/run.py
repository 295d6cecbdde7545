#!/usr/bin/env python3
"""Gives armcal every malformed input of the table and judges what it does.

  run.py --armcal=BINARY --formats=FOLDER --work=SCRATCH [--only=TEXT] [--show]

The table is GROUPS of each module here: rows of a name, how a good set of files
is spoiled, and what armcal says. Of every row: exit code 3; stderr is that
sentence and nothing else; stdout is empty; no file is written or changed; it
takes less than LONGEST seconds of CPU time and MOST_BYTES. The good files
themselves are taken. FOLDER holds data/log_formats/written.tar.xz. Prints each
fault; exit code 1 if there is any. --show prints what armcal says instead.
"""

import argparse
import concurrent.futures
import importlib
import os
import pathlib
import re
import resource
import shlex
import shutil
import subprocess
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from inputs import Row, nothing, write
from limited_process import LimitedProcess

TABLE = ["csv_logs", "arrays", "bags", "urdf_robots", "mjcf_robots", "yaml_robots",
         "other_files"]
LONGEST = 5  # s of CPU time
HANGS = 60  # s
MOST_BYTES = 400 << 20  # resident
MOST_ADDRESSES = 2 << 30  # so that a fault does not take the machine with it


def groups():
    return [group for name in TABLE for group in importlib.import_module(name).GROUPS]


def good_files(group, arguments):
    """By path: bytes."""
    files = {}
    for name, content in group.good.items():
        content = content() if callable(content) else content
        if isinstance(content, str) and content.startswith("@"):
            content = (arguments.formats / content[1:]).read_bytes()
        files[name] = content
    if not group.prepare:
        return files
    folder = arguments.work / f"{group.name} prepared"
    for name, content in files.items():
        write(folder / name, content)
    for command in group.prepare:
        subprocess.run([arguments.armcal] + shlex.split(command), cwd=folder,
                       stdout=subprocess.DEVNULL, check=True)
    # reduce puts the log's hash in the name.
    files = {re.sub("-[0-9a-f]{12}.factor", ".factor", str(path.relative_to(folder))):
             path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    shutil.rmtree(folder)
    return files


class Outcome(LimitedProcess):
    """What armcal did with a folder."""

    def __init__(self, armcal, command, folder, longest):
        before = self.snapshot(folder)
        streams = [folder.parent / f"{folder.name}.{s}" for s in ("out", "err")]
        super().__init__([armcal] + shlex.split(command) + ["--threads=2"], folder, streams,
                         {resource.RLIMIT_CPU: longest}, HANGS,
                         os.environ | {"TMPDIR": str(folder)})
        self.written = sorted(set(self.snapshot(folder)) ^ set(before))

    @staticmethod
    def snapshot(folder):
        return [(str(path.relative_to(folder)), path.lstat().st_size,
                 path.lstat().st_mtime_ns) for path in folder.rglob("*")]

    def faults(self, row, sanitized):
        if self.code < 0:
            yield f"ended by signal {-self.code}, after {self.seconds:.1f} s"
        elif self.code != 3:
            yield f"exit code {self.code}, expected 3"
        if self.err != f"armcal: {row.says}\n":
            yield f"says      {self.err.rstrip()}\n  expected  armcal: {row.says}"
        if self.out:
            yield f"prints {self.out[:200]!r}"
        for name, *_ in self.written:
            yield f"writes {name}"
        if self.bytes > MOST_BYTES and not sanitized:
            yield f"takes {self.bytes >> 20} MiB"


def run_row(arguments, group, files, row):
    folder = arguments.work / f"{group.name} {row.name}".replace("/", "_")
    for name, content in files.items():
        write(folder / name, content)
    row.change(folder)
    outcome = Outcome(arguments.armcal, row.command or group.command, folder, arguments.longest)
    shutil.rmtree(folder)
    return outcome


def main():
    parser = argparse.ArgumentParser()
    for name in ("armcal", "formats", "work"):
        parser.add_argument(f"--{name}", type=pathlib.Path, required=True)
    parser.add_argument("--only", default="")
    parser.add_argument("--show", action="store_true")
    arguments = parser.parse_args()
    shutil.rmtree(arguments.work, ignore_errors=True)
    arguments.work.mkdir(parents=True)
    # A sanitizer takes addresses and memory of its own.
    sanitized = b"__asan_init" in arguments.armcal.read_bytes()
    arguments.longest = LONGEST * 10 if sanitized else LONGEST
    if not sanitized:
        resource.setrlimit(resource.RLIMIT_AS, (MOST_ADDRESSES, MOST_ADDRESSES))
    faults = rows = 0
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        tasks = []
        for group in groups():
            files = good_files(group, arguments)
            for row in [Row("the good files", nothing, "")] + group.rows:
                if arguments.only in f"{group.name}: {row.name}":
                    tasks.append((group, row, pool.submit(run_row, arguments, group, files, row)))
        for group, row, task in tasks:
            outcome = task.result()
            rows += 1
            if arguments.show:
                print(f"{group.name}: {row.name}: exit {outcome.code}, {outcome.seconds:.2f} s, "
                      f"{outcome.bytes >> 20} MiB{' WRITES' if outcome.written else ''}\n"
                      f"    {outcome.err.rstrip()}{outcome.out[:100]}")
                continue
            if row.name == "the good files":
                found = [] if outcome.code in (0, 1) else [f"are refused: {outcome.err}"]
            else:
                found = list(outcome.faults(row, sanitized))
            for fault in found:
                print(f"{group.name}: {row.name}: {fault}")
            faults += bool(found)
    print(f"{rows} rows, {faults} with faults")
    return faults > 0 or rows == 0


if __name__ == "__main__":
    sys.exit(main())
