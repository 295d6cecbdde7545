"""Options of Python as the texts that flags of the command line take."""

from __future__ import annotations

import numbers
import os
from typing import Any, Dict, Mapping

import numpy as np

# Their two numbers are the ends of a range.
_RANGES = ("crop", "validate_crop")


def _scalar(name: str, value: Any) -> str:
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    if isinstance(value, os.PathLike):
        path: str = os.fspath(value)
        if "," in path:
            raise ValueError(f"{name}: found {path!r}, expected a path without "
                             "a comma")
        return path
    if isinstance(value, str):
        return value
    raise TypeError(f"{name}: found {type(value).__name__}, expected a text, a "
                    "number or a list of them")


def _range(name: str, value: Any) -> str:
    if len(value) != 2:
        raise ValueError(f"{name}: found {len(value)} numbers, expected two, "
                         "the ends of a range; None: open")
    return ":".join("" if end is None else _scalar(name, end) for end in value)


def _is_list(value: Any) -> bool:
    return isinstance(value, (list, tuple, np.ndarray))


def option_text(name: str, value: Any) -> str:
    """0.5 -> "0.5", [1, 2] -> "1,2", a range (0, 5) -> "0:5"."""
    if name in _RANGES and _is_list(value):
        return _range(name, value)
    if not _is_list(value):
        return _scalar(name, value)
    return ",".join(_range(name, part) if _is_list(part) else
                    _scalar(name, part) for part in value)


def option_texts(options: Mapping[str, Any]) -> Dict[str, str]:
    """All that are not None."""
    return {name: option_text(name, value) for name, value in options.items()
            if value is not None}
