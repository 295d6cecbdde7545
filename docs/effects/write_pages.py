#!/usr/bin/env python3
"""Writes the pages of this folder from effects.toml, figures.py,
tests/results/effects_recognition.json and tests/blind/equivalents.json. With --check it writes
nothing and names the pages that differ. Python 3.11, no packages."""

import json
import pathlib
import re
import runpy
import sys
import tomllib

import figures

HERE = pathlib.Path(__file__).parent
MODULES = HERE.parent.parent / "calib/diagnose/modules/assets/effects.py"
RECOGNITION = HERE.parent.parent / "tests" / "results" / "effects_recognition.json"
EQUIVALENTS = HERE.parent.parent / "tests" / "blind" / "equivalents.json"


def title(name):
    return name.replace("_", " ").capitalize()


def percent(value):
    """0.41 %, 53 %, 147 %."""
    return f"{value:.2g} %" if value < 99.5 else f"{value:.0f} %"


def in_modules():
    """Effects whose laws effects.py has, by its tables."""
    module = runpy.run_path(str(MODULES))
    return set().union(*(module[table] for table in (
        "COMMANDS", "FRICTION", "TORQUES", "TRANSMISSIONS", "ELSEWHERE")))


def simulators(name, text):
    if name not in in_modules():
        return text["simulators"]
    return (text["simulators"] + " In the loop of any simulator of rigid bodies: "
            "the source that `diagnose --modules=python,c` writes "
            "([how](../robot_files.md#laws-that-your-simulator-lacks)).")


def alike():
    """name: {other: {arms}}, declared equivalents."""
    found = {}
    for arm, pairs in json.loads(EQUIVALENTS.read_text()).items():
        for pair in pairs:
            a, b = pair["a"]["effect"], pair["b"]["effect"]
            for one, other in {(a, b), (b, a)}:
                found.setdefault(one, {}).setdefault(other, set()).add(arm)
    return found


def table(rows):
    lines = ["| name | unit | meaning |", "|---|---|---|"]
    for row in rows:
        name, turning, sliding, meaning = (x.strip() for x in row.split("|"))
        unit = turning if turning == sliding else f"{turning}; {sliding}"
        lines.append(f"| `{name}` | {unit} | {meaning} |")
    return lines


def shares(hits, count):
    return f"{hits} of {count}"


def source(keys):
    """For tests/claims.py."""
    return f"<!-- source: effects_recognition {keys} -->"


def recognised(name, figures_of):
    if figures_of is None:
        return (f"`{name}` was added after the last evaluation whose figures were kept by effect "
                "(2026-11-21). [EVALUATIONS](../../tests/blind/EVALUATIONS.md) has those since, over "
                "all effects.")
    seen, faint = figures_of["seen"], figures_of["faint"]
    text = (f"On the blind bench of 2026-11-21 (commit eaa5e611, simulated arms; the diagnosis has "
            f"changed since) `{name}` was named, on the right joint, in "
            f"{shares(*seen)} cases in which it was clear (ENR 0.32 and more)")
    text += f" and in {shares(*faint)} in which it was faint (0.17 to 0.32)."
    told = [f"`{other}` {count}" for other, count in
            figures_of["instead"].items()]
    told += [f"the same on another joint {count}" for count in figures_of["elsewhere"]]
    if told:
        text += " Told instead, of the clear ones: " + ", ".join(told) + "."
    error = figures_of["size_error"]
    if error:
        text += (f" Its size is off by {percent(error[0])} in the median "
                 f"and by {percent(error[1])} at the 90th percentile "
                 f"({error[2]} cases).")
    return text + source(name) + (" So few cases leave wide margins: see "
                   "[accuracy](../accuracy.md#diagnosis).")


