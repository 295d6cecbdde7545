#!/usr/bin/env python3
"""Does another armcal do the same, byte for byte? For refactorings.

  tests/same_outputs.py --before=BINARY --after=BINARY --work=SCRATCH
      [--only=REGEX] [--jobs=2] [--data=data] [--shared=../shared]

Runs the command lines of same_outputs_commands.py with both binaries, each
in a folder of its own, and compares exit code, stdout, stderr and every file
that is left there. Nothing else is normalised: armcal writes no time of day, no
process id and no absolute path, so that not a byte may differ (but between
versions, of armcal or of a library: reports and --version name them) but the
hash of the sources, which is left out.

--only takes the commands whose name matches, with those that they build on.
--data and --shared (relative to the repository) are what commands see as
`data` and `shared`. Prints a line per command, with the CPU time of each
binary, and where it differs the first file and line that do. Exit code 1 if
anything differs, or a command ends with another code than the table says.

SCRATCH, for one run at a time, keeps in before/HASH what the binary of that
SHA-256 made: with the same --before, only the other one runs. A command runs
anew when its line, its inputs in the table or in `data`, or a command that it
builds on have changed (`shared` never does). after/ is of the last run.
"""

from __future__ import annotations

import argparse
import concurrent.futures
import functools
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True
from limited_process import wait_for
from same_outputs_commands import COMMANDS, INPUTS, PRELUDE, Command

ROOT = pathlib.Path(__file__).resolve().parents[1]
LONGEST_S = "900"  # that a command may take before it is killed


def builds_on(command: Command) -> list[str]:
    """Names of the commands whose files a line reads as ../NAME/..."""
    return sorted(set(re.findall(r"\.\./(\w+)", command.line)))


@functools.cache
def hash_of_folder(folder: pathlib.Path) -> str:
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    contents = b"".join(path.read_bytes() for path in files)
    return hashlib.sha256(contents).hexdigest()


class Side:
    """A binary, the folder its commands run in, and what came of them."""

    def __init__(self, binary: pathlib.Path, root: pathlib.Path,
                 links: dict[str, pathlib.Path]):
        self.root = root
        self.links = links  # what commands see as `data` and `shared`
        self.keys: dict[str, str] = {}
        # A copy, as the binary may be built anew while this runs.
        self.path = root / "bin"
        shutil.rmtree(self.path, ignore_errors=True)
        self.path.mkdir(parents=True)
        shutil.copy(binary, self.path / "armcal")
        (root / "told").mkdir(exist_ok=True)
        version = subprocess.run([binary, "--version"], check=True,
                                 capture_output=True).stdout
        hashes = re.findall(rb"\(sources ([0-9a-f]+)\)", version)
        self.source_hash = hashes[0] if hashes else b"(none)"

    def told(self, command: Command, what: str) -> pathlib.Path:
        return self.root / "told" / f"{command.name}.{what}"

    def folder(self, command: Command) -> pathlib.Path:
        return self.root / "commands" / command.name

    def key(self, command: Command) -> str:
        """Changes with all that outputs depend on, but the binary."""
        text = PRELUDE + command.line
        parts = [text, str(command.code)]
        parts += [self.keys[name] for name in builds_on(command)]
        parts += [INPUTS[name] for name in INPUTS if name in command.line]
        for folder in sorted(set(re.findall(r"\bdata/(\w+)/", text))):
            parts.append(hash_of_folder(self.links["data"] / folder))
        return hashlib.sha256("\0".join(parts).encode()).hexdigest()

    def outcome(self, command: Command, keep: bool) -> tuple[int, float]:
        """Exit code and CPU time; of an earlier run if there was the same."""
        key = self.keys[command.name] = self.key(command)
        record = self.told(command, "json")
        kept = json.loads(record.read_text()) if record.exists() else {}
        if keep and kept.get("key") == key:
            return command.code, kept["seconds"]
        record.unlink(missing_ok=True)
        code, seconds = self.run(command)
        if code == command.code:
            record.write_text(json.dumps({"key": key, "seconds": seconds}))
        return code, seconds

    def run(self, command: Command) -> tuple[int, float]:
        folder = self.folder(command)
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        for name, target in self.links.items():
            (folder / name).symlink_to(target)
        for name, text in INPUTS.items():
            if name in command.line:
                (folder / name).write_text(text)
        environment = {"PATH": f"{self.path}:/usr/bin:/bin", "TZ": "UTC",
                       "LC_ALL": "C.UTF-8"}
        with (open(self.told(command, "stdout"), "wb") as out,
              open(self.told(command, "stderr"), "wb") as err):
            process = subprocess.Popen(
                ["timeout", LONGEST_S, "bash", "-e", "-o", "pipefail", "-c",
                 PRELUDE + command.line], cwd=folder, env=environment,
                stdin=subprocess.DEVNULL, stdout=out, stderr=err)
            seconds, _ = wait_for(process)
        return process.returncode, seconds

    def files(self, command: Command) -> dict[str, pathlib.Path]:
        """What a command printed and left, by names that both sides have."""
        top = self.folder(command)
        found = {f"({name})": self.told(command, name)
                 for name in ("stderr", "stdout")}
        for folder, _, names in os.walk(top):  # does not enter data, shared
            for path in (pathlib.Path(folder) / name for name in names):
                found[str(path.relative_to(top))] = path
        return found


