#!/usr/bin/env python3
"""What editors know of armcal's functions: armcal/__init__.pyi, from the flags
of the commands. After a flag has changed, with the built package:

  PYTHONPATH=build/python tests/python/write_stubs.py

ctest -R python_stub fails where the file is not what this writes."""

from __future__ import annotations

import ast
import inspect
import pathlib
from typing import Any, Callable

from armcal import commands

PACKAGE = (pathlib.Path(__file__).resolve().parents[2] /
           "tools/python/armcal")

HEADER = '''# Written by tests/python/write_stubs.py from the flags of the commands.
import os
from typing import Any, Literal, Mapping, Optional, Sequence, Union

'''


def argument(parameter: inspect.Parameter) -> str:
    text = f"{parameter.name}: {parameter.annotation}"
    if parameter.default is not parameter.empty:
        text += f" = {parameter.default!r}"
    return text


def function(command: Callable[..., Any]) -> str:
    """Its signature, an option a line, and its docstring."""
    signature = inspect.signature(command)
    lines, keywords = [], False
    for parameter in signature.parameters.values():
        if parameter.kind == parameter.KEYWORD_ONLY and not keywords:
            keywords = True
            lines.append("*")
        lines.append(argument(parameter))
    doc = inspect.getdoc(command) or ""
    body = "\n".join(f"    {line}".rstrip() for line in doc.split("\n"))
    assert '"""' not in body and "\\" not in body
    return (f"def {command.__name__}(\n    " + ",\n    ".join(lines) +
            f",\n) -> {signature.return_annotation}:\n"
            f'    """{body.strip()}\n    """\n')


def stub() -> str:
    """The imports of __init__.py, and the functions."""
    tree = ast.parse((PACKAGE / "__init__.py").read_text(encoding="utf-8"))
    names = {command.__name__ for command in commands.FUNCTIONS}
    parts = []
    for node in tree.body:
        if isinstance(node, ast.ImportFrom) and node.module == (
                "armcal.commands"):
            node.names = [ast.alias(name) for name in (
                "Logs", "Path", "Progress", "Range", "RobotLike")]
        elif not isinstance(node, (ast.ImportFrom, ast.Assign)):
            continue
        parts.append(ast.unparse(node))
    functions = [function(command) for command in commands.FUNCTIONS]
    assert len(functions) == len(names)
    return HEADER + "\n".join(parts) + "\n\n" + "\n".join(functions)


if __name__ == "__main__":
    (PACKAGE / "__init__.pyi").write_text(stub(), encoding="utf-8")
