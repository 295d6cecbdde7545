"""Logs as arrays."""

from __future__ import annotations

import os
from typing import Any, Dict, Optional, Union

import numpy as np
from numpy.typing import NDArray

from armcal import _armcal
from armcal.option_kinds import option_texts

Array = NDArray[np.float64]
# Signals of a log, with their names in an .npz.
_SIGNALS = {
    "q": "q", "qd": "qd", "qdd": "qdd", "tau": "tau", "current": "i",
    "voltage": "u", "qref": "qref", "temperature": "temp", "wrench": "wrench",
}
_AXES_OF_WRENCH = 6


class Log:
    """A recorded log: N samples of n joints in the robot's order.

    t            (N,) s, never falling
    q            (N, n) rad or m
    qd, qdd      (N, n) rad/s and rad/s^2, m/s and m/s^2
    tau          (N, n) N m or N, on the joint side
    current      (N, n) A, of the motors, instead of tau or beside that of sensors
    voltage      (N, n) V, of the motors, instead of both
    qref         (N, n) rad or m, what the controller was to follow
    temperature  (N, n) deg C
    wrench       (N, 6) N and N m, force and torque of a force-torque sensor on
                 the last link, in the sensor's axes
    simulated    says that tau is exact, as in logs of armcal simulate
    name         what reports and messages call it

    Signals that are not given are None. Arrays are copied as float64.
    """

    t: Array
    q: Array
    qd: Optional[Array]
    qdd: Optional[Array]
    tau: Optional[Array]
    current: Optional[Array]
    voltage: Optional[Array]
    qref: Optional[Array]
    temperature: Optional[Array]
    wrench: Optional[Array]
    simulated: bool
    name: str

    def __init__(self, *, t: Any, q: Any, tau: Any = None, qd: Any = None,
                 qdd: Any = None, current: Any = None, voltage: Any = None,
                 qref: Any = None, temperature: Any = None, wrench: Any = None,
                 simulated: bool = False, name: str = "log") -> None:
        if not name or set(name) & set("/,\0"):
            raise ValueError(f"name: found {name!r}, expected a text without "
                             "slashes and commas")
        self.name = name
        self.simulated = simulated
        self.t = np.array(t, dtype=float)
        if self.t.ndim != 1:
            raise ValueError(f"t: found shape {self.t.shape}, expected (N,)")
        given = {"q": q, "qd": qd, "qdd": qdd, "tau": tau, "current": current,
                 "voltage": voltage, "qref": qref, "temperature": temperature}
        joints: Union[int, str] = "n"
        for signal, values in given.items():
            array = self._columns(signal, values, joints)
            joints = joints if array is None else array.shape[1]
            setattr(self, signal, array)
        self.wrench = self._columns("wrench", wrench, _AXES_OF_WRENCH)
        if self.q is None:
            raise ValueError("q: found None, expected shape (N, n)")

    def _columns(self, signal: str, values: Any,
                 columns: Union[int, str]) -> Optional[Array]:
        """A copy of `values`, (N, columns); any number of them where it says n."""
        if values is None:
            return None
        array = np.array(values, dtype=float)
        if array.ndim != 2 or array.shape[0] != len(self.t) or (
                columns not in ("n", array.shape[1])):
            raise ValueError(f"{signal}: found shape {array.shape}, "
                             f"expected ({len(self.t)}, {columns})")
        return array

    def __len__(self) -> int:
        return len(self.t)

    def __repr__(self) -> str:
        seconds = self.t[-1] - self.t[0] if len(self) else 0.0
        return (f"<armcal.Log {self.name!r}, {len(self)} samples of "
                f"{self.q.shape[1]} joints, {seconds:.6g} s>")

    def savez(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes an .npz that read_log and the armcal binary read."""
        with open(path, "wb") as file:  # savez would add an ending
            arrays: Dict[str, Any] = dict(self._arrays())
            np.savez(file, **arrays)

    def _arrays(self) -> Dict[str, Array]:
        """By their names in an .npz."""
        arrays = {key: getattr(self, signal)
                  for signal, key in _SIGNALS.items()
                  if getattr(self, signal) is not None}
        if self.simulated:
            arrays["simulated"] = np.ones(len(self.t))
        return {"t": self.t, **arrays}


def read_log(path: Union[str, "os.PathLike[str]"], robot: _armcal.Robot, *,
             torque: bool = True, wrench: bool = False,
             **options: Any) -> Log:
    """Reads a log of any format that armcal knows, at most 2^20 rows.

    Times are since its first row; currents and voltages become torques.

    torque   False: torques may be missing, and are not read
    wrench   True: a force-torque sensor is read, if the log has one
    options  torque_kind, torque_constants, gear_ratios, topics as of calibrate
    """
    arrays = _armcal.read_log(os.fspath(path), robot, option_texts(options),
                              torque, wrench)
    signals = {signal: getattr(arrays, signal)
               for signal in ("qd", "qdd", "tau", "qref", "temperature",
                              "wrench")}
    return Log(t=arrays.t, q=arrays.q, simulated=arrays.simulated,
               name=os.path.basename(path),
               **{signal: values for signal, values in signals.items()
                  if values.size > 0})
