"""Robots that branch, of public packages, against Pinocchio and Simbody.

  PYTHONPATH=BUILD/python python3 tests/robots/trees.py --armcal=BUILD/armcal
                                                        [--work=DIR]

Needs `pip install pin` and armcal's Python module. Of every robot of ROBOTS,
all that moves is read (but joints that follow others, which both hold at 0):
torques, mass matrices and the span of the regressor are compared at 20 random
states, and the number of model parameters with the rank of Pinocchio's
regressor, which is that of its base parameters. `verify` compares torques and
mass matrices at 1000 random states with Simbody's. Prints a table; exit code 1
where anything differs.
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile

import armcal
import numpy as np
import pinocchio as pin

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

import packages  # noqa: E402
import result_files  # noqa: E402

# Each with what it is; two arms on a torso, hands, an arm with its fingers.
ROBOTS = {
    "baxter": "two arms and a head",
    "tiago_dual": "a lift with two arms, hands and a head",
    "tiago_pro": "a lift with two arms and a head",
    "pr2": "a lift with two arms, grippers, a head and casters",
    "talos_full_v2": "a humanoid",
    "romeo": "a humanoid with hands",
    "icub": "a humanoid",
    "centauro": "two arms on four legs",
    "g1_29dof_with_hand_rev_1_0": "a humanoid with hands",
    "alex_nub_hands": "a humanoid's upper body",
    "anymal-kinova": "four legs and an arm",
    "allegro_left_hand": "a hand",
    "panda": "an arm with both fingers",
}
STATES = 20
MOST_JOINTS = 64  # that armcal takes


def without_mimic(text):
    """Panda's second finger follows the first; free, they are two branches."""
    return re.sub(r"<mimic[^>]*/>", "", text)


def leaves(model):
    """Joints that carry no other."""
    return [j for j in range(1, model.njoints)
            if not any(model.parents[k] == j for k in range(1, model.njoints))]


def child_links(text):
    """{joint: its child link}."""
    from xml.etree import ElementTree
    return {j.get("name"): j.find("child").get("link")
            for j in ElementTree.fromstring(text).findall("joint")}


def tied(text):
    """Joints that follow another, and those that are followed."""
    from xml.etree import ElementTree
    names = set()
    for joint in ElementTree.fromstring(text).findall("joint"):
        mimic = joint.find("mimic")
        if mimic is not None:
            names |= {joint.get("name"), mimic.get("joint")}
    return names


def wanted_tips(model, text):
    """The links that the branches end at, cut before what is tied."""
    no, child = tied(text), child_links(text)
    tips, joints = [], set()
    for j in leaves(model):
        way = [k for k in model.supports[j] if k > 0]
        names = [model.names[k] for k in way]
        free = next((i for i, name in enumerate(names) if name in no),
                    len(names))
        if (free == 0 or child[names[free - 1]] in tips or
                len(joints.union(names[:free])) > MOST_JOINTS):
            continue
        tips.append(child[names[free - 1]])
        joints.update(names[:free])
    return tips


def reduced(model, robot):
    """The Pinocchio model of the same joints; others held next to 0."""
    q = pin.neutral(model)
    for j in range(1, model.njoints):
        joint = model.joints[j]
        if joint.nq == 1:
            q[joint.idx_q] = np.clip(
                0, model.lowerPositionLimit[joint.idx_q],
                model.upperPositionLimit[joint.idx_q])
    names = set(robot.joint_names)
    locked = [j for j in range(1, model.njoints)
              if model.names[j] not in names]
    return pin.buildReducedModel(model, locked, q)


def position(model, q_of):
    q = pin.neutral(model)
    for j in range(1, model.njoints):
        at, x = model.joints[j].idx_q, q_of[model.names[j]]
        if model.joints[j].nq == 2:  # a continuous joint
            q[at:at + 2] = np.cos(x), np.sin(x)
        else:
            q[at] = x
    return q


