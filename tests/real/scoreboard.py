#!/usr/bin/env python3
"""What a right answer says of every real robot in ../shared/data, and whether
armcal says it.

  python3 tests/real/scoreboard.py --armcal=build/armcal [--set=tx40,kr300]
      [--part=building|evaluation] [--markdown=FILE] [--work=FOLDER]
      [--results=FILE]

Each set is a file in sets/: its runs (commands on its logs) and its checks, from
the TRUTH.md or SOURCE.md beside the logs. The part of a set was fixed on
2026-11-23, before the diagnosis was changed for real robots: what decides is
built on "building" sets only; "evaluation" sets are for one evaluation at the end.
A run that gives no answer fails all checks that ask for it. Exit code 1 where a
check is not met.
"""

import argparse
import importlib
import os
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import result_files  # noqa: E402
from runs import Runs  # noqa: E402


def judge(check, runs):
    """(met, what was said) of a check: a function of the runs."""
    try:
        return check(runs)
    except (LookupError, TypeError, ValueError) as error:
        return False, f"{type(error).__name__}: {error}"[:120]


def score(arguments, name):
    """Rows (set, part, check, met, said)."""
    module = importlib.import_module(f"sets.{name}")
    runs = Runs(os.path.abspath(arguments.armcal), name, module.RUNS,
                Path(arguments.work).resolve())
    rows = []
    for check in module.CHECKS:
        met, said = judge(check, runs)
        rows.append((name, module.PART, " ".join(check.__doc__.split()), met, said))
        print(f"{'met   ' if met else 'MISSED'}  {name:22} {rows[-1][2]}\n"
              f"{'':32}{said}", flush=True)
    return rows


def markdown(rows):
    lines = ["| set | part | a right answer | met | said |", "|---|---|---|---|---|"]
    for name, part, text, met, said in rows:
        lines.append(f"| {name} | {part} | {text} | {'yes' if met else '**no**'} | "
                     f"{said.replace('|', '/')} |")
    return "\n".join(lines) + "\n"


def figures(rows):
    """{set or part: [met, of]}, and {set_K: [count, of]} where its check K says so."""
    found, counts = {}, {}
    for name, part, _, met, said in rows:
        for key in (name, part):
            count = found.setdefault(key, [0, 0])
            count[0] += met
            count[1] += 1
        if of := re.fullmatch(r"(\d+) of (\d+)", said):
            counts[f"{name}_{found[name][1]}"] = [int(of[1]), int(of[2])]
    return found | counts


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--armcal", default="build/armcal")
    parser.add_argument("--set", default="")
    parser.add_argument("--part", choices=["building", "evaluation"])
    parser.add_argument("--markdown")
    parser.add_argument("--work", default="/tmp/scoreboard")
    result_files.add_flag(parser)
    arguments = parser.parse_args()
    every = sorted(p.stem for p in (HERE / "sets").glob("*.py"))
    rows = []
    for name in arguments.set.split(",") if arguments.set else every:
        part = importlib.import_module(f"sets.{name}").PART
        if arguments.part in (None, part):
            rows += score(arguments, name)
    found = figures(rows)
    for part in ("building", "evaluation"):
        if part in found:
            print(f"{part}: {found[part][0]} of {found[part][1]}")
    if arguments.results:
        result_files.write(arguments.results, "real robots, their logs in ../shared/data; "
                           "the diagnosis has been changed after looking at all of them", found)
    if arguments.markdown:
        Path(arguments.markdown).write_text(markdown(rows))
    return 0 if all(row[3] for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main())
