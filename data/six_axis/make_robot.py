#!/usr/bin/env python3
"""Writes a six-axis arm of the size of a 5 kg cobot, twice.

robot.urdf is what its maker would publish; real.yaml, a DH table, is the same
arm with the inertia of its motors (armature), for which URDF has no field.
Links are solid cylinders; all numbers are ours. Plain Python 3, no packages.
"""

import math
import pathlib

# name, then standard DH a, d (m), alpha (rad); mass (kg), radius (m), damping
# (N m s/rad), friction (N m), armature (kg m^2), range to both sides (rad),
# speed (rad/s), effort (N m)
HALF = math.pi / 2
LINKS = [
    ("shoulder", 0, .16, HALF, 3.8, .06, 6, 6, 1.2, 2.6, 3, 150),
    ("upper_arm", -.42, 0, 0, 8.0, .055, 7, 7, 1.2, 1.6, 3, 150),
    ("forearm", -.39, 0, 0, 2.6, .045, 4, 4, .7, 2.4, 3, 150),
    ("wrist_1", 0, .11, HALF, 1.3, .04, .9, 1.1, .15, 2.6, 3.5, 28),
    ("wrist_2", 0, .095, -HALF, 1.3, .04, .8, 1.0, .15, 2.6, 3.5, 28),
    ("wrist_3", 0, .08, 0, .4, .035, .7, .9, .15, 2.6, 3.5, 28),
]
PAIRS = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))


def cylinder(mass, along, radius):
    """Inertia about the centre of a cylinder from 0 to `along`, kg m^2."""
    length = math.sqrt(sum(x * x for x in along))
    e = [x / length for x in along]
    axial = mass * radius**2 / 2
    across = mass * (3 * radius**2 + length**2) / 12
    return [[(across if i == j else 0) + (axial - across) * e[i] * e[j]
             for j in range(3)] for i in range(3)]


def about_x(alpha):
    c, s = math.cos(alpha), math.sin(alpha)
    return [[1, 0, 0], [0, c, -s], [0, s, c]]


def turned(inertia, r):
    """r' inertia r."""
    return [[sum(r[k][i] * inertia[k][m] * r[m][j]
                 for k in range(3) for m in range(3))
             for j in range(3)] for i in range(3)]


def text(values, gap=" "):
    return gap.join(f"{0 if abs(x) < 1e-12 else x:.6g}" for x in values)


def urdf():
    lines = ['<?xml version="1.0"?>', '<robot name="six_axis">',
             '  <link name="base"/>']
    parent, step, roll = "base", (0, 0, 0), 0
    for (name, a, d, alpha, mass, radius, damping, friction, _, reach, speed,
         effort) in LINKS:
        inertia = cylinder(mass, (a, 0, d), radius)
        entries = " ".join(
            f'{"ixx ixy ixz iyy iyz izz".split()[k]}="{inertia[i][j]:.6g}"'
            for k, (i, j) in enumerate(PAIRS))
        lines += [
            f'  <link name="{name}">', "    <inertial>",
            f'      <origin xyz="{text((a / 2, 0, d / 2))}"/>',
            f'      <mass value="{mass}"/>', f"      <inertia {entries}/>",
            "    </inertial>", "  </link>",
            f'  <joint name="{name}_joint" type="revolute">',
            f'    <parent link="{parent}"/>', f'    <child link="{name}"/>',
            f'    <origin xyz="{text(step)}" rpy="{roll:.15g} 0 0"/>',
            '    <axis xyz="0 0 1"/>',
            f'    <limit lower="{-reach}" upper="{reach}" effort="{effort}" '
            f'velocity="{speed}"/>',
            f'    <dynamics damping="{damping}" friction="{friction}"/>',
            "  </joint>"]
        parent, step, roll = name, (a, 0, d), alpha
    lines += ['  <link name="tool"/>',
              '  <joint name="tool_joint" type="fixed">',
              f'    <parent link="{parent}"/>', '    <child link="tool"/>',
              f'    <origin xyz="{text(step)}" rpy="{roll:.15g} 0 0"/>',
              "  </joint>", "</robot>", ""]
    return "\n".join(lines)


def dh_table():
    lines = ["name: six_axis", "convention: standard", "links:"]
    for (name, a, d, alpha, mass, radius, damping, friction, armature, reach,
         speed, effort) in LINKS:
        r = about_x(alpha)
        com = [sum(r[k][i] * (-a / 2, 0, -d / 2)[k] for k in range(3))
               for i in range(3)]
        i = turned(cylinder(mass, (a, 0, d), radius), r)
        lines += [
            f"  - name: {name}", f"    joint_name: {name}_joint",
            "    joint: revolute", f"    a: {a}", f"    d: {d}",
            f"    alpha: {alpha:.15g}", f"    mass: {mass}",
            f"    com: [{text(com, ', ')}]",
            "    inertia: [" + text((i[0][0], i[0][1], i[1][1], i[0][2],
                                     i[1][2], i[2][2]), ", ") + "]",
            f"    limits: {{lower: {-reach}, upper: {reach}, "
            f"velocity: {speed}, effort: {effort}}}",
            f"    viscous: {damping}", f"    coulomb: {friction}",
            f"    armature: {armature}"]
    return "\n".join(lines) + "\n"


def main():
    here = pathlib.Path(__file__).parent
    (here / "robot.urdf").write_text(urdf())
    (here / "real.yaml").write_text(dh_table())


if __name__ == "__main__":
    main()
