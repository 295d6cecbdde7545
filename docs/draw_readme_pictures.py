#!/usr/bin/env python3
"""Draws the two pictures of README.md from a real run.

  draw_readme_pictures.py --armcal=build/armcal           writes both
  draw_readme_pictures.py --armcal=build/armcal --check   writes none; exit code
                           1 where terminal.svg is not what armcal prints now

terminal.svg is a terminal in which a robot with an elastic gear is simulated and
diagnosed: the command lines that are run here, and what they print. report.png is
the top of the report.html that the diagnosis writes, as chromium shows it. The
same armcal gives the same SVG; the report's pixels depend on chromium's fonts.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import textwrap
from xml.sax.saxutils import escape, unescape

HERE = pathlib.Path(__file__).resolve().parent
sys.path += [str(HERE.parent / "tests"), str(HERE.parent / "tests/tools")]

import documents  # noqa: E402
from chromium import Chromium  # noqa: E402

SIMULATE = r"""armcal simulate --robot=data/six_axis/real.yaml --robot_error=0.02 \
  --effects=elasticity@2:windup=0.005 --duration=40 --out=friday"""
DIAGNOSE = r"""armcal diagnose --robot=data/six_axis/real.yaml \
  --log=friday/log.csv --out=diagnosed"""
# The last line of the diagnosis that is shown; what is below is in docs/diagnose.md.
LAST = "  removed "
COLUMNS, FONT_SIZE, LINE = 96, 13, 18
ADVANCE = .602 * FONT_SIZE  # of a character in usual monospaced fonts
PAPER, BAR, INK, PROMPT = "#1b2028", "#2b323d", "#d8dee6", "#7fd18b"
REPORT_WIDTH, REPORT_HEIGHT = 1000, 800


def run(command, folder, armcal):
    path = f"{folder}:{os.environ['PATH']}"
    if not (folder / "armcal").exists():
        (folder / "armcal").symlink_to(armcal)
        (folder / "data").symlink_to(HERE.parent / "data")
    done = subprocess.run(["bash", "-c", command], cwd=folder, text=True,
                          env={**os.environ, "PATH": path}, check=True,
                          stdout=subprocess.PIPE)
    return done.stdout.rstrip().splitlines()


def wrapped(line):
    """As lines of the terminal's width, which continue indented."""
    indent = " " * (2 + len(line) - len(line.lstrip()))
    return textwrap.wrap(line, COLUMNS, subsequent_indent=indent,
                         break_on_hyphens=False,
                         replace_whitespace=False) or [""]


def screen(folder, armcal):
    """The lines of the terminal: whether it is typed, and the text."""
    lines = []
    for command in (SIMULATE, DIAGNOSE):
        lines += [(True, line) for line in ("$ " + command).splitlines()]
        printed = run(command, folder, armcal)
        last = next((k for k, line in enumerate(printed)
                     if line.startswith(LAST)), len(printed) - 1)
        shown = printed[:last + 1]
        if last + 1 < len(printed):
            shown.append("...")
        lines += [(False, piece) for line in shown for piece in wrapped(line)]
        lines.append((False, ""))
    return lines[:-1]


def svg(lines):
    width, top = round(COLUMNS * ADVANCE) + 40, 58
    height = top + LINE * len(lines) + 4
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} '
           f'{height}" width="{width}" height="{height}" role="img" '
           'aria-labelledby="title">',
           '<title id="title">A terminal: armcal simulates a six-axis arm with an '
           "elastic gear and diagnoses its log</title>",
           "<style>text{white-space:pre}</style>",
           f'<rect width="{width}" height="{height}" rx="8" fill="{PAPER}"/>',
           f'<path d="M0 30V8a8 8 0 0 1 8-8H{width - 8}a8 8 0 0 1 8 8V30z" '
           f'fill="{BAR}"/>']
    out += [f'<circle cx="{20 + 20 * k}" cy="15" r="6" fill="{colour}"/>'
            for k, colour in enumerate(("#e0685e", "#e0b04e", "#68b868"))]
    out.append(f'<g font-family="DejaVu Sans Mono, Menlo, Consolas, monospace" '
               f'font-size="{FONT_SIZE}" fill="{INK}">')
    for k, (typed, text) in enumerate(lines):
        if text:
            colour = f' fill="{PROMPT}"' if typed else ""
            out.append(f'<text xml:space="preserve" x="20" y="{top + LINE * k}"'
                       f"{colour}>{escape(text)}</text>")
    return "\n".join(out + ["</g>", "</svg>", ""])


def is_what_is_printed(drawn, lines):
    """Numbers hang on chance, and lines are broken where they come to: words are
    compared, and numbers within 40 % as in docs/diagnose.md."""
    shown = re.findall(r"<text [^>]*>([^<]*)</text>", drawn)
    return documents.same_line(unescape(" ".join(shown)),
                               " ".join(text for _, text in lines if text), .4)


def draw_report(page, picture):
    with Chromium("chromium") as browser:
        browser.size(REPORT_WIDTH, REPORT_HEIGHT)
        browser.open(page)
        browser.picture(picture, width=REPORT_WIDTH, height=REPORT_HEIGHT)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--armcal", type=pathlib.Path, required=True)
    parser.add_argument("--check", action="store_true")
    given = parser.parse_args()
    terminal = HERE / "terminal.svg"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        lines = screen(folder, given.armcal.resolve())
        if given.check:
            if not is_what_is_printed(terminal.read_text(), lines):
                sys.exit("docs/terminal.svg is not what armcal prints; "
                         "docs/draw_readme_pictures.py draws it anew")
            return
        terminal.write_text(svg(lines))
        draw_report(folder / "diagnosed/report.html", HERE / "report.png")


if __name__ == "__main__":
    main()
