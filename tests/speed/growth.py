#!/usr/bin/env python3
"""growth.py [--largest N] --armcal BINARY --write WRITE_GROWTH_LOG
          --benchmarks BENCHMARKS --out FOLDER

How time and memory of `armcal calibrate` grow with samples and with joints, on
logs of arms of general geometry, and those of a diagnosis' screen with the
number of candidates. Every case is a process of its own, those of calibrate run
a few times: its least CPU seconds (of one screen: on all cores) and its peak
memory, as the kernel says them; the log of calibrate is read from a file, and
kept as far as the memory budget goes. The exponent of a power law is fitted to
the upper half of every curve, where what does not grow is small, with its 95 %
interval (Student's t of the residuals). Writes growth.json, growth.txt and
growth.svg; Python's standard library only.
"""

import argparse
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from limited_process import wait_for  # noqa: E402

# What varies, its values, and joints and samples there. To add a curve: a line
# here.
CURVES = [
    ("samples", [10 ** (k / 2) for k in range(6, 15)], lambda x: (6, round(x))),
    ("joints", range(1, 13), lambda x: (x, 100_000)),
]
# How many effects of the catalogue the screen has, whose candidates count.
EFFECTS = range(8, 33, 2)
# The linear estimate from all samples, on data taken as they are.
FLAGS = ["--estimate=linear", "--identification=differential", "--bandwidth=0",
         "--quiet"]
REPETITIONS = 2
# Two-sided 95 % quantiles of Student's t by degrees of freedom.
STUDENT = [math.nan, 12.71, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306,
           2.262, 2.228]


def measure(armcal, write, joints, samples):
    """Seconds and peak memory in MB of one calibration."""
    seconds, peak = math.inf, math.inf
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([write, str(joints), str(samples), folder], check=True)
        command = [armcal, "calibrate", f"--robot={folder}/robot.urdf",
                   f"--log={folder}/log.csv", f"--out={folder}/out", *FLAGS]
        for _ in range(REPETITIONS):
            child = subprocess.Popen(command, stderr=subprocess.DEVNULL)
            took, memory = wait_for(child)
            if child.returncode not in (0, 1):
                sys.exit(f"growth.py: exit code {child.returncode}: "
                         f"{' '.join(command)}")
            seconds = min(seconds, took)
            peak = min(peak, memory / 2**20)
    return {"seconds": seconds, "peak_mb": peak}


