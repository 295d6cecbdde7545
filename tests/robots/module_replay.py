#!/usr/bin/env python3
"""Does MuJoCo with effects.py follow held-out commands as the robot did?

  module_replay.py --armcal=build/armcal [--work=DIR] [--case=TEXT] [--dt=0.0005]

Arms with one hidden effect each, 2 % off their file, are simulated by armcal (Simbody)
under position drives, diagnosed with --modules=python --export=mjcf_plain, and calibrated. Then
MuJoCo follows the commands of a log that nothing was fitted to, in closed loop by the same
drives: with the calibrated rigid robot, and with robot_plain.xml and effects.py. Prints, per case,
how far positions are from those recorded, rms of all joints, for both and for armcal's own
replay (`forward` of diagnosis.json). Where a gear yields, encoders say where motors are: a second
row then has how far the links are from where they were (links.csv of `simulate`), which no
diagnosis has seen. Exit code 1 where effects.py is more than 1.2 times as
far as armcal's own. How far both are beside the rigid robot is the diagnosis's doing.

Needs mujoco, numpy and scipy.
"""

import argparse
import copy
import importlib.util
import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

import mujoco
import numpy as np
from scipy.interpolate import CubicSpline

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "peers")]
import commanded_arm as ca  # noqa: E402
import result_files  # noqa: E402

CASES = [
    ("stribeck", "stribeck@2:friction=.1"),
    ("presliding", "presliding@2:friction=.15,displacement=.02"),
    ("ripple", "torque_ripple@2:amplitude=.15,harmonic=12"),
    ("thermal", "thermal_friction@2:beta=.04,time_constant=.3"),
    ("delay", "delay:delay=.01s"),
    ("elasticity", "elasticity@2:windup=.01"),
    ("backlash", "backlash@3:gap=.02"),
    ("counterbalance", "spring@2:stiffness=.3,neutral=.4"),
]
BANDWIDTH = 4.  # Hz, of the drives
MOST_OF_OWN = 1.2
ARM = """name: arm
convention: standard
gravity: [0, 0, -9.81]
links:
  - {joint: revolute, d: .3, alpha: 1.5707963267948966, mass: 4, com: [0, -.05, .01],
     inertia: [.02, .015, .02], viscous: 3, coulomb: 4, armature: .5, LIMITS}
  - {joint: revolute, a: .4, mass: 5, com: [-.2, 0, .02], inertia: [.01, .08, .08],
     viscous: 4, coulomb: 5, armature: .6, LIMITS}
  - {joint: revolute, a: .35, mass: 2.5, com: [-.17, .01, 0], inertia: [.004, .03, .03],
     viscous: 1.5, coulomb: 2, armature: .25, LIMITS}
""".replace("LIMITS", "limits: {lower: -2, upper: 2, velocity: 2, effort: 200}")


def run(armcal, *flags):
    done = subprocess.run([armcal, *map(str, flags)], capture_output=True, text=True,
                          check=False)
    if done.returncode not in (0, 1):
        sys.exit(f"{' '.join(map(str, flags))}\n{done.stdout}{done.stderr}")


def gains(xml):
    """kp and kd that place each joint's loop at BANDWIDTH, critically damped."""
    model = mujoco.MjModel.from_xml_path(str(xml))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    inertia = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(*((model, inertia, data.qM) if hasattr(data, "qM")
                      else (model, data, inertia)))
    omega = 2 * np.pi * BANDWIDTH
    return omega ** 2 * np.diag(inertia), 2 * omega * np.diag(inertia)


class Drives:
    """armcal's `law: pd` without feedforward (docs/simulate.md), 1 kHz."""

    def __init__(self, log, kp, kd, rate=1000.):
        self.kp, self.kd, self.rate = kp, kd, rate
        self.reference = CubicSpline(log.t, log.qref)
        self.velocity_of_reference = self.reference.derivative()
        self.decay = np.exp(-2 * np.pi * 100 / rate)
        self.before, self.velocity = None, np.zeros(log.n)

    def torque(self, t, position):
        position = np.array(position)
        if self.before is not None:
            difference = (position - self.before) * self.rate
            self.velocity = difference + self.decay * (self.velocity - difference)
        self.before = position
        t = max(0., t)
        return (self.kp * (self.reference(t) - position)
                + self.kd * (self.velocity_of_reference(t) - self.velocity))


