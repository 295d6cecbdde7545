#!/usr/bin/env python3
"""What each threshold of a diagnosis decides.

  build/tests/write_blind_cases --set=calibration --seed=.. --cases=24 \\
    --logs=CASES/plain/logs --labels=CASES/plain/labels --quiet=CASES/plain/quiet
  (the same with --misfit into CASES/misfit)
  python3 tests/blind/sensitivity.py --cases=CASES [--only=NAME,..] [--check|--rewrite]

Diagnoses the cases of every folder of CASES with each threshold
(calib/diagnose/data/thresholds.h) at half and at twice its value, a quantile with
its remainder to 1 so, and writes docs/thresholds.md: how many answers change (the
verdict, or what is claimed above 50 %), and how many more or fewer are right. It goes
on where it stopped (CASES/sensitivity.json). --check: writes nothing, and fails where
the page does not list the thresholds as they are. --rewrite: the page as the thresholds
are now, with the figures that it has of those whose value is still the same.
"""

import argparse
import datetime
import json
import os
import re
import stat
import subprocess
import sys
from collections import Counter
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
PAGE = ROOT / "docs" / "thresholds.md"
NAMED = .5
SOURCE = {"tuned": "chosen on: ", "law": "", "definition": "defines: "}
FACTORS = {"half": .5, "twice": 2}
# Numbers that were chosen on data, or fitted to it, and stand beside the code that they
# decide in: file, how many, what they are, the data.
BESIDE = [
    ("calib/diagnose/judge/evidence.cc", 19,
     "weights of a claim's probability: 6 of an effect against a file, 5 since a reference, 5 of what comes and goes, 3 of what stands beyond a single "
     "reference", "the cases and logs that stand beside each set"),
    ("calib/diagnose/data/day_shares.h", 2,
     "friction from day to day, shares of viscous and of Coulomb friction", "a UR10e's eight logs of a month"),
    ("calib/diagnose/freedom.cc", 2, "by which factors a file's trust may be too small",
     "from the 5 % of a file taken at its word to the 50 % that calibrations give one"),
    ("calib/diagnose/select/missing_terms.cc", 1,
     "the prior of missing terms, by the size that matters",
     "the sizes of the catalogue"),
    ("calib/diagnose/select/rivals.cc", 2, "how near in score rivals are fitted as well",
     "nothing that was noted"),
]


def changed(threshold, factor):
    value = threshold["value"]
    if threshold["unit"] == "quantile":
        return 1 - factor * (1 - value)
    return factor * value


def run(arguments, folder, setting):
    """{case: diagnosis} with thresholds as `setting` says; None: no answer."""
    name = setting or "as_they_are"
    answers = folder / "answers" / name
    answers.mkdir(parents=True, exist_ok=True)
    program = Path(arguments.cases).resolve() / "program.sh"
    program.write_text(f"#!/bin/sh\nexec {os.path.abspath(arguments.program)} "
                       f"'{setting}' \"$@\"\n")
    program.chmod(program.stat().st_mode | stat.S_IRWXU | stat.S_IRGRP |
                  stat.S_IXGRP | stat.S_IROTH | stat.S_IXOTH)
    subprocess.run([arguments.run_blind, f"--armcal={program}", "--forward=false",
                    f"--logs={folder}/logs", f"--labels={folder}/labels",
                    f"--answers={answers}"], check=False, stdout=subprocess.DEVNULL)
    found = {}
    for case in sorted(answers.iterdir()):
        path = case / "diagnosis.json"
        found[case.name] = json.loads(path.read_text()) if path.exists() else None
    return found


def claims(diagnosis):
    return {(e["effect"], e["joint_index"]) for e in diagnosis["effects"]
            if e["probability"] > NAMED}


def said(diagnosis):
    """What must not change: the verdict and the claims."""
    return diagnosis and (diagnosis["verdict"], claims(diagnosis))


def is_right(diagnosis, label):
    """Nothing where there is nothing, else all that there is and no more; of what is
    in no catalogue no name."""
    if diagnosis is None:
        return False
    truth = {(e["effect"], e["joint_index"]) for e in label["effects"] if e["in_catalogue"]}
    if label["effects"]:
        return claims(diagnosis) == truth
    return not diagnosis["effects"] and diagnosis["verdict"] not in (
        "unknown", "partly_explained", "explained")


def labels(folder):
    return {path.stem: json.loads(path.read_text())
            for path in (folder / "labels").glob("case_*.json")}


def study(arguments, threshold, folders, before, truth):
    """{"half": {"changed": .., "right": .., "value": ..}, "twice": ..}"""
    row = {}
    for word, factor in FACTORS.items():
        value = changed(threshold, factor)
        after = {f.name: run(arguments, f, f"{threshold['name']}={value:.12g}")
                 for f in folders}
        cases = [(f.name, case) for f in folders for case in truth[f.name]]
        row[word] = {
            "value": value,
            "changed": sum(said(before[f][c]) != said(after[f][c]) for f, c in cases),
            "right": sum(is_right(after[f][c], truth[f][c]) -
                         is_right(before[f][c], truth[f][c]) for f, c in cases)}
    return row


def number(x):
    return f"{x:.3g}"


