#!/usr/bin/env python3
"""Holds the tree to its rules: rooms, words, paths, names, sizes.

    layering_test.py --work=DIR [--root=.] [--cmake=cmake]

The rules are the functions of tests/layering/rules_of_*.py, the rooms those of
cmake/rooms.cmake. Before the real tree they judge one in DIR that breaks each of
them, so that a rule that stopped working is noticed. Python's standard library only.
"""

import argparse
import pathlib
import shutil
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "layering"))

import bad_tree  # noqa: E402
import rules_of_names  # noqa: E402
import rules_of_rooms  # noqa: E402
import rules_of_sizes  # noqa: E402
import rules_of_texts  # noqa: E402
from tree import Rooms, Tree  # noqa: E402

RULES = (rules_of_rooms.RULES + rules_of_texts.RULES + rules_of_names.RULES
         + rules_of_sizes.RULES)


def wrong_rules(tree):
    """What the rules fail to notice about the bad tree, or notice in vain."""
    for rule in RULES:
        found = list(rule(tree))
        expected = list(bad_tree.EXPECTED[rule.__name__])
        for begin in expected:
            if not any(complaint.startswith(begin) for complaint in found):
                yield f"{rule.__name__} no longer notices: {begin}"
        for complaint in found:
            if not any(complaint.startswith(begin) for begin in expected):
                yield f"{rule.__name__} is wrong about the bad tree: {complaint}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--root", type=pathlib.Path, default=HERE.parent)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--cmake", default="cmake")
    given = parser.parse_args()
    rooms = Rooms(given.root / "cmake/rooms.cmake", given.cmake)
    bad = given.work / "bad_layers"
    shutil.rmtree(bad, ignore_errors=True)
    bad_tree.write(bad)
    complaints = list(wrong_rules(Tree(str(bad), rooms)))
    tree = Tree(str(given.root), rooms)
    for rule in RULES:
        complaints += rule(tree)
    print("\n".join(complaints))
    sys.exit(f"{len(complaints)} complaints" if complaints else 0)


if __name__ == "__main__":
    main()
