"""A log of write_log.py, how long its calibration takes, stage by stage, and
how well a prediction meets it."""

import time

import numpy as np


class Stages:
    """CPU seconds of stages that follow each other, as "<name>/<stage>_s"."""

    def __init__(self, name, values):
        self.name, self.values = name, values
        self.begin = self.start = time.process_time()

    def took(self, stage):
        now = time.process_time()
        self.values[f"{self.name}/{stage}_s"] = now - self.start
        self.values[f"{self.name}/total_s"] = now - self.begin
        self.start = now


def split(table):
    """t, q, qd, qdd, tau of the columns t, q1.., qd1.., qdd1.., tau1.."""
    return table[:, 0], *np.split(table[:, 1:], 4, axis=1)


def relative_residual(tau, predicted):
    """Root of the summed squares of all joints, relative to the torque's."""
    return float(np.linalg.norm(tau - predicted) / np.linalg.norm(tau))
