#!/usr/bin/env python3
"""sysid_from_commands.py FOLDER [ITERATIONS [TIMESTEP]]: MuJoCo's sysid.

Fits armature, damping, frictionloss and the drive's two gains of every joint
and one delay of the commands, all of which start from the files of a FOLDER of
commanded_logs.py, by sysid's least squares with finite differences (its default
optimizer; 30 iterations at most, steps of 2 ms, one thread). Its own initial
states have commands of 0 in the buffer of the delay, so these are made here.
"""

import logging
import pathlib
import sys
import time

import absl.logging
import mujoco
import numpy as np
from mujoco import rollout, sysid

import commanded_arm as ca
from mujoco_sysid import set_term

absl.logging.set_verbosity(logging.ERROR)

TERMS = {"armature": (.005, 3.), "damping": (.01, 20.), "frictionloss": (.01, 20.)}
DELAY = (.002, .03)  # s


def set_gain(spec, name, which, value):
    motor = spec.actuator(name)
    kp, kd = motor.gainprm[0], -motor.biasprm[2]
    ca.set_gains(motor, *((value, kd) if which == "kp" else (kp, value)))


def set_delay(spec, value):
    for motor in spec.actuators:
        motor.delay = value


def make_parameters(spec, kp, kd):
    """All but the delay by their share of the start; sysid's steps are in the
    parameters' units."""
    parameters = sysid.ParameterDict()

    def add(name, value, low, high, modifier):
        parameters.add(sysid.Parameter(
            name, nominal=1., min_value=low / value, max_value=high / value,
            modifier=lambda s, p: modifier(s, value * p.value[0])))

    for j, joint in enumerate(spec.joints):
        for term, (low, high) in TERMS.items():
            value = float(np.atleast_1d(getattr(joint, term))[0])
            add(f"{term}_{j}", value, low, high,
                lambda s, x, n=joint.name, t=term: set_term(s.joint(n), t, x))
        motor = spec.actuators[j].name
        for which, value in (("kp", kp[j]), ("kd", kd[j])):
            add(f"{which}_{j}", value, value / 3, 3 * value,
                lambda s, x, n=motor, w=which: set_gain(s, n, w, x))
    add("delay", .008, *DELAY, set_delay)
    return parameters


def estimates_of(parameters, spec, kp, kd):
    values = {name: float(np.atleast_1d(p.value)[0])
              for name, p in parameters.parameters.items()}
    result = {}
    for term in TERMS:
        result[term] = [values[f"{term}_{j}"] *
                        float(np.atleast_1d(getattr(joint, term))[0])
                        for j, joint in enumerate(spec.joints)]
    result["kp"] = [values[f"kp_{j}"] * kp[j] for j in range(len(kp))]
    result["kd"] = [values[f"kd_{j}"] * kd[j] for j in range(len(kd))]
    result["delay"] = values["delay"] * .008
    return result


def replay_rms(model, log):
    times, command = log.command(model.opt.timestep)
    _, sensors = rollout.rollout(model, mujoco.MjData(model),
                                 ca.initial_state(model, log), command)
    return ca.rms(ca.difference(times + model.opt.timestep, sensors[0], log))


def main():
    folder = pathlib.Path(sys.argv[1])
    iterations = int(sys.argv[2]) if len(sys.argv) > 2 else 30
    timestep = float(sys.argv[3]) if len(sys.argv) > 3 else 2e-3
    kp, kd = ca.read_gains(folder / "controller.yaml")
    make_spec = lambda: ca.servo_spec(folder / "robot.xml", kp, kd, timestep)
    spec = make_spec()
    train = ca.CommandedLog(folder / "train.csv")
    begin = time.process_time()
    model = spec.compile()
    times, command = train.command(timestep)
    measured = sysid.TimeSeries.from_names(
        times, np.stack([np.interp(times, train.t, train.q[:, j])
                         for j in range(train.n)], 1), model)
    counter = {"rollouts": 0}

    def modify(params, predicted, measured, model, return_all, state=None):
        counter["rollouts"] += 1
        late = predicted.times >= ca.SETTLE
        both = predicted.times[late]
        kept = predicted.resample(both), measured.resample(both)
        return (kept[0].data - kept[1].data, *kept)

    parameters = make_parameters(spec, kp, kd)
    residual = sysid.build_residual_fn(
        models_sequences=[sysid.ModelSequences(
            "arm", make_spec(), "log", ca.initial_state(model, train),
            sysid.TimeSeries(times, command), measured)],
        modify_residual=modify, n_threads=1)
    fitted, _ = sysid.optimize(parameters, residual, max_iters=iterations,
                               verbose=False)
    seconds = time.process_time() - begin
    final = make_spec()
    for parameter in fitted.parameters.values():
        parameter.modifier(final, parameter)
    held_out = ca.CommandedLog(folder / "held_out.csv")
    after = final.compile()
    ca.report("mujoco.sysid", folder, estimates_of(fitted, make_spec(), kp, kd),
              held_out_rms=replay_rms(after, held_out),
              held_out_rms_before=replay_rms(model, held_out),
              train_rms=replay_rms(after, train), cpu_s=seconds,
              rollouts=counter["rollouts"])


if __name__ == "__main__":
    main()
