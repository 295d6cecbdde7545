"""Random arms, most of them strange, and their torques by Newton and Euler."""

import typing

import numpy as np

IDENTITY = (np.eye(3), np.zeros(3))
G = 9.81


class Link(typing.NamedTuple):
    """A joint and the body that it moves. X_PJ: the joint in the link before;
    X_JL: the link in the moved joint; a pose is (rotation, translation)."""
    prismatic: bool
    X_PJ: tuple
    axis: np.ndarray  # in J
    X_JL: tuple
    mass: float  # kg
    com: np.ndarray  # in L, m
    inertia: np.ndarray  # about the com in L, kg m^2
    terms: dict  # viscous, coulomb, armature, offset
    dh: dict  # a, alpha, d, theta, if the robot is a DH table


class Robot(typing.NamedTuple):
    links: list
    gravity: np.ndarray  # m/s^2, in the base
    convention: str  # standard, modified, poses or URDF
    bodies: bool  # whether the file has masses
    kinds: dict  # what was drawn, for the table
    length: float  # m, scale of its links

    def file(self):
        """(name, text)"""
        if self.convention == "urdf":
            return "robot.urdf", urdf(self)
        return "robot.yaml", yaml(self)


def compose(X, Y):
    return X[0] @ Y[0], X[1] + X[0] @ Y[1]


def rotation(axis, angle):
    """Rodrigues; of angles, one each."""
    x, y, z = axis
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    s, c = (f(angle)[..., None, None] for f in (np.sin, np.cos))
    return np.eye(3) + s * K + (1 - c) * (K @ K)


def moved(robot, q):
    """Of each link: rotation and translation of its moved joint's frame M in
    the M before, at all positions, and the link in M."""
    before = IDENTITY
    for k, link in enumerate(robot.links):
        R, p = compose(before, link.X_PJ)
        angle = np.zeros(len(q)) if link.prismatic else q[:, k]
        shift = np.outer(q[:, k], R @ link.axis) if link.prismatic else 0
        yield R @ rotation(link.axis, angle), p + shift * np.ones((len(q), 1))
        before = link.X_JL


def tips(robot, q):
    """Of the last link's frame, in the base."""
    R, p = np.broadcast_to(np.eye(3), (len(q), 3, 3)), np.zeros((len(q), 3))
    for R_PM, p_PM in moved(robot, q):
        p = p + np.einsum("kij,kj->ki", R, p_PM)
        R = R @ R_PM
    X = robot.links[-1].X_JL
    return R @ X[0], p + np.einsum("kij,j->ki", R, X[1])


def torques(robot, q, qd, qdd):
    """Newton and Euler (Craig, chapter 6), in the links' frames."""
    n, count = len(robot.links), len(q)
    rotations, states = [], []
    w, wd = np.zeros((count, 3)), np.zeros((count, 3))
    a = np.broadcast_to(-robot.gravity, (count, 3))
    for k, (R, p) in enumerate(moved(robot, q)):
        link = robot.links[k]
        def turned(v, R=R):
            return np.einsum("kji,kj->ki", R, v)
        a = turned(a + np.cross(wd, p) + np.cross(w, np.cross(w, p)))
        w, wd = turned(w), turned(wd)
        d, dd = np.outer(qd[:, k], link.axis), np.outer(qdd[:, k], link.axis)
        if link.prismatic:
            a = a + dd + 2 * np.cross(w, d)
        else:
            wd = wd + dd + np.cross(w, d)
            w = w + d
        c = link.X_JL[1] + link.X_JL[0] @ link.com
        inertia = link.X_JL[0] @ link.inertia @ link.X_JL[0].T
        force = link.mass * (a + np.cross(wd, c) + np.cross(w, np.cross(w, c)))
        moment = wd @ inertia + np.cross(w, w @ inertia) + np.cross(c, force)
        rotations.append((R, p))
        states.append((force, moment))
    tau = np.zeros((count, n))
    force, moment = np.zeros((count, 3)), np.zeros((count, 3))
    for k in reversed(range(n)):
        link = robot.links[k]
        force, moment = force + states[k][0], moment + states[k][1]
        tau[:, k] = (force if link.prismatic else moment) @ link.axis
        terms = {"viscous": 0, "coulomb": 0, "armature": 0, "offset": 0} | link.terms
        tau[:, k] += (terms["viscous"] * qd[:, k] + terms["coulomb"] * np.sign(qd[:, k]) +
                      terms["armature"] * qdd[:, k] + terms["offset"])
        R, p = rotations[k]
        force = np.einsum("kij,kj->ki", R, force)
        moment = np.einsum("kij,kj->ki", R, moment) + np.cross(p, force)
    return tau