def load_module(folder):
    spec = importlib.util.spec_from_file_location("effects", folder / "effects.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class Paths(NamedTuple):
    """Positions at `times`, steps x joints: of the motors, as encoders have them, and of links."""

    times: np.ndarray
    motors: np.ndarray
    links: np.ndarray


class Simulation:
    """MuJoCo steps of dt, torques of drives held over their periods."""

    def __init__(self, xml, dt):
        self.model = mujoco.MjModel.from_xml_path(str(xml))
        self.model.opt.timestep = dt
        self.model.opt.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        self.model.opt.disableflags |= (mujoco.mjtDisableBit.mjDSBL_CONTACT |
                                        mujoco.mjtDisableBit.mjDSBL_LIMIT)
        self.data = mujoco.MjData(self.model)

    def start(self, position):
        self.data.qpos[:] = position

    def read(self):
        return self.data.qpos

    def links(self):
        return self.data.qpos

    def give(self, torque):
        self.data.ctrl[:] = torque

    def paths(self, log, kp, kd):
        dt, drives = self.model.opt.timestep, Drives(log, kp, kd)
        self.start(log.qref[0])
        every = round(1 / drives.rate / dt)
        settle, end = round(ca.SETTLE / dt), int(log.t[-1] / dt)
        motors, links = np.empty((end, log.n)), np.empty((end, log.n))
        for k in range(-settle, end):
            position = self.read()
            if k >= 0:
                motors[k], links[k] = position, self.links()
            if k % every == 0:
                torque = drives.torque(k * dt, position)
            self.give(torque)
            mujoco.mj_step(self.model, self.data)
        return Paths(np.arange(end) * dt, motors, links)


class WithEffects(Simulation):
    def __init__(self, folder, dt):
        super().__init__(folder / "robot_plain.xml", dt)
        self.effects = load_module(folder).Effects(folder / "effects.json")
        self.effects.take_over(self.model)

    def paths(self, log, kp, kd):
        self.data.qpos[:] = log.qref[0]
        mujoco.mj_forward(self.model, self.data)
        self.effects.reset(load=self.data.qfrc_bias)
        self.effects.t = -ca.SETTLE
        return super().paths(log, kp, kd)

    def read(self):
        return self.effects.sense(self.model.opt.timestep, self.data.qpos, self.data.qvel)

    def give(self, torque):
        self.effects.act(torque)
        self.model.dof_damping[:] = self.effects.damping
        self.data.qfrc_applied[:] = self.effects.undamped


def make(armcal, out, effect):
    """Logs, diagnosis and calibration of a case."""
    robot = out / "arm.yaml"
    robot.parent.mkdir(parents=True, exist_ok=True)
    robot.write_text(ARM, encoding="utf-8")
    run(armcal, "inspect", f"--robot={robot}", "--export=mjcf", f"--out={out / 'file'}")
    kp, kd = gains(out / "file" / "robot.xml")
    controller = out / "controller.yaml"
    controller.write_text(f"law: pd\nfeedforward: none\nkp: {kp.tolist()}\n"
                          f"kd: {kd.tolist()}\nki: [0, 0, 0]\n", encoding="utf-8")
    for k in (1, 2):
        run(armcal, "simulate", f"--robot={robot}", f"--controller={controller}",
            "--duration=40", "--robot_error=.02", "--seed=3", f"--run={k}",
            f"--effects={effect}", f"--out={out / f'log{k}'}", f"--truth={out / 'truth'}")
    logs = [f"--robot={robot}", f"--log={out / 'log1' / 'log.csv'}"]
    run(armcal, "diagnose", *logs, f"--validate={out / 'log2' / 'log.csv'}",
        f"--controller={controller}", "--export=mjcf,mjcf_plain", "--modules=python,c",
        f"--out={out / 'diagnosed'}")
    run(armcal, "calibrate", *logs, "--export=mjcf", f"--out={out / 'calibrated'}")
    return kp, kd


def far(paths, out, log):
    """rms from where motors were recorded and, where a gear yields, links were."""
    rms = [ca.rms(ca.difference(paths.times, paths.motors, log))]
    truth = out / "truth" / "links.csv"
    if truth.exists():
        links = copy.copy(log)
        links.q = np.loadtxt(truth, delimiter=",", skiprows=1)[:, 1:1 + log.n]
        rms.append(ca.rms(ca.difference(paths.times, paths.links, links)))
    return rms


def show_links(name, rigid, found):
    """A row, and the values that are stored of it."""
    print(f"{name + ', links':22}{rigid:10.2e}{found:11.2e}{'':21}{found / rigid:10.2f}",
          flush=True)
    return [rigid, found, found / rigid]


def own_replay(out):
    """rms of joints' positions: refitted rigid robot, with the effects."""
    diagnosis = json.loads((out / "diagnosed" / "diagnosis.json").read_text(encoding="utf-8"))
    joints = diagnosis["gap"]["forward"]["joints"]
    named = [f"{e['effect']}@{e['joint']}" if e["joint"] else e["effect"]
             for e in diagnosis["effects"]]
    rms = [float(np.sqrt(np.mean([j[key] ** 2 for j in joints])))
           for key in ("refit_rms", "after_rms")]
    return named, rms


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--armcal", required=True)
    parser.add_argument("--work")
    parser.add_argument("--case", default="")
    parser.add_argument("--dt", type=float, default=5e-4)
    result_files.add_flag(parser)
    flags = parser.parse_args()
    values = {}
    failed = False
    with tempfile.TemporaryDirectory() as folder:
        print(f"{'case':22}{'rigid':>10}{'effects.py':>11}{'armcal':>10}"
              f"{'of armcal':>11}{'of rigid':>10}  named")
        for name, effect in CASES:
            if flags.case not in name:
                continue
            out = Path(flags.work or folder).resolve() / name
            kp, kd = make(Path(flags.armcal).resolve(), out, effect)
            log = ca.CommandedLog(out / "log2" / "log.csv")
            rigid, *rigid_links = far(Simulation(
                out / "calibrated" / "robot.xml", flags.dt).paths(log, kp, kd), out, log)
            module, *links = far(WithEffects(
                out / "diagnosed", flags.dt).paths(log, kp, kd), out, log)
            named, (_, own) = own_replay(out)
            good = module <= MOST_OF_OWN * own
            failed = failed or not good
            values[name] = [rigid, module, own, module / own, module / rigid]
            print(f"{name:22}{rigid:10.2e}{module:11.2e}{own:10.2e}{module / own:11.2f}"
                  f"{module / rigid:10.2f}  {', '.join(named)}{'' if good else '  FAILED'}",
                  flush=True)
            for pair in zip(rigid_links, links):
                values[f"{name}_links"] = show_links(name, *pair)
    if flags.results:
        result_files.write(flags.results, "simulated arms with one effect each", values)
    sys.exit(failed)


if __name__ == "__main__":
    main()
