"""Many logs of many units reduced by the workers of a Dask cluster, and merged
here. The factor files are the same whichever worker made them, and merging puts
them in the order of their logs' hashes: so is the result."""

from __future__ import annotations

import csv
import os
from dataclasses import dataclass
from typing import Any, Callable, Dict, Iterable, List, Optional, Tuple

from armcal import _armcal
from armcal.commands import RobotLike, merge, reduce
from armcal.results import Merger

#: Called with how many logs of how many are done.
Done = Optional[Callable[[int, int], None]]


@dataclass(frozen=True)
class Recording:
    """A log and what it does not say itself."""

    log: str
    unit: str = ""
    date: str = ""  # 2026-11-21 or 2026-11-21T10:30, UTC


def read_table(path: str) -> List[Recording]:
    """A CSV with the columns log, unit and date, in any order; logs are
    relative to its folder."""
    folder = os.path.dirname(os.path.abspath(path))
    with open(path, newline="", encoding="utf-8") as file:
        rows = csv.DictReader(file)
        if "log" not in (rows.fieldnames or []):
            raise ValueError(f"{path}: found columns {rows.fieldnames}, "
                             "expected log, and unit and date where known")
        return [Recording(os.path.join(folder, row["log"]),
                          row.get("unit") or "", row.get("date") or "")
                for row in rows]


#: path, source, text (of a robot in no file), base and tip.
Place = Tuple[str, str, str, str, str]


def _place_of(robot: _armcal.Robot) -> Place:
    if robot.path:
        return (os.path.abspath(robot.path), "", "", robot.base, robot.tip)
    return ("", robot.source, robot.text, robot.base, robot.tip)


def _robot_of(place: Place) -> _armcal.Robot:
    path, source, text, base, tip = place
    if path:
        return _armcal.read_robot(path, base, tip)
    name, format = source.rsplit(".", 1)
    return _armcal.Robot.from_text(text, format, name=name, base=base, tip=tip)


def reduce_one(place: Place, recording: Recording, like: bytes,
               options: Dict[str, Any]) -> Tuple[str, bytes, str]:
    """On a worker: the name and the bytes of a factor file, or why there is
    none. A log that is refused is so wherever it is tried."""
    import tempfile
    given = {**options, "unit": recording.unit or None,
             "date": recording.date or None}
    if "threads" in _armcal.options("reduce"):
        given.setdefault("threads", 1)  # workers are as many as cores
    try:
        with tempfile.TemporaryDirectory(prefix="armcal-") as folder:
            if like:
                given["like"] = os.path.join(folder, "like.factor")
                with open(given["like"], "wb") as file:
                    file.write(like)
            made = reduce(_robot_of(place), recording.log, **given)
    except ValueError as error:  # InputError, UsageError
        return "", b"", str(error)
    (name, content), = made.files.items()
    return name, content, ""


def _write(folder: str, name: str, content: bytes) -> str:
    path = os.path.join(folder, name)
    with open(path + ".part", "wb") as file:
        file.write(content)
    os.replace(path + ".part", path)
    return path


def reduce_logs(client: Any, robot: RobotLike, recordings: Iterable[Recording],
                folder: str, *, like: Optional[str] = None, done: Done = None,
                **options: Any) -> Tuple[List[str], Dict[str, str]]:
    """Reduces logs on the workers of a distributed.Client and writes the factor
    files to `folder`, each as it comes. Workers need armcal and the paths.

    like     a factor file that says how; None: the first log (by name) does,
             as `options` of reduce leave it open
    returns  the factor files, and {log: why it was refused}
    """
    from distributed import as_completed
    arm = robot if isinstance(robot, _armcal.Robot) else _armcal.read_robot(
        robot)
    place = _place_of(arm)
    todo = sorted(recordings, key=lambda recording: recording.log)
    os.makedirs(folder, exist_ok=True)
    model = b""
    reading = {name: value for name, value in options.items() if name in (
        "torque_kind", "torque_constants", "torque_constants_stddev", "gear_ratios",
        "topics", "crop")}
    files: List[str] = []
    refused: Dict[str, str] = {}
    if like is not None:
        with open(like, "rb") as file:
            model = file.read()
    while not model and todo:
        first = todo.pop(0)
        name, model, why = client.submit(reduce_one, place, first, b"",
                                         options, retries=3).result()
        if why:
            refused[first.log] = why
        else:
            files.append(_write(folder, name, model))
    futures = {client.submit(reduce_one, place, recording, model, reading,
                             retries=3): recording for recording in todo}
    total = len(files) + len(refused) + len(todo)
    for future in as_completed(list(futures)):
        name, content, why = future.result()
        if why:
            refused[futures[future].log] = why
        else:
            files.append(_write(folder, name, content))
        if done is not None:
            done(len(files) + len(refused), total)
    return sorted(files), refused


def calibrate_fleet(client: Any, robot: RobotLike,
                    recordings: Iterable[Recording], folder: str, *,
                    like: Optional[str] = None, done: Done = None,
                    **options: Any) -> Tuple[Merger, Dict[str, str]]:
    """reduce_logs into folder/factors, and merge of what it made, written to
    `folder`; with {log: why it was refused}."""
    files, refused = reduce_logs(client, robot, recordings,
                                 os.path.join(folder, "factors"), like=like,
                                 done=done, **options)
    if not files:
        raise _armcal.InputError("no log could be reduced: " +
                                 "; ".join(refused.values()))
    return merge(robot, files, out=folder), refused
