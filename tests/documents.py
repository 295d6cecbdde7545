#!/usr/bin/env python3
"""Runs what the documents tell their readers to run.

  documents.py --armcal=BINARY --root=REPOSITORY --work=SCRATCH

Every ```sh block that calls armcal is run, in order, in one scratch folder per
document, in which `data` and `build/armcal` are what a reader has. A ```text
block that follows is what the block prints (stdout, then stderr): its lines have
to come in this order, `...` on a line of its own stands for any lines. Numbers
agree within 5 %, a unit of the last digit shown, or where both are below 1e-7
(rounding); words behind the fence say otherwise:

  ```text exact          numbers are those shown
  ```text within 20%     of figures that hang on chance
  ```sh on your robot    not run: it needs what only the reader has
  ```sh with real logs   run where ../shared/data is, as shared/data

Besides, each page of a command explains every flag of its help (docs/README.md
or docs/command_line.md those that all share) and every key of the JSON files that the documents made,
links lead somewhere, docs/effects and the picture of the diagnosis' bars are what their scripts write, and the
picture of a terminal in README.md is what armcal prints. Prints each fault in a line; exit
code 1 if there is any.
"""

import argparse
import json
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys

PAGES = {  # whose page explains the keys of a file
    "calibration.json": "calibrate", "verification.json": "verify",
    "diagnosis.json": "diagnose", "effects.json": "diagnose",
    "excite.json": "excite", "inspect.json": "inspect",
    "truth.json": "simulate", "fleet.json": "fleet",
    "watch.json": "watch"}
NUMBER = re.compile(r"(?<![A-Za-z_\d.])[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?")
FENCE = re.compile(r"^```(\S*) *([^\n]*)\n(.*?)^```$", re.M | re.S)
LINK = re.compile(r"\]\(([^)#: ]+)(?:#[^)]*)?\)")


def last_digit(text):
    """A unit of the last digit that a number shows."""
    mantissa, _, exponent = text.lower().partition("e")
    decimals = len(mantissa.partition(".")[2])
    return 10.0 ** (int(exponent or 0) - decimals)


def same_number(shown, found, tolerance):
    if tolerance == 0:
        return shown == found
    a, b = float(shown), float(found)
    if abs(a) < 1e-7 and abs(b) < 1e-7:
        return True
    return abs(a - b) <= tolerance * abs(a) + 1.01 * last_digit(shown)


def same_line(shown, found, tolerance):
    words = [re.sub(r"\s+", " ", NUMBER.sub("#", x)).strip()
             for x in (shown, found)]
    return words[0] == words[1] and all(
        same_number(a, b, tolerance)
        for a, b in zip(NUMBER.findall(shown), NUMBER.findall(found)))


def first_missing(shown, found, tolerance):
    """The first line shown that does not follow, or None."""
    lines, at, anywhere = found.splitlines(), 0, True
    for line in shown.splitlines():
        if line.strip() == "...":
            anywhere = True
            continue
        end = len(lines) if anywhere else min(at + 1, len(lines))
        hit = next((k for k in range(at, end)
                    if same_line(line, lines[k], tolerance)), None)
        if hit is None:
            return line
        at, anywhere = hit + 1, False
    return None


