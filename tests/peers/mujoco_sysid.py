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

STEPS = 10_000


def make_spec(urdf):
    """The robot with a motor and a position sensor at every joint."""
    spec = mujoco.MjSpec.from_file(urdf)
    spec.option.timestep = 1e-3
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_RK4
    spec.option.disableflags |= (mujoco.mjtDisableBit.mjDSBL_CONTACT |
                                 mujoco.mjtDisableBit.mjDSBL_LIMIT)
    for joint in spec.joints:
        # Explicit steps of 1 ms need some inertia at the wrist.
        joint.armature, joint.damping, joint.frictionloss = .5, 1, .1
        spec.add_actuator(name=f"motor_{joint.name}", target=joint.name,
                          trntype=mujoco.mjtTrn.mjTRN_JOINT)
        spec.add_sensor(name=f"position_{joint.name}", objname=joint.name,
                        type=mujoco.mjtSensor.mjSENS_JOINTPOS,
                        objtype=mujoco.mjtObj.mjOBJ_JOINT)
    return spec


def make_parameters(spec, model):
    parameters = sysid.ParameterDict()
    for body in spec.bodies[1:]:
        parameters.add(sysid.body_inertia_param(
            spec, model, body.name, inertia_type=sysid.InertiaType.Pseudo))
    for joint in spec.joints:
        for name in "armature", "damping", "frictionloss":
            value = float(np.ravel(getattr(joint, name))[0])
            parameters.add(sysid.Parameter(
                f"{joint.name}_{name}", nominal=value, min_value=value / 2,
                max_value=2 * value,
                modifier=lambda s, p, j=joint.name, n=name: setattr(
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
        t, np.zeros((STEPS, model.nsensordata)), model)
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
