"""A tree of sources as the rules see it: files, rooms, texts."""

import functools
import os
import re
import subprocess

CODE = (".h", ".cc", ".inc")
LAYERS = ("model", "problems", "calib", "tools")
LIBRARIES = ("model", "problems", "calib")
FOLDERS = LAYERS + ("tests", "data", "docs", "cmake", "examples")

# Comments, raw strings, strings and characters of C++; what stands in none of
# them can begin none of them either.
TOKEN = re.compile(
    r'(?P<comment>//(?:[^\n\\]|\\.|\\\n)*|/\*.*?\*/)'
    r'|R"(?P<mark>[^(\s]*)\((?P<raw>.*?)\)(?P=mark)"'
    r'|"(?P<string>(?:[^"\\\n]|\\.)*)"'
    r"|(?P<character>(?<![0-9A-Fa-f])'(?:[^'\\\n]|\\.)+')", re.S)
INCLUDE = re.compile(r'^ *# *include *(["<])([^">]*)[">]', re.M)


class Rooms:
    """The table of cmake/rooms.cmake, as CMake itself reads it."""

    def __init__(self, table, cmake="cmake"):
        script = os.path.join(os.path.dirname(__file__), "print_rooms.cmake")
        printed = subprocess.run([cmake, f"-DTABLE={table}", "-P", script], check=True,
                                 capture_output=True, text=True).stderr
        lines = [line.split("|") for line in printed.splitlines() if "|" in line]
        self.sees_hidden = re.compile(lines.pop(0)[1])
        self.names = [name for name, _ in lines]
        self.forbidden = {name: set(rooms.split(";")) for name, rooms in lines}

    def may_use(self, room):
        """The rooms whose files a file of `room` may include."""
        above = self.names[:self.names.index(room) + 1]
        return set(above) - self.forbidden[room]


class Tree:
    def __init__(self, root, rooms):
        self.root, self.rooms = root, rooms
        self.paths = set(os.listdir(root))  # files and folders
        self.files = sorted(self._walk())

    def _walk(self):
        yield from (name for name in self.paths if os.path.isfile(f"{self.root}/{name}"))
        for top in FOLDERS:
            for folder, folders, names in os.walk(f"{self.root}/{top}"):
                folders[:] = [name for name in folders if name != "__pycache__"]
                place = os.path.relpath(folder, self.root)
                self.paths.update(f"{place}/{name}" for name in folders + names)
                yield from (f"{place}/{name}" for name in names)

    def code(self, tops=LAYERS):
        """Sources in C++ of these folders, but for what armcal writes as it is."""
        return [path for path in self.files
                if path.split("/")[0] in tops and path.endswith(CODE)
                and "/assets/" not in path]

    @functools.lru_cache(maxsize=None)
    def text(self, path):
        with open(f"{self.root}/{path}", encoding="utf-8", errors="replace") as file:
            return file.read()

    @functools.lru_cache(maxsize=None)
    def includes(self, path):
        """[(quoted, name)]"""
        return [(mark == '"', name) for mark, name in INCLUDE.findall(self.text(path))]

    @functools.lru_cache(maxsize=None)
    def strings(self, path):
        """What literals hold; those that follow each other are one."""
        text, end, found = self.text(path), None, []
        for match in TOKEN.finditer(text):
            value = match["string"] if match["raw"] is None else match["raw"]
            if value is None:
                continue
            if end is not None and not text[end:match.start()].strip():
                found[-1] += value
            else:
                found.append(value)
            end = match.end()
        return found

    @functools.lru_cache(maxsize=None)
    def comments(self, path):
        """But for the names of namespaces at their ends."""
        found = [match["comment"] for match in TOKEN.finditer(self.text(path))]
        return [text for text in found if text and not text.startswith("// namespace")]

    @functools.lru_cache(maxsize=None)
    def bare(self, path):
        """The code with nothing in its strings and no comments, line for line."""
        def keep_lines(match):
            lines = "\n" * match[0].count("\n")
            return lines if match["comment"] else f'""{lines}'
        return TOKEN.sub(keep_lines, self.text(path))


def room_of(path):
    return os.path.dirname(path)


def unit_of(path):
    """Header and source are one unit."""
    return os.path.splitext(path)[0]
