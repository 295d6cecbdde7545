#!/usr/bin/env python3
"""Whether a diagnosis of a real log stays the same where its data hardly change.

  python3 tests/real/stability.py --armcal=build/armcal [--set=tx40,kr300]
      [--part=building|evaluation] [--draws=2] [--work=FOLDER] [--json=FILE]

Every diagnosis of the scoreboard's sets is repeated on its logs (the reference
stays) with
  noise   every number but the times multiplied by 1 + 1e-7 e, e ~ N(0, 1),
  first   the first 3 % of the rows left out,
  last    the last 3 % of the rows left out,
  block   a random block of 5 % of the rows left out, which leaves a hole,
noise and block with `draws` draws each; a block is drawn again where a contact that
is claimed was in it, which nobody can find without it. A claim (an effect, its joint, above 70 %)
is kept where the repeat names the same on the same joint with more than 50 %; a
claim that a repeat makes above 70 % and that is not above 50 % as recorded is a new
one. Exit code 1 where fewer than 95 % of the claims are kept.
"""

import argparse
import gzip
import importlib
import json
import os
import random
import sys
import zlib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import result_files  # noqa: E402
from reading import claims  # noqa: E402
from runs import DATA, Runs  # noqa: E402

HERE = Path(__file__).resolve().parent
TIMES = ("t", "time", "timestamp", "__time")
SURE, NAMED = .7, .5
CROP, BLOCK, NOISE = .03, .05, 1e-7
LEAST_KEPT = .95


def read(path):
    opened = gzip.open if path.suffix == ".gz" else open
    with opened(path, "rt", encoding="utf-8") as file:
        return file.read().splitlines()


def first(rows, _):
    return rows[round(CROP * len(rows)):]


def last(rows, _):
    return rows[:len(rows) - round(CROP * len(rows))]


def block_outside(windows, separator, column):
    """Of rows: a random block left out that holds none of these time windows."""
    def time(row):
        return float(row.split(separator)[column])

    def change(rows, draw):
        count = round(BLOCK * len(rows))
        start = time(rows[0])
        while True:
            begin = draw.randrange(1, len(rows) - count)
            cut = [time(rows[k]) - start for k in (begin - 1, begin + count)]
            if all(cut[1] < w[0] or cut[0] > w[1] for w in windows):
                return rows[:begin] + rows[begin + count:]
    return change


def time_columns(header, separator):
    return [name.strip(' "#').split("[")[0].strip() in TIMES
            for name in header.split(separator)]


def noisy(times, separator):
    """Of rows: all numbers but the times, a little off."""
    def field(text, is_time, draw):
        try:
            return text if is_time else repr(float(text) * (1 + NOISE * draw.gauss(0, 1)))
        except ValueError:
            return text

    def change(rows, draw):
        return [separator.join(field(text, is_time, draw) for text, is_time
                               in zip(row.split(separator), times)) for row in rows]
    return change


def contact_windows(diagnosis):
    """[begin, end] of every contact that is claimed, s since the log's first row."""
    return [(c["begin"], c["end"]) for e in claims(diagnosis or {"effects": []}, SURE)
            for c in e.get("contacts", [])]


def perturbed(log, kind, draw, folder, windows):
    """The changed copy of a log."""
    header, *rows = read(log)
    separator = next((s for s in ",;\t" if s in header), ",")
    times = time_columns(header, separator)
    changes = {"noise": noisy(times, separator), "first": first, "last": last,
               "block": block_outside(windows, separator,
                                       times.index(True) if windows else 0)}
    path = folder / log.name.removesuffix(".gz")
    path.write_text("\n".join([header] + changes[kind](rows, draw)) + "\n")
    return path


def repeats(draws):
    """(name, kind of change) of every repeat."""
    return ([(f"noise_{k}", "noise") for k in range(draws)] +
            [("first", "first"), ("last", "last")] +
            [(f"block_{k}", "block") for k in range(draws)])


