"""What commands return."""

from __future__ import annotations

import csv
import io
import json
import os
from dataclasses import dataclass
from typing import Any, Callable, Dict, List, Mapping, Optional, Set, Union

import numpy as np
from numpy.typing import NDArray

from armcal import _armcal
from armcal.html import Table, page
from armcal.log import Array, Log

Path = Union[str, "os.PathLike[str]"]


class Result:
    """What a command found: the content of its result files, and what it would
    print."""

    #: The file that to_dict() is.
    json_name = ""

    def __init__(self, outcome: _armcal.Outcome, text: str,
                 files: Mapping[str, bytes]) -> None:
        self._outcome = outcome
        self._text = text
        #: Result files by name.
        self.files: Dict[str, bytes] = dict(files)

    def to_dict(self) -> Dict[str, Any]:
        """The result file of the command line, such as calibration.json."""
        found = json.loads(self.files[self.json_name])
        assert isinstance(found, dict)
        return found

    def report(self) -> str:
        """What the command line prints."""
        return self._text

    @property
    def passed(self) -> bool:
        """Whether the command line would exit with 0; with 1 it ran, but the
        verdict is negative."""
        return self._outcome.code == 0

    def write(self, folder: Path) -> None:
        """Writes the result files as the command line's --out does: all of
        `files`, report.html too where the command has one. Of a folder of its
        own ("samples/robot_1.urdf") what begins alike and is not written again
        goes."""
        os.makedirs(folder, exist_ok=True)
        for name, content in self.files.items():
            temporary = os.path.join(folder, f"{name}.tmp{os.getpid()}")
            os.makedirs(os.path.dirname(temporary), exist_ok=True)
            with open(temporary, "wb") as file:
                file.write(content)
            os.replace(temporary, os.path.join(folder, name))
        for older in _older(os.fspath(folder), self.files):
            os.remove(older)

    def __repr__(self) -> str:
        return f"<armcal.{type(self).__name__}: {self._first_line()}>"

    def _repr_html_(self) -> str:
        """What a notebook shows: the verdict and the result's main figures."""
        return page(f"armcal {type(self).__name__.lower()}", self.passed,
                    self._first_line(), self._tables(), self.report())

    def _tables(self) -> List[Table]:
        return []

    def _first_line(self) -> str:
        text = self._outcome.brief or self._text
        return text.strip().split("\n", maxsplit=1)[0]


def _older(folder: str, written: Mapping[str, bytes]) -> List[str]:
    """Files of the series that were written in folders of their own, such as
    robot_1.urdf, robot_2.urdf .. in samples/, but now are not."""
    series: Dict[str, Set[str]] = {}
    for name in written:
        inner, last = os.path.split(name)
        if inner and "_" in last:
            series.setdefault(inner, set()).add(last.split("_")[0] + "_")
    return [os.path.join(folder, inner, name)
            for inner, beginnings in series.items()
            for name in os.listdir(os.path.join(folder, inner))
            if name.startswith(tuple(beginnings))
            and os.path.isfile(os.path.join(folder, inner, name))
            and f"{inner}/{name}" not in written]


@dataclass(frozen=True)
class Estimates:
    """Estimated parameters; arrays have an entry per parameter.

    stddev is infinite where the data do not determine a parameter; prior is
    the robot file's value, NaN where it has none; covariance is NaN where one
    of two parameters is not identifiable, and None where it was not asked for.
    """

    names: List[str]
    units: List[str]
    values: Array
    stddev: Array
    prior: Array
    identifiable: NDArray[np.bool_]
    covariance: Optional[Array] = None

    def __len__(self) -> int:
        return len(self.names)

    def __getitem__(self, name: str) -> float:
        """The value of a parameter, by its name."""
        return float(self.values[self.names.index(name)])

    def _table(self, caption: str) -> Table:
        rows = zip(self.names, self.values.tolist(), self.stddev.tolist(),
                   self.prior.tolist(), self.units)
        return Table(caption, ("", "value", "std. deviation", "robot file",
                               "unit"), list(rows))

    def _repr_html_(self) -> str:
        return page("armcal estimates", True, f"{len(self)} parameters",
                    [self._table("parameters")])


