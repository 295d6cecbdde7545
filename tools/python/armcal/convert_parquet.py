"""Parquet files, as .npz (armcal.convert)."""

from __future__ import annotations

import pathlib
import zipfile
from typing import Any, Dict, List, Tuple

import numpy as np

from armcal._armcal import InputError


def _flat(table: Any) -> Any:
    """Fields of structures as columns, called `of/field` as in a CSV log."""
    import pyarrow as pa
    while any(pa.types.is_struct(field.type) for field in table.schema):
        names = {f"{field.name}.": f"{field.name}/" for field in table.schema
                 if pa.types.is_struct(field.type)}
        table = table.flatten()
        for begin, mended in names.items():
            table = table.rename_columns([
                mended + name[len(begin):] if name.startswith(begin) else name
                for name in table.column_names])
    return table


def _is_list(kind: Any) -> bool:
    import pyarrow as pa
    return bool(pa.types.is_list(kind) or pa.types.is_large_list(kind)
                or pa.types.is_fixed_size_list(kind))


def _numbers(column: Any) -> np.ndarray[Any, Any]:
    """Of numbers; NaN where there is none, which armcal refuses with its row."""
    return np.asarray(column.to_numpy(zero_copy_only=False)
                      if column.null_count == 0
                      else column.cast("float64").to_numpy(zero_copy_only=False))


def _rows_of_lists(column: Any) -> np.ndarray[Any, Any]:
    """(N, n) of N lists of n numbers. Raises ValueError where they differ."""
    import pyarrow.compute as pc
    lengths = pc.unique(pc.list_value_length(column)).to_pylist()
    if len(lengths) != 1 or lengths[0] is None:
        raise ValueError("lists of different lengths")
    flat = _numbers(pc.list_flatten(column))
    return flat.reshape(len(column), lengths[0])


def _array(name: str, column: Any) -> Tuple[str, np.ndarray[Any, Any]]:
    """A column as an array of an .npz. Raises ValueError with why there is
    none."""
    import pyarrow as pa
    import pyarrow.compute as pc
    column = column.combine_chunks()
    if isinstance(column, pa.ChunkedArray):
        column = (column.chunk(0) if column.num_chunks
                  else pa.array([], column.type))
    kind = column.type
    if pa.types.is_timestamp(kind):
        # With its unit, as the header of a CSV has it.
        return f"{name} [{kind.unit}]", _numbers(column.cast("int64"))
    if pa.types.is_decimal(kind):
        return name, _numbers(column.cast("float64"))
    if pa.types.is_integer(kind) or pa.types.is_floating(kind):
        return name, _numbers(column)
    if not _is_list(kind):
        raise ValueError(f"of {kind}")
    if pa.types.is_string(kind.value_type):
        # Names of joints, as a JointState has them in every message.
        texts = {tuple(row) for row in column.to_pylist()}
        if len(texts) != 1:
            raise ValueError("texts that differ from row to row")
        return name, np.array(texts.pop(), dtype=str)
    if not (pa.types.is_integer(kind.value_type)
            or pa.types.is_floating(kind.value_type)):
        raise ValueError(f"of {kind}")
    if pc.sum(pc.is_null(column)).as_py():
        raise ValueError("lists that are missing")
    return name, _rows_of_lists(column)


def _write(arrays: Dict[str, np.ndarray[Any, Any]], path: pathlib.Path) -> None:
    # numpy.savez would take a column `file` for its own argument.
    with zipfile.ZipFile(path, "w") as archive:
        for name, array in arrays.items():
            with archive.open(f"{name}.npy", "w", force_zip64=True) as file:
                np.lib.format.write_array(file, array, allow_pickle=False)


def parquet_to_npz(path: pathlib.Path, made: pathlib.Path) -> List[str]:
    """Writes the columns of numbers under their names; lists of one length
    become arrays of two dimensions."""
    try:
        import pyarrow as pa
        import pyarrow.parquet as pq
    except ImportError as error:
        raise ImportError("a Parquet file needs the package pyarrow, `pip "
                          f"install pyarrow`: {error}") from None
    try:
        table = _flat(pq.read_table(path))
    except (pa.ArrowException, OSError) as error:
        raise InputError(f"{path}: {error}") from None
    arrays: Dict[str, np.ndarray[Any, Any]] = {}
    unused = []
    for name, column in zip(table.column_names, table.columns):
        try:
            key, array = _array(name, column)
            arrays[key] = array
        except ValueError as error:
            unused.append(f"{name} ({error})")
    others = f"left out: {', '.join(unused)}"
    if table.num_rows == 0 or not any(len(a) == table.num_rows and
                                      a.dtype.kind in "fiu"
                                      for a in arrays.values()):
        raise InputError(f"{path}: found {table.num_rows} rows of "
                         f"{', '.join(table.column_names) or 'no columns'}: "
                         "expected columns of numbers; " + others)
    _write(arrays, made)
    written = f"{made}: {table.num_rows} rows of {', '.join(arrays)}"
    return [written] + ([others] if unused else [])
