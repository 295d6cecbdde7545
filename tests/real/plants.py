"""Changes that are put into a real log: what a later day of the robot might have.

Each takes a log (planted_log.Log) and a size, and changes the log's columns; it returns the
joint that it is on (from 1), 0 for one of the whole robot. Positions and torques keep the noise and
the misfit that they have.
"""

from xml.etree import ElementTree

import numpy as np


def speeds(log):
    """Joint speeds (joints x rows): slopes of straight lines over 21 samples."""
    t, q = np.array(log.t), np.array(log.columns["q"])
    step = np.median(np.diff(t))
    weights = np.arange(-10, 11) / (np.sum(np.arange(-10, 11) ** 2) * step)
    padded = np.pad(q, ((0, 0), (10, 10)), mode="edge")
    return np.array([np.convolve(x, weights[::-1], "valid") for x in padded])


def busiest(log):
    """The joint whose torque varies most among those that move: a drive of which much is
    seen. From 0."""
    torque = np.std(log.columns[log.torque], axis=1)
    moving = log.moving()
    return max(moving, key=lambda j: torque[j])


def scale(log, j):
    """A joint's rms torque about its mean: what shares are of."""
    return float(np.std(log.columns[log.torque][j]))


def add(log, j, torque):
    log.columns[log.torque][j] = (np.array(log.columns[log.torque][j]) + torque).tolist()


def none(log, _size, _robot):
    return 0


def delay(log, size, _robot):
    """All torques `size` ms late."""
    log.columns[log.torque] = [log.late(x, 1e-3 * size) for x in log.columns[log.torque]]
    return 0


def strengthen(log, j, size):
    """A drive that gives `size` percent more per unit of command: the same motion by less."""
    log.columns[log.torque][j] = [x / (1 + size / 100) for x in log.columns[log.torque][j]]


def gain(log, size, _robot):
    """One drive so."""
    j = busiest(log)
    strengthen(log, j, size)
    return j + 1


def scale_all(log, size, _robot):
    """All drives so. None of fewer than three, which are not asked for it."""
    if sum(scale(log, j) > 0 for j in range(log.joints)) < 3:
        return None
    for j in range(log.joints):
        strengthen(log, j, size)
    return 0


def coulomb(log, size, _robot):
    """Friction of `size` percent of the torque's rms, smoothed within 2 % of top speed."""
    j = busiest(log)
    speed = speeds(log)[j]
    add(log, j, size / 100 * scale(log, j) * np.tanh(speed / (.02 * np.max(np.abs(speed)))))
    return j + 1


def viscous(log, size, _robot):
    """Friction in proportion to speed, of `size` percent of the torque's rms, by rms."""
    j = busiest(log)
    speed = speeds(log)[j]
    add(log, j, size / 100 * scale(log, j) * speed / np.std(speed))
    return j + 1


def encoder(log, size, _robot):
    """A position that reads `size` degrees too much."""
    j = busiest(log)
    log.columns["q"][j] = [x + np.radians(size) for x in log.columns["q"][j]]
    return j + 1


def pulse(log, size, _robot, length=.3):
    """A push of .3 s (half a sine) at the log's middle, `size` percent of the torque's rms."""
    j = busiest(log)
    t = np.array(log.t)
    phase = (t - .5 * (t[0] + t[-1])) / length + .5
    inside = (phase > 0) & (phase < 1)
    add(log, j, np.where(inside, size / 100 * scale(log, j) * np.sin(np.pi * phase), 0))
    return j + 1


def push(log, size, robot):
    """The same, of 1.5 s."""
    return pulse(log, size, robot, 1.5)


def turned(axis, angles):
    """Rotations about `axis` by each angle (rows x 3 x 3)."""
    x, y, z = axis / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    sin, cos = np.sin(angles)[:, None, None], np.cos(angles)[:, None, None]
    return np.eye(3) + sin * cross + (1 - cos) * cross @ cross


def numbers(element, name, default):
    return np.array((element.get(name) if element is not None and element.get(name)
                     else default).split(), float)


def chain(robot, count):
    """The joints from the base to the tip of a robot file, fixed ones as well: of its branches
    the first that has `count` joints that move."""
    joints = ElementTree.parse(robot).getroot().findall("joint")
    above = {j.find("child").get("link"): j for j in joints}
    for link in above:
        path = []
        while link in above:
            path.insert(0, above[link])
            link = above[link].find("parent").get("link")
        if sum(j.get("type") != "fixed" for j in path) == count:
            return path
    raise ValueError(f"{robot}: no branch has {count} joints")


def tool_motion(robot, q):
    """Of a robot file's chain: axes and their origins (joints x rows x 3), the tip (rows x
    3: .1 m along z of the last link) in the base, and which joints slide."""
    rows = q.shape[1]
    turn, at = np.tile(np.eye(3), (rows, 1, 1)), np.zeros((rows, 3))
    axes, origins, sliding = [], [], []
    for joint in chain(robot, len(q)):
        origin = joint.find("origin")
        roll, pitch, yaw = numbers(origin, "rpy", "0 0 0")
        at = at + turn @ numbers(origin, "xyz", "0 0 0")
        for axis, angle in (((0, 0, 1), yaw), ((0, 1, 0), pitch), ((1, 0, 0), roll)):
            turn = turn @ turned(np.array(axis, float), np.array([angle]))
        if joint.get("type") == "fixed":
            continue
        axis, moved = numbers(joint.find("axis"), "xyz", "1 0 0"), q[len(axes)]
        axes.append(turn @ axis)
        sliding.append(joint.get("type") == "prismatic")
        if sliding[-1]:
            at = at + axes[-1] * moved[:, None]
        origins.append(at)
        if not sliding[-1]:
            turn = turn @ turned(axis, moved)
    return np.array(axes), np.array(origins), at + turn @ np.array([0, 0, .1]), sliding


def smooth_rate(x, step):
    """Second derivative of columns: parabolas over 31 samples."""
    k = np.arange(-15, 16)
    weights = np.linalg.pinv(np.vander(k * step, 3, increasing=True))[2] * 2
    padded = np.pad(x, ((15, 15), (0, 0)), mode="edge")
    return np.array([np.convolve(c, weights[::-1], "valid") for c in padded.T]).T


def payload_torque(log, robot, gravity):
    """Torque of 1 kg at the tip, joints x rows: J' (a - g)."""
    q = np.array(log.columns["q"])
    axes, origins, tip, sliding = tool_motion(robot, q)
    force = smooth_rate(tip, np.median(np.diff(log.t))) - gravity
    return np.array([np.sum((axis if slides else np.cross(axis, tip - origin)) * force, axis=1)
                     for axis, origin, slides in zip(axes, origins, sliding)])


def payload(log, size, robot):
    """A point mass .1 m beyond the last joint, whose torque is `size` percent of the torque's
    rms on the joint where it is largest (for drives of the robot's torque constants). None where
    a joint has no drive: what it would need moves it."""
    if any(scale(log, j) == 0 for j in range(log.joints)):
        return None
    torque = payload_torque(log, robot["file"], robot["gravity"]) / robot["constants"][:, None]
    share = max(np.sqrt(np.mean(torque[j] ** 2)) / scale(log, j) for j in range(len(torque)))
    for j, change in enumerate(torque):
        add(log, j, size / 100 / share * change)
    log.planted = size / 100 / share
    return 0