def page(thresholds, result):
    kinds = Counter(t["kind"] for t in thresholds)
    beside = sum(count for _, count, _, _ in BESIDE)
    count, of = result.get("cases", 0), result.get("of", "")
    lines = [
        "# Thresholds of a diagnosis", "",
        f"Numbers that decide what `armcal diagnose` says of logs: {kinds['tuned']} that were "
        f"chosen on data, {kinds['law']} that follow from a law, and {kinds['definition']} "
        "that define a word of the answer or what is looked for. Written by `tests/blind/sensitivity.py` from "
        f"`calib/diagnose/data/thresholds.h`. {beside} more that were chosen on data, or fitted to "
        "it, stand beside the code that they decide in ([below](#beside-the-code)): "
        f"{kinds['tuned'] + beside} tuned numbers in all. Not here are the ranges of "
        "[effects' parameters](effects/README.md), what a standstill is "
        "(`model/signals/standstill.h`), the constants of changes over many logs "
        "(`calib/diagnose/changes`) and of measured poses (`calib/poses`), the bounds within "
        "which odds are weighed (`calib/diagnose/judge/evidence.cc`), and the sizes of grids "
        "and caps on rounds. *Nothing that was noted*: it is not known any more on what data "
        "that number was chosen.", "",
        *(["The last two figures are not measured yet.", ""] if not count else []),
        f"*Half* and *twice*: how many of {count or 'the'} calibration cases of the "
        f"[blind bench](../tests/blind/README.md){of} get "
        "another verdict or another claim above 50 % with half or twice the value (of a "
        "quantile: of its remainder to 1), and, where that differs, how many more (+) or "
        "fewer (-) are then right. These cases are of the set that many of the numbers were "
        "chosen on: the figures say what a number decides, not how good it is. Without figures: "
        f"not varied. Measured on {result.get('date', 'an unknown day')}, with the diagnosis of that day.", "",
        "| name | value | unit | meaning | half | twice | source |",
        "|---|---|---|---|---|---|---|"]
    for t in thresholds:
        row = result["rows"].get(t["name"], {})
        cells = []
        for word in FACTORS:
            entry = row.get(word)
            text = "" if entry is None else str(entry["changed"])
            if entry and entry["right"]:
                text += f" ({entry['right']:+d})"
            cells.append(text)
        source = SOURCE[t["kind"]] + t["source"]
        lines.append(f"| `{t['name']}` | {number(t['value'])} | {t['unit']} | "
                     f"{t['meaning']} | {cells[0]} | {cells[1]} | {source} |")
    lines += ["", "## Beside the code", "",
              "| file | numbers | what they are | chosen on |",
              "|---|---|---|---|"]
    lines += [f"| `{file}` | {count} | {what} | {data} |" for file, count, what, data in BESIDE]
    return "\n".join(lines) + "\n"


def listed():
    """The page's cells, a row for each threshold."""
    rows, _, _ = PAGE.read_text().partition("## Beside the code")
    return [[cell.strip() for cell in line[1:-1].split("|")]
            for line in rows.splitlines() if line.startswith("| `")]


def measured(thresholds):
    """The page's figures, of thresholds whose value is still that of the page."""
    text = PAGE.read_text()
    cases = re.search(r"how many of (\d+) calibration cases of the \S+ \S+( \(.*?\))? get",
                      text)
    result = {"rows": {}, "cases": int(cases[1]), "of": cases[2] or "",
              "date": re.search(r"Measured on ([-\d]+)", text)[1]}
    values = {t["name"]: number(t["value"]) for t in thresholds}
    for cells in listed():
        name = cells[0].strip("`")
        if values.get(name) != cells[1]:
            continue
        figures = {word: re.fullmatch(r"(\d+)(?: \(([-+]\d+)\))?", cell)
                   for word, cell in zip(FACTORS, cells[4:6])}
        result["rows"][name] = {
            word: {"changed": int(found[1]), "right": int(found[2] or 0)}
            for word, found in figures.items() if found}
    return result


def is_current(thresholds):
    """Whether the page's rows are these thresholds with these values."""
    return [(row[0].strip("`"), row[1], row[2], row[3]) for row in listed()] == [
        (t["name"], number(t["value"]), t["unit"], t["meaning"]) for t in thresholds]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--cases", default="/tmp/sensitivity")
    parser.add_argument("--program", default="build/tests/diagnose_with_thresholds")
    parser.add_argument("--run_blind", default="build/tests/run_blind")
    parser.add_argument("--only", default="")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--rewrite", action="store_true")
    arguments = parser.parse_args()
    thresholds = json.loads(subprocess.run(
        [arguments.program, "--list"], check=True, capture_output=True).stdout)
    if arguments.check:
        return 0 if is_current(thresholds) else f"{PAGE}: not of these thresholds"
    if arguments.rewrite:
        PAGE.write_text(page(thresholds, measured(thresholds)))
        return 0
    folders = sorted(p for p in Path(arguments.cases).iterdir() if (p / "logs").exists())
    truth = {f.name: labels(f) for f in folders}
    saved = Path(arguments.cases) / "sensitivity.json"
    result = json.loads(saved.read_text()) if saved.exists() else {"rows": {}}
    result["date"] = str(datetime.date.today())
    result["cases"] = sum(len(t) for t in truth.values())
    result["of"] = " (" + ", ".join(f"{len(t)} {name}" for name, t in truth.items()) + ")"
    before = {f.name: run(arguments, f, "") for f in folders}
    only = arguments.only.split(",") if arguments.only else None
    for threshold in thresholds:
        if threshold["name"] in result["rows"] or (
                only and threshold["name"] not in only):
            continue
        row = study(arguments, threshold, folders, before, truth)
        result["rows"][threshold["name"]] = row
        saved.write_text(json.dumps(result, indent=1))
        print(threshold["name"], {w: (e["changed"], e["right"]) for w, e in row.items()},
              flush=True)
    PAGE.write_text(page(thresholds, result))
    return 0


if __name__ == "__main__":
    sys.exit(main())