def _joint_table(joints: List[Dict[str, Any]],
                 columns: Dict[str, str]) -> Table:
    """A row per joint, of those `columns` {key: heading} that any joint has."""
    known = {key: heading for key, heading in columns.items()
             if any(joint.get(key) is not None for joint in joints)}
    return Table("joints", ("", *known.values(), "unit"),
                 [(joint["name"], *(joint.get(key) for key in known),
                   joint.get("unit")) for joint in joints])


def _numbers(entries: List[Dict[str, Any]], key: str,
             missing: float) -> Array:
    values = [entry.get(key) for entry in entries]
    return np.array([missing if value is None else value for value in values],
                    dtype=float)


def _estimates(entries: List[Dict[str, Any]],
               covariance: Optional[Array] = None) -> Estimates:
    return Estimates(
        names=[entry["name"] for entry in entries],
        units=[entry["unit"] for entry in entries],
        values=_numbers(entries, "value", np.nan),
        stddev=_numbers(entries, "stddev", np.inf),
        prior=_numbers(entries, "prior", np.nan),
        identifiable=np.array([entry.get("identifiable", True)
                               for entry in entries], dtype=bool),
        covariance=covariance)


def _matrix(content: Optional[bytes]) -> Optional[Array]:
    """Of a CSV whose first row are names; NaN where a field is empty."""
    if content is None:
        return None
    rows = list(csv.reader(io.StringIO(content.decode())))[1:]
    matrix = np.array([[float(field) if field else np.nan for field in row]
                       for row in rows])
    return matrix if matrix.ndim == 2 else None


class Calibration(Result):
    """What calibrate found; to_dict() is calibration.json (docs/calibrate.md).

    robot      the calibrated robot; None where none was estimated
    estimate   "refined", "linear", or "poses" for a geometry from poses alone
    """

    json_name = "calibration.json"

    def __init__(self, outcome: _armcal.Outcome, text: str,
                 files: Mapping[str, bytes],
                 trace: Callable[..., List[_armcal.PredictedLog]]) -> None:
        super().__init__(outcome, text, files)
        self._trace = trace
        self._dict = self.to_dict()
        self.robot: Optional[_armcal.Robot] = outcome.robot
        self.estimate: str = self._dict.get("estimate", "poses")

    def brief_report(self) -> str:
        """One sentence: how good, on what, whether anything stayed unseen."""
        return self._outcome.brief or self._first_line()

    @property
    def converged(self) -> bool:
        return bool(self._dict.get("termination", {}).get("converged", False))

    @property
    def parameters(self) -> Estimates:
        """Physical parameters: link inertias, friction, geometry."""
        return _estimates(
            self._dict.get("parameters", self._dict.get("geometry", [])),
            _matrix(self.files.get("parameters_covariance.csv")))

    @property
    def model_parameters(self) -> Estimates:
        """The parameters that torques are linear in."""
        return _estimates(self._dict.get("model_parameters", []),
                          _matrix(self.files.get("covariance.csv")))

    @property
    def _main(self) -> Estimates:
        linear = self.estimate == "linear"
        return self.model_parameters if linear else self.parameters

    # Of what `estimate` names: parameters, of a linear one model_parameters.
    @property
    def names(self) -> List[str]:
        return self._main.names

    @property
    def units(self) -> List[str]:
        return self._main.units

    @property
    def values(self) -> Array:
        return self._main.values

    @property
    def stddev(self) -> Array:
        return self._main.stddev

    @property
    def identifiable(self) -> NDArray[np.bool_]:
        return self._main.identifiable

    @property
    def covariance(self) -> Optional[Array]:
        return self._main.covariance

    @property
    def joints(self) -> List[Dict[str, Any]]:
        """Per joint: name, unit, torque_rms, residual_rms, residual_percent,
        validation_residual_rms, ... (docs/calibrate.md)."""
        joints: List[Dict[str, Any]] = self._dict.get("joints", [])
        return joints

    def _tables(self) -> List[Table]:
        columns = {"torque_rms": "torque, rms", "residual_rms": "residual, rms",
                   "residual_percent": "%",
                   "validation_residual_rms": "held out, rms",
                   "validation_residual_percent": "held out, %"}
        estimates = self._main
        return [_joint_table(self.joints, columns),
                estimates._table("parameters")]

    def torques(self, log: Any = None) -> List[_armcal.PredictedLog]:
        """Measured and predicted torques of the logs it was calibrated on, or
        of others, low-passed at four times its bandwidth as report.html draws
        them (its residual figures are low-passed at the bandwidth itself)."""
        return self._trace(self._outcome, self._dict, log)


