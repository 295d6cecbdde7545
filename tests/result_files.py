"""Results of measurements, in tests/results: what the figures in the texts are held to.

A file has `of` (what was measured), `command` (what measures it), `date`, `commit`, and
`values`: numbers, lists or objects of them, in the units that texts print. Where the
command did not write it itself, `stored_from` says what the values were taken from.
"""

import datetime
import json
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
FOLDER = ROOT / "tests" / "results"
KEYS = {"of", "command", "date", "commit", "values"}


def add_flag(parser):
    parser.add_argument("--results", help="write the figures that texts quote to this "
                                          "file of tests/results")


def command_line():
    """This program as its reader would call it."""
    words = [os.path.relpath(os.path.abspath(sys.argv[0]), ROOT)]
    left_out = ("--results", "--work", "--data", "--json", "--markdown")
    skip = False
    for word in sys.argv[1:]:
        if skip or word.startswith(left_out):
            skip = not skip and word in left_out
            continue
        words.append("--armcal=build/armcal" if word.startswith("--armcal=") else word)
    return " ".join(["python3", *words])


def commit():
    """Of the tree, a + behind it where that has changes."""
    def git(*words):
        return subprocess.run(["git", "-C", ROOT, *words], capture_output=True, text=True,
                              check=True).stdout.strip()
    changed = git("status", "--porcelain", "--untracked-files=no")
    return git("rev-parse", "--short=8", "HEAD") + ("+" if changed else "")


def rounded(value):
    if isinstance(value, dict):
        return {name: rounded(entry) for name, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [rounded(entry) for entry in value]
    if hasattr(value, "item"):  # NumPy's
        value = value.item()
    return float(f"{value:.6g}") if isinstance(value, float) else value


def as_text(result):
    """JSON, a value a line."""
    def entries(given, indent):
        return ",\n".join(f"{indent}{json.dumps(name)}: {json.dumps(value)}"
                          for name, value in given.items())
    head = {name: value for name, value in result.items() if name != "values"}
    return (f'{{\n{entries(head, " ")},\n "values": {{\n'
            f'{entries(rounded(result["values"]), "  ")}\n }}\n}}\n')


def write(path, of, values):
    """Numbers as texts print them or more exact ones."""
    result = {"of": of, "command": command_line(), "date": str(datetime.date.today()),
              "commit": commit(), "values": values}
    pathlib.Path(path).write_text(as_text(result), encoding="utf-8")


def numbers(value):
    """All of them, in the order in which they stand; words are left out."""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        return [x for entry in value for x in numbers(entry)]
    return [] if isinstance(value, str) or value is None else [value]


def read_all():
    """{name: result} of all files, those of folders as FOLDER/NAME."""
    return {str(path.relative_to(FOLDER).with_suffix("")):
            json.loads(path.read_text(encoding="utf-8"))
            for path in sorted(FOLDER.rglob("*.json"))}
