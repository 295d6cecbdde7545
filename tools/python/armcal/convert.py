"""Converts logs that armcal does not read itself into logs that it reads.

    python3 -m armcal.convert log.bag my_bag          # ROS 1: a bag of ROS 2
    python3 -m armcal.convert log.parquet log.npz     # Parquet: an .npz

What a file is, its first bytes tell, not its name. Needed are the packages that
read it: `pip install rosbags` for ROS 1, `pip install pyarrow` for Parquet.
"""

from __future__ import annotations

import argparse
import os
import pathlib
import sys
from typing import List, Optional, Union

from armcal._armcal import InputError

Path = Union[str, "os.PathLike[str]"]


def convert(source: Path, destination: Path) -> List[str]:
    """Writes the log `source` as `destination`, which must not be there yet.

    A bag of ROS 1 becomes a folder, a bag of ROS 2, so that topics are chosen
    and joined by armcal's own reader of bags; Parquet an .npz. Returns
    sentences: what was written, and what was left out. Raises InputError for
    what cannot be used, ImportError where the package that reads it is missing.
    """
    path, made = pathlib.Path(source), pathlib.Path(destination)
    try:
        with open(path, "rb") as file:
            first = file.read(8)
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    if first[:7] != b"#ROSBAG" and first[:4] != b"PAR1":
        raise InputError(f"{path}: expected a bag of ROS 1 or a Parquet file; "
                         "other formats need no conversion (docs/logs.md)")
    if made.exists():
        raise InputError(f"{made}: is there already")
    if first[:4] == b"PAR1":
        from armcal.convert_parquet import parquet_to_npz
        return parquet_to_npz(path, made)
    from armcal.convert_bag import ros1_to_ros2
    return ros1_to_ros2(path, made)


def main(arguments: Optional[List[str]] = None) -> int:
    """Exit codes are the command line's: 0, 2 wrong usage, 3 bad input."""
    parser = argparse.ArgumentParser(
        prog="python3 -m armcal.convert", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source", help="log.bag or log.parquet")
    parser.add_argument("destination", help="folder, or log.npz")
    given = parser.parse_args(arguments)
    try:
        for sentence in convert(given.source, given.destination):
            print(sentence)
    except (InputError, ImportError) as error:
        print(f"armcal.convert: {error}", file=sys.stderr)
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main())
