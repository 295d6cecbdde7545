#!/usr/bin/env python3
"""cma_from_commands.py FOLDER [EVALUATIONS [TIMESTEP]]: PACE's form of a fit.

An evolution strategy (CMA-ES) over armature, damping, frictionloss and encoder
bias of every joint and one delay of the commands, drives' gains being known;
the cost is the mean square of simulated minus recorded positions. FOLDER is one
of commanded_logs.py; 2000 rollouts by default, of 2 ms, one thread. PACE runs
some 4096 arms at once on a GPU; here it is MuJoCo's C by mujoco.rollout.
"""

import copy
import pathlib
import sys
import time

import cma
import mujoco
import numpy as np
from mujoco import rollout

import commanded_arm as ca

# Per joint: lowest and highest; logarithmic but for the bias.
RANGES = {"armature": (.005, 3), "damping": (.01, 20), "frictionloss": (.01, 20)}
BIAS = .05  # rad
DELAY = (.002, .03)  # s


class Fit:
    def __init__(self, folder, timestep):
        self.kp, self.kd = ca.read_gains(folder / "known_gains.yaml")
        self.model = ca.servo_spec(folder / "robot.xml", self.kp, self.kd,
                                   timestep).compile()
        self.n = self.model.nv
        self.data = mujoco.MjData(self.model)
        self.evaluations = 0

    def estimates(self, x):
        """Of coordinates from 0 to 1."""
        n, values = self.n, {}
        for k, (name, (low, high)) in enumerate(RANGES.items()):
            share = np.clip(x[k * n:(k + 1) * n], 0, 1)
            values[name] = low * (high / low) ** share
        values["bias"] = BIAS * (2 * np.clip(x[3 * n:4 * n], 0, 1) - 1)
        values["delay"] = DELAY[0] + (DELAY[1] - DELAY[0]) * np.clip(x[-1], 0, 1)
        return values

    def start(self):
        """What the robot file has."""
        m, logs = self.model, []
        for name, (low, high) in RANGES.items():
            given = np.array([getattr(m, f"dof_{name}")[j] for j in range(self.n)])
            logs.append(np.log(given / low) / np.log(high / low))
        return np.concatenate(logs + [np.full(self.n, .5), [.2]])

    def with_values(self, values):
        m = copy.copy(self.model)
        for name in RANGES:
            getattr(m, f"dof_{name}")[:] = values[name]
        m.actuator_delay[:] = values["delay"]
        return m

    def misfits(self, xs, log):
        """Mean squares, of several at once."""
        values = [self.estimates(x) for x in xs]
        models = [self.with_values(v) for v in values]
        times, command = log.command(self.model.opt.timestep)
        states = np.stack([ca.initial_state(m, log, v["bias"])
                           for m, v in zip(models, values)])
        _, sensors = rollout.rollout(models, self.data, states,
                                     np.repeat(command[None], len(xs), 0))
        self.evaluations += len(xs)
        # What a step ends with is of the time of the next.
        at = times + self.model.opt.timestep
        costs = [np.mean(np.square(ca.difference(at, path, log, v["bias"])))
                 for path, v in zip(sensors, values)]
        return [c if np.isfinite(c) else 1e6 for c in costs]


def main():
    folder = pathlib.Path(sys.argv[1])
    evaluations = int(sys.argv[2]) if len(sys.argv) > 2 else 2000
    timestep = float(sys.argv[3]) if len(sys.argv) > 3 else 2e-3
    train = ca.CommandedLog(folder / "train.csv")
    begin = time.process_time()
    fit = Fit(folder, timestep)
    strategy = cma.CMAEvolutionStrategy(
        fit.start(), .15, {"bounds": [0, 1], "seed": 1, "maxfevals": evaluations,
                           "verbose": -9, "tolfun": 1e-14, "tolfunhist": 1e-14})
    while not strategy.stop():
        xs = strategy.ask()
        strategy.tell(xs, [1e8 * c for c in fit.misfits(xs, train)])
    seconds = time.process_time() - begin
    x = strategy.result.xbest
    held_out = ca.CommandedLog(folder / "held_out.csv")
    count = fit.evaluations
    root = lambda y, log: float(np.sqrt(fit.misfits([y], log)[0]))
    ca.report("CMA-ES (PACE's form)", folder, fit.estimates(x),
              held_out_rms=root(x, held_out),
              held_out_rms_before=root(fit.start(), held_out),
              train_rms=root(x, train), cpu_s=seconds, rollouts=count,
              stopped=",".join(strategy.stop()))


if __name__ == "__main__":
    main()
