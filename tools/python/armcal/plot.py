"""Three figures of results, with matplotlib (Debian's python3-matplotlib)."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING, Any, Optional, Sequence

import numpy as np

from armcal.results import Calibration, Diagnosis

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def _figure(rows: int, width: float, height: float) -> Any:
    try:
        from matplotlib import pyplot
    except ImportError as error:
        raise ImportError("armcal.plot needs matplotlib: apt install "
                          "python3-matplotlib, or pip install matplotlib"
                          ) from error
    return pyplot.subplots(rows, 1, figsize=(width, height), squeeze=False,
                           sharex="col", layout="constrained")


def torques(result: Calibration, log: Any = None, *,
            joints: Optional[Sequence[str]] = None) -> "Figure":
    """Measured and predicted torque of each joint over time, and what is left,
    of one log: the first it was calibrated on, or another."""
    trace = result.torques(log)[0]
    shown = [k for k, joint in enumerate(result.joints)
             if joints is None or joint["name"] in joints]
    if not shown:
        raise ValueError(f"joints: found {joints}, expected some of "
                         f"{[joint['name'] for joint in result.joints]}")
    figure, axes = _figure(len(shown), 8, 1 + 1.6 * len(shown))
    for ax, k in zip(axes[:, 0], shown):
        joint = result.joints[k]
        measured, predicted = trace.measured[:, k], trace.predicted[:, k]
        ax.plot(trace.t, measured, color="0.6", lw=1.6, label="measured")
        ax.plot(trace.t, predicted, color="C0", lw=0.8, label="predicted")
        ax.plot(trace.t, measured - predicted, color="C3", lw=0.8,
                label="difference")
        ax.set_ylabel(f"{joint['name']}\n{joint['unit']}")
        ax.grid(alpha=0.3)
    axes[0, 0].legend(loc="upper right", ncols=3, fontsize="small")
    axes[-1, 0].set_xlabel("s")
    return figure


def parameters(result: Calibration, *, sigmas: float = 2) -> "Figure":
    """Parameters with their intervals and the robot file's value beside, each
    relative to the largest of these."""
    estimates = result.parameters if result.estimate != "linear" else (
        result.model_parameters)
    seen = np.flatnonzero(estimates.identifiable &
                          np.isfinite(estimates.stddev))
    if seen.size == 0:
        raise ValueError("no parameter is identifiable")
    prior, values = estimates.prior[seen], estimates.values[seen]
    reach = sigmas * estimates.stddev[seen]
    scale = np.maximum.reduce([np.abs(values), np.nan_to_num(np.abs(prior)),
                               reach, np.full(seen.size, 1e-300)])
    rows = np.arange(seen.size)
    figure, axes = _figure(1, 7, 1 + 0.22 * seen.size)
    ax = axes[0, 0]
    ax.errorbar(values / scale, rows, xerr=reach / scale, fmt="o", ms=3,
                color="C0", label=f"estimate, {sigmas:g} standard deviations")
    known = np.isfinite(prior)
    ax.plot((prior / scale)[known], rows[known], "x", color="0.4",
            label="robot file")
    ax.set_yticks(rows, [f"{estimates.names[k]}  {estimates.values[k]:.4g} "
                         f"{estimates.units[k]}" for k in seen],
                  fontsize="small")
    ax.invert_yaxis()
    ax.set_xlabel("relative to the largest of value, file and interval")
    ax.grid(alpha=0.3)
    ax.legend(fontsize="small")
    return figure


def gap(result: Diagnosis) -> "Figure":
    """Held-out torque residual of each joint, in percent of the robot file's:
    that, refitted, with the effects that were found, and the noise."""
    bars = {"nominal_rms": "robot file", "refit_rms": "refitted",
            "after_rms": "with the effects", "floor_rms": "noise"}
    whole = np.array([joint["nominal_rms"] for joint in result.joints],
                     dtype=float)
    names = [f"{joint['name']}\n{rms:.3g} {joint['unit']}"
             for joint, rms in zip(result.joints, whole)]
    rows = np.arange(len(names))
    figure, axes = _figure(1, 7, 1.3 + 0.7 * len(names))
    ax = axes[0, 0]
    height = 0.8 / len(bars)
    for k, (key, label) in enumerate(bars.items()):
        values = np.array([joint[key] for joint in result.joints], dtype=float)
        ax.barh(rows + (k - 1.5) * height, 100 * values / whole, height,
                label=label)
    ax.set_yticks(rows, names)
    ax.invert_yaxis()
    ax.set_xlabel("rms of the held-out torque residual, % of the robot file's")
    ax.grid(axis="x", alpha=0.3)
    ax.legend(fontsize="small")
    ax.set_title("\n".join(textwrap.wrap(result.brief_report(), 80)),
                 fontsize="medium")
    return figure
