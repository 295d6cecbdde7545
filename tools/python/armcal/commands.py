"""The commands of the armcal binary as functions. An option has the name of
the command's flag; armcal.options(command) lists them all."""

from __future__ import annotations

import os
import tempfile
from inspect import Parameter, signature
from textwrap import wrap
from typing import Any, Callable, Dict, List, Optional, Tuple, Union

from armcal import _armcal
from armcal.inputs import Inputs
from armcal.log import Log, read_log
from armcal.option_kinds import (default_of, kind_of, option_text, options_of,
                                 unit_of)
from armcal.results import (Calibration, Comparison, Diagnosis, Excitation,
                            Inspection, Merger, Reduction, Simulation,
                            Verification)

Path = Union[str, "os.PathLike[str]"]
# Two ends, s or as the option says; None: open.
Range = Union[Tuple[Optional[float], Optional[float]], List[Optional[float]]]
RobotLike = Union[_armcal.Robot, str, "os.PathLike[str]"]
LogLike = Union[Log, str, "os.PathLike[str]"]
Logs = Union[LogLike, List[LogLike], Tuple[LogLike, ...]]
Progress = Optional[Callable[[str, float], None]]

# They say what is read of the robot's file: the command line's flags under
# "chain of the robot".
_CHAIN_FLAGS = ("base", "tip", "posture", "gravity", "robot_folder")
# They say what is printed, which here is nothing.
_PRINT_FLAGS = ("json", "quiet")


def _vector(name: str, text: str) -> List[float]:
    try:
        return [float(part) for part in text.split(",")]
    except ValueError:
        raise _armcal.UsageError(f"{name}: found '{text}', expected numbers "
                                 "with commas between") from None


def _positions(text: str) -> Dict[str, float]:
    """finger=0.02,thumb=1 as a dict; a name may hold an equals sign."""
    positions = {}
    for part in text.split(",") if text else []:
        name, _, position = part.rpartition("=")
        if not name:
            raise _armcal.UsageError(f"posture: found '{part}', expected "
                                     "joint=position, as in finger=0.02")
        positions[name], = _vector("posture", position)
    return positions


def _robot(robot: RobotLike, options: Dict[str, Any]) -> _armcal.Robot:
    """The robot of a file is read as the options for its chain say. A Robot has
    been read, and would take no notice of them."""
    given = {name: option_text(name, options[name]) for name in _CHAIN_FLAGS
             if options.get(name) is not None}
    if isinstance(robot, _armcal.Robot):
        for name in given:
            raise _armcal.UsageError(f"{name}: give it to read_robot")
        return robot
    return _armcal.read_robot(
        robot, base=given.get("base", ""), tip=given.get("tip", ""),
        gravity=(_vector("gravity", given["gravity"])
                 if given.get("gravity") else None),
        robot_folder=given.get("robot_folder", ""),
        posture=_positions(given.get("posture", "")))


def _run(command: str, robot: Optional[_armcal.Robot], options: Dict[str, Any],
         progress: Progress
         ) -> Tuple[_armcal.Outcome, str, Dict[str, bytes]]:
    with Inputs(options) as inputs:
        flags = inputs.texts(options)
        if robot is not None:
            for name in ("base", "tip"):
                if getattr(robot, name):
                    flags[name] = getattr(robot, name)
            flags["robot"] = robot.source
        try:
            outcome = _armcal.run(command, flags, robot, progress,
                                  inputs.logs, write="out" in flags)
        except (_armcal.InputError, _armcal.UsageError) as error:
            raise type(error)(inputs.without_folder(str(error))) from None
        files = {name: content if name.endswith(".factor") else
                 inputs.without_folder(content.decode()).encode()
                 for name, content in outcome.files.items()}
        return outcome, inputs.without_folder(outcome.text), files


def _tracer(robot: _armcal.Robot, log: Optional[Logs],
            options: Dict[str, Any]) -> Callable[..., List[_armcal.PredictedLog]]:
    reading = {name: options.get(name)
               for name in ("torque_kind", "torque_constants",
                            "torque_constants_stddev", "gear_ratios")}

    def trace(outcome: _armcal.Outcome, found: Dict[str, Any],
              other: Optional[Logs]) -> List[_armcal.PredictedLog]:
        shown = dict(reading)
        shown["log"] = log if other is None else other
        if other is None:
            shown["crop"] = options.get("crop")
        if "drive_gains" in found:
            shown["torque_kind"] = "current"
            shown["torque_constants"] = [gain["value"]
                                         for gain in found["drive_gains"]]
            shown["gear_ratios"] = options.get("gear_ratios")
        with Inputs(shown) as inputs:
            return _armcal.trace(outcome, robot, inputs.texts(shown),
                                 found["bandwidth_hz"], inputs.logs)

    return trace


def calibrate(robot: RobotLike, log: Optional[Logs] = None, *,
              validate: Optional[Logs] = None, progress: Progress = None,
              **options: Any) -> Calibration:
    """Dynamics and geometry of an arm from logs of its joint positions and
    torques, and from measured poses.

    robot     a Robot or its file
    log       logs to calibrate on, paths or Logs; None: from poses alone
    validate  logs held out to check the result
    progress  is called with what is being done and its share, 0 to 1; below 0
              nobody knows
    """
    arm = _robot(robot, options)
    run = _run("calibrate", arm, {**options, "log": log, "validate": validate},
               progress)
    return Calibration(*run, trace=_tracer(arm, log, options))


