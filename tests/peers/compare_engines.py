"""Inverse dynamics of exported robot files in other engines.

  armcal inspect --robot=ROBOT --export=urdf,mjcf,sdf,yaml --out=DIR
  write_predicted_torques ROBOT 200 1 > DIR/torques.csv
  compare_engines.py DIR

Prints, for each engine and file, the largest relative difference of joint
torques (2-norm over the joints) from what armcal predicts: `rigid` of the bodies
alone, `all` with armature, viscous and Coulomb friction where the format holds
them. MuJoCo's dry friction is compared where it is saturated (below it creeps).
Engines that are not installed are left out.
"""

import os
import sys
from importlib.metadata import version
from xml.etree import ElementTree

import numpy as np


def predicted(path):
    table = np.genfromtxt(path, delimiter=",", names=True)
    n = sum(name.startswith("rigid") for name in table.dtype.names)
    return {kind: np.stack([table[f"{kind}{j + 1}"] for j in range(n)], 1)
            for kind in ("q", "qd", "qdd", "rigid", "tau")}


def relative(theirs, ours):
    return np.linalg.norm(theirs - ours, axis=1) / np.linalg.norm(ours, axis=1)


def report(engine, file, what, differences, note=""):
    print(f"{engine:14} {file:12} {what:6} {np.max(differences):.1e}  "
          f"{len(differences)} states {note}")


def gravity_of(folder):
    root = ElementTree.parse(os.path.join(folder, "robot.xml")).getroot()
    return np.array([float(x) for x in root.find("option").get("gravity").split()])


def mujoco_rigid(path, p, gravity):
    import mujoco
    from mujoco_arm import Arm
    arm = Arm(path)
    m = arm.model
    m.dof_damping[:], m.dof_frictionloss[:], m.dof_armature[:] = 0, 0, 0
    m.opt.gravity[:] = gravity  # that URDF cannot say
    tau = np.array([arm.inverse(*x) for x in zip(p["q"], p["qd"], p["qdd"])])
    return relative(tau, p["rigid"]), mujoco.__version__


def mujoco_all(path, p):
    from mujoco_arm import Arm
    arm = Arm(path)
    tau, saturated = [], []
    for x in zip(p["q"], p["qd"], p["qdd"]):
        tau.append(arm.inverse(*x))
        # It brakes qd + qdd / 105 Hz, whose sign is qd's above 0.05 rad/s.
        saturated.append(arm.saturated().all() and np.min(np.abs(x[1])) > 0.05)
    return relative(np.array(tau), p["tau"])[np.array(saturated)]


def compare_mujoco(folder, p, gravity):
    path = os.path.join(folder, "robot.xml")
    rigid, number = mujoco_rigid(path, p, gravity)
    engine = f"mujoco {number}"
    report(engine, "robot.xml", "rigid", rigid)
    report(engine, "robot.xml", "all", mujoco_all(path, p), "saturated")
    urdf = mujoco_rigid(os.path.join(folder, "robot.urdf"), p, gravity)[0]
    report(engine, "robot.urdf", "rigid", urdf)


def compare_drake(folder, p, gravity):
    from pydrake.multibody.parsing import Parser
    from pydrake.multibody.plant import MultibodyPlant
    from pydrake.multibody.tree import MultibodyForces
    for file in ("robot.sdf", "robot.urdf"):
        plant = MultibodyPlant(0)
        plant.mutable_gravity_field().set_gravity_vector(gravity)
        Parser(plant).AddModels(os.path.join(folder, file))
        if file.endswith(".urdf"):
            plant.WeldFrames(plant.world_frame(),
                             plant.GetFrameByName("base_link"))
        plant.Finalize()
        context = plant.CreateDefaultContext()
        damping = np.array([plant.get_joint(j).default_damping_vector()[0]
                            for j in plant.GetJointIndices()
                            if plant.get_joint(j).num_velocities() == 1])
        armature = np.zeros(plant.num_velocities())
        for i in plant.GetJointActuatorIndices():
            actuator = plant.get_joint_actuator(i)
            armature[actuator.joint().velocity_start()] = (
                actuator.default_reflected_inertia())
        tau = []
        for q, qd, qdd in zip(p["q"], p["qd"], p["qdd"]):
            plant.SetPositions(context, q)
            plant.SetVelocities(context, qd)
            forces = MultibodyForces(plant)
            plant.CalcForceElementsContribution(context, forces)
            tau.append(plant.CalcInverseDynamics(context, qdd, forces))
        # Joint damping is among Drake's forces, reflected inertia in its mass
        # matrix.
        rigid = np.array(tau) - armature * p["qdd"] - damping * p["qd"]
        report("drake " + version("drake"), file, "rigid",
               relative(rigid, p["rigid"]))
        print(f"{'':14} {file:12} damping {np.round(damping, 6)} "
              f"reflected inertia {np.round(armature, 6)}")


def main(folder):
    p = predicted(os.path.join(folder, "torques.csv"))
    for compare in (compare_mujoco, compare_drake):
        try:
            compare(folder, p, gravity_of(folder))
        except ModuleNotFoundError as error:
            print(f"left out: {error.name} is not installed")


if __name__ == "__main__":
    main(sys.argv[1])
