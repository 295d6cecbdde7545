"""Robots in YAML: DH tables and chains of poses."""

from inputs import (ARM, LOG, Group, Row, a_folder, edited, linked, nothing,
                    padded, removed, replaced, written)

COMMAND = "calibrate --robot=robot.yaml --log=log.csv --out=out"
LAST = "{joint: revolute, a: 0.3}"


def arm(old, new):
    return replaced("robot.yaml", old, new)


def link(text):
    """The last link of the arm."""
    return arm(LAST, "{" + text + "}")


LAUGHS = "a0: &a0 [x, x, x, x, x, x, x, x, x]\n" + "".join(
    f"a{k}: &a{k} [{', '.join([f'*a{k - 1}'] * 9)}]\n" for k in range(1, 10))

GROUPS = [Group("YAML", COMMAND, {"robot.yaml": ARM, "log.csv": LOG}, [

    # No file, or no YAML.
    Row("missing", removed("robot.yaml"),
        "robot.yaml: cannot be opened: No such file or directory"),
    Row("empty", written("robot.yaml", ""),
        "robot.yaml: the file is empty"),
    Row("comment alone", written("robot.yaml", "# nothing\n"),
        "robot.yaml: expected one YAML document and nothing after it"),
    Row("folder", a_folder("robot.yaml"),
        "robot.yaml: is a folder: expected a file"),
    Row("endless zeros", linked("robot.yaml", "/dev/zero"),
        "robot.yaml: is larger than 1 MiB, the most that such a file may have"),
    Row("2 MiB", padded("robot.yaml", 2 << 20),
        "robot.yaml: is larger than 1 MiB, the most that such a file may have"),
    Row("UTF-16", edited("robot.yaml", lambda x: x.decode().encode("utf-16")),
        "robot.yaml: is UTF-16: expected UTF-8 text"),
    Row("NUL byte", arm("standard", "stand\0ard"),
        "robot.yaml: contains NUL bytes: expected UTF-8 text"),
    Row("tab as indentation", arm("  - {joint: revolute, a: 0.4}", "\t- {joint: revolute}"),
        "robot.yaml: line 3: not well-formed YAML (illegal block entry)"),
    Row("bracket not closed", arm(LAST, "{joint: revolute, a: 0.3"),
        "robot.yaml: line 5: not well-formed YAML (end of map flow not found)"),
    Row("quote not closed", arm("standard", '"standard'),
        "robot.yaml: line 1, convention: found 'standard links: - {joint: revolute, a: 0.4} "
        "- {joint: revolute, a: 0.3} ': expected one of standard, modified, poses"),
    Row("stray bracket", edited("robot.yaml", lambda x: x + b"}\n"),
        "robot.yaml: line 5: not well-formed YAML (illegal flow end)"),
    Row("two documents", edited("robot.yaml", lambda x: x + b"---\n" + x),
        "robot.yaml: expected one YAML document and nothing after it"),
    Row("a list", written("robot.yaml", "- standard\n"),
        "robot.yaml: line 1: found '[standard]': expected a map with the keys name, "
        "gravity, convention, links, tool"),
    Row("a word", written("robot.yaml", "robot\n"),
        "robot.yaml: line 1: found 'robot': expected a map with the keys name, gravity, "
        "convention, links, tool"),
    Row("URDF", written("robot.yaml", '<robot name="x"/>'),
        'robot.yaml: line 1: found \'<robot name="x"/>\': expected a map with the keys name, '
        "gravity, convention, links, tool"),

    # Attacks.
    Row("billion laughs", written("robot.yaml", LAUGHS + ARM),
        "robot.yaml: line 1: found 'a0': expected one of the keys name, gravity, "
        "convention, links, tool"),
    Row("laughs as links", written("robot.yaml", "convention: standard\ntool:\n  name: &a0 [x, x, x, x, x, x, x, x, x]\n"
                             + LAUGHS.partition("\n")[2].replace("\na", "\n  a").replace("a1:", "  a1:", 1) + "links: *a9\n"),
        "robot.yaml: line 11, links[1]: found 'a list of 9': expected a map with the keys "
        "name, joint, joint_name, a, d, alpha, theta, unknown, mass, com, inertia, limits, "
        "viscous, coulomb, armature, offset, zero, inertial, parent"),
    Row("anchor in itself", arm(LAST, "&a {joint: revolute, a: *a}"),
        "robot.yaml: line 4, links[2].a: expected a number in m"),
    Row("list in itself", written("robot.yaml", "convention: standard\nlinks: &a [*a]\n"),
        "robot.yaml: line 2, links[1]: found 'a list of 1': expected a map with the keys "
        "name, joint, joint_name, a, d, alpha, theta, unknown, mass, com, inertia, limits, "
        "viscous, coulomb, armature, offset, zero, inertial, parent"),
    Row("anchor that is not there", arm("0.3", "*length"),
        "robot.yaml: line 4: not well-formed YAML (the referenced anchor is not defined)"),
    Row("tag of a Python object", arm("0.3", "!!python/object/apply:os.system [touch owned]"),
        "robot.yaml: line 4, links[2].a: found '[touch owned]': expected a number in m"),
    Row("100000 nested lists", written("robot.yaml", lambda: "links: " + "[" * 100000),
        "robot.yaml: line 1: lists and maps are nested too deeply"),
    Row("50000 nested maps", written("robot.yaml", lambda: "links: " + "{a: " * 50000),
        "robot.yaml: line 1: lists and maps are nested too deeply"),
    Row("20000 indented lists", written("robot.yaml", lambda: "- " * 20000 + "x\n"),
        "robot.yaml: line 1: lists and maps are nested too deeply"),
    Row("40000 joints", written("robot.yaml", lambda: "convention: standard\nlinks:\n"
                                 + "  - {joint: revolute}\n" * 40000),
        "robot.yaml: line 3, links: found 'a list of 40000': expected at most 64 links"),
    Row("300000 values", written("robot.yaml", lambda: "links: [" + "1, " * 300000 + "1]\n"),
        "robot.yaml: line 1: expected a key 'convention'"),
    Row("65 joints", written("robot.yaml", "convention: standard\nlinks:\n"
                             + "  - {joint: revolute}\n" * 65),
        "robot.yaml: line 3, links: found 'a list of 65': expected at most 64 links"),

    # Keys and values.
    Row("convention missing", arm("convention: standard\n", ""),
        "robot.yaml: line 1: expected a key 'convention'"),
    Row("convention unknown", arm("standard", "khalil"),
        "robot.yaml: line 1, convention: found 'khalil': expected one of standard, "
        "modified, poses"),
    Row("links missing", written("robot.yaml", "convention: standard\n"),
        "robot.yaml: line 1: expected a key 'links'"),
    Row("links empty", written("robot.yaml", "convention: standard\nlinks: []\n"),
        "robot.yaml: line 2, links: found '[]': expected at least one link"),
    Row("links a word", written("robot.yaml", "convention: standard\nlinks: two\n"),
        "robot.yaml: line 2, links: found 'two': expected a list"),
    Row("key unknown", edited("robot.yaml", lambda x: x + b"gravitation: [0, 0, 1]\n"),
        "robot.yaml: line 5: found 'gravitation': expected one of the keys name, gravity, "
        "convention, links, tool"),
    Row("key twice", edited("robot.yaml", lambda x: x + b"convention: modified\n"),
        "robot.yaml: line 5: found 'convention': the key is given twice"),
    Row("key of a link unknown", link("joint: revolute, aa: 1"),
        "robot.yaml: line 4, links[2]: found 'aa': expected one of the keys name, joint, "
        "joint_name, a, d, alpha, theta, unknown, mass, com, inertia, limits, viscous, "
        "coulomb, armature, offset, zero, inertial, parent"),
    Row("joint missing", link("a: 0.3"),
        "robot.yaml: line 4, links[2]: expected a key 'joint'"),
    Row("joint unknown", link("joint: ball"),
        "robot.yaml: line 4, links[2].joint: found 'ball': expected one of revolute, "
        "continuous, prismatic"),
    Row("mass with unit", link("joint: revolute, mass: 2kg"),
        "robot.yaml: line 4, links[2].mass: found '2kg': expected a number in kg"),
    Row("mass with decimal comma", link("joint: revolute, mass: '2,5'"),
        "robot.yaml: line 4, links[2].mass: found '2,5': expected a number in kg, with a "
        "decimal point"),
    Row("mass negative", link("joint: revolute, mass: -2"),
        "robot.yaml: line 4, links[2].mass: found '-2': expected a number in kg that is not "
        "negative"),
    Row("mass .nan", link("joint: revolute, mass: .nan"),
        "robot.yaml: line 4, links[2].mass: found '.nan': expected a number in kg"),
    Row("mass .inf", link("joint: revolute, mass: .inf"),
        "robot.yaml: line 4, links[2].mass: found '.inf': expected a number in kg"),
    Row("mass empty", link("joint: revolute, mass: "),
        "robot.yaml: line 4, links[2].mass: expected a number in kg"),
    Row("mass a list", link("joint: revolute, mass: [2]"),
        "robot.yaml: line 4, links[2].mass: found '[2]': expected a number in kg"),
    Row("com without mass", link("joint: revolute, com: [0, 0, 0]"),
        "robot.yaml: line 4, links[2].com: found '[0, 0, 0]': expected the link's mass as "
        "well"),
    Row("com of two numbers", link("joint: revolute, mass: 2, com: [0, 0]"),
        "robot.yaml: line 4, links[2].com: found '[0, 0]': expected a list of three numbers "
        "in m"),
    Row("inertia of four numbers", link("joint: revolute, mass: 2, inertia: [1, 1, 1, 1]"),
        "robot.yaml: line 4, links[2].inertia: found '[1, 1, 1, 1]': expected a list of "
        "Ixx, Ixy, Iyy, Ixz, Iyz, Izz or Ixx, Iyy, Izz"),
    Row("inertia negative", link("joint: revolute, mass: 2, inertia: [1, -1, 1]"),
        "robot.yaml: line 4, links[2].inertia: found '[1, -1, 1]': expected Ixx, Iyy and "
        "Izz that are not negative"),
    Row("limits swapped", link("joint: revolute, limits: {lower: 2, upper: 1}"),
        "robot.yaml: line 4, links[2].limits.lower: found '2': expected less than the upper "
        "limit 1"),
    Row("limits of a continuous joint", link("joint: continuous, limits: {lower: 2}"),
        "robot.yaml: line 4, links[2].limits.lower: found '2': expected no position limits "
        "of a continuous joint; is it revolute?"),
    Row("velocity limit 0", link("joint: revolute, limits: {velocity: 0}"),
        "robot.yaml: line 4, links[2].limits.velocity: found '0': expected a positive "
        "number in rad/s"),
    Row("friction negative", link("joint: revolute, coulomb: -1"),
        "robot.yaml: line 4, links[2].coulomb: found '-1': expected a number in N m that is "
        "not negative"),
    Row("gravity of two numbers", edited("robot.yaml", lambda x: x + b"gravity: [0, 9.8]\n"),
        "robot.yaml: line 5, gravity: found '[0, 9.8]': expected a list of three numbers in "
        "m/s^2"),
    Row("length beyond what can be calculated", link("joint: revolute, mass: 2, com: [1e200, 0, 0]"),
        "robot.yaml: the numbers of link 'link2' are too large to calculate with"),
    Row("unknown length that is none", link("joint: revolute, unknown: [alpha]"),
        "robot.yaml: line 4, links[2].unknown[1]: found 'alpha': expected one of a, d"),
    Row("name twice", link("joint: revolute, name: link1"),
        "robot.yaml: line 4, links[2]: the link name 'link1' is used before"),
    Row("name of two lines", link('joint: revolute, name: "a\\nb"'),
        "robot.yaml: line 4, links[2].name: found 'a b': expected a name without control "
        "characters"),
    Row("DH row among poses", arm("standard", "poses"),
        "robot.yaml: line 3, links[1]: found 'a': expected one of the keys name, joint, "
        "joint_name, pose, axis, link_pose, mass, com, inertia, limits, viscous, coulomb, "
        "armature, offset, zero, inertial, parent"),
    Row("axis zero", written("robot.yaml", "convention: poses\nlinks:\n"
                             "  - {joint: revolute, axis: [0, 0, 0]}\n"),
        "robot.yaml: line 3, links[1].axis: found '[0, 0, 0]': expected an axis that is not "
        "zero"),
    Row("pose unknown", written("robot.yaml", "convention: poses\nlinks:\n"
                                "  - {joint: revolute, pose: {x: 1}}\n"),
        "robot.yaml: line 3, links[1].pose: found 'x': expected one of the keys xyz, rpy, "
        "rotation"),
    Row("tool of a word", edited("robot.yaml", lambda x: x + b"tool: gripper\n"),
        "robot.yaml: line 5, tool: found 'gripper': expected a map with the keys name, x, "
        "y, z, roll, pitch, yaw"),
    Row("base of a table", nothing,
        "robot.yaml: --base: found 'link1': expected no such flag with a YAML robot, all "
        "of which is used", COMMAND + " --base=link1"),
])]
