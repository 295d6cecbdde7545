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
# Those that are libraries of their own (CMakeLists.txt).
LIBRARIES_WITHIN = ("model/effects", "model/plant/hidden", "model/plant", "tools/report",
                    "tools/python")

# They speak of the past, and of a tree that is not this one.
OTHER_TREES = {"CHANGELOG.md", "tests/blind/EVALUATIONS.md",
               "tests/layering/bad_tree.py", "tests/layering/rules_of_names.py"}
# Of another program.
ELSEWHERE = {("docs/comparison.md", "tools/_report_common.py")}

# Files that readers of docs/extending.md make; extending_test.py does.
EXAMPLE = re.compile(r"^```(?:cpp|diff) .*?^```$", re.M | re.S)

# A file without its folder, which may be anywhere.
BARE = re.compile(r"(?<![\w*{}<>/.])[a-z]\w*\.(?:h|cc)\b")
BARE_ELSEWHERE = {"nist.cc", "effects_data.h"}  # of Ceres; what diagnose writes

NOT_SHIPPED = re.compile(r"\b(?:DESIGN|ECOSYSTEM|GAP|HOUSE|INFERENCE|MATH|PERFORMANCE|REAL"
                         r"|STYLE|USERS)\.md")
# Constants, types and functions that stand in a source by themselves, which
# clang-format has at the beginning of a line.
CONSTANT = re.compile(r"^(?:static |constexpr |const )+[\w:<>, *&]*\b(k[A-Z]\w*)", re.M)
NAMESPACE = re.compile(r"^(?:inline )?namespace ([\w:]+) \{", re.M)
TYPE = re.compile(r"^(?:class|struct|enum class) (\w+)(?: final)?[^;{]*\{", re.M)
FUNCTION = re.compile(r"^\w[\w:<>,*& ]*[ *&](\w+)\(([^;{}()]*)\)(?: const)? \{", re.M)


TEST = re.compile(r"(?<![\w/.:<{}*-])[a-z][a-z0-9_]*_test\b(?!\.\w)")
CTEST = re.compile(r"ctest[^`\n]* -R[ =]*[\"']?([^`\"'\n A-Z]+)")
ADDED = re.compile(r"add_test\(NAME (\w+)")


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
    text = tree.text(path) if path.endswith(WHOLE_TEXTS) else ""
    return EXAMPLE.sub("", text) if path.endswith(".md") else text


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


def files_are_there(tree):
    """A file that is named without its folder is in one."""
    names = {os.path.basename(path) for path in tree.files} | BARE_ELSEWHERE
    for path in tree.files:
        if path in OTHER_TREES or not path.endswith(CODE + (".md",)):
            continue
        for name in sorted(set(BARE.findall(_prose(tree, path))) - names):
            yield f"{path}: {name} does not exist"


def test_names(tree):
    """As test_name() in tests/room_tests.cmake makes them, and as they are added by name."""
    yield from ADDED.findall(tree.text("tests/CMakeLists.txt"))
    for path in tree.files:
        room, file = os.path.split(path[len("tests/"):])
        name, ending = os.path.splitext(file)
        if path.startswith("tests/tools/") and ending == ".cmake":
            yield f"tools_{name}"
        if not path.startswith("tests/") or not file.endswith("_test.cc"):
            continue
        room = re.sub(r"^(model/plant|model|calib)/", "", room + "/").strip("/")
        if name.startswith(os.path.basename(room) + "_"):
            room = os.path.dirname(room)
        yield f"{room}/{name}".strip("/").replace("/", "_")


def tests_are_there(tree):
    """A test that is named can be run by that name."""
    names = set(test_names(tree))
    for path in tree.files:
        if path in OTHER_TREES or not path.endswith(CODE + (".md",)):
            continue
        prose = _prose(tree, path)
        for name in sorted(set(TEST.findall(prose)) - names):
            yield f"{path}: there is no test {name}"
        for pattern in {part for found in CTEST.findall(prose) for part in found.split("|")}:
            if not any(re.search(pattern, name) for name in names):
                yield f"{path}: ctest -R {pattern} finds no test"


def _own_names(code):
    """What a source names for itself alone, functions with their parameters' types."""
    yield from CONSTANT.findall(code)
    yield from TYPE.findall(code)
    for name, parameters in FUNCTION.findall(code):
        types = re.sub(r"\w+(?=,|$)", "", " ".join(parameters.split()))
        yield f"{name}({types.replace(' ', '')})"


def sources_share_no_names(tree):
    """Sources of a library are compiled together, in batches that any new file shifts."""
    first = {}
    for path in (path for path in tree.code() if path.endswith(".cc")):
        library = next((name for name in LIBRARIES_WITHIN if path.startswith(name + "/")),
                       path.split("/")[0])
        hidden = tree.bare(path).partition("namespace {\n")[2].partition("\n}  \n")[0]
        for name in sorted(set(_own_names(hidden))):
            other = first.setdefault((library, name), path)
            if other != path:
                yield f"{path}: {name} is in {other}, too, of the same library"


def headers_share_no_types(tree):
    """Two types of one name in one namespace are one to the linker, whichever it takes."""
    first = {}
    for path in (path for path in tree.code() if path.endswith(".h")):
        code = tree.bare(path)
        namespace = "::".join(NAMESPACE.findall(code))
        for name in sorted(set(TYPE.findall(code))):
            other = first.setdefault((namespace, name), path)
            if other != path:
                yield f"{path}: {name} is in {other}, too, of the same namespace"


def sources_are_shipped(tree):
    """What a reader is sent to is in this repository."""
    for path in tree.files:
        if not path.endswith(CODE + WHOLE_TEXTS):
            continue
        for name in sorted(set(NOT_SHIPPED.findall(tree.text(path)))):
            yield f"{path}: cites {name}, which is not shipped: say what it says"


RULES = (names_say_something, paths_lead_somewhere, files_are_there, tests_are_there,
         sources_share_no_names, headers_share_no_types, sources_are_shipped)