def against_simbody(program, text, tips, folder):
    """The largest relative difference of torques and mass matrices."""
    path = folder / "robot.urdf"
    path.write_text(text)
    made = subprocess.run(
        [program, "verify", f"--robot={path}", "--tip=" + ",".join(tips),
         "--json"], capture_output=True, text=True, check=False)
    if made.returncode > 1:
        sys.exit(made.stderr)
    found = json.loads(made.stdout)
    return max(found["torque_max_rel"], found["mass_matrix_max_rel"])


def compare(text, tips):
    full = pin.buildModelFromXML(text)
    robot = armcal.Robot.from_text(text, tip=",".join(tips))
    model = reduced(full, robot)
    model.armature[:] = 0
    data, names = model.createData(), robot.joint_names
    order = [model.joints[model.getJointId(name)].idx_v for name in names]
    random = np.random.default_rng(1)
    n, torque, mass, U, Y = len(names), 0, 0, [], []
    for _ in range(STATES + 10 * n):
        q, qd, qdd = random.uniform(-2, 2, (3, n))
        at = position(model, dict(zip(names, q)))
        v, a = np.zeros(n), np.zeros(n)
        v[order], a[order] = qd, qdd
        Y.append(pin.computeJointTorqueRegressor(model, data, at, v, a)[order])
        U.append(robot.regressor(q, qd, qdd))
        if len(Y) > STATES:
            continue
        truth = pin.rnea(model, data, at, v, a)[order]
        torque = max(torque, np.abs(robot.inverse_dynamics(q, qd, qdd) - truth)
                     .max() / max(1, np.abs(truth).max()))
        M = pin.crba(model, data, at)
        M = (np.triu(M) + np.triu(M, 1).T)[np.ix_(order, order)]
        mass = max(mass, np.abs(robot.mass_matrix(q) - M).max() /
                   max(1, np.abs(M).max()))
    U, Y = np.vstack(U), np.vstack(Y)
    norms = np.linalg.norm(Y, axis=0)
    seen = norms > 1e-10 * norms.max()  # others are rounding
    rank = np.linalg.matrix_rank(Y[:, seen] / norms[seen], tol=1e-9)
    fit = np.linalg.lstsq(U, Y, rcond=None)[0]
    span = np.abs(U @ fit - Y).max() / np.abs(Y).max()
    return n, torque, mass, span, len(robot.model_parameters), rank


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--armcal", required=True)
    parser.add_argument("--work", type=pathlib.Path)
    result_files.add_flag(parser)
    flags = parser.parse_args()
    work = flags.work or pathlib.Path(tempfile.mkdtemp())
    folder, = packages.fetch(work, ["example-robot-data"]).values()
    good, values = True, {}
    print("| Robot | | Joints | Tips | Torque | Mass matrix | Span of the "
          "regressor | Parameters | Pinocchio's rank | Simbody |\n|" +
          "---|" * 10)
    for name, what in ROBOTS.items():
        path = next(folder.rglob(name + ".urdf"))
        text = path.read_text()
        if name == "panda":
            text = without_mimic(text)
        tips = wanted_tips(pin.buildModelFromXML(text), text)
        n, torque, mass, span, size, rank = compare(text, tips)
        with tempfile.TemporaryDirectory() as scratch:
            simbody = against_simbody(flags.armcal, text, tips,
                                      pathlib.Path(scratch))
        same = size == rank and max(torque, mass, span, simbody) < 1e-10
        good &= same
        values[name] = [n, len(tips), torque, mass, span, size, rank, simbody]
        print(f"| {name} | {what} | {n} | {len(tips)} | {torque:.0e} | "
              f"{mass:.0e} | {span:.0e} | {size} | {rank} | {simbody:.0e} |" +
              ("" if same else " DIFFERS"), flush=True)
    if flags.results:
        result_files.write(flags.results, "public robots that branch, against Pinocchio and "
                           "Simbody", values)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
