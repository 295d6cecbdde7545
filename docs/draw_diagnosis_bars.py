#!/usr/bin/env python3
"""Writes diagnosis_bars.svg: the diagnosis' shares of the last evaluation
(tests/blind/EVALUATIONS.md), their 95 % intervals and the bars."""

import pathlib

ROWS = [  # label, hits, of, low and high end of the interval (%), bar (%)
    ("one clear effect, rich and poor", 143, 149, 91.4, 98.5, 97),
    ("one faint effect", 27, 43, 46.7, 77.0, 75),
    ("two clear effects, both", 24, 38, 46.0, 78.2, 85),
    ("without a name: abstains", 30, 37, 64.8, 92.0, 95),
    ("nothing wrong, rich: silent", 101, 101, 96.4, 100, 99),
    ("nothing wrong, poor: silent", 41, 41, 91.4, 100, 95),
    ("candidates hold the truth", 148, 148, 97.5, 100, 95),
]
INK, MARK, BAR = "#808080", "#3080d0", "#d06020"


def main():
    left, width, step = 220, 380, 26
    at = lambda percent: left + width * (percent - 40) / 60
    bottom = 14 + step * len(ROWS)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 640 '
           f'{bottom + 40}" font-family="sans-serif" font-size="12" '
           f'fill="{INK}">', "<title>Diagnosis: measured and asked</title>"]
    for percent in range(40, 101, 10):
        out.append(f'<path d="M{at(percent):.0f} 8V{bottom}" stroke="{INK}" '
                   'stroke-opacity=".3"/>')
        out.append(f'<text x="{at(percent):.0f}" y="{bottom + 16}" '
                   f'text-anchor="middle">{percent}</text>')
    for k, (label, hits, count, low, high, bar) in enumerate(ROWS):
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
    (pathlib.Path(__file__).parent / "diagnosis_bars.svg").write_text(
        "\n".join(out))


if __name__ == "__main__":
    main()
