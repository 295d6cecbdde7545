"""Files that are good, and ways to spoil them, for the rows of the table.

A change is a function of the folder that holds a copy of the good files.
"""

import os
import pathlib
import typing
import zlib


class Row(typing.NamedTuple):
    """One malformed input."""
    name: str
    change: typing.Callable[[pathlib.Path], None]
    says: str  # all of stderr, after "armcal: "
    command: str = ""  # instead of the group's


class Group(typing.NamedTuple):
    """Rows that spoil one good set of files, which `command` takes."""
    name: str
    command: str
    good: dict[str, typing.Any]  # by path: text, bytes, "@" and a file of --formats
    rows: list[Row]
    prepare: typing.Sequence[str] = ()  # commands that add to the good files


def write(path, content):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content.encode() if isinstance(content, str) else content)


def written(name, content):
    """The file `name` holds `content`, which may be a function that makes it."""
    return lambda folder: write(
        folder / name, content() if callable(content) else content)


def replaced(name, old, new):
    """The file `name` has `new` wherever it had `old` (text or bytes)."""
    def change(folder):
        before = (folder / name).read_bytes()
        a, b = (x.encode() if isinstance(x, str) else x for x in (old, new))
        assert a in before, f"{old!r} is not in the good {name}"
        (folder / name).write_bytes(before.replace(a, b))
    return change


def edited(name, edit):
    """The bytes of the file `name` are what `edit` makes of them."""
    return lambda folder: (folder / name).write_bytes(
        edit((folder / name).read_bytes()))


def cut(name, size):
    """The file `name` ends after `size` bytes (before the last ones if < 0)."""
    return edited(name, lambda data: data[:size])


def removed(name):
    return lambda folder: (folder / name).unlink()


def a_folder(name):
    """A folder has the place of the file."""
    def change(folder):
        (folder / name).unlink(missing_ok=True)
        (folder / name).mkdir()
    return change


def linked(name, target):
    """The file is a symbolic link, as to a device."""
    def change(folder):
        (folder / name).unlink(missing_ok=True)
        os.symlink(target, folder / name)
    return change


def padded(name, size):
    """Zero bytes make the file `size` long; they take no place on the disk."""
    return lambda folder: os.truncate(folder / name, size)


def both(*changes):
    def change(folder):
        for one in changes:
            one(folder)
    return change


def nothing(folder):
    del folder


# A two-joint arm and 31 samples of it; the header is row 1.
ARM = """convention: standard
links:
  - {joint: revolute, a: 0.4}
  - {joint: revolute, a: 0.3}
"""
HEADER = "t,q1,q2,tau1,tau2"
SAMPLES = [(1 + k / 100, k / 100, (1 - 2 * (k % 2)) / 2, 2 + k / 100, -k / 100)
           for k in range(10, 41)]
LOG = "\n".join([HEADER] + [",".join(f"{x:g}" for x in s) for s in SAMPLES]) + "\n"


def headed(header):
    return replaced("log.csv", HEADER + "\n", header + "\n")


def with_row(number, text):
    """Row `number` of log.csv, as an editor counts, is `text`."""
    def change(folder):
        lines = LOG.splitlines()
        lines[number - 1] = text
        write(folder / "log.csv", "\n".join(lines) + "\n")
    return change


def compressed(text, times=1):
    """gzip of `times` copies of `text`."""
    def make():
        packer = zlib.compressobj(9, wbits=31)
        block = text.encode() if isinstance(text, str) else text
        parts = [packer.compress(block) for _ in range(times)]
        return b"".join(parts) + packer.flush()
    return make