def needed(text):
    """The size from which it shows, of a study on simulated arms."""
    if "needs" not in text:
        return []
    size = text["needs"].removesuffix(" *")
    line = (f"Size that just shows (ENR 0.32, see [all effects](README.md)): {size}, in 40 s of "
            "rich motion of a simulated six-axis arm with 1 % of torque noise and a file that is 2 "
            "to 4 % off (2026-11-21, commit 76f2321; no result file holds it).")
    if size != text["needs"]:
        line += (" What limits it is the file's error and not the noise: smaller ones are taken up "
                 "when the model's own numbers are fitted again. With a reference log, which tells "
                 "these numbers better than the file, smaller ones show.")
    return ["", line]


def kin(name, others, names):
    """What an ordinary motion does not tell it from."""
    if name not in others:
        return ("No other effect leaves nearly the same torque on an ordinary motion (cosine below "
                "0.95 on each of five simulated arms).")
    parts = []
    for other, arms in sorted(others[name].items()):
        text = f"[`{other}`]({other}.md)" if other in names else f"`{other}`"
        if other == name:
            text += " of another joint"
        elif other not in names:
            text += " (not in the catalogue)"
        parts.append(f"{text} ({', '.join(sorted(arms))})")
    return ("Nearly the same torque on an ordinary motion, after the model's own numbers were "
            "fitted (cosine of at least 0.95, on the simulated arms named): " + "; ".join(parts) +
            ".")


def page(name, text, figures_of, others, names):
    joint = "the whole robot" if text.get("scope") == "robot" else "one joint"
    lines = [
        "<!-- Written by write_pages.py from effects.toml: change that. -->",
        f"# {title(name)}", "",
        f"`{name}`, of {joint}. [All effects](README.md) explains the symbols.", "", "```",
        text["law"], "```", "", text["cause"], "",
        f"![What {name} leaves in the torque of a joint: against what orders "
        f"it, and over time]({name}.svg)", "",
        "## Parameters", "", *table(text.get("estimates",
                                             text["parameters"]))]
    if "estimates" in text:
        lines += ["", "These are the estimates of diagnosis.json; effects.json has the "
                  "law's own parameters:", "", *table(text["parameters"])]
    lines += [
        "", "Units with a semicolon: of a revolute joint; of a prismatic one."
        if any(row.split("|")[1].strip() != row.split("|")[2].strip()
               for row in text["parameters"]) else "",
        "", "## In the residual", "", text["residual"], "",
        "## When it is visible", "", text["visible"], *needed(text), "",
        "## What it is taken for", "", text["tell"], "",
        kin(name, others, names), "",
        "## How well it is recognised", "", recognised(name, figures_of), "",
        "## In simulators", "", simulators(name, text), "",
        f"Try it: `armcal simulate --robot=data/six_axis/real.yaml --run=1 --effects=\""
        f"{text['inject']}\" --out=after`. Without a log from before, a diagnosis may take it for "
        "wrong numbers of the file. So write one, `armcal simulate "
        "--robot=data/six_axis/real.yaml --out=before`, and ask `armcal diagnose "
        "--robot=data/six_axis/real.yaml --reference=before/log.csv --log=after/log.csv`.",
        "", "[All effects](README.md)", ""]
    out = []
    for line in lines:
        if line or (out and out[-1]):
            out.append(line)
    return "\n".join(out) + "\n"


