"""Robots of arrays: what a robot file says, in NumPy."""

from __future__ import annotations

import json
from typing import Any, Dict, List, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armcal import _armcal

Array = NDArray[np.float64]


def _array(name: str, values: ArrayLike, *shape: int) -> Array:
    try:
        array = np.array(values, dtype=float)
    except (TypeError, ValueError):
        raise ValueError(f"{name}: expected an array of numbers") from None
    if array.shape != shape:
        raise ValueError(f"{name}: found shape {array.shape}, expected "
                         f"{shape}")
    return array


def _finite(name: str, values: ArrayLike, *shape: int) -> Array:
    array = _array(name, values, *shape)
    if not np.isfinite(array).all():
        raise ValueError(f"{name}: expected finite numbers")
    return array


def _texts(name: str, values: Sequence[str], n: int) -> List[str]:
    if isinstance(values, str) or len(values) != n or not all(
            isinstance(value, str) for value in values):
        raise ValueError(f"{name}: found {values!r}, expected {n} texts")
    return list(values)


def _pose(name: str, X: Array) -> Dict[str, Any]:
    """As robot files in YAML have it, the rotation to the last bit."""
    if not np.array_equal(X[3], [0, 0, 0, 1]):
        raise ValueError(f"{name}: found last row {X[3].tolist()}, expected "
                         "0, 0, 0, 1")
    return {"xyz": X[:3, 3].tolist(), "rotation": X[:3, :3].ravel().tolist()}


def _poses(n: int, poses: Optional[ArrayLike], xyz: Optional[ArrayLike],
           rpy: Optional[ArrayLike]) -> List[Dict[str, Any]]:
    if poses is not None:
        if xyz is not None or rpy is not None:
            raise ValueError("poses: expected either poses or xyz and rpy")
        return [_pose(f"poses[{j}]", X)
                for j, X in enumerate(_finite("poses", poses, n, 4, 4))]
    found: List[Dict[str, Any]] = [{} for _ in range(n)]
    for key, given in (("xyz", xyz), ("rpy", rpy)):
        if given is not None:
            for pose, row in zip(found, _finite(key, given, n, 3)):
                pose[key] = row.tolist()
    return found


def _limits(n: int, given: Dict[str, Optional[ArrayLike]]
            ) -> List[Dict[str, float]]:
    """Of each joint; infinite ones are none."""
    limits: List[Dict[str, float]] = [{} for _ in range(n)]
    for name, values in given.items():
        if values is None:
            continue
        for of_joint, value in zip(limits, _array(name, values, n)):
            if np.isnan(value):
                raise ValueError(f"{name}: expected numbers")
            if np.isfinite(value):
                of_joint[name.replace("_limits", "")] = float(value)
    return limits


def _add_parents(parents: Optional[Sequence[int]],
                 links: List[Dict[str, Any]]) -> None:
    if parents is None:
        return
    if len(parents) != len(links):
        raise ValueError(f"parents: found {len(parents)} numbers, expected "
                         f"{len(links)}")
    for i, (link, parent) in enumerate(zip(links, parents)):
        if not -1 <= parent < i:
            raise ValueError(f"parents[{i}]: found {parent}, expected a link "
                             "before, from 0, or -1")
        if parent != i - 1:
            link["parent"] = "base" if parent < 0 else links[parent].get(
                "name", f"link{parent + 1}")


def from_arrays(*, joint_types: Sequence[str],
                poses: Optional[ArrayLike] = None,
                xyz: Optional[ArrayLike] = None,
                rpy: Optional[ArrayLike] = None,
                axes: Optional[ArrayLike] = None,
                inertial_parameters: Optional[ArrayLike] = None,
                lower: Optional[ArrayLike] = None,
                upper: Optional[ArrayLike] = None,
                velocity_limits: Optional[ArrayLike] = None,
                effort_limits: Optional[ArrayLike] = None,
                viscous: Optional[ArrayLike] = None,
                coulomb: Optional[ArrayLike] = None,
                armature: Optional[ArrayLike] = None,
                offset: Optional[ArrayLike] = None,
                joint_names: Optional[Sequence[str]] = None,
                link_names: Optional[Sequence[str]] = None,
                parents: Optional[Sequence[int]] = None,
                gravity: ArrayLike = (0, 0, -9.81),
                tool: Optional[ArrayLike] = None,
                name: str = "robot") -> _armcal.Robot:
    """A robot of n joints from the base outwards that is in no file.

    joint_types          n of revolute, continuous and prismatic
    poses                (n, 4, 4), m, of each joint's frame on the link it sits
                         on, at q = 0 that of the link it moves; as the origin
                         of a URDF's joint
    xyz, rpy             (n, 3), m and rad: the same as URDF writes it
    axes                 (n, 3), of the joints in their frames; None: z
    inertial_parameters  (n, 10), as of Robot; None: unknown
    lower, upper, velocity_limits, effort_limits,
    viscous, coulomb, armature, offset
                         (n,), as of Robot
    parents              n numbers: the link, from 0, that each joint sits on,
                         -1 for the base, branch by branch; None: the one before
    gravity              (3,), in the base's frame, m/s^2
    tool                 (4, 4), its pose on the last link, m
    """
    n = len(joint_types)
    types = _texts("joint_types", joint_types, n)
    links: List[Dict[str, Any]] = [
        {"joint": kind, "pose": pose} for kind, pose in
        zip(types, _poses(n, poses, xyz, rpy))]
    rows: Dict[str, Optional[ArrayLike]] = {
        "axis": axes, "inertial": inertial_parameters}
    called = {"axis": "axes", "inertial": "inertial_parameters"}
    for key, given in rows.items():
        if given is not None:
            width = 3 if key == "axis" else 10
            for link, row in zip(links, _finite(called[key], given, n, width)):
                link[key] = row.tolist()
    for key, given in {"viscous": viscous, "coulomb": coulomb,
                       "armature": armature, "offset": offset}.items():
        if given is not None:
            for link, value in zip(links, _finite(key, given, n)):
                link[key] = float(value)
    for key, texts in {"joint_name": joint_names, "name": link_names}.items():
        if texts is not None:
            for link, text in zip(links, _texts(key + "s", texts, n)):
                link[key] = text
    _add_parents(parents, links)
    limits = _limits(n, {"lower": lower, "upper": upper,
                         "velocity_limits": velocity_limits,
                         "effort_limits": effort_limits})
    for link, of_joint in zip(links, limits):
        if of_joint:
            link["limits"] = of_joint
    robot: Dict[str, Union[str, List[Any], Dict[str, Any]]] = {
        "name": name, "convention": "poses", "links": links,
        "gravity": _finite("gravity", gravity, 3).tolist()}
    if tool is not None:
        robot["tool"] = {"pose": _pose("tool", _finite("tool", tool, 4, 4))}
    # JSON is YAML; numbers are written so that they are read back the same.
    return _armcal.Robot.from_text(json.dumps(robot, indent=1), "yaml",
                                   name=name)


_armcal.Robot.from_arrays = staticmethod(from_arrays)  # type: ignore
