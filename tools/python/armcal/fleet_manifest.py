"""Which logs have a factor file in a folder, and how each was made: what a run
that ended early has left to do."""

from __future__ import annotations

import hashlib
import json
import os
from typing import Any, Dict, List, Optional

NAME = "manifest.jsonl"


def digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


def recipe(*parts: Any) -> str:
    """A hash of what a factor file depends on beside its log."""
    return digest(json.dumps(parts, sort_keys=True, default=str).encode())


def _state(log: str) -> Optional[List[int]]:
    """Size and time of change, by which a log is known again; None: no file."""
    try:
        found = os.stat(log)
    except OSError:
        return None
    return [found.st_size, found.st_mtime_ns]


class Manifest:
    """The file manifest.jsonl of a folder of factor files, a line for each log
    that was tried, the last of a log's lines being what holds. It is only ever
    added to, line by line, so that the end of a run at any moment costs at most
    the line that was being written.

    A factor file is taken over where the log has the size and time of change
    that it had, the recipe is the same, and the file has the hash that was
    written down. Logs that were refused are tried again.
    """

    def __init__(self, folder: str) -> None:
        self._folder = folder
        self._path = os.path.join(folder, NAME)
        self._lines: Dict[str, Dict[str, Any]] = {}
        text = b""
        if os.path.exists(self._path):
            with open(self._path, "rb") as file:
                text = file.read()
        for line in text.splitlines():
            try:
                entry = json.loads(line)
                self._lines[entry["log"]] = entry
            except (ValueError, TypeError, KeyError):
                continue  # cut off
        self._ends_cut = text != b"" and not text.endswith(b"\n")

    def find(self, log: str, made_by: str) -> Optional[str]:
        """The path of a log's factor file; None: it is to be made."""
        entry = self._lines.get(os.path.abspath(log), {})
        if "factor" not in entry or entry.get("recipe") != made_by:
            return None
        if entry.get("state") != _state(log):
            return None
        path = os.path.join(self._folder, entry["factor"])
        try:
            with open(path, "rb") as file:
                return path if digest(file.read()) == entry["sha256"] else None
        except OSError:
            return None

    def add(self, log: str, made_by: str, factor: str, content: bytes) -> str:
        """Writes a factor file of this name, and that it is there; its path."""
        path = os.path.join(self._folder, factor)
        with open(path + ".part", "wb") as file:
            file.write(content)
        os.replace(path + ".part", path)
        self._append({"log": os.path.abspath(log), "state": _state(log),
                      "recipe": made_by, "factor": factor,
                      "sha256": digest(content)})
        return path

    def refuse(self, log: str, why: str) -> None:
        self._append({"log": os.path.abspath(log), "refused": why})

    def _append(self, entry: Dict[str, Any]) -> None:
        self._lines[entry["log"]] = entry
        with open(self._path, "a", encoding="utf-8") as file:
            if self._ends_cut:
                file.write("\n")
                self._ends_cut = False
            file.write(json.dumps(entry) + "\n")
