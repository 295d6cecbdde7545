#!/usr/bin/env python3
"""Writes a torso with two arms and grippers, twice.

robot.urdf is what its maker would publish; real.yaml, by poses, is the same with
the left gripper held closed and the inertia of the motors (armature), for which
URDF has no field. The left gripper's second finger follows its first; the right
one has a jaw that does not move. Links are solid cylinders; all numbers are
ours. Plain Python 3, no packages.
"""

import pathlib

# name, parent, joint, origin on the parent (m), axis, along (m), mass (kg),
# radius (m), damping (N m s/rad, N s/m), friction (N m, N), armature (kg m^2,
# kg), limits (rad, m), speed (rad/s, m/s), effort (N m, N)
TURNS, SLIDES = "revolute", "prismatic"


def arm(side, y):
    return [
        (f"{side}_shoulder", "torso", TURNS, (0, .18 * y, .35), (0, 1, 0),
         (0, .12 * y, 0), 3.2, .05, 3, 3, .6, (-2.4, 2.4), 2.5, 90),
        (f"{side}_upper_arm", f"{side}_shoulder", TURNS, (0, .12 * y, 0),
         (1, 0, 0), (0, 0, -.3), 2.6, .045, 2.5, 2.5, .5, (-1.6, 1.6), 2.5, 80),
        (f"{side}_forearm", f"{side}_upper_arm", TURNS, (0, 0, -.3), (0, 1, 0),
         (0, 0, -.26), 1.7, .04, 1.5, 1.5, .3, (-2.2, 2.2), 3, 45),
        (f"{side}_hand", f"{side}_forearm", TURNS, (0, 0, -.26), (1, 0, 0),
         (0, 0, -.12), .9, .04, .5, .6, .08, (-1.5, 1.5), 3.5, 15),
        (f"{side}_finger", f"{side}_hand", SLIDES, (0, .02, -.12), (0, 1, 0),
         (0, 0, -.06), .15, .01, 20, 2, .6, (0, .04), .2, 40),
    ]


LINKS = [("torso", "base", TURNS, (0, 0, .5), (0, 0, 1), (0, 0, .4), 14, .12, 8,
          6, 2, (-2.2, 2.2), 1.5, 150)] + arm("left", 1) + arm("right", -1)
OTHER_FINGER = "left_finger_2"
PAIRS = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))


def cylinder(mass, along, radius):
    """Inertia about the centre of a cylinder from 0 to `along`, kg m^2."""
    length = sum(x * x for x in along)**.5
    e = [x / length for x in along]
    axial = mass * radius**2 / 2
    across = mass * (3 * radius**2 + length**2) / 12
    return [[(across if i == j else 0) + (axial - across) * e[i] * e[j]
             for j in range(3)] for i in range(3)]


def mirrored(y):
    return y[0], -y[1], y[2]


def body(mass, along, radius, origin=(0, 0, 0)):
    """m, h, I about the frame in which the cylinder begins at `origin`, in the
    order of armcal: kg, kg m, kg m^2."""
    com = [o + x / 2 for o, x in zip(origin, along)]
    inertia = cylinder(mass, along, radius)
    square = sum(c * c for c in com)
    about = [[inertia[i][j] + mass * ((square if i == j else 0) -
                                      com[i] * com[j])
              for j in range(3)] for i in range(3)]
    return ([mass] + [mass * c for c in com] +
            [about[0][0], about[0][1], about[1][1], about[0][2], about[1][2],
             about[2][2]])


def text(values, gap=" "):
    return gap.join(f"{x:.6g}" for x in values)


def urdf_link(name, mass, along, radius):
    inertia = cylinder(mass, along, radius)
    entries = " ".join(f'i{"xyz"[i]}{"xyz"[j]}="{inertia[i][j]:.6g}"'
                       for i, j in PAIRS)
    return [f'  <link name="{name}">', "    <inertial>",
            f'      <origin xyz="{text(x / 2 for x in along)}"/>',
            f'      <mass value="{mass:.6g}"/>', f"      <inertia {entries}/>",
            "    </inertial>", "  </link>"]


def urdf_joint(name, kind, parent, child, origin, axis, more):
    return [f'  <joint name="{name}" type="{kind}">',
            f'    <parent link="{parent}"/>', f'    <child link="{child}"/>',
            f'    <origin xyz="{text(origin)}"/>', f'    <axis xyz="{text(axis)}"/>',
            *more, "  </joint>"]


def urdf():
    lines = ['<?xml version="1.0"?>', '<robot name="two_arms">',
             '  <link name="base"/>']
    for (name, parent, kind, origin, axis, along, mass, radius, damping,
         friction, _, limits, speed, effort) in LINKS:
        lines += urdf_link(name, mass, along, radius)
        limit = (f'    <limit lower="{limits[0]}" upper="{limits[1]}" '
                 f'velocity="{speed}" effort="{effort}"/>')
        lines += urdf_joint(name + "_joint", kind, parent, name, origin, axis, [
            limit, f'    <dynamics damping="{damping}" friction="{friction}"/>'])
        if name == "left_finger":
            lines += urdf_link(OTHER_FINGER, mass, along, radius)
            lines += urdf_joint(
                OTHER_FINGER + "_joint", kind, parent, OTHER_FINGER,
                mirrored(origin), mirrored(axis),
                [limit, f'    <mimic joint="{name}_joint"/>'])
    return "\n".join(lines + ["</robot>", ""])


def yaml():
    lines = ["name: two_arms", "convention: poses", "links:"]
    before = "base"
    for (name, parent, kind, origin, axis, along, mass, radius, damping,
         friction, armature, limits, speed, effort) in LINKS:
        if name == "left_finger":  # held closed, with its other
            continue
        numbers = body(mass, along, radius)
        if name == "left_hand":
            finger, = (row for row in LINKS if row[0] == "left_finger")
            for at in (finger[3], mirrored(finger[3])):
                more = body(finger[6], finger[5], finger[7], at)
                numbers = [x + y for x, y in zip(numbers, more)]
        lines += [f"  - name: {name}", f"    joint: {kind}",
                  f"    joint_name: {name}_joint"]
        if parent != before:
            lines.append(f"    parent: {parent}")
        lines += [f"    pose: {{xyz: [{text(origin, ', ')}]}}",
                  f"    axis: [{text(axis, ', ')}]",
                  f"    inertial: [{text(numbers, ', ')}]",
                  f"    limits: {{lower: {limits[0]}, upper: {limits[1]}, "
                  f"velocity: {speed}, effort: {effort}}}",
                  f"    viscous: {damping}", f"    coulomb: {friction}",
                  f"    armature: {armature}"]
        before = name
    return "\n".join(lines + [""])


def main():
    here = pathlib.Path(__file__).parent
    (here / "robot.urdf").write_text(urdf())
    (here / "real.yaml").write_text(yaml())


if __name__ == "__main__":
    main()
