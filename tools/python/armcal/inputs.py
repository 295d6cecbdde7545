"""What commands read that is in no file."""

from __future__ import annotations

import os
import tempfile
from typing import Any, Dict, List, Optional, Tuple

from armcal.log import Array, Log
from armcal.option_kinds import option_text
from armcal.results import Reduction, Result


def _listed(value: Any) -> List[Any]:
    return list(value) if isinstance(value, (list, tuple)) else [value]


class Inputs:
    """What flags name that is in no file: logs, which commands take as arrays,
    and results, whose files are written to a folder while a command reads
    them."""

    def __init__(self, options: Dict[str, Any]) -> None:
        #: {name: arrays}
        self.logs: Dict[str, Dict[str, Array]] = {}
        self._names: Dict[int, str] = {}
        self._folder: Optional[tempfile.TemporaryDirectory[str]] = None
        self._staged: Dict[int, Tuple[Result, str]] = {}
        # A log must not be called as a file is that the command reads.
        self._taken = {os.fspath(part) for value in options.values()
                       for part in _listed(value)
                       if isinstance(part, (str, os.PathLike))}

    def __enter__(self) -> "Inputs":
        return self

    def __exit__(self, *_: Any) -> None:
        if self._folder is not None:
            self._folder.cleanup()

    def texts(self, options: Dict[str, Any]) -> Dict[str, str]:
        return {name: option_text(name, self._named(value))
                for name, value in options.items() if value is not None}

    def _named(self, value: Any) -> Any:
        """The name of a Log, the path of a Result; others as they are."""
        if isinstance(value, (list, tuple)):
            return [self._named(part) for part in value]
        if isinstance(value, Log):
            return self._log(value)
        return self._file(value) if isinstance(value, Result) else value

    def _log(self, log: Log) -> str:
        """Its name; several of one name are numbered."""
        if id(log) not in self._names:
            name, count = log.name, 1
            while name in self._taken:
                count += 1
                name = f"{log.name} {count}"
            self._taken.add(name)
            self._names[id(log)] = name
            self.logs[name] = log._arrays()
        return self._names[id(log)]

    def _file(self, result: Result) -> str:
        if self._folder is None:
            self._folder = tempfile.TemporaryDirectory(prefix="armcal-")
        if id(result) not in self._staged:
            folder = os.path.join(self._folder.name, str(len(self._staged)))
            result.write(folder)
            path = (folder if isinstance(result, Reduction) else
                    os.path.join(folder, result.json_name))
            self._staged[id(result)] = (result, path)
        return self._staged[id(result)][1]

    def without_folder(self, text: str) -> str:
        """A text of the command with results' own names."""
        for result, path in self._staged.values():
            text = text.replace(path, result.json_name)
        return text
