#!/usr/bin/env python3
"""Pastes the examples into the guides that show them.

  tools/paste_examples.py [--check]

The code block after a line <!-- examples/cpp/NAME.cc --> of docs/*.md becomes
that file. With --check nothing is written; exit code 1 where a guide shows
something else than the file.
"""

import argparse
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
BLOCK = re.compile(r"(<!-- (examples/\S+) -->\n```cpp\n)(.*?)(```\n)", re.S)


def with_examples(text: str) -> str:
    return BLOCK.sub(
        lambda found: found[1] + (ROOT / found[2]).read_text() + found[4],
        text)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--check", action="store_true")
    check = parser.parse_args().check
    stale = shown = 0
    for guide in sorted((ROOT / "docs").glob("*.md")):
        text = guide.read_text()
        shown += len(BLOCK.findall(text))
        new = with_examples(text)
        if new == text:
            continue
        stale += 1
        if check:
            print(f"{guide.relative_to(ROOT)}: shows something else than its "
                  "examples; tools/paste_examples.py mends it")
        else:
            guide.write_text(new)
    if shown == 0:
        print("no guide shows an example")
    return int(shown == 0 or (check and stale > 0))


if __name__ == "__main__":
    sys.exit(main())
