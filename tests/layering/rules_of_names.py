"""Names that say something, and paths and documents that are there."""

import fnmatch
import os
import re

from tree import CODE

SAYS_NOTHING = re.compile(r"(utils?|common|misc|helpers?|types)$")
NAMED = ("model", "problems", "calib", "tools", "tests", "data", "docs")

# A path from the root, at the beginning of a word; ${X} and <x> stand for anything.
PATH = re.compile(r"(?<![\w/.}\-$>*+^)])(?:model|problems|calib|tools|tests|docs|data)"
                  r"/(?:[\w./*+-]|\$\{\w+\}|<\w+>)*(?:[\w*/]|\$\{\w+\}|<\w+>)")
ANYTHING = re.compile(r"\$\{\w+\}|<\w+>")
WHOLE_TEXTS = (".md", ".py", ".sh", ".cmake", ".txt", ".toml", ".ipynb", ".in")
# They speak of the past, and of a tree that is not this one.
OTHER_TREES = {"CHANGELOG.md", "tests/blind/EVALUATIONS.md",
               "tests/layering/bad_tree.py", "tests/layering/rules_of_names.py"}
# Of another program.
ELSEWHERE = {("docs/comparison.md", "tools/_report_common.py")}

NOT_SHIPPED = re.compile(r"\b(?:DESIGN|GAP|MATH|HOUSE|REAL)\.md")


def names_say_something(tree):
    """No utils, common, misc, helpers, types."""
    for path in sorted(tree.paths):
        name = os.path.basename(path).split(".")[0]
        if path.split("/")[0] in NAMED and SAYS_NOTHING.match(name):
            yield f"{path}: the name says nothing"


def _prose(tree, path):
    """What of a file may name other files."""
    if path.endswith(CODE):
        return "\n".join(tree.comments(path))
    return tree.text(path) if path.endswith(WHOLE_TEXTS) else ""


def _exists(tree, folder, named):
    pattern = ANYTHING.sub("*", named).rstrip("/")
    for base in (pattern, f"{folder}/{pattern}"):  # from the root, or from here
        for path in (base, f"{base}.h", f"{base}.cc"):
            if path in tree.paths or "*" in path and fnmatch.filter(tree.paths, path):
                return True
    return False


def paths_lead_somewhere(tree):
    """What a page, a comment or a script names is there."""
    for path in tree.files:
        if path in OTHER_TREES:
            continue
        for named in sorted(set(PATH.findall(_prose(tree, path)))):
            if (path, named) not in ELSEWHERE and not _exists(
                    tree, os.path.dirname(path), named):
                yield f"{path}: {named} does not exist"


def sources_are_shipped(tree):
    """What a reader is sent to is in this repository."""
    for path in tree.files:
        if not path.endswith(CODE + WHOLE_TEXTS):
            continue
        for name in sorted(set(NOT_SHIPPED.findall(tree.text(path)))):
            yield f"{path}: cites {name}, which is not shipped: say what it says"


RULES = (names_say_something, paths_lead_somewhere, sources_are_shipped)