def diagnose(robot: RobotLike, log: Logs, *, validate: Optional[Logs] = None,
             reference: Optional[Logs] = None,
             calibration: Union[Calibration, str, "os.PathLike[str]",
                                None] = None,
             progress: Progress = None, **options: Any) -> Diagnosis:
    """Where the sim-to-real gap lies, which effect causes it, and how far it
    shrinks once that effect is in the model.

    log          logs of the real machine, paths or Logs
    validate     logs held out that the figures are of
    reference    logs of the same robot from before
    calibration  a Calibration, its calibration.json or the folder of that:
                 what is still missing in the calibrated robot; robot is then
                 the one that it was made of
    """
    return Diagnosis(*_run("diagnose", _robot(robot, options),
                           {**options, "log": log, "validate": validate,
                            "reference": reference,
                            "calibration": calibration}, progress))


def verify(robot: RobotLike, log: Optional[Logs] = None, *,
           calibration: Union[Calibration, str, "os.PathLike[str]",
                              None] = None,
           progress: Progress = None, **options: Any) -> Verification:
    """A robot, or a calibration of it, against an independent engine.

    calibration  a Calibration, its calibration.json or the folder of that;
                 robot is then the one that it was made of
    """
    return Verification(*_run("verify", _robot(robot, options),
                              {**options, "log": log,
                               "calibration": calibration}, progress))


def inspect(robot: RobotLike, log: Optional[Logs] = None,
            **options: Any) -> Inspection:
    """What a robot file or a log holds, and what is wrong with it."""
    return Inspection(*_run("inspect", _robot(robot, options),
                            {**options, "log": log}, None))


def _log_of(name: str, files: Dict[str, bytes], robot: _armcal.Robot,
            torque: bool, **options: Any) -> Log:
    with tempfile.TemporaryDirectory(prefix="armcal-") as folder:
        path = os.path.join(folder, name)
        with open(path, "wb") as file:
            file.write(files[name])
        return read_log(path, robot, torque=torque, **options)


def excite(robot: RobotLike, *,
           given: Union[Logs, Calibration, None] = None,
           progress: Progress = None, **options: Any) -> Excitation:
    """A motion, or postures, that show an arm's parameters within its limits.

    given  logs or a Calibration that are there already
    """
    arm = _robot(robot, options)
    outcome, text, files = _run("excite", arm, {**options, "given": given},
                                progress)
    name = "trajectory.csv"
    return Excitation(outcome, text, files, _log_of(
        name, files, arm, False) if name in files else None)


def simulate(robot: RobotLike, *, progress: Progress = None,
             **options: Any) -> Simulation:
    """The log of a simulated robot with hidden effects, and the truth."""
    arm = _robot(robot, options)
    if options.get("list_effects"):
        raise _armcal.UsageError("list_effects is for the command line")
    outcome, text, files = _run("simulate", arm, options, progress)
    constants = options.get("torque_constants")
    return Simulation(outcome, text, files, _log_of(
        "log.csv", files, arm, True, torque_constants=constants))


def reduce(robot: RobotLike, log: Logs, *, progress: Progress = None,
           **options: Any) -> Reduction:
    """What a calibration needs of logs, as factor files.

    log  logs, paths or Logs; like, unit and date are of all of them
    """
    return Reduction(*_run("reduce", _robot(robot, options),
                           {**options, "log": log}, progress))


def merge(robot: RobotLike, factors: Any, *, progress: Progress = None,
          **options: Any) -> Merger:
    """The calibration that factor files give together, and what units of one
    robot have in common, differ in and drift by.

    factors  factor files, folders of them, or Reductions, one or a list
    """
    return Merger(*_run("merge", _robot(robot, options),
                        {**options, "factors": factors}, progress))


def compare(results: Any, *, robot: Optional[RobotLike] = None,
            log: Optional[Logs] = None, progress: Progress = None,
            **options: Any) -> Comparison:
    """Whether results of one robot agree within noise.

    results  two or more: Calibrations, Diagnoses, Verifications, their files or
             folders, or robot files
    robot    of log; what calibrations are of
    log      held out: what calibrations and robots leave of its torques
    """
    arm = None if robot is None else _robot(robot, options)
    return Comparison(*_run("compare", arm,
                            {**options, "results": results, "log": log},
                            progress))


def _sentence(option: _armcal.Option, annotation: str) -> List[str]:
    """Type, unit, meaning and default, in lines."""
    text = "str" if annotation.startswith("Literal") else annotation
    if unit_of(option):
        text += f", {unit_of(option)}"
    text += f": {option.description}"
    if option.default:
        text += f" (default {option.default})"
    return wrap(text, 75, initial_indent=f"{option.name:<20} ",
                subsequent_indent=" " * 21)


def _say_options(function: Callable[..., Any]) -> None:
    """Gives a function the signature and the sentences of its options."""
    own = signature(function)
    explicit = [p for p in own.parameters.values() if p.kind != p.VAR_KEYWORD]
    hidden = {p.name for p in explicit} | {"robot", *_PRINT_FLAGS}
    said, parameters = [], []
    for option in options_of(function.__name__):
        if option.name in hidden:
            continue
        kind, default = kind_of(option), default_of(option)
        annotation = (f"Optional[{kind.annotation}]" if default is None else
                      kind.annotation)
        parameters.append(Parameter(option.name, Parameter.KEYWORD_ONLY,
                                    default=default, annotation=annotation))
        said += _sentence(option, kind.annotation)
    function.__signature__ = own.replace(  # type: ignore[attr-defined]
        parameters=explicit + parameters)
    function.__doc__ = "\n    ".join(
        [(function.__doc__ or "").rstrip(), "", "Options:", *said, ""])


#: In the order of armcal --help.
FUNCTIONS: List[Callable[..., Any]] = [calibrate, verify, diagnose, simulate,
                                       excite, inspect, reduce, merge,
                                       compare]
for _function in FUNCTIONS:
    _say_options(_function)
