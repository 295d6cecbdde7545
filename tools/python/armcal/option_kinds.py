"""What options of commands may be: their types in Python, and the texts of
them that the command line's flags would have.

An option's kind follows from its flag: from the type, and from the form of the
value that --help shows ("HZ", "T0:T1"). A text is always taken, as it would be
typed; the command then says what is wrong with it."""

from __future__ import annotations

import numbers
import os
from dataclasses import dataclass
from typing import Any, Callable, Dict, List, Mapping

import numpy as np

from armcal import _armcal

COMMANDS = ("calibrate", "verify", "diagnose", "simulate", "excite", "inspect",
            "reduce", "merge", "compare")

# Units that a form of value names.
_UNITS = {"HZ": "Hz", "S": "s", "M": "m", "RAD": "rad", "KG": "kg"}


def _is_list(value: Any) -> bool:
    return isinstance(value, (list, tuple, np.ndarray))


def _is_number(value: Any) -> bool:
    return isinstance(value, numbers.Real) and not isinstance(
        value, (bool, np.bool_))


class _Unfit(Exception):
    """A value is not of the kind."""


def _whole(value: Any) -> str:
    if not _is_number(value) or not isinstance(value, numbers.Integral):
        raise _Unfit
    return str(int(value))


def _number(value: Any) -> str:
    if isinstance(value, numbers.Integral):
        return _whole(value)
    if not _is_number(value):
        raise _Unfit
    return repr(float(value))


def _switch(value: Any) -> str:
    if not isinstance(value, (bool, np.bool_)):
        raise _Unfit
    return "true" if value else "false"


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise _Unfit
    return value


def _path(value: Any) -> str:
    if not isinstance(value, (str, os.PathLike)):
        raise _Unfit
    path = os.fspath(value)
    if not isinstance(path, str):
        raise _Unfit
    return path


def _one_path(value: Any) -> str:
    path = _path(value)
    if "," in path:
        raise ValueError(f"found {path!r}, expected a path without a comma; "
                         "several go in a list")
    return path


def _end(value: Any) -> str:
    return "" if value is None else _number(value)


def _range(value: Any) -> str:
    if isinstance(value, str):
        return value
    if not _is_list(value):
        raise _Unfit
    if len(value) != 2:
        raise ValueError(f"found {len(value)} numbers, expected two, the ends "
                         "of a range; None: open")
    return ":".join(_end(end) for end in value)


def _several(one: Callable[[Any], str], between: str = ","
             ) -> Callable[[Any], str]:
    """One value, or a list of them."""
    def text(value: Any) -> str:
        if not _is_list(value):
            return one(value)
        return between.join(_text(part) if isinstance(part, str) and
                            one is not _one_path else one(part)
                            for part in value)
    return text


def _posture(value: Any) -> str:
    """{"finger": 0.02} -> "finger=0.02"; a text as it is."""
    if isinstance(value, str):
        return value
    if not isinstance(value, Mapping):
        raise _Unfit
    return ",".join(f"{_text(name)}={_number(q)}" for name, q in value.items())


def _ranges(value: Any) -> str:
    """(0, 1) is a range, ((0, 1), (2, 3)) are two."""
    if _is_list(value) and not any(_is_list(part) or isinstance(part, str)
                                   for part in value):
        return _range(value)
    return _several(_range)(value)


@dataclass(frozen=True)
class Kind:
    """What values an option takes, and their text."""

    annotation: str  # in the words of typing and of armcal.commands
    expected: str    # of messages
    text: Callable[[Any], str]


_SWITCH = Kind("bool", "True or False", _switch)
_WHOLE = Kind("int", "a whole number", _whole)
_NUMBER = Kind("float", "a number", _number)
_TEXT = Kind("str", "a text", _text)
_TEXTS = Kind("Union[str, Sequence[str]]", "a text or a list of texts",
              _several(_text))
_NUMBERS = Kind("Union[float, Sequence[float]]",
                "a number or a list of numbers", _several(_number))
_RANGES = Kind("Union[Range, Sequence[Range]]",
               "a pair of numbers or a list of pairs", _ranges)