def numbers(values):
    return "[" + ", ".join(repr(float(x)) for x in np.ravel(values)) + "]"


def yaml(robot):
    convention = robot.convention
    lines = ["name: drawn", f"gravity: {numbers(robot.gravity)}",
             f"convention: {convention}", "links:"]
    for link in robot.links:
        keys = {"joint": "prismatic" if link.prismatic else "revolute"}
        if link.dh:
            keys |= {key: repr(float(value)) for key, value in link.dh.items()}
        else:
            for key, X in (("pose", link.X_PJ), ("link_pose", link.X_JL)):
                keys[key] = f"{{xyz: {numbers(X[1])}, rotation: {numbers(X[0])}}}"
            keys["axis"] = numbers(link.axis)
        if robot.bodies:
            keys |= {"mass": repr(float(link.mass)), "com": numbers(link.com),
                     "inertia": numbers(link.inertia[[0, 0, 1, 0, 1, 2], [0, 1, 1, 2, 2, 2]])}
        keys |= {key: repr(float(value)) for key, value in link.terms.items()}
        lines.append("- {" + ", ".join(f"{k}: {v}" for k, v in keys.items()) + "}")
    return "\n".join(lines) + "\n"


def rpy(R):
    """URDF's fixed-axis angles."""
    pitch = np.arctan2(-R[2, 0], np.hypot(R[0, 0], R[1, 0]))
    if abs(R[2, 0]) > 1 - 1e-12:
        return np.arctan2(-R[1, 2], R[1, 1]), pitch, 0.0
    return np.arctan2(R[2, 1], R[2, 2]), pitch, np.arctan2(R[1, 0], R[0, 0])


def urdf(robot):
    def text(values):
        return " ".join(repr(float(x)) for x in values)

    lines = ['<robot name="drawn">', '<link name="base"/>']
    for k, link in enumerate(robot.links):
        child, parent = f"link{k + 1}", f"link{k}" if k else "base"
        lines.append(f'<link name="{child}">')
        if robot.bodies:
            i = link.inertia
            lines.append(
                f'<inertial><origin xyz="{text(link.com)}"/><mass value="{link.mass!r}"/>'
                f'<inertia ixx="{i[0, 0]!r}" ixy="{i[0, 1]!r}" ixz="{i[0, 2]!r}" '
                f'iyy="{i[1, 1]!r}" iyz="{i[1, 2]!r}" izz="{i[2, 2]!r}"/></inertial>')
        dynamics = "".join(
            f' {name}="{float(link.terms[key])!r}"' for key, name in
            (("viscous", "damping"), ("coulomb", "friction")) if key in link.terms)
        lines.append(
            f'</link><joint name="joint{k + 1}" type="'
            f'{"prismatic" if link.prismatic else "revolute"}"><parent link="{parent}"/>'
            f'<child link="{child}"/><origin xyz="{text(link.X_PJ[1])}" '
            f'rpy="{text(rpy(link.X_PJ[0]))}"/><axis xyz="{text(link.axis)}"/>'
            f'<limit lower="-3" upper="3" velocity="3" effort="100"/>'
            + (f"<dynamics{dynamics}/>" if dynamics else "") + "</joint>")
    return "\n".join(lines + ["</robot>"]) + "\n"


def chance(rng, weights):
    """A key of {key: weight}."""
    keys = list(weights)
    p = np.array([weights[k] for k in keys], float)
    return keys[rng.choice(len(keys), p=p / p.sum())]


def scale(rng, usual=0.9):
    """1, or anything from 1e-9 to 1e6."""
    return 1.0 if rng.random() < usual else 10 ** rng.uniform(-9, 6)


def unit(rng):
    v = rng.normal(size=3)
    return v / np.linalg.norm(v)


def random_rotation(rng):
    return rotation(unit(rng), np.array(rng.uniform(-np.pi, np.pi)))


