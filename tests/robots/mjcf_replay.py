#!/usr/bin/env python3
"""Does MuJoCo with robot.xml alone follow held-out commands as the robot did?

  mjcf_replay.py --armcal=build/armcal [--other|--means] [--work=DIR] [--case=TEXT] [--dt=S]

The arms of module_replay.py and one with a cable, one hidden effect each (--other: on other joints and of other
sizes, which nothing was developed on; --means: laws that MJCF has no field for) are diagnosed with --export=mjcf and
calibrated. Then MuJoCo follows the commands of a log that nothing was fitted to, in closed loop
by the same drives, whose torques are all that is given: no callback, no module. Prints, per
case, how far positions are from those recorded, rms of all joints: of the calibrated rigid
robot, of robot.xml in its own time steps (or --dt), and of armcal's own replay (`forward` of
diagnosis.json). What no field of MJCF holds is in robot.xml as its mean over the log, which the
rigid robot has as well; a second row then has effects.py beside robot.xml, which adds the rest.
Where a gear yields a row more has links instead of motors, beside the truth.
Exit code 1 where robot.xml is not nearer than the rigid robot (1.1 times as far where it lacks a
law), where it does not come back as an arm of as many joints, or where it, or if it lacks a law
effects.py beside it, is more than 1.2 times as far as armcal's own.

Needs mujoco 4.0.0, numpy and scipy.
"""

import argparse
import json
import sys
import tempfile
from pathlib import Path

import mujoco
import numpy as np

sys.path[:0] = [str(Path(__file__).resolve().parent), str(Path(__file__).resolve().parents[1]),
                str(Path(__file__).resolve().parents[1] / "peers")]
import commanded_arm as ca  # noqa: E402
import module_replay  # noqa: E402
import result_files  # noqa: E402

CASES = [*module_replay.CASES, ("cable", "cable@2:torque=.2")]
OTHER = [
    ("stribeck", "stribeck@1:friction=.15"),
    ("presliding", "presliding@3:friction=.1,displacement=.01"),
    ("ripple", "torque_ripple@3:amplitude=.1,harmonic=20"),
    ("delay", "delay:delay=.004s"),
    ("elasticity", "elasticity@3:windup=.02"),
    ("backlash", "backlash@2:gap=.01"),
    ("counterbalance", "spring@3:stiffness=.2,neutral=-.3"),
    ("cable", "cable@3:torque=.1"),
    ("several", "elasticity@2:windup=.01;presliding@2:friction=.15,displacement=.02;"
                "torque_ripple@3:amplitude=.1,harmonic=20"),
]


MEANS = [
    ("thermal_1", "thermal_friction@1:beta=.05,time_constant=.2"),
    ("thermal_3", "thermal_friction@3:beta=.03,time_constant=.5"),
    ("load", "load_friction@2:coefficient=.15"),
    ("position", "position_friction@2:friction=.2"),
    ("asymmetric", "asymmetric_friction@2:asymmetry=.2"),
    ("drift", "time_drift@2:torque=.2"),
]
MOST_OF_RIGID = 1.1  # where robot.xml lacks a law


class Native(module_replay.Simulation):
    """robot.xml as it is: its own steps, limits and laws. Encoders sit on the motors, which are
    the joints of the arm's names; so are the actuators that have a control."""

    def __init__(self, xml, dt, joints):
        self.model = mujoco.MjModel.from_xml_path(str(xml))
        self.model.opt.timestep = dt or self.model.opt.timestep
        self.model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
        self.data = mujoco.MjData(self.model)
        self.at = [self.model.joint(name).qposadr[0] for name in joints]
        self.controls = [self.model.actuator(name).id for name in joints]
        self.gears = {k: self.model.joint(f"{name}_gear").qposadr[0]
                      for k, name in enumerate(joints)
                      if mujoco.mj_name2id(self.model, mujoco.mjtObj.mjOBJ_JOINT,
                                           f"{name}_gear") >= 0}

    def start(self, position):
        self.data.qpos[self.at] = position

    def read(self):
        return self.data.qpos[self.at]

    def links(self):
        positions = np.array(self.data.qpos[self.at])
        for k, gear in self.gears.items():
            positions[k] += self.data.qpos[gear]
        return positions

    def give(self, torque):
        self.data.ctrl[self.controls] = torque