def difference(name: str, one: bytes, other: bytes) -> str:
    """The first line of a file that differs."""
    if b"\0" in one + other:
        at = len(os.path.commonprefix([one, other]))
        return f"{name}, byte {at} of {len(one)} and {len(other)}"
    ones, others = (text.split(b"\n") + [b"(end)"] for text in (one, other))
    k = next(k for k, (a, b) in enumerate(zip(ones, others)) if a != b)
    column = len(os.path.commonprefix([ones[k], others[k]]))
    part = slice(max(0, column - 20), column + 70)
    return (f"{name}, line {k + 1}, column {column + 1}"
            f"\n    before  {ones[k][part].decode(errors='replace')}"
            f"\n    after   {others[k][part].decode(errors='replace')}")


def compare(command: Command, before: Side, after: Side) -> str:
    """What differs first; empty if nothing does."""
    sides = before.files(command), after.files(command)
    for name in sorted({**sides[0], **sides[1]}):  # (stderr), (stdout), files
        one, other = (
            files[name].read_bytes().replace(side.source_hash, b"(sources)")
            if name in files else b"(no such file)"
            for side, files in zip((before, after), sides))
        if one != other:
            return difference(name, one, other)
    return ""


def chosen(pattern: str) -> list[Command]:
    """Commands that match, and those that they build on, in their order."""
    wanted = {c.name for c in COMMANDS if re.search(pattern, c.name)}
    for command in reversed(COMMANDS):  # what is built on comes before
        if command.name in wanted:
            wanted.update(builds_on(command))
    return [c for c in COMMANDS if c.name in wanted]


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    for flag in ("--before", "--after", "--work"):
        parser.add_argument(flag, type=pathlib.Path, required=True)
    parser.add_argument("--only", default="")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--data", default="data")
    parser.add_argument("--shared", default="../shared")
    args = parser.parse_args()
    links = {"data": (ROOT / args.data).resolve(strict=True),
             "shared": (ROOT / args.shared).resolve(strict=True)}
    work = args.work.resolve()
    shutil.rmtree(work / "after", ignore_errors=True)
    digest = hashlib.sha256(args.before.read_bytes()).hexdigest()[:12]
    before = Side(args.before, work / "before" / digest, links)
    after = Side(args.after, work / "after", links)

    commands = chosen(args.only)
    futures: dict[str, concurrent.futures.Future[tuple[float, float, str]]] = {}

    def both(command: Command) -> tuple[float, float, str]:
        for name in builds_on(command):
            futures[name].result()
        code, seconds = before.outcome(command, keep=True)
        other_code, other_seconds = after.outcome(command, keep=False)
        text = compare(command, before, after)
        if not code == other_code == command.code:
            text = (f"exit codes {code} and {other_code} instead of "
                    f"{command.code}; {text}")
        return seconds, other_seconds, text

    same, total = 0, [0.0, 0.0]
    print(f"{'CPU time, s':27}{'before':>7}{'after':>7}")
    pool = concurrent.futures.ThreadPoolExecutor(args.jobs)
    for command in commands:
        futures[command.name] = pool.submit(both, command)
    try:
        for command in commands:
            one, other, text = futures[command.name].result()
            total = [total[0] + one, total[1] + other]
            same += not text
            told = f"DIFFERS: {text}" if text else "same"
            print(f"{command.name:27}{one:7.1f}{other:7.1f}  {told}", flush=True)
    finally:
        pool.shutdown(cancel_futures=True)
    print(f"{'all':27}{total[0]:7.1f}{total[1]:7.1f}")
    print(f"{same} same, {len(commands) - same} differ")
    return 0 if same == len(commands) else 1


if __name__ == "__main__":
    sys.exit(main())