def geometry(rng, kind, n, length):
    """Per joint: X_PJ, axis, X_JL and the row of the DH table."""
    if kind in ("standard", "modified"):
        for _ in range(n):
            dh = {"a": length * rng.choice([0, rng.uniform(-1, 1)]),
                  "d": length * rng.choice([0, rng.uniform(-1, 1)]),
                  "alpha": rng.choice([0, np.pi / 2, -np.pi / 2, np.pi, rng.uniform(-3, 3)]),
                  "theta": rng.choice([0, rng.uniform(-3, 3)])}
            x, z = np.eye(3)[0], np.eye(3)[2]
            screw_z = (rotation(z, np.array(dh["theta"])), dh["d"] * z)
            screw_x = (rotation(x, np.array(dh["alpha"])), dh["a"] * x)
            yield ((IDENTITY, z, compose(screw_z, screw_x), dh) if kind == "standard" else
                   (compose(screw_x, screw_z), z, IDENTITY, dh))
        return
    z = np.eye(3)[2]
    for k in range(n):
        p = length * rng.uniform(-1, 1, 3)
        if kind == "random":
            yield (random_rotation(rng), p), unit(rng), (random_rotation(rng), p[::-1]), {}
        elif kind == "parallel":
            yield (np.eye(3), p), z, IDENTITY, {}
        elif kind == "nearly parallel":
            tilt = rotation(unit(rng), np.array(10 ** rng.uniform(-12, -3)))
            yield (tilt, p), z, IDENTITY, {}
        elif kind == "intersecting":
            yield (random_rotation(rng), np.zeros(3) if k % 3 else p), z, IDENTITY, {}
        elif kind == "all in one point":
            yield (random_rotation(rng), np.zeros(3)), unit(rng), IDENTITY, {}
        else:  # the same axis over and over
            yield IDENTITY, z, (np.eye(3), np.zeros(3)), {}


def body(rng, kind, length, mass):
    """Mass, com, inertia about it."""
    if kind == "massless" or (kind == "some massless" and rng.random() < 0.4):
        return 0.0, np.zeros(3), np.zeros((3, 3))
    com = length * rng.uniform(-0.5, 0.5, 3) * (rng.random() < 0.8)
    points = rng.normal(size=(3, 4)) * length * 0.3  # masses in four points
    if kind == "particles":
        points *= 0
    elif kind == "rods":
        points[1:] = 0
    elif kind == "plates":
        points[2:] = 0
    square = mass * points @ points.T
    inertia = np.trace(square) * np.eye(3) - square
    if kind == "impossible":
        inertia = np.diag([1.0, 1.0, 5.0]) * mass * length ** 2 * rng.uniform(0.1, 1)
    return mass, com, inertia


def draw(rng, most_joints=20):
    n = int(rng.integers(1, 8) if rng.random() < 0.95 else rng.integers(min(8, most_joints), most_joints + 1))
    axes = chance(rng, {"random": 4, "parallel": 3, "nearly parallel": 1, "intersecting": 3,
                        "all in one point": 1, "one axis": 0.5, "standard": 3, "modified": 3})
    bodies = chance(rng, {"bodies": 8, "some massless": 2, "massless": 1, "particles": 1,
                          "rods": 1, "plates": 1, "impossible": 1, "none in the file": 1})
    slides = rng.choice([0, 0.3, 1], p=[0.6, 0.35, 0.05])
    length, mass, friction = scale(rng), scale(rng), scale(rng, 0.95)
    uneven = rng.random() < 0.05
    has = {key: rng.random() < 0.4 for key in ("viscous", "coulomb", "armature", "offset")}
    size = {"viscous": 1, "coulomb": 1, "armature": 0.1, "offset": 1}
    links = []
    for X_PJ, axis, X_JL, dh in geometry(rng, axes, n, length):
        own = 10 ** rng.uniform(-9, 6) if uneven else 1.0
        m, com, inertia = body(rng, bodies, length, mass * own * rng.uniform(0.1, 10))
        terms = {key: friction * size[key] * rng.choice([0, rng.uniform(0, 1)], p=[0.2, 0.8])
                 for key in has if has[key]}
        links.append(Link(rng.random() < slides, X_PJ, axis, X_JL, m, com, inertia, terms, dh))
    gravity = chance(rng, {"down": 6, "tilted": 2, "along the first axis": 1, "none": 1.5,
                           "sideways": 1, "strange": 0.5})
    first = links[0].X_PJ[0] @ links[0].axis
    g = {"down": [0, 0, -G], "tilted": G * unit(rng), "along the first axis": -G * first,
         "none": [0, 0, 0], "sideways": [G, 0, 0],
         "strange": unit(rng) * 10 ** rng.uniform(-9, 6)}[gravity]
    convention = axes if dh else "poses"
    if axes in ("parallel", "nearly parallel", "intersecting") and rng.random() < 0.5 and (
            not has["armature"] and not has["offset"]):
        convention = "urdf"
        if gravity != "down":
            g, gravity = [0, 0, -G], "down"
    kinds = {"joints": f"{n}" if n < 8 else "8 to 20", "axes": axes, "bodies": bodies,
             "slides": {0: "none", 0.3: "some", 1: "all"}[slides], "gravity": gravity,
             "lengths": "usual" if length == 1 else "huge or tiny",
             "masses": ("uneven" if uneven else "usual" if mass == 1 else "huge or tiny"),
             "joint terms": ("in the file" if any(has.values()) else "none"),
             "robot file": convention}
    return Robot(links, np.array(g, float), convention, bodies != "none in the file", kinds,
                 length)
