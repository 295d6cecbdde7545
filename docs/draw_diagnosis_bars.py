#!/usr/bin/env python3
"""Writes diagnosis_bars.svg: the diagnosis' shares of the last evaluation
(tests/blind/EVALUATIONS.md), their 95 % intervals and the bars."""

import pathlib

ROWS = [  # label, hits, of, low and high end of the interval (%), bar (%)
    ("one clear effect, rich and poor", 72, 75, 88.8, 99.2, 96),
    ("one faint effect", 12, 23, 30.6, 73.2, 70),
    ("two clear effects, both", 12, 20, 36.1, 80.9, 80),
    ("without a name: abstains", 17, 19, 66.9, 98.7, 92),
    ("nothing wrong, rich: silent", 50, 50, 92.9, 100, 99),
    ("nothing wrong, poor: silent", 20, 20, 83.2, 100, 95),
    ("candidates hold the truth", 73, 73, 95.1, 100, 95),
    ("errors of form: one clear", 57, 74, 65.8, 86.0, 88),
    ("... two clear, both", 6, 20, 11.9, 54.3, 65),
    ("... without a name: abstains", 18, 20, 68.3, 98.8, 85),
    ("... nothing wrong: silent", 70, 70, 94.9, 100, 97),
]
INK, MARK, BAR = "#808080", "#3080d0", "#d06020"


def main():
    left, width, step = 220, 380, 26
    at = lambda percent: left + width * (percent - 10) / 90
    bottom = 14 + step * len(ROWS)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 640 '
           f'{bottom + 40}" font-family="sans-serif" font-size="12" '
           f'fill="{INK}">', "<title>Diagnosis: measured and asked</title>"]
    for percent in range(10, 101, 10):
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
