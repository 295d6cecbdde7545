#!/usr/bin/env python3
"""Does MuJoCo follow a log's commands as armcal's simulation does?

  follow_in_mujoco.py --robot=robot.xml --log=log.csv

robot.xml is `armcal inspect --controller=FILE --export=mjcf`, whose actuators
are the drives; log.csv has t, q, qref. The commands are given at the model's
time steps, with the velocity of the reference and its inverse dynamics where
actuators take them. Prints a line of JSON: how far
positions are from the log's, from a second on, rms of all joints and the
largest, beside how far the log is from its commands.
"""

import argparse
import json

import mujoco
import numpy as np
from scipy.interpolate import CubicSpline

import commanded_arm as ca

POS, VEL, FF = 1, 2, 4  # mjtCtrlInput


class Follower:
    def __init__(self, path):
        self.model = mujoco.MjModel.from_xml_path(path)
        self.model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
        self.data = mujoco.MjData(self.model)
        m = self.model
        # In the order of joints; constant torques have no command.
        self.drives = [i for i in range(m.nactuator)
                       if not m.actuator(i).name.endswith("_offset")]
        self.reference = mujoco.MjModel.from_xml_path(path)
        self.reference.dof_frictionloss[:] = 0
        self.scratch = mujoco.MjData(self.reference)

    def inputs(self, i):
        """Of an actuator: which of pos, vel, ff it takes."""
        m = self.model
        if m.actuator_gaintype[i] == int(mujoco.mjtGain.mjGAIN_FIXED):
            return [POS]
        return [k for k in (POS, VEL, FF) if m.actuator_ctrlspec[i] & k]

    def feedforward(self, q, qd, qdd):
        d = self.scratch
        d.qpos[:], d.qvel[:], d.qacc[:] = q, qd, qdd
        mujoco.mj_inverse(self.reference, d)
        return d.qfrc_inverse.copy()

    def controls(self, log):
        """Rows of ctrl at the time steps."""
        m = self.model
        times = np.arange(0, log.t[-1], m.opt.timestep)
        spline = CubicSpline(log.t, log.qref)
        q, qd, qdd = (spline(times, order) for order in range(3))
        wants_ff = any(FF in self.inputs(i) for i in self.drives)
        ff = np.array([self.feedforward(*x) for x in zip(q, qd, qdd)]) \
            if wants_ff else q
        ctrl = np.zeros((len(times), m.nu))
        for joint, i in enumerate(self.drives):
            for k, kind in enumerate(self.inputs(i)):
                ctrl[:, m.actuator_ctrladr[i] + k] = {
                    POS: q, VEL: qd, FF: ff}[kind][:, joint]
        return times, ctrl

    def settle(self, log, ctrl):
        """Holds the first command, as the log did before it began."""
        m, d = self.model, self.data
        mujoco.mj_resetData(m, d)
        d.qpos[:] = log.qref[0]
        for i in self.drives:
            samples = m.actuator_history[i][0]
            if samples > 0:
                first = ctrl[0][m.actuator_ctrladr[i]:][:m.actuator_ctrlnum[i]]
                mujoco.mj_initCtrlHistory(m, d, i, None,
                                          np.tile(first, (samples, 1)))
        d.ctrl[:] = ctrl[0]
        while d.time < ca.SETTLE:
            mujoco.mj_step(m, d)

    def path(self, log):
        times, ctrl = self.controls(log)
        self.settle(log, ctrl)
        path = np.empty((len(times), self.model.nq))
        for k, u in enumerate(ctrl):
            path[k] = self.data.qpos
            self.data.ctrl[:] = u
            mujoco.mj_step(self.model, self.data)
        return times, path


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--robot", required=True)
    parser.add_argument("--log", required=True)
    flags = parser.parse_args()
    log = ca.CommandedLog(flags.log)
    follower = Follower(flags.robot)
    off = ca.difference(*follower.path(log), log)
    counts = log.t >= ca.SETTLE
    tracking = (log.qref - log.q)[counts]
    print(json.dumps({"difference_rms": ca.rms(off),
                      "difference_max": float(np.abs(off).max()),
                      "per_joint": np.sqrt(np.mean(off ** 2, 0)).round(8).tolist(),
                      "tracking_rms": ca.rms(tracking)}))


if __name__ == "__main__":
    main()
