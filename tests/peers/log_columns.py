"""A log of write_log.py, and how well a prediction meets it."""

import numpy as np


def split(table):
    """t, q, qd, qdd, tau of the columns t, q1.., qd1.., qdd1.., tau1.."""
    return table[:, 0], *np.split(table[:, 1:], 4, axis=1)


def relative_residual(tau, predicted):
    """Root of the summed squares of all joints, relative to the torque's."""
    return float(np.linalg.norm(tau - predicted) / np.linalg.norm(tau))
