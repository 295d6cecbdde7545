#!/usr/bin/env python3
"""Writes diagnosis_bars.svg: the diagnosis' shares of the last evaluation, by
tests/results/blind_ce6cce33.json and blind_f8422ab1_misfit.json, their 95 % intervals and the bars. With --check it
writes nothing; exit code 1 where the file is another."""

import json
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).parent
RESULTS = HERE.parent / "tests" / "results"
EVALUATION, MISFIT = "blind_ce6cce33", "blind_f8422ab1_misfit"


def values(name):
    return json.loads((RESULTS / f"{name}.json").read_text(encoding="utf-8"))["values"]


def exact_95(hits, count):
    """Clopper and Pearson's interval, %, by bisection."""
    def tail(p, least):
        return sum(math.comb(count, k) * p**k * (1 - p)**(count - k)
                   for k in range(least, count + 1))

    def solve(least, share):
        low, high = 0., 1.
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if tail(middle, least) < share else (low, middle)
        return 100 * low
    return (solve(hits, .025) if hits else 0.,
            solve(hits + 1, .975) if hits < count else 100.)


def rows():
    """(label, hits, of, low and high end of the interval (%), bar (%))"""
    plain, misfit, bars = values(EVALUATION), values(MISFIT), values("blind_bars")

    def row(label, counts, bar):
        hits, count = counts[:2]
        return label, hits, count, *exact_95(hits, count), bar

    def silent(*counts):
        alarms, count = (sum(c[k] for c in counts) for k in (0, 1))
        return count - alarms, count
    return [
        row("one clear effect, rich and poor", plain["one"], bars["one"][0]),
        row("one faint effect", plain["faint"], bars["faint"]),
        row("two clear effects, both", plain["two"], bars["two"][0]),
        row("without a name: abstains", plain["abstains"], bars["abstains"][0]),
        row("nothing wrong, rich: silent", silent(plain["rich"]), 100 - bars["rich"][0]),
        row("nothing wrong, poor: silent", silent(plain["poor"]), 100 - bars["poor"]),
        row("candidates hold the truth", plain["candidates"], bars["candidates"]),
        row("errors of form: one clear", misfit["one"], bars["one"][1]),
        row("... one faint effect", misfit["faint"], bars["faint"]),
        row("... two clear, both", misfit["two"], bars["two"][1]),
        row("... without a name: abstains", misfit["abstains"], bars["abstains"][1]),
        row("... nothing wrong: silent", silent(misfit["rich"], misfit["poor"]),
            100 - bars["rich"][1]),
    ]


INK, MARK, BAR = "#808080", "#3080d0", "#d06020"


def picture(drawn):
    left, width, step = 220, 380, 26
    at = lambda percent: left + width * percent / 100
    bottom = 14 + step * len(drawn)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 640 '
           f'{bottom + 40}" font-family="sans-serif" font-size="12" '
           f'fill="{INK}">', "<title>Diagnosis: measured and asked</title>"]
    for percent in range(0, 101, 10):
        out.append(f'<path d="M{at(percent):.0f} 8V{bottom}" stroke="{INK}" '
                   'stroke-opacity=".3"/>')
        out.append(f'<text x="{at(percent):.0f}" y="{bottom + 16}" '
                   f'text-anchor="middle">{percent}</text>')
    for k, (label, hits, count, low, high, bar) in enumerate(drawn):
        y = 24 + step * k
        out += [f'<text x="{left - 8}" y="{y + 4}" text-anchor="end">{label}'
                "</text>",
                f'<path d="M{at(low):.1f} {y}H{at(high):.1f}" '
                f'stroke="{MARK}" stroke-width="3"/>',
                f'<circle cx="{at(100 * hits / count):.1f}" cy="{y}" r="5" '
                f'fill="{MARK}"/>',
                f'<path d="M{at(bar):.1f} {y - 9}v18" stroke="{BAR}" '
                'stroke-width="3"/>']
    out += [f'<text x="{left}" y="{bottom + 34}">% of cases: dot measured, '
            "line 95 % interval, upright mark the bar</text>", "</svg>", ""]
    return "\n".join(out)


def main():
    file, text = HERE / "diagnosis_bars.svg", picture(rows())
    if "--check" not in sys.argv:
        file.write_text(text, encoding="utf-8")
    elif file.read_text(encoding="utf-8") != text:
        sys.exit(f"{file} is not what draw_diagnosis_bars.py writes")


if __name__ == "__main__":
    main()
