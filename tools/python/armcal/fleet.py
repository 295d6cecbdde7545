"""Many logs of many units reduced by the workers of a Dask cluster, and merged
here. The factor files are the same whichever worker made them, and merging puts
them in the order of their logs' hashes: so is the result."""

from __future__ import annotations

import csv
import itertools
import os
from dataclasses import dataclass
from typing import (Any, Callable, Dict, Iterable, Iterator, List, Optional,
                    Tuple)

from armcal import _armcal
from armcal.commands import RobotLike, merge, reduce
from armcal.fleet_manifest import Manifest, digest, recipe
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


#: How a worker reads a robot again: base, tip, gravity, posture and, of a file,
#: robot_folder.
Chain = Dict[str, Any]
#: path, source, text (of a robot in no file), and its chain.
Place = Tuple[str, str, str, Chain]
#: Name and bytes of a factor file; why there is none.
Reduced = Tuple[str, bytes, str]
#: Options of reduce that say how a log is read, which another factor does not.
READING = ("torque_kind", "torque_constants", "torque_constants_stddev",
           "gear_ratios", "topics", "crop")


def _place_of(robot: _armcal.Robot) -> Place:
    chain: Chain = {"base": robot.base, "tip": robot.tip,
                    "gravity": [float(g) for g in robot.gravity],
                    "posture": dict(robot.posture)}
    if not robot.path:
        return ("", robot.source, robot.text, chain)
    if robot.robot_folder:
        chain["robot_folder"] = os.path.abspath(robot.robot_folder)
    return (os.path.abspath(robot.path), "", "", chain)


def _robot_of(place: Place) -> _armcal.Robot:
    path, source, text, chain = place
    if path:
        return _armcal.read_robot(path, **chain)
    name, format = source.rsplit(".", 1)
    return _armcal.Robot.from_text(text, format, name=name, **chain)


def _text_of(place: Place) -> bytes:
    path, _, text, _ = place
    if not path:
        return text.encode()
    with open(path, "rb") as file:
        return file.read()


def reduce_one(robot: _armcal.Robot, recording: Recording, like: bytes,
               options: Dict[str, Any]) -> Reduced:
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
            made = reduce(robot, recording.log, **given)
    except ValueError as error:  # InputError, UsageError
        return "", b"", str(error)
    (name, content), = made.files.items()
    return name, content, ""


def reduce_some(place: Place, recordings: List[Recording], like: bytes,
                options: Dict[str, Any]) -> List[Reduced]:
    """On a worker: each log's factor file, or why there is none. A log that is
    refused is so wherever it is tried."""
    robot = _robot_of(place)
    return [reduce_one(robot, recording, like, options)
            for recording in recordings]