def cpu_seconds():
    """Of the commands that were run."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def tolerance_of(words):
    if words == "exact":
        return 0
    share = re.fullmatch(r"within (\d+)%", words)
    return int(share[1]) / 100 if share else .05


def check_itself():
    """What would let everything pass is noticed."""
    right = [("a  1.00 m", "a 1.04 m", .05), ("x 3", "x 4", .05),
             ("e 2e-16", "e 7e-15", .05), ("n 3 of 4", "n 3 of 4", 0)]
    wrong = [("a 1.00 m", "a 1.20 m", .05), ("a 1 m", "a 1 mm", .05),
             ("a 1", "a 1 1", .05), ("n 3 of 4", "n 4 of 4", 0),
             ("a 0.5", "a -0.5", .3), ("e 2e-16", "e 2e-6", .05)]
    for shown, found, tolerance in right:
        assert same_line(shown, found, tolerance), (shown, found)
    for shown, found, tolerance in wrong:
        assert not same_line(shown, found, tolerance), (shown, found)
    assert first_missing("a\n...\nc", "a\nb\nc", 0) is None
    assert first_missing("a\nc", "a\nb\nc", 0) == "c"
    assert first_missing("...\nc\na", "a\nb\nc", 0) == "a"


class Documents:
    def __init__(self, options):
        self.root = pathlib.Path(options.root).resolve()
        self.work = pathlib.Path(options.work).resolve()
        self.armcal = pathlib.Path(options.armcal).resolve()
        self.shared = self.root.parent / "shared"
        self.faults = []
        self.ran = self.left = 0

    def fault(self, document, text):
        self.faults.append(f"{document}: {text}")

    def scratch(self, document):
        folder = self.work / re.sub(r"\W+", "_", document)
        shutil.rmtree(folder, ignore_errors=True)
        (folder / "build").mkdir(parents=True)
        (folder / "armcal-out").mkdir()
        (folder / "build" / "armcal").symlink_to(self.armcal)
        (folder / "data").symlink_to(self.root / "data")
        (folder / "shared").symlink_to(self.shared)
        return folder

    def run(self, document):
        text = (self.root / document).read_text()
        blocks = FENCE.findall(text)
        folder, started = None, cpu_seconds()
        for k, (language, words, body) in enumerate(blocks):
            if language != "sh" or not re.search(r"\barmcal\b [a-z-]", body):
                continue
            if words and not (words == "with real logs"
                              and (self.shared / "data").is_dir()):
                self.left += 1
                continue
            folder = folder or self.scratch(document)
            self.ran += 1
            path = f"{self.armcal.parent}:{os.environ['PATH']}"
            done = subprocess.run(["bash", "-e", "-c", body], cwd=folder,
                                  env={**os.environ, "PATH": path},
                                  capture_output=True, text=True, check=False)
            output = done.stdout + done.stderr
            name = body.strip().splitlines()[0]
            if done.returncode != 0:
                self.fault(document, f"`{name}` has exit code "
                                     f"{done.returncode}\n{output}")
                return
            if k + 1 < len(blocks) and blocks[k + 1][0] == "text":
                _, how, shown = blocks[k + 1]
                missing = first_missing(shown, output, tolerance_of(how))
                if missing is not None:
                    self.fault(document, f"`{name}` does not print\n{missing}"
                                         f"\nbut\n{output}")
        if folder:
            print(f"{document}: {cpu_seconds() - started:.1f} CPU s")

    def check_links(self, document):
        path = self.root / document
        for target in LINK.findall(path.read_text()):
            if not (path.parent / target).exists():
                self.fault(document, f"the link {target} leads nowhere")

    def help_of(self, *words):
        """All of the help, where a short one leaves flags out."""
        for flag in ("--helpfull", "--help"):
            done = subprocess.run([self.armcal, *words, flag], text=True,
                                  capture_output=True, check=False)
            if done.returncode == 0:
                return done.stdout
        return ""

    def check_effects(self):
        """Pages are what their script writes, and simulate knows what they
        say to try."""
        done = subprocess.run([sys.executable, "docs/effects/write_pages.py",
                               "--check"], cwd=self.root, text=True,
                              capture_output=True, check=False)
        if done.returncode != 0:
            self.fault("docs/effects", done.stdout + done.stderr)
        for page in sorted((self.root / "docs" / "effects").glob("*.md")):
            tried = re.search("Try it: `armcal ([^`]*)`", page.read_text())
            if not tried:
                continue
            done = subprocess.run(
                f"{self.armcal} {tried[1]} --duration=1", shell=True,
                cwd=self.scratch("effects"), capture_output=True, text=True,
                check=False)
            if done.returncode != 0:
                self.fault(f"docs/effects/{page.name}", done.stderr)

    def check_pictures(self):
        done = subprocess.run([sys.executable, "docs/draw_diagnosis_bars.py", "--check"],
                              cwd=self.root, text=True, capture_output=True, check=False)
        if done.returncode != 0:
            self.fault("docs/accuracy.md", done.stdout + done.stderr)
        done = subprocess.run([sys.executable, "docs/draw_readme_pictures.py",
                               f"--armcal={self.armcal}", "--check"],
                              cwd=self.root, text=True, capture_output=True,
                              check=False)
        if done.returncode != 0:
            self.fault("README.md", done.stdout + done.stderr)

    def check_flags(self):
        shared = [self.root / "docs" / name
                  for name in ("README.md", "command_line.md")]
        for command in re.findall(r"^  ([a-z]+)  ", self.help_of(), re.M):
            flags = re.findall(r"^  (--[a-z_]+)", self.help_of(command), re.M)
            if not flags:
                continue
            page = self.root / "docs" / f"{command}.md"
            text = page.read_text() if page.exists() else ""
            text += "".join(path.read_text() for path in shared
                            if path.exists())
            for flag in flags:
                if not re.search(f"`{flag}[=`]", text):
                    self.fault(f"docs/{command}.md", f"{flag} is not explained")

    def check_keys(self):
        for file, page in PAGES.items():
            document = f"docs/{page}.md"
            text = (self.root / document).read_text()
            found = sorted(self.work.rglob(file))
            if not found:
                self.fault(document, f"no document makes a {file}")
            keys = set()
            for path in found:
                collect_keys(json.loads(path.read_text()), keys)
            for key in sorted(keys):
                if not re.search(rf"`{re.escape(key)}(\[\])*`", text):
                    self.fault(document, f"the key {key} of {file} is not "
                                         "explained")


def collect_keys(value, keys):
    if isinstance(value, dict):
        keys.update(value)
        for entry in value.values():
            collect_keys(entry, keys)
    elif isinstance(value, list):
        for entry in value:
            collect_keys(entry, keys)


def main():
    parser = argparse.ArgumentParser()
    for name in ("armcal", "root", "work"):
        parser.add_argument(f"--{name}", required=True)
    parser.add_argument("--only", help="run one document, check no keys")
    options = parser.parse_args()
    check_itself()
    all_of = Documents(options)
    names = sorted(str(path.relative_to(all_of.root)) for pattern in (
        "README.md", "docs/*.md", "docs/effects/*.md", "docs/tutorials/*.md",
        "data/*/README.md")
        for path in all_of.root.glob(pattern))
    for name in [options.only] if options.only else names:
        all_of.check_links(name)
        all_of.run(name)
    if not options.only:
        all_of.check_effects()
        all_of.check_pictures()
        all_of.check_flags()
        all_of.check_keys()
    print(f"{all_of.ran} blocks run, {all_of.left} left to the reader")
    for fault in all_of.faults:
        print(fault, file=sys.stderr)
    sys.exit(1 if all_of.faults else 0)


if __name__ == "__main__":
    main()
