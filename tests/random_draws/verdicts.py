"""What a run of armcal must end in: a result whose every number is one, or a
refusal that says what is wrong."""

import csv
import json
import re

import numpy as np

LONGEST = 60  # s of CPU time
# Numbers that are none, outside of words.
NO_NUMBER = re.compile(r"(?<![\w.#-])[-+]?(nan|inf(inity)?)(?![\w-])", re.IGNORECASE)
# What an interval or a figure may lack, by the last key (docs/calibrate.md):
# then it is null.
ENDED = {0: "result", 1: "negative verdict", 2: "wrong flags", 3: "refusal"}
# A refusal names the file, the flag, the joint or the link.
NAMES = re.compile(r"\.(csv|yaml|urdf|json|factor)|--[a-z_]+|joint\d|link\d|factors|out")


def refused(outcome):
    """Why this is no refusal."""
    lines = outcome.err.splitlines()
    if not lines or not lines[-1].startswith("armcal: "):
        yield "no sentence on stderr"
    elif not NAMES.search(lines[-1]):
        yield f"names nothing: {lines[-1]}"
    if outcome.code == 3 and len(lines) != 1:
        yield f"{len(lines)} lines on stderr: {outcome.err[:300]}"
    if outcome.out:
        yield f"prints {outcome.out[:200]!r}"
    if NO_NUMBER.search(outcome.err.replace("found 'nan'", "").replace("found 'inf'", "")):
        yield f"says {lines[-1]}"


def strict(text):
    def constant(name):
        raise ValueError(f"{name} in JSON")
    return json.loads(text, parse_constant=constant)


def nulls(value, path=""):
    """Paths of all nulls, without indices."""
    if value is None:
        yield path
    elif isinstance(value, dict):
        for key, inner in value.items():
            yield from nulls(inner, f"{path}.{key}" if path else key)
    elif isinstance(value, list):
        for inner in value:
            yield from nulls(inner, path + "[]")


def estimates(value, path=""):
    """All objects that hold a value and its standard deviation."""
    if isinstance(value, dict):
        if "stddev" in value and "value" in value:
            yield path, value
        for key, inner in value.items():
            yield from estimates(inner, f"{path}.{key}")
    elif isinstance(value, list):
        for inner in value:
            yield from estimates(inner, path)


def covariance(text):
    """Symmetric, and no variance below 0 in any direction, to rounding."""
    rows = list(csv.reader(text.splitlines()))
    names, rows = rows[0], rows[1:]
    if not rows:
        return
    # A line of one empty cell reads as no cell.
    cells = [[float(x) if x else None for x in row or [""]] for row in rows]
    known = [k for k, row in enumerate(cells) if row[k] is not None]
    C = np.array([[cells[i][j] for j in known] for i in known], dtype=float)
    if len(rows) != len(names) or not np.all(np.isfinite(C)):
        yield "the covariance has empty or infinite entries"
        return
    if not known:
        return
    variances = np.diag(C)
    if np.any(variances < 0):
        yield f"variances below 0: {[names[known[k]] for k in np.flatnonzero(variances < 0)]}"
        return
    scale = np.where(variances > 0, np.sqrt(np.maximum(variances, 1e-300)), 1)
    R = C / scale[:, None] / scale
    if np.abs(R - R.T).max() > 1e-9:
        yield f"the covariance is not symmetric: {np.abs(R - R.T).max():.2g}"
    least = np.linalg.eigvalsh((R + R.T) / 2)[0]
    if least < -1e-7 * len(known):
        yield f"the covariance has a variance of {least:.2g} (of correlations)"


def calibration(text):
    result = strict(text)
    solved = result["termination"]["converged"]
    if not solved and not result["termination"]["reason"]:
        yield "not solved, without a reason"
    for path, e in estimates(result):
        if e["value"] is None and e.get("identifiable") is not False and solved and (
                "payload" not in path):
            yield f"{path} {e.get('name')} has no value"
        if e.get("identifiable") and (e["stddev"] is None or e["stddev"] < 0):
            yield f"{path} {e.get('name')} is identifiable, with stddev {e['stddev']}"
        if e.get("identifiable") is False and e["stddev"] is not None:
            yield f"{path} {e.get('name')} is not identifiable, with stddev {e['stddev']}"
        # Identifiable is what the data tell more of than a file trusted to 100 %.
        known = max(abs(e["value"] or 0), abs(e.get("prior") or 0))
        if e.get("identifiable") and re.search(r"\.(mass|I(xx|yy|zz))$", e["name"]) and (
                e["stddev"] is not None and e["stddev"] > 1e3 * known > 0):
            yield f"{path} {e['name']} is {e['value']} +- {e['stddev']}"
    passed, reasons = result["verdict"]["passed"], result["verdict"]["reasons"]
    if not passed and not reasons:
        yield "a negative verdict without a reason"


def judged(outcome, folder):
    """What is wrong with how a run ended."""
    if outcome.code < 0:
        yield f"ended by signal {-outcome.code}"
    elif outcome.code not in ENDED:
        yield f"exit code {outcome.code}: {outcome.err[-500:]}"
    elif outcome.code >= 2:
        yield from refused(outcome)
    if outcome.seconds > LONGEST:
        yield f"took {outcome.seconds:.1f} s of CPU time"
    if outcome.code not in (0, 1):
        return
    for line in outcome.out.splitlines():
        if NO_NUMBER.search(line):
            yield f"prints {line!r}"
    if outcome.code == 1 and not outcome.out and not outcome.err:
        yield "a negative verdict without a word"
    for path in sorted(folder.glob("out/*")):
        yield from (f"{path.name}: {fault}" for fault in published(path))


def published(path):
    """What is wrong with a file that a run wrote."""
    if path.suffix == ".factor":  # binary; merge reads it, and judges its numbers
        return
    text = path.read_text(errors="replace")
    if path.suffix == ".html":
        # What others wrote, such as dygraphs, may speak of NaN.
        text = re.sub(r"<script\b.*?</script>", "", text, flags=re.DOTALL)
    found = NO_NUMBER.search(text)
    if found:
        yield f"holds {text[max(0, found.start() - 60):found.end() + 20]!r}"
    if path.name.endswith("covariance.csv"):
        yield from covariance(text)
    elif path.name == "calibration.json":
        yield from calibration(text)
    elif path.suffix == ".json":
        strict(text)