def _in_tasks(todo: List[Recording], workers: int) -> List[List[Recording]]:
    """A scheduler spends some milliseconds on a task, a quarter of what a log
    of a minute takes to reduce: a task has several logs, as many as leave each
    worker 32 tasks, so that all end at nearly the same time."""
    size = max(1, len(todo) // (32 * workers))
    return [todo[k:k + size] for k in range(0, len(todo), size)]


def _results(client: Any, place: Place, todo: List[Recording], like: bytes,
             options: Dict[str, Any]) -> Iterator[Tuple[Recording, Reduced]]:
    """Of each log, as they come. A task is given up when the workers that had
    it died again and again; its logs are then tried one by one, nothing else
    being tried meanwhile, and which is still given up is refused: Dask blames
    all tasks of a worker for its death. So that few are, a worker has two at a
    time; workers may come and go."""
    from distributed import KilledWorker, as_completed

    def workers() -> int:
        return max(1, len(client.scheduler_info()["workers"]))

    def submit(recordings: List[Recording]) -> Any:
        return client.submit(reduce_some, place, recordings, like, options,
                             retries=3, pure=False)

    def fill() -> None:
        for task in itertools.islice(waiting,
                                     max(0, 2 * workers() - len(running))):
            future = submit(task)
            running[future] = task
            done.add(future)

    waiting = iter(_in_tasks(todo, workers()))
    running: Dict[Any, List[Recording]] = {}
    suspects: List[Recording] = []
    done = as_completed()
    fill()
    for future in done:
        recordings = running.pop(future)
        fill()
        try:
            yield from zip(recordings, future.result())
        except KilledWorker:
            suspects += recordings
    for suspect in suspects:
        try:
            yield suspect, submit([suspect]).result()[0]
        except KilledWorker:
            yield suspect, ("", b"", f"{suspect.log}: each worker that tried "
                                     "to reduce it died")


class _Folder:
    """Factor files as they come to a folder, and what is told of it."""

    def __init__(self, path: str, place: Place, total: int, done: Done) -> None:
        os.makedirs(path, exist_ok=True)
        self.files: List[str] = []
        self.refused: Dict[str, str] = {}
        self._manifest = Manifest(path)
        self._robot = (digest(_text_of(place)), place[3:])
        self._total = total
        self._done = done

    def _recipe(self, recording: Recording, like: bytes,
                options: Dict[str, Any]) -> str:
        return recipe(_armcal.__sources__, self._robot, recording.unit,
                      recording.date, digest(like), options)

    def take_over(self, recording: Recording, like: bytes,
                  options: Dict[str, Any]) -> Optional[str]:
        """The path of what an earlier run made of a log; None: nothing."""
        path = self._manifest.find(recording.log,
                                   self._recipe(recording, like, options))
        if path:
            self.files.append(path)
            self._tell()
        return path

    def add(self, recording: Recording, reduced: Reduced, like: bytes,
            options: Dict[str, Any]) -> None:
        name, content, why = reduced
        if why:
            self.refused[recording.log] = why
            self._manifest.refuse(recording.log, why)
        else:
            self.files.append(self._manifest.add(
                recording.log, self._recipe(recording, like, options), name,
                content))
        self._tell()

    def _tell(self) -> None:
        if self._done is not None:
            self._done(len(self.files) + len(self.refused), self._total)


def _first_factor(client: Any, place: Place, todo: List[Recording],
                  options: Dict[str, Any], folder: _Folder) -> bytes:
    """Of the first log that is not refused, which says how the others are
    reduced. These logs are taken from `todo`."""
    while todo:
        first = todo.pop(0)
        path = folder.take_over(first, b"", options)
        if path:
            with open(path, "rb") as file:
                return file.read()
        reduced, = client.submit(reduce_some, place, [first], b"", options,
                                 retries=3, pure=False).result()
        folder.add(first, reduced, b"", options)
        if reduced[1]:
            return reduced[1]
    return b""


def reduce_logs(client: Any, robot: RobotLike, recordings: Iterable[Recording],
                folder: str, *, like: Optional[str] = None, done: Done = None,
                **options: Any) -> Tuple[List[str], Dict[str, str]]:
    """Reduces logs on the workers of a distributed.Client and writes the factor
    files to `folder`, each as it comes. Workers need armcal and the paths. What
    an earlier run made in this folder is taken over where log, robot and
    settings are the same (fleet_manifest.py).

    like     a factor file that says how; None: the first log (by name) does,
             as `options` of reduce leave it open
    returns  the factor files, and {log: why it was refused}
    """
    arm = robot if isinstance(robot, _armcal.Robot) else _armcal.read_robot(
        robot)
    place = _place_of(arm)
    todo = sorted(recordings, key=lambda recording: recording.log)
    made = _Folder(folder, place, len(todo), done)
    if like is not None:
        with open(like, "rb") as file:
            model = file.read()
    else:
        model = _first_factor(client, place, todo, options, made)
    reading = {name: value for name, value in options.items()
               if name in READING}
    todo = [recording for recording in todo
            if not made.take_over(recording, model, reading)]
    for recording, reduced in _results(client, place, todo, model, reading):
        made.add(recording, reduced, model, reading)
    return sorted(made.files), made.refused


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
