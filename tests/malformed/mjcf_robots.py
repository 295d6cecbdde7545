"""Robots in MuJoCo's MJCF."""

from inputs import (LOG, Group, Row, cut, nothing, padded, replaced, written)

MJCF = """<mujoco model="two">
  <compiler angle="radian"/>
  <default>
    <default class="strong"> <joint damping="1"/> </default>
  </default>
  <worldbody>
    <body name="arm">
      <inertial pos="0.1 0 0" mass="2" diaginertia="1 1 1"/>
      <joint name="shoulder" type="hinge" axis="0 0 1"/>
      <body name="hand" pos="1 0 0">
        <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
        <joint name="elbow" type="hinge" axis="0 1 0" range="-1 1"/>
        <geom name="ball" type="sphere" size="0.1"/>
      </body>
    </body>
  </worldbody>
</mujoco>
"""
COMMAND = "calibrate --robot=robot.xml --log=log.csv --out=out"


def mjcf(old, new):
    return replaced("robot.xml", old, new)


def nested(depth):
    return lambda: ("<mujoco><worldbody>" + "<body>" * depth + "</body>" * depth
                    + "</worldbody></mujoco>")


GROUPS = [Group("MJCF", COMMAND, {"robot.xml": MJCF, "log.csv": LOG}, [
    Row("cut", cut("robot.xml", 300),
        "robot.xml: line 10: an element is not closed or closed by another name; is the "
        "file truncated?"),
    Row("another root", written("robot.xml", "<model/>"),
        "robot.xml: line 1, <model>: found 'model': expected the root element <robot> "
        "(URDF), <mujoco> (MJCF) or <sdf>"),
    Row("no bodies", written("robot.xml", "<mujoco/>"),
        "robot.xml: expected a joint that moves a link of base link 'world'"),
    Row("33 MiB", padded("robot.xml", 33 << 20),
        "robot.xml: is larger than 32 MiB, the most that such a file may have"),

    # Attacks.
    Row("entity", mjcf("<mujoco", '<!DOCTYPE mujoco [<!ENTITY m SYSTEM "/etc/passwd">]>\n<mujoco'),
        "robot.xml: line 1: found '<!DOCTYPE': expected no DOCTYPE or entity declarations"),
    Row("include", mjcf("<worldbody>", '<include file="../../../etc/passwd"/><worldbody>'),
        "robot.xml: line 6, <include file>: found '../../../etc/passwd': expected a file in the "
        "robot file's own folder; --robot_folder=DIR allows those in another"),
    Row("include by an absolute path", mjcf("<worldbody>", '<include file="/dev/zero"/><worldbody>'),
        "robot.xml: line 6, <include file>: found '/dev/zero': expected a file in the "
        "robot file's own folder; --robot_folder=DIR allows those in another"),
    Row("include of a device", mjcf("<worldbody>", '<include file="/dev/zero"/><worldbody>'),
        "robot.xml: line 6, <include file>: found '/dev/zero': expected a file that exists",
        COMMAND + " --robot_folder=/"),
    Row("mesh of a device", written("robot.xml", MJCF.replace(
        '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>', '<geom type="mesh" mesh="m"/>').replace(
            "<worldbody>", '<asset><mesh name="m" file="/dev/zero"/></asset><worldbody>')),
        "robot.xml: line 6, <mesh file>: found '/dev/zero': expected a file in the robot file's "
        "own folder; --robot_folder=DIR allows those in another"),
    Row("include of itself", mjcf("<worldbody>", '<include file="robot.xml"/><worldbody>'),
        "robot.xml: line 6, <include file>: found 'robot.xml': expected a file that is not "
        "included already"),
    Row("100000 nested bodies", written("robot.xml", nested(100000)),
        "robot.xml: line 1: elements are nested too deeply"),
    Row("20000 bodies in a row", written("robot.xml", lambda: MJCF.replace(
        "</worldbody>", "".join(f'<body name="b{k}"><joint name="j{k}"/></body>\n'
                                for k in range(20000)) + "</worldbody>")),
        "robot.xml: found 'hand, b0, b1, b2, b3, b4, b5, b6, b7, b8, b9, b10, b11, b12, "
        "b13, b14, b15, b16, b17, b18, b19, b20, b21, b22, b23, b24, b25, b26, b27, b28, "
        "b29, b30, b31, b32, b33, b34, b35, b36, b37, b38 and 19961 more': expected one "
        "chain: choose its last link with --tip, or several, as in --tip=hand,b0; what other "
        "joints move counts as held still (--posture)"),
    Row("20000 joints of a body", mjcf('<joint name="elbow"', "".join(
        f'<joint name="j{k}"/>\n' for k in range(20000)) + '<joint name="elbow"'),
        "robot.xml: found '20002 joints': expected at most 64 moving joints in the chain"),
    Row("nested defaults", mjcf('<default class="strong">', "".join(
        f'<default class="c{k}">' for k in range(300)) + "</default>" * 300
        + '<default class="strong">'),
        "robot.xml: line 4: elements are nested too deeply"),
    Row("plugin", mjcf('<geom name="ball"', '<replicate count="1000000000"><geom size="1"/></replicate>'
                       '<geom name="ball"'),
        "robot.xml: line 13, <replicate> of body 'hand': found 'replicate': expected a body, "
        "inertial, joint, geom, site, camera, light or frame; what MuJoCo makes bodies from, "
        "its compile turns into them"),

    # What MuJoCo would make of it is not what armcal can.
    Row("composite", mjcf('<geom name="ball"', '<composite type="rope"/><geom name="ball"'),
        "robot.xml: line 13, <composite> of body 'hand': found 'composite': expected a body, "
        "inertial, joint, geom, site, camera, light or frame; what MuJoCo makes bodies from, "
        "its compile turns into them"),
    Row("attach", mjcf('<geom name="ball"', '<attach model="x" prefix="y"/><geom name="ball"'),
        "robot.xml: line 13, <attach> of body 'hand': found 'attach': expected a body, "
        "inertial, joint, geom, site, camera, light or frame; what MuJoCo makes bodies from, "
        "its compile turns into them"),
    Row("global coordinates", mjcf('angle="radian"', 'coordinate="global"'),
        "robot.xml: line 2, <compiler coordinate>: found 'global': expected local, as "
        "MuJoCo itself does since 2.3.4; MuJoCo 2.3.3 saves a global model as a local one"),
    Row("loop", mjcf("</worldbody>", '</worldbody><equality><connect body1="hand"/></equality>'),
        "robot.xml: line 16, equality <connect>, which closes a loop: found 'shoulder, elbow': "
        "expected joints that move on their own in the chain: armcal's arms are open chains; "
        "and where the real robot has no such part, take it out of the file"),
    Row("Euler sequence", mjcf('angle="radian"', 'eulerseq="xyw"'),
        "robot.xml: line 2, <compiler eulerseq>: found 'xyw': expected three of the letters "
        "xyzXYZ"),
    Row("angle unit", mjcf('angle="radian"', 'angle="grad"'),
        "robot.xml: line 2, <compiler angle>: found 'grad': expected degree or radian"),

    # Bodies.
    Row("body twice", mjcf('body name="hand"', 'body name="arm"'),
        "robot.xml: line 10, <body name> of body 'arm': found 'arm': expected a name that "
        "is not yet used (line 7)"),
    Row("mass missing", mjcf('mass="2" ', ""),
        "robot.xml: line 8, <inertial> of body 'arm': expected an attribute 'mass'"),
    Row("mass negative", mjcf('mass="2"', 'mass="-2"'),
        "robot.xml: line 8, <inertial mass> of body 'arm': found '-2': expected a number in "
        "kg that is not negative"),
    Row("mass in words", mjcf('mass="2"', 'mass="two"'),
        "robot.xml: line 8, <inertial mass> of body 'arm': found 'two': expected a number "
        "in kg"),
    Row("mass nan", mjcf('mass="2"', 'mass="nan"'),
        "robot.xml: line 8, <inertial mass> of body 'arm': found 'nan': expected a finite "
        "number in kg"),
    Row("mass inf", mjcf('mass="2"', 'mass="inf"'),
        "robot.xml: line 8, <inertial mass> of body 'arm': found 'inf': expected a finite "
        "number in kg"),
    Row("inertia of two numbers", mjcf('mass="2" diaginertia="1 1 1"', 'mass="2" diaginertia="1 1"'),
        "robot.xml: line 8, <inertial diaginertia> of body 'arm': found '1 1': expected "
        "three numbers in kg m^2"),
    Row("inertia negative", mjcf('mass="2" diaginertia="1 1 1"', 'mass="2" diaginertia="1 -1 1"'),
        "robot.xml: line 8, <inertial diaginertia> of body 'arm': found '1 -1 1': expected "
        "moments in kg m^2 that are not negative"),
    Row("inertia missing", mjcf('mass="2" diaginertia="1 1 1"', 'mass="2"'),
        "robot.xml: line 8, <inertial> of body 'arm': expected an attribute 'diaginertia'"),
    Row("full and diagonal", mjcf('mass="2" ', 'mass="2" fullinertia="1 1 1 0 0 0" '),
        "robot.xml: line 8, <inertial diaginertia> of body 'arm': found '1 1 1': expected "
        "none beside fullinertia, which is in the body's axes"),
    Row("position of two numbers", mjcf('pos="1 0 0"', 'pos="1 0"'),
        "robot.xml: line 10, <body pos> of body 'hand': found '1 0': expected three numbers "
        "in m"),
    Row("quaternion zero", mjcf('pos="1 0 0"', 'quat="0 0 0 0"'),
        "robot.xml: line 10, <body quat> of body 'hand': found '0 0 0 0': expected w x y z "
        "that are not all zero"),
    Row("two orientations", mjcf('pos="1 0 0"', 'quat="1 0 0 0" euler="0 0 1"'),
        "robot.xml: line 10, <body euler> of body 'hand': found '0 0 1': expected one "
        "orientation: there is quat already"),
    Row("childclass unknown", mjcf('name="hand"', 'name="hand" childclass="weak"'),
        "robot.xml: line 10, <body childclass> of body 'hand': found 'weak': expected one "
        "of the default classes main, strong"),

    # Joints.
    Row("joint twice", mjcf('joint name="elbow"', 'joint name="shoulder"'),
        "robot.xml: line 12, <joint name> of body 'hand': found 'shoulder': expected a name "
        "that is not yet used (line 9)"),
    Row("joint of unknown type", mjcf('name="elbow" type="hinge"', 'name="elbow" type="rotary"'),
        "robot.xml: line 12, <joint type> of joint 'elbow': found 'rotary': expected hinge, "
        "slide, ball or free"),
    Row("ball joint", mjcf('name="elbow" type="hinge"', 'name="elbow" type="ball"'),
        "robot.xml: line 12, joint 'elbow': found 'ball': expected a hinge or slide joint, "
        "or none, in the chain; --base=hand starts behind it"),
    Row("free joint", mjcf('<joint name="elbow" type="hinge" axis="0 1 0" range="-1 1"/>', "<freejoint/>"),
        "robot.xml: line 12, joint 'joint1': found 'free': expected a hinge or slide joint, "
        "or none, in the chain; --base=hand starts behind it"),
    Row("axis zero", mjcf('axis="0 1 0"', 'axis="0 0 0"'),
        "robot.xml: line 12, <joint axis> of joint 'elbow': found '0 0 0': expected an axis "
        "that is not zero"),
    Row("axis nan", mjcf('axis="0 1 0"', 'axis="0 nan 0"'),
        "robot.xml: line 12, <joint axis> of joint 'elbow': found '0 nan 0': expected three "
        "finite numbers"),
    Row("range swapped", mjcf('range="-1 1"', 'range="1 -1"'),
        "robot.xml: line 12, <joint range> of joint 'elbow': found '1 -1': expected the "
        "smaller number first"),
    Row("range of one number", mjcf('range="-1 1"', 'range="1"'),
        "robot.xml: line 12, <joint range> of joint 'elbow': found '1': expected two "
        "numbers in rad"),
    Row("damping negative", mjcf('axis="0 1 0"', 'axis="0 1 0" damping="-1"'),
        "robot.xml: line 12, <joint damping> of joint 'elbow': found '-1': expected a "
        "number in N m s/rad that is not negative"),
    Row("class unknown", mjcf('joint name="elbow"', 'joint class="weak" name="elbow"'),
        "robot.xml: line 12, <joint class> of joint 'elbow': found 'weak': expected one of "
        "the default classes main, strong"),
    Row("class twice", mjcf("</default>\n  </default>", '</default><default class="strong"/>\n  </default>'),
        "robot.xml: line 4, <default class> of default class 'main': found 'strong': "
        "expected a class that is not yet used"),
    Row("limited by a word", mjcf('range="-1 1"', 'range="-1 1" limited="yes"'),
        "robot.xml: line 12, <joint limited> of joint 'elbow': found 'yes': expected auto, "
        "true or false"),
    Row("two tips", mjcf("</worldbody>", '<body name="other"><joint name="x"/></body></worldbody>'),
        "robot.xml: found 'hand, other': expected one chain: choose its last link with "
        "--tip, or several, as in --tip=hand,other; what other joints move counts as held still "
        "(--posture)"),
    Row("motor of no joint", mjcf("</worldbody>", '</worldbody><actuator><motor joint="wrist"/></actuator>'),
        "robot.xml: line 16, <motor joint>: found 'wrist': expected one of the joints "
        "shoulder, elbow"),
    Row("tip that is no body", nothing,
        "robot.xml: --tip: found 'finger': expected one of the links world, arm, hand", COMMAND + " --tip=finger"),
]),

    # Bodies that have an inertia need no mesh: this one has no end.
    Group("MJCF with meshes", COMMAND, {"log.csv": LOG, "robot.xml": MJCF.replace(
        "<worldbody>", '<asset> <mesh name="skin" file="/dev/zero"/> </asset>\n<worldbody>'
    ).replace("<geom ", '<geom type="mesh" mesh="skin"/> <geom ')}, [])]
