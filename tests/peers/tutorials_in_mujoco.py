#!/usr/bin/env python3
"""Do the robots of docs/tutorials move in MuJoCo as their logs do?

  tutorials_in_mujoco.py --armcal=build/armcal --pages=SCRATCH [--results=FILE]

SCRATCH is where tests/documents.py ran the pages (its --work). The UR's robot.xml
gets the torques of its check log in windows of 0.5 s that begin in the log's states;
the servo arm's gets the goals of its check log, calibrated, with the file's numbers
and the right gain, and with these and the guess. Prints what is left of positions, mrad:
the UR's median over windows of the rms of all joints, the servos' rms of each joint.
"""

import argparse
import pathlib
import subprocess
import sys

import mujoco
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import result_files  # noqa: E402

CONSTANTS = [11.82, 12.40, 9.614, 9.183, 9.495, 9.907]  # of docs/tutorials/ur.md


def replay_windows(model, path):
    log = np.genfromtxt(path, names=True)
    t, joints = log["timestamp"], range(6)
    q, qd, current = ([log[f"actual_{name}_{k}"] for k in joints]
                      for name in ("q", "qd", "current"))
    data, left = mujoco.MjData(model), []

    def at(time, series):
        return np.array([np.interp(time, t, x) for x in series])

    for start in np.arange(2, t[-1] - 2, .5):
        data.time, data.qpos[:], data.qvel[:] = start, at(start, q), at(start, qd)
        errors = []
        while data.time < start + .5:
            data.ctrl[:6] = CONSTANTS * at(data.time, current)
            mujoco.mj_step(model, data)
            errors.append(data.qpos - at(data.time, q))
        left.append(np.sqrt(np.mean(np.square(errors))))
    return 1e3 * np.median(left)


def follow_goals(model, path):
    rows = np.loadtxt(path, delimiter=",", skiprows=1)
    t, position, goal = rows[:, 0], rows[:, 1:6], rows[:, 6:11]
    data, left = mujoco.MjData(model), []
    data.qpos[:] = position[0]
    for k in range(1, len(t)):
        while data.time < t[k] - 1e-9:
            data.ctrl[:5] = [np.interp(data.time, t, goal[:, j]) for j in range(5)]
            mujoco.mj_step(model, data)
        left.append(data.qpos - position[k])
    return (1e3 * np.sqrt(np.mean(np.square(left[100:]), axis=0))).tolist()


def as_file_has_it(armcal, folder, controller):
    subprocess.run([armcal, "inspect", "--robot=so101.yaml", "--export=mjcf",
                    f"--controller={controller}", "--out=as_file"], cwd=folder,
                   check=True, stdout=subprocess.DEVNULL)
    return mujoco.MjModel.from_xml_path(str(folder / "as_file/robot.xml"))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("armcal", "pages"):
        parser.add_argument(f"--{name}", required=True, type=pathlib.Path)
    result_files.add_flag(parser)
    given = parser.parse_args()
    armcal = given.armcal.resolve()
    ur = given.pages / "docs_tutorials_ur_md"
    servo = given.pages / "docs_tutorials_hobby_servo_md"
    model = mujoco.MjModel.from_xml_path(str(ur / "fitted/robot.xml"))
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    model.opt.timestep = .001
    check = servo / "check.csv"
    fitted = mujoco.MjModel.from_xml_path(str(servo / "fitted/robot.xml"))
    ends = {"ur_replay": [replay_windows(model, ur / "check.csv")]}
    for name, model in (("calibrated", fitted),
                        ("file", as_file_has_it(armcal, servo, "secret.yaml")),
                        ("guess", as_file_has_it(armcal, servo, "guess.yaml"))):
        left = follow_goals(model, check)
        print(f"servo, {name}: {np.round(left, 2)} mrad")
        ends[f"servo_{name}"] = [min(left), max(left)]
    print(f"MuJoCo {mujoco.__version__}, ur: {ends['ur_replay'][0]:.2f} mrad")
    if given.results:
        result_files.write(given.results, "robots of docs/tutorials in MuJoCo "
                           f"{mujoco.__version__}: mrad from their logs (of five "
                           "servos the least and the most)", ends)


if __name__ == "__main__":
    main()