_BOX = Kind("Sequence[Range]", "three pairs of numbers", _ranges)
_FILES = Kind("Logs", "a path, a Log or a list of them", _several(_one_path))

# Of flags that are texts.
_OF_FORM: Dict[str, Kind] = {
    "FILE": Kind("Path", "a path", _path),
    "DIR": Kind("Path", "a path", _path),
    "FILES": _FILES,
    "HZ": _NUMBER, "KG": _NUMBER, "M": _NUMBER, "S": _NUMBER, "SHARE": _NUMBER,
    "K1,K2..": _NUMBERS, "N1,N2..": _NUMBERS, "1,2..": _NUMBERS,
    "A[,..]": _NUMBERS, "V[,..]": _NUMBERS, "T[,..]": _NUMBERS,
    "X,Y,Z": _NUMBERS,
    "T0:T1": Kind("Range", "a pair of numbers", _range),
    "T1:T2[,..]": _RANGES, "LOW:HIGH[,..]": _RANGES,
    "JOINT=Q,..": Kind("Mapping[str, float]",
                       "a dict of joints' positions", _posture),
    "BOX": _BOX,
    "BOXES": Kind("Sequence[Sequence[Range]]",
                  "boxes, each of three pairs of numbers",
                  _several(_ranges, ";")),
    "A,SIGNAL:B..": _TEXTS, "A,B[,..]": _TEXTS, "A[,B..]": _TEXTS,
    "EFFECTS": _TEXT, "DATE": _TEXT, "NAME": _TEXT, "LINK": _TEXT,
}


def _is_numeric(text: str) -> bool:
    try:
        return bool([float(part) for part in text.split(",")])
    except ValueError:
        return False


def _of_words(option: _armcal.Option) -> Kind:
    words = ", ".join(repr(word) for word in option.words)
    # With commas between them they may be one text, and none of them "none".
    return Kind("Union[str, Sequence[str]]" if option.several else
                f"Literal[{words}]", f"of {words}",
                _several(_text) if option.several else _text)


def kind_of(option: _armcal.Option) -> Kind:
    """The kind of an option. KeyError: a form of value that is not known."""
    if option.type != "str":
        return {"bool": _SWITCH, "int": _WHOLE, "float": _NUMBER}[option.type]
    if option.form == "WORD":
        return _of_words(option)
    if option.form == "TEXT":  # of noises, per joint, or of words and numbers
        return _NUMBERS if _is_numeric(option.default) else _TEXT
    return _OF_FORM[option.form]


def unit_of(option: _armcal.Option) -> str:
    """That the form of value names, or nothing; else the sentence does."""
    return _UNITS.get(option.form, "")


def default_of(option: _armcal.Option) -> Any:
    """In Python; None where the flag's default is to be empty."""
    if option.type == "bool":
        return option.default == "true"
    if option.default == "":
        return None
    if option.type == "str":
        if kind_of(option) is not _NUMBERS:
            return option.default
        found = tuple(float(part) for part in option.default.split(","))
        return found[0] if len(found) == 1 else found
    return {"int": int, "float": float}[option.type](option.default)


def options_of(command: str) -> List[_armcal.Option]:
    """Of a command, in the order of --help."""
    return _armcal.option_definitions(command)


_KINDS: Dict[str, Kind] = {option.name: kind_of(option)
                           for command in COMMANDS
                           for option in options_of(command)}


def option_text(name: str, value: Any) -> str:
    """0.5 -> "0.5", [1, 2] -> "1,2", a range (0, 5) -> "0:5"."""
    kind = _KINDS.get(name)
    if kind is None:  # the command says that it is not known
        return str(value)
    if isinstance(value, str) and kind is not _FILES:
        return value
    try:
        return kind.text(value)
    except _Unfit:
        raise TypeError(f"{name}: found {type(value).__name__} {value!r}, "
                        f"expected {kind.expected}") from None
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from None


def option_texts(options: Mapping[str, Any]) -> Dict[str, str]:
    """All that are not None."""
    return {name: option_text(name, value) for name, value in options.items()
            if value is not None}