def measure_screen(benchmarks, effects):
    """The same of one diagnosis' screen, by its number of candidates."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "out.json")
        child = subprocess.Popen(
            [benchmarks, "--benchmark_out=" + out, "--benchmark_min_time=1",
             f"--benchmark_filter=^DiagnosisScreenOf/effects:{effects}/"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        _, memory = wait_for(child)
        if child.returncode != 0:
            sys.exit(f"growth.py: exit code {child.returncode}: {benchmarks}")
        with open(out, encoding="utf-8") as file:
            run = json.load(file)["benchmarks"][0]
    return {"x": run["candidates"], "effects": effects,
            "seconds": run["per_sample"], "peak_mb": memory / 2**20}


def curve_of(over, points):
    return {"over": over, "points": points,
            "seconds": exponent(points, "seconds"),
            "peak_mb": exponent(points, "peak_mb")}


def exponent(points, key):
    """Slope of log y over log x in the upper half, and half its interval."""
    upper = points[min(len(points) // 2, len(points) - 3):]
    x = [math.log(p["x"]) for p in upper]
    y = [math.log(p[key]) for p in upper]
    n, mx, my = len(x), sum(x) / len(x), sum(y) / len(y)
    sxx = sum((a - mx) ** 2 for a in x)
    slope = sum((a - mx) * (b - my) for a, b in zip(x, y)) / sxx
    rss = sum((b - my - slope * (a - mx)) ** 2 for a, b in zip(x, y))
    return {"exponent": slope, "of_points": n, "from": upper[0]["x"],
            "half_width": STUDENT[n - 2] * math.sqrt(rss / (n - 2) / sxx)}


def describe(curves):
    for curve in curves:
        yield f"{curve['over']:>10}  {'CPU s':>10}  {'peak MB':>8}"
        for p in curve["points"]:
            yield f"{p['x']:10.0f}  {p['seconds']:10.4g}  {p['peak_mb']:8.1f}"
        for key, what in ("seconds", "time"), ("peak_mb", "memory"):
            fit = curve[key]
            yield (f"{what} grows as {curve['over']}^({fit['exponent']:.3f} "
                   f"+- {fit['half_width']:.3f}) from {fit['from']:.0f} on")
        yield ""


INK, MARK = "#808080", "#3080d0"
WIDTH, HEIGHT, LEFT, TOP = 250, 170, 60, 30  # of a panel's axes


def panel(curve, key, title, dx, dy):
    """Log-log axes with points and the fitted line, as SVG elements."""
    points = curve["points"]
    decades = []
    for k in "x", key:
        low = math.floor(math.log10(min(p[k] for p in points)) + 1e-9)
        high = math.ceil(math.log10(max(p[k] for p in points)) - 1e-9)
        decades.append((low, max(high, low + 1)))
    (x0, x1), (y0, y1) = decades
    at_x = lambda v: dx + LEFT + WIDTH * (math.log10(v) - x0) / (x1 - x0)
    at_y = lambda v: dy + TOP + HEIGHT * (y1 - math.log10(v)) / (y1 - y0)
    out = [f'<text x="{dx + 8}" y="{dy + TOP - 10}">{title}</text>']
    for k in range(x0, x1 + 1):
        out.append(f'<path d="M{at_x(10 ** k):.1f} {dy + TOP}v{HEIGHT}" '
                   f'stroke="{INK}" stroke-opacity=".3"/><text text-anchor='
                   f'"middle" x="{at_x(10 ** k):.1f}" '
                   f'y="{dy + TOP + HEIGHT + 16}">1e{k}</text>')
    for k in range(y0, y1 + 1):
        out.append(f'<path d="M{dx + LEFT} {at_y(10 ** k):.1f}h{WIDTH}" '
                   f'stroke="{INK}" stroke-opacity=".3"/><text text-anchor='
                   f'"end" x="{dx + LEFT - 6}" '
                   f'y="{at_y(10 ** k) + 4:.1f}">1e{k}</text>')
    fit = curve[key]
    upper = points[-fit["of_points"]:]
    last, first = upper[-1]["x"], upper[0]["x"]
    middle = math.exp(sum(math.log(p[key]) for p in upper) / len(upper))
    center = math.exp(sum(math.log(p["x"]) for p in upper) / len(upper))
    line = [middle * (x / center) ** fit["exponent"] for x in (first, last)]
    out.append(f'<path d="M{at_x(first):.1f} {at_y(line[0]):.1f}L'
               f'{at_x(last):.1f} {at_y(line[1]):.1f}" stroke="{MARK}" '
               'stroke-width="2"/>')
    out += [f'<circle cx="{at_x(p["x"]):.1f}" cy="{at_y(p[key]):.1f}" r="4" '
            f'fill="{MARK}"/>' for p in points]
    return out


def draw(curves):
    step_x, step_y = LEFT + WIDTH + 20, TOP + HEIGHT + 40
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 '
           f'{2 * step_x} {len(curves) * step_y}" font-family="sans-serif" '
           f'font-size="12" fill="{INK}">',
           "<title>Growth of time and memory</title>"]
    for row, curve in enumerate(curves):
        for column, (key, what) in enumerate([("seconds", "CPU time, s"),
                                              ("peak_mb", "peak memory, MB")]):
            fit = curve[key]
            title = (f"{what}, over {curve['over']}: exponent "
                     f"{fit['exponent']:.2f} ± {fit['half_width']:.2f}")
            out += panel(curve, key, title, column * step_x, row * step_y)
    return "\n".join([*out, "</svg>", ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[1])
    parser.add_argument("--armcal", required=True)
    parser.add_argument("--write", required=True)
    parser.add_argument("--benchmarks", required=True)
    parser.add_argument("--out", required=True, type=pathlib.Path)
    parser.add_argument("--largest", type=float, default=1e7, help="samples "
                        "(default: 1e7, which writes a log of 4 GB)")
    arguments = parser.parse_args()
    if arguments.largest < 1e4:
        parser.error("--largest must be at least 1e4")
    curves = []
    for over, values, case in CURVES:
        points = []
        for x in values:
            joints, samples = case(x)
            if over == "samples" and samples > arguments.largest:
                continue
            samples = min(samples, round(arguments.largest))
            points.append({"x": x, "joints": joints, "samples": samples,
                           **measure(arguments.armcal, arguments.write, joints,
                                     samples)})
            print(f"growth.py: {over} {x:.0f}: {points[-1]}", file=sys.stderr)
        curves.append(curve_of(over, points))
    points = [measure_screen(arguments.benchmarks, e) for e in EFFECTS]
    curves.append(curve_of("candidates", points))
    values = {f"Growth/{c['over']}_{k}_exponent": c[k]["exponent"]
              for c in curves for k in ("seconds", "peak_mb")}
    arguments.out.mkdir(parents=True, exist_ok=True)
    text = "\n".join(describe(curves))
    print(text)
    (arguments.out / "growth.txt").write_text(text, encoding="utf-8")
    (arguments.out / "growth.svg").write_text(draw(curves), encoding="utf-8")
    with open(arguments.out / "growth.json", "w", encoding="utf-8") as file:
        json.dump({"curves": curves, "values": values}, file, indent=1)
        file.write("\n")


if __name__ == "__main__":
    main()
