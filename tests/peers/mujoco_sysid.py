"""mujoco_sysid.py URDF: one Jacobian of MuJoCo's sysid.

78 parameters (ten per link as pseudo-inertia, damping, frictionloss and
armature), finite differences of RK4 rollouts of 1e4 steps without contacts, one
thread: what an iteration of its optimizer begins with. Prints a line of JSON.
"""

import json
import sys
import time

import mujoco
import numpy as np
from mujoco import minimize, sysid
from mujoco.sysid._src import model_modifier

STEPS = 10_000
JOINT_TERMS = {"armature": .5, "damping": 1., "frictionloss": .1}


def set_term(joint, name, value):
    """Damping is a polynomial in the velocity; its first coefficient."""
    old = np.atleast_1d(np.array(getattr(joint, name), dtype=float))
    old[0] = value
    setattr(joint, name, old if len(old) > 1 else value)


def make_spec(urdf):
    """The robot with a motor and a position sensor at every joint."""
    spec = mujoco.MjSpec.from_file(urdf)
    spec.option.timestep = 1e-3
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_RK4
    spec.option.disableflags |= (mujoco.mjtDisableBit.mjDSBL_CONTACT |
                                 mujoco.mjtDisableBit.mjDSBL_LIMIT)
    for joint in spec.joints:
        # Explicit steps of 1 ms need some inertia at the wrist.
        for name, value in JOINT_TERMS.items():
            set_term(joint, name, value)
        spec.add_actuator(name=f"motor_{joint.name}", target=joint.name,
                          trntype=mujoco.mjtTrn.mjTRN_JOINT)
        spec.add_sensor(name=f"position_{joint.name}", objname=joint.name,
                        type=mujoco.mjtSensor.mjSENS_JOINTPOS,
                        objtype=mujoco.mjtObj.mjOBJ_JOINT)
    return spec


def set_inertia(spec, parameter, name):
    """What sysid's own modifier does, by principal axes: that one's full
    inertia of a second body is refused by the compiler (4.0.0)."""
    pi = model_modifier.pi_from_theta(parameter.value)
    body, com = spec.body(name), pi[1:4] / pi[0]
    cross = np.cross(np.eye(3), com)
    inertia = pi[4:].reshape(3, 3) + pi[0] * cross @ cross
    moments, axes = np.linalg.eigh(inertia)
    axes[:, 0] *= np.linalg.det(axes)
    quaternion = np.empty(4)
    mujoco.mju_mat2Quat(quaternion, axes.ravel())
    body.mass, body.ipos = pi[0], com
    body.inertia, body.iquat = moments, quaternion
    body.fullinertia = np.full(6, np.nan)


def make_parameters(spec, model):
    parameters = sysid.ParameterDict()
    for body in spec.bodies[1:]:
        parameters.add(sysid.body_inertia_param(
            spec, model, body.name, inertia_type=sysid.InertiaType.Pseudo,
            modifier=lambda s, p, n=body.name: set_inertia(s, p, n)))
    for joint in spec.joints:
        for name, value in JOINT_TERMS.items():
            parameters.add(sysid.Parameter(
                f"{joint.name}_{name}", nominal=value, min_value=value / 2,
                max_value=2 * value,
                modifier=lambda s, p, j=joint.name, n=name: set_term(
                    s.joint(j), n, p.value[0])))
    return parameters


def main():
    spec = make_spec(sys.argv[1])
    model = spec.compile()
    data = mujoco.MjData(model)
    t = np.arange(STEPS) * model.opt.timestep
    control = np.column_stack([np.sin(2 * np.pi * (.3 + .1 * j) * t)
                               for j in range(model.nu)])
    initial = sysid.create_initial_state(model, data.qpos, data.qvel, data.act)
    measured = sysid.TimeSeries.from_names(
        t, np.ones((STEPS, model.nsensordata)), model)
    parameters = make_parameters(spec, model)
    residual = sysid.build_residual_fn(
        models_sequences=[sysid.ModelSequences(
            "arm", spec, "log", initial, sysid.TimeSeries(t, control),
            measured)], n_threads=1)

    def stacked(x):
        return np.concatenate(residual(x, parameters)[0])

    x = parameters.as_vector()
    start = time.process_time()
    r = stacked(x).reshape(-1, 1)
    jacobian, _ = minimize.jacobian_fd(stacked, x.reshape(-1, 1), r, 1e-6, 0)
    values = {"Sysid/jacobian_s": time.process_time() - start,
              "Sysid/parameters": len(x), "Sysid/rows": jacobian.shape[0]}
    print(json.dumps({"values": values}))


if __name__ == "__main__":
    main()