class WithRest(Native):
    """What robot.xml lacks is effects.py's, which leaves it what it has."""

    def __init__(self, folder, dt, joints):
        super().__init__(folder / "robot.xml", dt, joints)
        self.effects = module_replay.load_module(folder).Effects(
            folder / "effects.json", beside="mjcf")
        self.dofs = [self.model.joint(name).dofadr[0] for name in joints]

    def paths(self, log, kp, kd):
        self.effects.t = -ca.SETTLE
        return super().paths(log, kp, kd)

    def read(self):
        return self.effects.sense(self.model.opt.timestep, super().read(),
                                  self.data.qvel[self.dofs])

    def give(self, torque):
        super().give(torque)
        self.data.qfrc_applied[self.dofs] = np.subtract(self.effects.act(torque), torque)


def rest_of(folder):
    """Whether robot.xml lacks a law that was found."""
    effects = json.loads((folder / "effects.json").read_text(encoding="utf-8"))["effects"]
    return any("mjcf" not in effect["in"] for effect in effects)


def reads_back(armcal, xml, out, joints):
    """Whether armcal reads the file as the arm that it was."""
    module_replay.run(armcal, "inspect", f"--robot={xml}", "--export=mjcf_plain", f"--out={out}")
    model = mujoco.MjModel.from_xml_path(str(out / "robot_plain.xml"))
    return [model.joint(j).name for j in range(model.njnt)] == joints


def replay(armcal, out, effect, dt):
    """rms (rigid robot, robot.xml, with effects.py beside it if it lacks a law), each of motors
    and, behind gears that yield, of links; armcal's own; what was named, whether it is read
    back."""
    kp, kd = module_replay.make(armcal, out, effect)
    log = ca.CommandedLog(out / "log2" / "log.csv")
    rigid = module_replay.Simulation(out / "calibrated" / "robot.xml", 5e-4)
    joints = [rigid.model.joint(j).name for j in range(rigid.model.njnt)]
    xml = out / "diagnosed" / "robot.xml"
    simulations = [rigid, Native(xml, dt, joints)]
    if rest_of(out / "diagnosed"):
        simulations.append(WithRest(out / "diagnosed", dt, joints))
    rms = [module_replay.far(simulation.paths(log, kp, kd), out, log)
           for simulation in simulations]
    named, (_, own) = module_replay.own_replay(out)
    return rms, own, named, reads_back(armcal, xml, out / "back", joints)


def show(name, rigid, found, own, text):
    """A row, and the values that are stored of it."""
    print(f"{name:22}{rigid:10.2e}{found:11.2e}{own:10.2e}{found / own:11.2f}"
          f"{found / rigid:10.2f}  {text}", flush=True)
    return [rigid, found, own, found / own, found / rigid]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--armcal", required=True)
    parser.add_argument("--work")
    parser.add_argument("--case", default="")
    group = parser.add_mutually_exclusive_group()
    group.add_argument("--other", action="store_true")
    group.add_argument("--means", action="store_true")
    parser.add_argument("--dt", type=float)
    result_files.add_flag(parser)
    flags = parser.parse_args()
    values = {}
    failed = False
    with tempfile.TemporaryDirectory() as folder:
        print(f"{'case':22}{'rigid':>10}{'robot.xml':>11}{'armcal':>10}"
              f"{'of armcal':>11}{'of rigid':>10}  named")
        cases = OTHER if flags.other else MEANS if flags.means else CASES
        for name, effect in cases:
            if flags.case not in name:
                continue
            out = Path(flags.work or folder).resolve() / (f"other_{name}" if flags.other else name)
            rms, own, named, back = replay(Path(flags.armcal).resolve(), out, effect, flags.dt)
            rigid, native, *rest = [of[0] for of in rms]
            good = back and (native < MOST_OF_RIGID * rigid if rest else
                             native < min(rigid, module_replay.MOST_OF_OWN * own))
            values[name] = show(name, rigid, native, own,
                                ", ".join(named) + ("" if good else "  FAILED"))
            for module in rest:
                near = module <= module_replay.MOST_OF_OWN * own
                values[f"{name}_effects_py"] = show(f"{name}, effects.py", rigid, module, own,
                                                    "" if near else "FAILED")
                good = good and near
            for links in zip(*(of[1:] for of in rms[:2])):
                values[f"{name}_links"] = module_replay.show_links(name, *links)
            failed = failed or not good
    if flags.results:
        result_files.write(flags.results, "simulated arms with one effect each, robot.xml alone",
                           values)
    sys.exit(failed)


if __name__ == "__main__":
    main()