class Diagnosis(Result):
    """What diagnose found; to_dict() is diagnosis.json (docs/diagnose.md)."""

    json_name = "diagnosis.json"

    def __init__(self, outcome: _armcal.Outcome, text: str,
                 files: Mapping[str, bytes]) -> None:
        super().__init__(outcome, text, files)
        self._dict = self.to_dict()
        #: The fitted robot with the effects that a rigid one can have.
        self.robot: Optional[_armcal.Robot] = outcome.robot

    def brief_report(self) -> str:
        """One sentence: what the gap comes from."""
        return self._outcome.brief

    @property
    def verdict(self) -> str:
        """noise_floor, absorbed, explained, partly_explained, unknown or
        not_testable."""
        verdict: str = self._dict["verdict"]
        return verdict

    @property
    def effects(self) -> List[Dict[str, Any]]:
        """The strongest first: effect, joint, probability, estimates, ..."""
        effects: List[Dict[str, Any]] = self._dict["effects"]
        return effects

    @property
    def gap(self) -> Dict[str, Any]:
        """torque and forward: nominal, refit, after, floor, ..."""
        gap: Dict[str, Any] = self._dict["gap"]
        return gap

    @property
    def joints(self) -> List[Dict[str, Any]]:
        """Per joint: nominal_rms, refit_rms, after_rms, floor_rms, ..."""
        joints: List[Dict[str, Any]] = self._dict["where"]["joints"]
        return joints

    def _tables(self) -> List[Table]:
        effects = [(effect["effect"], effect.get("joint"),
                    effect.get("probability")) for effect in self.effects]
        columns = {"nominal_rms": "robot file, rms", "refit_rms": "refitted",
                   "after_rms": "with the effects", "floor_rms": "noise"}
        return [Table("effects", ("", "joint", "probability"), effects),
                _joint_table(self.joints, columns)]


class Verification(Result):
    """What verify found; to_dict() is verification.json (docs/verify.md)."""

    json_name = "verification.json"


class Inspection(Result):
    """What inspect found; to_dict() is inspect.json (docs/inspect.md)."""

    json_name = "inspect.json"


class Excitation(Result):
    """What excite designed; to_dict() is excite.json (docs/excite.md).

    trajectory  t, q, qd, qdd to follow; None for postures, or without one
    """

    json_name = "excite.json"

    def __init__(self, outcome: _armcal.Outcome, text: str,
                 files: Mapping[str, bytes],
                 trajectory: Optional[Log]) -> None:
        super().__init__(outcome, text, files)
        self.trajectory = trajectory


class Simulation(Result):
    """A simulated log; to_dict() is truth.json (docs/simulate.md)."""

    json_name = "truth.json"

    def __init__(self, outcome: _armcal.Outcome, text: str,
                 files: Mapping[str, bytes], log: Log) -> None:
        super().__init__(outcome, text, files)
        self.log = log


class Reduction(Result):
    """What reduce made: `files` are factor files, by name. to_dict() is what
    the first of them says of its model and log."""

    def to_dict(self) -> Dict[str, Any]:
        content = next(iter(self.files.values()))
        begin = content.index(b"\n") + 1
        size = int.from_bytes(content[begin:begin + 8], "little")
        found = json.loads(content[begin + 8:begin + 8 + size])
        assert isinstance(found, dict)
        return found


class Comparison(Result):
    """What compare found; to_dict() is comparison.json (docs/compare.md)."""

    json_name = "comparison.json"

    @property
    def disagreements(self) -> List[str]:
        """Sentences; none where all results agree within noise."""
        return [sentence for pair in self.to_dict()["pairs"]
                for sentence in pair["disagreements"]]


class Merger(Result):
    """What merge found; to_dict() is calibration.json (docs/merge.md)."""

    json_name = "calibration.json"

    @property
    def model_parameters(self) -> Estimates:
        """Of all logs as if they were of one robot."""
        return _estimates(self.to_dict()["model_parameters"],
                          _matrix(self.files.get("covariance.csv")))

    def _tables(self) -> List[Table]:
        return [self.model_parameters._table("model parameters")]

    @property
    def fleet(self) -> Optional[Dict[str, Any]]:
        """fleet.json; None without units."""
        content = self.files.get("fleet.json")
        if content is None:
            return None
        found = json.loads(content)
        assert isinstance(found, dict)
        return found
