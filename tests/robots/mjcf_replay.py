#!/usr/bin/env python3
"""Does MuJoCo with robot.xml alone follow held-out commands as the robot did?

  mjcf_replay.py --armcal=build/armcal [--other] [--work=DIR] [--case=TEXT] [--dt=S]

The arms of module_replay.py with one hidden effect each (--other: on other joints and of other
sizes, which nothing was developed on) are diagnosed with --export=mjcf and
calibrated. Then MuJoCo follows the commands of a log that nothing was fitted to, in closed loop
by the same drives, whose torques are all that is given: no callback, no module. Prints, per
case, how far positions are from those recorded, rms of all joints: of the calibrated rigid
robot, of robot.xml in its own time steps (or --dt), and of armcal's own replay (`forward` of
diagnosis.json). Exit code 1 where robot.xml is not nearer than the rigid robot, or where it
does not come back as an arm of as many joints.

Needs mujoco 4.0.0, numpy and scipy.
"""

import argparse
import sys
import tempfile
from pathlib import Path

import mujoco

sys.path[:0] = [str(Path(__file__).resolve().parent), str(Path(__file__).resolve().parents[1]),
                str(Path(__file__).resolve().parents[1] / "peers")]
import commanded_arm as ca  # noqa: E402
import module_replay  # noqa: E402
import result_files  # noqa: E402

NOT_IN_MJCF = {"thermal"}
OTHER = [
    ("stribeck", "stribeck@1:friction=.15"),
    ("presliding", "presliding@3:friction=.1,displacement=.01"),
    ("ripple", "torque_ripple@3:amplitude=.1,harmonic=20"),
    ("delay", "delay:delay=.004s"),
    ("elasticity", "elasticity@3:windup=.02"),
    ("backlash", "backlash@2:gap=.01"),
    ("counterbalance", "spring@3:stiffness=.2,neutral=-.3"),
    ("several", "elasticity@2:windup=.01;presliding@2:friction=.15,displacement=.02;"
                "torque_ripple@3:amplitude=.1,harmonic=20"),
]


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

    def start(self, position):
        self.data.qpos[self.at] = position

    def read(self):
        return self.data.qpos[self.at]

    def give(self, torque):
        self.data.ctrl[self.controls] = torque


def reads_back(armcal, xml, out, joints):
    """Whether armcal reads the file as the arm that it was."""
    module_replay.run(armcal, "inspect", f"--robot={xml}", "--export=mjcf_plain", f"--out={out}")
    model = mujoco.MjModel.from_xml_path(str(out / "robot_plain.xml"))
    return [model.joint(j).name for j in range(model.njnt)] == joints


def replay(armcal, out, effect, dt):
    """rms (rigid robot, robot.xml, armcal's own), what was named, whether it is read back."""
    kp, kd = module_replay.make(armcal, out, effect)
    log = ca.CommandedLog(out / "log2" / "log.csv")
    rigid = module_replay.Simulation(out / "calibrated" / "robot.xml", 5e-4)
    joints = [rigid.model.joint(j).name for j in range(rigid.model.njnt)]
    xml = out / "diagnosed" / "robot.xml"
    apart = [ca.rms(ca.difference(*simulation.path(log, kp, kd), log))
             for simulation in (rigid, Native(xml, dt, joints))]
    named, (_, own) = module_replay.own_replay(out)
    return (*apart, own), named, reads_back(armcal, xml, out / "back", joints)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--armcal", required=True)
    parser.add_argument("--work")
    parser.add_argument("--case", default="")
    parser.add_argument("--other", action="store_true")
    parser.add_argument("--dt", type=float)
    result_files.add_flag(parser)
    flags = parser.parse_args()
    values = {}
    failed = False
    with tempfile.TemporaryDirectory() as folder:
        print(f"{'case':15}{'rigid':>10}{'robot.xml':>11}{'armcal':>10}"
              f"{'of armcal':>11}{'of rigid':>10}  named")
        for name, effect in OTHER if flags.other else module_replay.CASES:
            if flags.case not in name or name in NOT_IN_MJCF:
                continue
            out = Path(flags.work or folder).resolve() / (f"other_{name}" if flags.other else name)
            (rigid, native, own), named, back = replay(
                Path(flags.armcal).resolve(), out, effect, flags.dt)
            good = native < rigid and back
            failed = failed or not good
            values[name] = [rigid, native, own, native / own, native / rigid]
            print(f"{name:15}{rigid:10.2e}{native:11.2e}{own:10.2e}{native / own:11.2f}"
                  f"{native / rigid:10.2f}  {', '.join(named)}{'' if good else '  FAILED'}",
                  flush=True)
    if flags.results:
        result_files.write(flags.results, "simulated arms with one effect each, robot.xml alone",
                           values)
    sys.exit(failed)


if __name__ == "__main__":
    main()
