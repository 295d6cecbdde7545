"""What libraries and commands may print, and which words they may know."""

import re

from tree import LIBRARIES, room_of

PRINT_CALL = r"(?:^|[^A-Za-z_])(?:printf|fprintf|vprintf|puts|fputs|putchar) *\("
PRINTS = re.compile(r"std::(?:cout|cerr|clog)|<iostream>|LOG\((?:INFO|WARNING|ERROR)\)|"
                    + PRINT_CALL, re.M)
TO_STDOUT = re.compile(r"std::cout|[(, ]stdout[),]|" + PRINT_CALL, re.M)
CONSOLE = ("tools/console.h", "tools/console.cc")

EFFECT_NAME = re.compile(r'\bname = "(\w+)"')
# Names of effects that are words of other things, too: of files and of joints.
# A diagnosis means the effect by them, but where it writes files.
OTHER_MEANINGS = {"armature", "delay", "payload"}
WRITE_FILES = {"calib/diagnose/robot_export.cc", "calib/diagnose/modules/effects_json.cc"}
# Fields of other programs' files that are called as effects are.
FIELDS = {"model/robot_files/isaac_writer.cc": {"viscous_friction"}}

FLAG = re.compile(r"(?<!-)--[A-Za-z][\w-]*")
# The flags of other programs that messages recommend.
OTHER_PROGRAMS = {}  # {path: {flags}}


def libraries_print_nothing(tree):
    """They return results; tools print them."""
    for path in tree.code(LIBRARIES):
        if PRINTS.search(tree.bare(path)):
            yield f"{path}: prints: libraries return results, tools print them"


def commands_print_by_the_console(tree):
    """--json, --quiet and full disks are looked after in one place."""
    for path in tree.code(("tools",)):
        if path not in CONSOLE and TO_STDOUT.search(tree.bare(path)):
            yield f"{path}: prints: commands do so through tools/console.h"


def effects_are_named_by_themselves(tree):
    """What a diagnosis does about an effect follows from its description."""
    names = set()
    for path in tree.code():
        if re.match(r"model/effects/\w+/\w+\.cc", path):
            named = EFFECT_NAME.findall(tree.text(path))
            names.update(named)
            if not named:
                yield f"{path}: names no effect by a line effect.name = .."
    for path in tree.code():
        if path.startswith(("model/effects/", "model/plant/hidden/")):
            continue
        named = names.intersection(tree.strings(path))
        if not room_of(path).startswith("calib/diagnose") or path in WRITE_FILES:
            named -= OTHER_MEANINGS
        named -= FIELDS.get(path, set())
        if named:
            yield f"{path}: names the effect {sorted(named)[0]}: ask the effect instead"


def libraries_know_no_flags(tree):
    """They name an option by OptionName(), which tools write as a flag."""
    for path in tree.code(LIBRARIES):
        known = OTHER_PROGRAMS.get(path, set())
        for text in tree.strings(path):
            for flag in FLAG.findall(text):
                if flag not in known:
                    yield f"{path}: {flag} in a string: OptionName() names options"


RULES = (libraries_print_nothing, commands_print_by_the_console,
         effects_are_named_by_themselves, libraries_know_no_flags)
