#!/usr/bin/env python3
"""Does what docs/extending.md says, to a copy of the sources, and tries the result.

    extending_test.py --work=DIR [--root=.] [--option=CMAKE_OPTION ...] [--apply_only]

A block of code whose fence names a file is that file, a new one; a block ```diff
FILE changes it: lines with + are added, with - removed, others are there, and
"..." stands between places. Each section has a table that promises which files
it touches. All examples are built into one armcal (as long as a fresh build), unless
only whether they fit is asked.
"""

import argparse
import fnmatch
import os
import pathlib
import re
import shutil
import subprocess
import sys

SECTION = re.compile(r"^## (.*)\n", re.M)
BLOCK = re.compile(r"^```(cpp|diff) (\S+)\n(.*?)^```$", re.M | re.S)
NAMED = re.compile(r"`([\w./<>-]+/[\w./<>-]*)`")
EXAMPLES = {"An effect", "A joint type", "A log format", "A flag", "A command"}
ARM = """name: arm
gravity: [0, -9.81, 0]
convention: standard
links:
  - {{joint: revolute, a: .4, mass: 5, com: [-.2, 0, 0], inertia: [.01, .07, .07],
     viscous: 2, coulomb: 3, armature: .3}}
  - {{joint: {type}, a: .3, mass: 3, com: [-.15, 0, 0], inertia: [.01, .03, .03],
     viscous: 1, coulomb: 2, armature: .2}}
"""


def changed(text, diff, path):
    """`text` after a diff, each piece of which fits it in one place."""
    for piece in diff.split("...\n"):
        lines = piece.splitlines(keepends=True)
        before = "".join(line[1:] for line in lines if line[0] != "+")
        after = "".join(line[1:] for line in lines if line[0] != "-")
        if before.startswith("DEFINE"):  # the beginning of a statement
            before, after = before.rstrip("\n"), after.rstrip("\n")
        if text.count(before) != 1:
            sys.exit(f"{path}: {text.count(before)} places are as the page says:\n{before}")
        text = text.replace(before, after)
    return text


def apply_page(page, tree):
    """Applies all examples; complains of files that a section does not promise."""
    parts = SECTION.split(page.read_text(encoding="utf-8"))
    applied = set()
    for title, text in zip(parts[1::2], parts[2::2]):
        promised = [re.sub(r"<\w+>", "*", name) for line in text.splitlines()
                    if line.startswith("|") for name in NAMED.findall(line)]
        for kind, path, block in BLOCK.findall(text):
            if not any(fnmatch.fnmatch(path, name) or path.startswith(name)
                       for name in promised):
                sys.exit(f"{title}: its tables do not promise that {path} is touched")
            file = tree / path
            if kind == "diff":
                block = changed(file.read_text(encoding="utf-8"), block, path)
            elif file.exists():
                sys.exit(f"{title}: {path} is there already")
            file.write_text(block, encoding="utf-8")
            applied.add(title)
    if applied != EXAMPLES:
        sys.exit(f"examples expected: {sorted(EXAMPLES)}, found: {sorted(applied)}")


def copied(root, tree):
    """The sources, with their times, so that a second run builds little."""
    shutil.rmtree(tree, ignore_errors=True)
    tree.mkdir(parents=True)
    for path in root.iterdir():
        if path.is_file():
            shutil.copy2(path, tree)
        elif not path.name.startswith((".git", "build", "armcal-out")):
            shutil.copytree(path, tree / path.name, symlinks=True)
    return tree


def built(tree, build, options):
    if shutil.which("ccache"):
        options = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache", *options]
    subprocess.run(["cmake", "-S", tree, "-B", build, "-G", "Ninja", "-DBUILD_TESTING=OFF",
                    *options], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", build, "-j", str(os.cpu_count()), "--target",
                    "armcal"], check=True)
    return build / "armcal"


class Trial:
    """Runs commands of the extended armcal in a folder."""

    def __init__(self, armcal, folder):
        self.armcal, self.folder = armcal, folder
        folder.mkdir(exist_ok=True)
        for kind in ("revolute", "prismatic", "belt"):
            (folder / f"{kind}.yaml").write_text(ARM.format(type=kind), encoding="utf-8")

    def run(self, command, *codes):
        ran = subprocess.run([self.armcal, *command.split()], cwd=self.folder, text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if ran.returncode not in (codes or (0, 1)):
            sys.exit(f"armcal {command}: exit code {ran.returncode}\n{ran.stdout}")
        return ran.stdout

    def log(self, kind):
        self.run(f"simulate --robot={kind}.yaml --duration=12 --log_rate=100 --out={kind}", 0)
        return (self.folder / kind / "log.csv").read_text(encoding="utf-8")

    def effect(self):
        diagnose = "diagnose --robot=revolute.yaml --log=revolute/log.csv --noforward"
        yield "pull" in self.run(f"{diagnose} --without=gremlins", 2), "it is proposed"
        self.run(f"{diagnose} --without=pull --out=without")
        told = (self.folder / "without/diagnosis.json").read_text(encoding="utf-8")
        yield '"pull"' in told, "diagnosis.json says that it was left out"

    def joint_type(self):
        # A belt slides as any other sliding joint.
        yield self.log("belt") == self.log("prismatic"), "a belt's log is a slide's"
        wrong = ARM.format(type="band").encode()
        (self.folder / "band.yaml").write_bytes(wrong)
        yield "belt" in self.run("inspect --robot=band.yaml", 3), "the type is proposed"

    def log_format(self):
        table = self.log("revolute").replace(",", " ")
        (self.folder / "log.txt").write_text("# " + table, encoding="utf-8")
        as_csv = self.run("inspect --robot=revolute.yaml --json --log=revolute/log.csv")
        as_text = self.run("inspect --robot=revolute.yaml --json --log=log.txt")
        yield as_csv == as_text.replace("log.txt", "revolute/log.csv"), "both logs are one"

    def flag(self):
        yield "--robot_only" in self.run("help inspect --all", 0), "help has the flag"
        self.run("inspect --robot=revolute.yaml --log=none.csv", 3)
        self.run("inspect --robot=revolute.yaml --log=none.csv --robot_only")

    def command(self):
        yield "weigh" in self.run("help", 0), "help has the command"
        yield self.run("weigh --robot=revolute.yaml", 0) == "arm: 8 kg\n", "the weight"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--root", type=pathlib.Path,
                        default=pathlib.Path(__file__).resolve().parent.parent)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--option", action="append", default=[])
    parser.add_argument("--apply_only", action="store_true")
    given = parser.parse_args()
    tree = copied(given.root, given.work.resolve() / "tree")
    apply_page(given.root / "docs/extending.md", tree)
    if given.apply_only:
        return
    trial = Trial(built(tree, given.work.resolve() / "build", given.option),
                  given.work.resolve() / "runs")
    for step in (trial.command, trial.log_format, trial.effect, trial.joint_type,
                 trial.flag):
        for right, what in step():
            if not right:
                sys.exit(f"{step.__name__}: not so: {what}")
        print(f"{step.__name__}: works as docs/extending.md has it")


if __name__ == "__main__":
    main()
