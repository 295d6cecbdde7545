"""An arm under position drives in MuJoCo, and a log of its commands."""

import csv
import json
import pathlib
import re

import mujoco
import numpy as np

NSAMPLE = 32  # of commands that a drive may be late by
SETTLE = 1.0  # s that do not count: the log may begin in motion


class CommandedLog:
    """t, q, qref (samples x joints, SI units) of an armcal CSV, time from 0."""

    def __init__(self, path):
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        table = np.array(rows[1:], dtype=float)
        at = {name: i for i, name in enumerate(rows[0])}
        n = sum(bool(re.fullmatch(r"qref\d+", name)) for name in rows[0])
        self.n = n
        self.t = table[:, at["t"]] - table[0, at["t"]]
        self.q = table[:, [at[f"q{j + 1}"] for j in range(n)]]
        self.qref = table[:, [at[f"qref{j + 1}"] for j in range(n)]]

    def command(self, timestep):
        """qref at a simulation's steps, on the line between samples."""
        times = np.arange(0, self.t[-1], timestep)
        return times, np.stack([np.interp(times, self.t, self.qref[:, j])
                                for j in range(self.n)], 1)


def read_gains(path):
    """kp and kd of a controller.yaml of commanded_logs.py."""
    text = pathlib.Path(path).read_text(encoding="utf-8")
    return [np.array([float(x) for x in
                      re.search(rf"^{key}: \[(.*)\]", text, re.M)[1].split(",")])
            for key in ("kp", "kd")]


def servo_spec(xml, kp, kd, timestep):
    """The robot with a position drive in place of each motor. Commands are read
    from a buffer, on the line between its samples."""
    spec = mujoco.MjSpec.from_file(str(xml))
    spec.option.timestep = timestep
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.disableflags |= (mujoco.mjtDisableBit.mjDSBL_CONTACT |
                                 mujoco.mjtDisableBit.mjDSBL_LIMIT)
    for motor, p, d in zip(spec.actuators, kp, kd):
        limit = motor.ctrlrange[1]
        motor.ctrllimited = False
        motor.forcelimited, motor.forcerange = True, [-limit, limit]
        motor.biastype = mujoco.mjtBias.mjBIAS_AFFINE
        set_gains(motor, p, d)
        motor.nsample, motor.interp, motor.delay = NSAMPLE, 1, timestep
    for joint in spec.joints:
        spec.add_sensor(name=f"position_{joint.name}", objname=joint.name,
                        type=mujoco.mjtSensor.mjSENS_JOINTPOS,
                        objtype=mujoco.mjtObj.mjOBJ_JOINT)
    return spec


def set_gains(actuator, kp, kd):
    gain, bias = np.zeros(10), np.zeros(10)
    gain[0], bias[1], bias[2] = kp, -kp, -kd
    actuator.gainprm, actuator.biasprm = gain, bias


def initial_state(model, log, bias=0):
    """At rest where the log begins, its first command given for ever."""
    data = mujoco.MjData(model)
    data.qpos[:] = log.q[0] + bias
    for i in range(model.nu):
        mujoco.mj_initCtrlHistory(model, data, i, None,
                                  np.full(NSAMPLE, log.qref[0, i]))
    spec = mujoco.mjtState.mjSTATE_FULLPHYSICS.value
    state = np.empty(mujoco.mj_stateSize(model, spec))
    mujoco.mj_getState(model, data, state, spec)
    return state


def difference(times, path, log, bias=0):
    """Simulated minus recorded positions where the log counts."""
    counts = (log.t >= SETTLE) & (log.t <= times[-1])
    at = log.t[counts]
    simulated = np.stack([np.interp(at, times, path[:, j])
                          for j in range(log.n)], 1)
    return simulated - bias - log.q[counts]


def rms(x):
    return float(np.sqrt(np.mean(np.square(x))))


def report(peer, folder, estimates, **figures):
    """One line of JSON, with how far estimates are from the hidden truth."""
    truth = json.loads((pathlib.Path(folder) / "hidden" / "truth.json")
                       .read_text(encoding="utf-8"))
    errors = {}
    for name, values in estimates.items():
        if name not in truth:
            continue
        off = np.abs(np.array(values) / np.array(truth[name]) - 1)
        errors[name] = float(np.max(off).round(4))
    rounded = {k: np.round(v, 6).tolist() for k, v in estimates.items()}
    print(json.dumps({"peer": peer, "arm": pathlib.Path(folder).name, **figures,
                      "estimates": rounded, "largest_relative_error": errors}))