INDEX = """<!-- Written by write_pages.py: change that. -->
# Effects

What [diagnose](../diagnose.md) has names for: {count} laws that rigid bodies with viscous
and Coulomb friction lack. `tau` is the torque that the motor needs beyond the model
(recorded minus predicted), v the joint's velocity, ID inverse dynamics, sign(v) rounded as
the joint's own Coulomb friction is. SI units.

Each page has the law, its parameters as the result files have them, what it leaves in the
residual, which motion shows it, what it is taken for, how well it is recognised and what
simulators have for it. Figures are of one small arm and one motion (`figures.py`), so that
they can be compared: left the residual against what orders it, right over time, shaded
where the joint moves forwards.

For simulators that lack a law, `diagnose --modules=python,c` writes it with its numbers as a
source for their loop ([how](../robot_files.md#laws-that-your-simulator-lacks)).

| effect | law | clear cases named | alike on an ordinary motion |
|---|---|---|---|
{rows}

"Clear" is an effect whose torque is at least 0.32 of the noise's after all that the model
may vary has been fitted to it (ENR, [blind bench](../../tests/blind/README.md)); {hits} of
{total}<!-- source: blind_eaa5e611 one --> were named with class and joint right in the evaluation of 2026-11-21 (commit
eaa5e611, seed 1789257233), on five simulated arms, with poor motion in one fifth of the cases. It is the last one whose
figures were kept by effect; the diagnosis has changed since ([accuracy](../accuracy.md#diagnosis)). Seven cases of an
effect say little about that effect: the interval of 7 of 7 is 59 to 100 % (95 %). "Alike" are effects that leave nearly
the same torque after the model's own numbers were fitted, on one of these arms or more.

## Which of them is mine

| the residual | look at |
|---|---|
| flips with the direction | `coulomb_friction`, `stribeck`, `load_friction`, `position_friction`, `presliding`, `thermal_friction` |
| flips with another joint's direction | `coupled_friction`, `torque_crosstalk` |
| grows with speed | `viscous_friction`, `quadratic_friction`, `asymmetric_friction`; on all joints: `viscous_friction_of_all_joints`, `time_base` |
| follows acceleration | `armature`, `link_inertia`, `elasticity`, `time_base` |
| repeats with position | `spring`, `cable`, `torque_ripple`, `position_friction` |
| follows gravity, on several joints | `payload`, `added_mass`, `link_inertia`, `link_length`, `encoder_offset`, `base_tilt` |
| follows the torque itself | `torque_gain`, `torque_gain_of_all_joints`, `torque_nonlinearity`, `torque_saturation`, `torque_deadband` |
| comes where torque changes fast | `delay`, `backlash`, `elasticity` |
| is there at rest | `torque_offset`, `vibration`, `time_drift` |
| comes once | `external_contact` |

What it has no name for (a brake that drags, a belt that slips, a load that sloshes ...):
`armcal simulate --list_effects` has 13 of them. A diagnosis should then say `unknown`; it
did, or named what cannot be told from it, in 47 of 56 cases, and named something else with
confidence in 9<!-- source: blind_eaa5e611 abstains abstains_wrong --> (2026-11-21, as above).
"""


def linked(text, names):
    """With links from names in backquotes."""
    head, mark, table_of = text.partition("## Which of them is mine")
    return head + mark + re.sub(
        "`([a-z_]+)`", lambda m: f"[`{m[1]}`]({m[1]}.md)"
        if m[1] in names else m[0], table_of)


def index(texts, known, others):
    rows, hits, total = [], 0, 0
    for name, text in texts.items():
        told = "not in it"
        if name in known:
            seen = known[name]["seen"]
            hits, total = hits + seen[0], total + seen[1]
            told = shares(*seen) + source(name + ".seen")
        kin_of = ", ".join(f"`{x}`" + (" of another joint" if x == name else "")
                           for x in sorted(others.get(name, {})))
        law = text["law"].replace("|", "\\|")
        rows.append(f"| [`{name}`]({name}.md) | {law} | {told} | "
                    f"{kin_of} |")
    return linked(INDEX.format(count=len(texts), rows="\n".join(rows),
                               hits=hits, total=total), texts)


def main():
    texts = tomllib.loads((HERE / "effects.toml").read_text())
    known = json.loads(RECOGNITION.read_text())["values"]
    others = alike()
    files = {"README.md": index(texts, known, others)}
    for name, text in texts.items():
        files[f"{name}.md"] = page(name, text, known.get(name), others, texts)
    if "--check" in sys.argv:
        stale = [name for name, text in files.items()
                 if not (HERE / name).exists() or
                 (HERE / name).read_text() != text]
        stale += [f"{name}.svg" for name in texts
                  if not (HERE / f"{name}.svg").exists()]
        for name in stale:
            print(f"docs/effects/{name} is not what write_pages.py writes")
        sys.exit(1 if stale else 0)
    for name in texts:
        files[f"{name}.svg"] = figures.draw(name)
    for name, text in files.items():
        (HERE / name).write_text(text)


if __name__ == "__main__":
    main()