def changed_command(set_name, run, command, repeat, kind, folder, windows):
    """The same command on changed logs, files of the set by their whole paths."""
    name, flags, answer = command
    folder.mkdir(parents=True, exist_ok=True)
    draw = random.Random(zlib.crc32(f"{set_name} {run} {repeat}".encode()))
    flags = list(flags)
    for k, flag in enumerate(flags):
        if flag.startswith("--log="):
            logs = [DATA / set_name / log for log in flag[6:].split(",")]
            flags[k] = "--log=" + ",".join(
                str(perturbed(log, kind, draw, folder, windows)) for log in logs)
    return name, flags, answer


def places(diagnosis, above):
    return {(e["effect"], e["joint"]): e["probability"]
            for e in claims(diagnosis, above)}


def compare(before, after):
    """(kept, lost, new) claims; `after` None: there was no answer."""
    sure = places(before, SURE)
    named = places(after, NAMED) if after else {}
    found = places(after, SURE) if after else {}
    kept = [place for place in sure if place in named]
    lost = [place for place in sure if place not in named]
    new = [place for place in found if place not in places(before, NAMED)]
    return kept, lost, new


def answer(runs, run):
    """Its diagnosis; None, and why, where there is none."""
    try:
        return runs[run]
    except LookupError as error:
        print(f"{run}: no answer ({str(error)[-100:]})", flush=True)
        return None


def study(arguments, set_name):
    """Rows {set, run, repeat, kept, lost, new}."""
    module = importlib.import_module(f"sets.{set_name}")
    commands = {run: command for run, command in module.RUNS.items()
                if command[0] == "diagnose"}
    if not commands:
        return []
    work = Path(arguments.work).resolve()
    armcal = os.path.abspath(arguments.armcal)
    jobs = [(run, repeat, kind) for run in commands
            for repeat, kind in repeats(arguments.draws)]
    before = Runs(armcal, set_name, commands, work)
    recorded = {run: answer(before, run) for run in commands}
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        made = list(pool.map(lambda job: changed_command(
            set_name, job[0], commands[job[0]], job[1], job[2],
            work / set_name / "logs" / f"{job[0]}_{job[1]}",
            contact_windows(recorded[job[0]])), jobs))
    changed = {f"{run}_{repeat}": command
               for (run, repeat, _), command in zip(jobs, made)}
    runs = Runs(armcal, set_name, changed, work)
    rows = []
    for run, repeat, _ in jobs:
        if recorded[run] is None:
            continue  # claims nothing
        kept, lost, new = compare(recorded[run], answer(runs, f"{run}_{repeat}"))
        rows.append({"set": set_name, "run": run, "repeat": repeat, "kept": kept,
                     "lost": lost, "new": new})
        for word, those in (("lost", lost), ("new", new)):
            for effect, joint in those:
                print(f"{set_name} {run} {repeat}: {word} {effect} {joint}", flush=True)
    return rows


def summary(rows):
    kept, lost, new = (sum(len(row[key]) for row in rows)
                       for key in ("kept", "lost", "new"))
    share = kept / (kept + lost) if kept + lost else 1
    return [kept, kept + lost, 100 * share, new, len(rows)], (f"{kept} of {kept + lost} claims kept ({100 * share:.1f} %), {new} "
                   f"new, in {len(rows)} repeats")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--armcal", default="build/armcal")
    parser.add_argument("--set", default="")
    parser.add_argument("--part", choices=["building", "evaluation"],
                        default="building")
    parser.add_argument("--draws", type=int, default=2)
    parser.add_argument("--work", default="/tmp/stability")
    parser.add_argument("--json")
    result_files.add_flag(parser)
    arguments = parser.parse_args()
    rows = []
    every = sorted(p.stem for p in (HERE / "sets").glob("*.py"))
    for name in arguments.set.split(",") if arguments.set else every:
        if not arguments.set and \
                importlib.import_module(f"sets.{name}").PART != arguments.part:
            continue
        of_set = study(arguments, name)
        rows += of_set
        if of_set:
            print(f"{name}: {summary(of_set)[1]}", flush=True)
    counts, text = summary(rows)
    print(text)
    if arguments.results:
        result_files.write(arguments.results, f"real robots, part {arguments.part}: claims kept, "
                           "of, %, new ones, repeats", {"kept": counts})
    if arguments.json:
        Path(arguments.json).write_text(json.dumps(rows, indent=1))
    return 0 if counts[2] >= 100 * LEAST_KEPT else 1


if __name__ == "__main__":
    sys.exit(main())
