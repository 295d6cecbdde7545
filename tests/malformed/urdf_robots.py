"""Robots in URDF."""

from inputs import (LOG, Group, Row, a_folder, both, cut, edited, linked, nothing,
                    padded, removed, replaced, written)

URDF = """<?xml version="1.0"?>
<robot name="two">
  <link name="base"/>
  <link name="arm">
    <inertial>
      <origin xyz="0.1 0 0" rpy="0 0 0"/>
      <mass value="2"/>
      <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>
    </inertial>
  </link>
  <link name="hand">
    <inertial>
      <mass value="1"/> <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0.0" ixz="0.0" iyz="0.0"/>
    </inertial>
  </link>
  <joint name="shoulder" type="revolute">
    <parent link="base"/> <child link="arm"/> <axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="9" velocity="9"/>
  </joint>
  <joint name="elbow" type="revolute">
    <parent link="arm"/> <child link="hand"/> <axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" effort="8" velocity="8"/>
    <dynamics damping="0.1" friction="0.2"/>
  </joint>
</robot>
"""
COMMAND = "calibrate --robot=robot.urdf --log=log.csv --out=out"


def urdf(old, new):
    return replaced("robot.urdf", old, new)


def added(text):
    return urdf("</robot>", text + "\n</robot>")


def joint(name, parent, child, kind="revolute"):
    return (f'<joint name="{name}" type="{kind}"> <parent link="{parent}"/>'
            f' <child link="{child}"/> </joint>')


def chain(joints):
    """A robot of many joints in a row."""
    links = "".join(f'<link name="l{k}"/>' for k in range(joints + 1))
    return lambda: (f'<robot name="long">\n{links}\n'
                    + "\n".join(joint(f"j{k}", f"l{k}", f"l{k + 1}", "continuous")
                                for k in range(joints)) + "\n</robot>")


def nested(depth):
    return lambda: "<robot>" + "<x>" * depth + "</x>" * depth + "</robot>"


ENTITIES = ('<!DOCTYPE robot [\n<!ENTITY a "2">\n' + "".join(
    f'<!ENTITY {chr(98 + k)} "{("&" + chr(97 + k) + ";") * 10}">\n' for k in range(9))
    + "]>\n<robot")

GROUPS = [Group("URDF", COMMAND, {"robot.urdf": URDF, "log.csv": LOG}, [

    # No file, or none of this kind.
    Row("missing", removed("robot.urdf"),
        "robot.urdf: cannot be opened: No such file or directory"),
    Row("empty", written("robot.urdf", ""),
        "robot.urdf: the file is empty"),
    Row("folder", a_folder("robot.urdf"),
        "robot.urdf: is a folder: expected a file"),
    Row("endless zeros", linked("robot.urdf", "/dev/zero"),
        "robot.urdf: is larger than 32 MiB, the most that such a file may have"),
    Row("endless noise", linked("robot.urdf", "/dev/urandom"),
        "robot.urdf: is larger than 32 MiB, the most that such a file may have"),
    Row("ending", written("robot.txt", URDF),
        "robot.txt: found '.txt': expected a robot file that ends in .urdf, .xml, .mjcf or "
        ".sdf (URDF, MJCF or SDF) or .yaml or .yml (DH table or poses)",
        "calibrate --robot=robot.txt --log=log.csv"),
    Row("no ending", written("robot", URDF),
        "robot: expected a robot file that ends in .urdf, .xml, .mjcf or .sdf (URDF, MJCF or "
        "SDF) or .yaml or .yml (DH table or poses)", "calibrate --robot=robot --log=log.csv"),
    Row("xacro by name", written("robot.xacro", URDF),
        "robot.xacro: expected a plain URDF: run xacro first "
        "(xacro robot.urdf.xacro > robot.urdf)", "calibrate --robot=robot.xacro --log=log.csv"),
    Row("text", written("robot.urdf", "robot\n"),
        "robot.urdf: line 1: expected XML: elements, and no text around them"),
    Row("YAML", written("robot.urdf", "convention: standard\n"),
        "robot.urdf: line 1: expected XML: elements, and no text around them"),
    Row("SDF", written("robot.urdf", '<sdf version="1.9"><model name="m"/></sdf>'),
        "robot.urdf: line 1, <model>: expected at least one <link>"),
    Row("SDF with others", written("robot.urdf", '<sdf version="1.9"><model name="m"><include>'
                                   "<uri>file:///etc/passwd</uri></include></model></sdf>"),
        "robot.urdf: line 1, <include>: expected a model that is one, of this file alone: gz sdf "
        "-p FILE writes out what it includes"),
    Row("HTML", written("robot.urdf", "<!DOCTYPE html>\n<html><body>404</body></html>"),
        "robot.urdf: line 1: found '<!DOCTYPE': expected no DOCTYPE or entity declarations"),
    Row("gzip", written("robot.urdf", b"\x1f\x8b\x08\0\0\0\0\0\0\3abc"),
        "robot.urdf: contains NUL bytes: expected UTF-8 text"),

    # Not well-formed.
    Row("cut in the middle", cut("robot.urdf", 400),
        "robot.urdf: line 14: an element is not closed or closed by another name; is the "
        "file truncated?"),
    Row("end tag missing", urdf("</robot>", ""),
        "robot.urdf: line 2: an element is not closed or closed by another name; is the "
        "file truncated?"),
    Row("closed by another name", urdf("</inertial>", "</inertia>"),
        "robot.urdf: line 5: an element is not closed or closed by another name; is the "
        "file truncated?"),
    Row("attribute without quotes", urdf('value="2"', "value=2"),
        "robot.urdf: line 7: an attribute is malformed or given twice"),
    Row("attribute without end", urdf('value="2"/>', 'value="2/>'),
        "robot.urdf: line 7: an element is not closed or closed by another name; is the "
        "file truncated?"),
    Row("attribute twice", urdf('value="2"', 'value="2" value="3"'),
        "robot.urdf: line 7: an attribute is malformed or given twice"),
    Row("two roots", edited("robot.urdf", lambda x: x + b'<robot name="more"/>\n'),
        "robot.urdf: line 26: found '<robot>': expected only one root element"),
    Row("text after the root", edited("robot.urdf", lambda x: x + b"and more\n"),
        "robot.urdf: line 26: expected XML: elements, and no text around them"),
    Row("comment without end", urdf('<link name="hand"', '<!-- <link name="hand"'),
        "robot.urdf: line 11: a comment has no end (-->)"),
    Row("unknown entity", urdf('name="hand"', 'name="&hand;"'),
        "robot.urdf: line 21, <child link> of joint 'elbow': found 'hand': expected one of "
        "the links base, arm, &hand;"),
    Row("NUL byte", urdf('name="hand"', 'name="ha\0nd"'),
        "robot.urdf: contains NUL bytes: expected UTF-8 text"),
    Row("UTF-16", edited("robot.urdf", lambda x: x.decode().encode("utf-16")),
        "robot.urdf: is UTF-16: expected UTF-8 text"),
    Row("UTF-16 without mark", edited("robot.urdf", lambda x: x.decode().encode("utf-16-be")),
        "robot.urdf: contains NUL bytes: expected UTF-8 text"),
    Row("control character in a name", urdf('name="hand"', 'name="ha&#27;nd"'),
        "robot.urdf: line 11, <link name>: found 'ha nd': expected a name without control "
        "characters"),

    # Attacks.
    Row("entity declared", urdf("<robot", '<!DOCTYPE robot [<!ENTITY m "2">]>\n<robot'),
        "robot.urdf: line 2: found '<!DOCTYPE': expected no DOCTYPE or entity declarations"),
    Row("billion laughs", both(urdf("<robot", ENTITIES), urdf('value="2"', 'value="&j;"')),
        "robot.urdf: line 2: found '<!DOCTYPE': expected no DOCTYPE or entity declarations"),
    Row("external entity", both(
        urdf("<robot", '<!DOCTYPE robot [<!ENTITY x SYSTEM "file:///etc/passwd">]>\n<robot'),
        urdf('name="hand"', 'name="&x;"')),
        "robot.urdf: line 2: found '<!DOCTYPE': expected no DOCTYPE or entity declarations"),
    Row("external DTD", urdf("<robot", '<!DOCTYPE robot SYSTEM "http://127.0.0.1:9/x.dtd">\n<robot'),
        "robot.urdf: line 2: found '<!DOCTYPE': expected no DOCTYPE or entity declarations"),
    Row("200000 nested elements", written("robot.urdf", nested(200000)),
        "robot.urdf: line 1: elements are nested too deeply"),
    Row("unclosed elements", written("robot.urdf", lambda: "<robot>" + "<x>" * 200000),
        "robot.urdf: line 1: elements are nested too deeply"),
    Row("20000 joints", written("robot.urdf", chain(20000)),
        "robot.urdf: found '20000 joints': expected at most 64 moving joints in the chain"),
    Row("65 joints", written("robot.urdf", chain(65)),
        "robot.urdf: found '65 joints': expected at most 64 moving joints in the chain"),
    Row("300000 joints", written("robot.urdf", chain(300000)),
        "robot.urdf: is larger than 32 MiB, the most that such a file may have"),
    Row("200000 attributes", urdf('<link name="hand"', '<link name="hand" ' + " ".join(
        f'a{k}=""' for k in range(200000)) + ' name="again"'),
        "robot.urdf: line 11: expected an element of at most 1000 attributes"),
    Row("33 MiB", padded("robot.urdf", 33 << 20),
        "robot.urdf: is larger than 32 MiB, the most that such a file may have"),

    # Not plain URDF.
    Row("xacro element", added('<xacro:macro name="m"/>'),
        "robot.urdf: line 25, <xacro:macro>: expected a plain URDF: run xacro first "
        "(xacro robot.urdf.xacro > robot.urdf)"),
    Row("xacro value", urdf('value="2"', 'value="${mass}"'),
        "robot.urdf: line 7, <mass value> of link 'arm': found '${mass}': expected a plain "
        "URDF: run xacro first "
        "(xacro robot.urdf.xacro > robot.urdf)"),
    Row("xacro substitution", urdf('value="2"', 'value="$(arg mass)"'),
        "robot.urdf: line 7, <mass value> of link 'arm': found '$(arg mass)': expected a "
        "plain URDF: run xacro first "
        "(xacro robot.urdf.xacro > robot.urdf)"),
    Row("root of another name", both(urdf("<robot", "<robots"), urdf("</robot>", "</robots>")),
        "robot.urdf: line 2, <robots>: found 'robots': expected the root element <robot> "
        "(URDF), <mujoco> (MJCF) or <sdf>"),
    Row("no links", written("robot.urdf", '<robot name="none"/>'),
        "robot.urdf: line 1, <robot>: expected at least one <link>"),
    Row("name in another namespace", both(urdf("<robot", "<r:robot"), urdf("</robot>", "</r:robot>")),
        "robot.urdf: line 2, <r:robot>: found 'r:robot': expected the root element <robot> "
        "(URDF), <mujoco> (MJCF) or <sdf>"),

    # Links.
    Row("link without name", urdf('<link name="hand"', "<link"),
        "robot.urdf: line 11, <link>: expected an attribute 'name'"),
    Row("link of empty name", urdf('name="hand"', 'name=""'),
        "robot.urdf: line 11, <link name>: expected a name"),
    Row("link twice", urdf('<link name="hand"', '<link name="arm"'),
        "robot.urdf: line 11, <link name>: found 'arm': expected a name that is not yet "
        "used (line 4)"),
    Row("mass with unit", urdf('mass value="2"', 'mass value="2kg"'),
        "robot.urdf: line 7, <mass value> of link 'arm': found '2kg': expected a number in "
        "kg"),
    Row("mass in words", urdf('mass value="2"', 'mass value="two"'),
        "robot.urdf: line 7, <mass value> of link 'arm': found 'two': expected a number in "
        "kg"),
    Row("mass with decimal comma", urdf('mass value="2"', 'mass value="2,5"'),
        "robot.urdf: line 7, <mass value> of link 'arm': found '2,5': expected a number in "
        "kg, with a decimal point"),
    Row("mass empty", urdf('mass value="2"', 'mass value=""'),
        "robot.urdf: line 7, <mass value> of link 'arm': expected a number in kg"),
    Row("mass nan", urdf('mass value="2"', 'mass value="nan"'),
        "robot.urdf: line 7, <mass value> of link 'arm': found 'nan': expected a finite "
        "number in kg"),
    Row("mass inf", urdf('mass value="2"', 'mass value="inf"'),
        "robot.urdf: line 7, <mass value> of link 'arm': found 'inf': expected a finite "
        "number in kg"),
    Row("mass beyond a double", urdf('mass value="2"', 'mass value="1e999"'),
        "robot.urdf: line 7, <mass value> of link 'arm': found '1e999': expected a number "
        "in kg"),
    Row("mass hexadecimal", urdf('mass value="2"', 'mass value="0x2"'),
        "robot.urdf: line 7, <mass value> of link 'arm': found '0x2': expected a number in "
        "kg"),
    Row("mass negative", urdf('mass value="2"', 'mass value="-2"'),
        "robot.urdf: line 7, <mass value> of link 'arm': found '-2': expected a number in "
        "kg that is not negative"),
    Row("mass of two numbers", urdf('mass value="2"', 'mass value="2 3"'),
        "robot.urdf: line 7, <mass value> of link 'arm': found '2 3': expected a number in "
        "kg"),
    Row("mass without value", urdf('<mass value="2"/>', "<mass>2</mass>"),
        "robot.urdf: line 7, <mass> of link 'arm': expected an attribute 'value'"),
    Row("mass missing", urdf('<mass value="2"/>', ""),
        "robot.urdf: line 5, <inertial> of link 'arm': expected an element <mass>"),
    Row("mass twice", urdf('<mass value="2"/>', '<mass value="2"/><mass value="3"/>'),
        "robot.urdf: line 7, <mass> of link 'arm': expected only one <mass> element"),
    Row("inertia missing", urdf('<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>', ""),
        "robot.urdf: line 5, <inertial> of link 'arm': expected an element <inertia>"),
    Row("inertia without iyz", urdf(' iyz="0"', ""),
        "robot.urdf: line 8, <inertia> of link 'arm': expected an attribute 'iyz'"),
    Row("inertia negative", urdf('iyy="1"', 'iyy="-1"'),
        "robot.urdf: line 8, <inertia iyy> of link 'arm': found '-1': expected a number in "
        "kg m^2 that is not negative"),
    Row("inertia beyond what can be calculated", both(
        urdf('value="2"', 'value="1e300"'), urdf('xyz="0.1 0 0"', 'xyz="1e300 0 0"')),
        "robot.urdf: the numbers of link 'arm' are too large to calculate with"),
    Row("two inertials", urdf("</inertial>", "</inertial><inertial/>"),
        "robot.urdf: line 9, <inertial> of link 'arm': expected only one <inertial> element"),
    Row("origin of two numbers", urdf('xyz="0.1 0 0"', 'xyz="0.1 0"'),
        "robot.urdf: line 6, <origin xyz> of link 'arm': found '0.1 0': expected three "
        "numbers in m"),
    Row("origin of four numbers", urdf('xyz="0.1 0 0"', 'xyz="0.1 0 0 0"'),
        "robot.urdf: line 6, <origin xyz> of link 'arm': found '0.1 0 0 0': expected three "
        "numbers in m"),
    Row("origin with commas", urdf('xyz="0.1 0 0"', 'xyz="0.1, 0, 0"'),
        "robot.urdf: line 6, <origin xyz> of link 'arm': found '0.1, 0, 0': expected three "
        "numbers in m, with blanks between them and decimal points"),
    Row("origin nan", urdf('rpy="0 0 0"', 'rpy="0 nan 0"'),
        "robot.urdf: line 6, <origin rpy> of link 'arm': found '0 nan 0': expected three "
        "finite numbers in rad"),

    # Joints.
    Row("joint without name", urdf('joint name="elbow" ', "joint "),
        "robot.urdf: line 20, <joint>: expected an attribute 'name'"),
    Row("joint twice", urdf('joint name="elbow"', 'joint name="shoulder"'),
        "robot.urdf: line 20, <joint name>: found 'shoulder': expected a name that is not "
        "yet used (line 16)"),
    Row("joint without type", urdf('"elbow" type="revolute"', '"elbow"'),
        "robot.urdf: line 20, joint 'elbow': expected an attribute 'type'"),
    Row("joint of unknown type", urdf('"elbow" type="revolute"', '"elbow" type="rotary"'),
        "robot.urdf: line 20, <joint type> of joint 'elbow': found 'rotary': expected "
        "revolute, continuous, prismatic, fixed, floating or planar"),
    Row("joint of type in capitals", urdf('"elbow" type="revolute"', '"elbow" type="Revolute"'),
        "robot.urdf: line 20, <joint type> of joint 'elbow': found 'Revolute': expected "
        "revolute, continuous, prismatic, fixed, floating or planar"),
    Row("floating joint in the chain", urdf('"elbow" type="revolute"', '"elbow" type="floating"'),
        "robot.urdf: line 20, joint 'elbow': found 'floating': expected a revolute, "
        "continuous, prismatic or fixed joint in the chain; --base=hand starts behind it"),
    Row("joint without parent", urdf('<parent link="arm"/>', ""),
        "robot.urdf: line 20, joint 'elbow': expected an element <parent>"),
    Row("joint without child", urdf('<child link="hand"/>', ""),
        "robot.urdf: line 20, joint 'elbow': expected an element <child>"),
    Row("parent that is no link", urdf('<parent link="arm"/>', '<parent link="army"/>'),
        "robot.urdf: line 21, <parent link> of joint 'elbow': found 'army': expected one of "
        "the links base, arm, hand"),
    Row("child that is no link", urdf('<child link="hand"/>', '<child link="hands"/>'),
        "robot.urdf: line 21, <child link> of joint 'elbow': found 'hands': expected one of "
        "the links base, arm, hand"),
    Row("axis zero", urdf('axis xyz="0 1 0"', 'axis xyz="0 0 0"'),
        "robot.urdf: line 21, <axis xyz> of joint 'elbow': found '0 0 0': expected an axis "
        "that is not zero"),
    Row("axis nan", urdf('axis xyz="0 1 0"', 'axis xyz="0 nan 0"'),
        "robot.urdf: line 21, <axis xyz> of joint 'elbow': found '0 nan 0': expected three "
        "finite numbers"),
    Row("axis of two numbers", urdf('axis xyz="0 1 0"', 'axis xyz="0 1"'),
        "robot.urdf: line 21, <axis xyz> of joint 'elbow': found '0 1': expected three "
        "numbers"),
    Row("axis twice", urdf('<axis xyz="0 1 0"/>', '<axis xyz="0 1 0"/><axis xyz="1 0 0"/>'),
        "robot.urdf: line 21, <axis> of joint 'elbow': expected only one <axis> element"),
    Row("limits swapped", urdf('lower="-2" upper="2"', 'lower="2" upper="-2"'),
        "robot.urdf: line 22, <limit lower> of joint 'elbow': found '2': expected at most "
        "the upper limit -2"),
    Row("limit in words", urdf('lower="-2"', 'lower="min"'),
        "robot.urdf: line 22, <limit lower> of joint 'elbow': found 'min': expected a "
        "number in rad"),
    Row("effort negative", urdf('effort="8"', 'effort="-8"'),
        "robot.urdf: line 22, <limit effort> of joint 'elbow': found '-8': expected a "
        "number in N m that is not negative"),
    Row("velocity nan", urdf('velocity="8"', 'velocity="nan"'),
        "robot.urdf: line 22, <limit velocity> of joint 'elbow': found 'nan': expected a "
        "finite number in rad/s"),
    Row("damping negative", urdf('damping="0.1"', 'damping="-0.1"'),
        "robot.urdf: line 23, <dynamics damping> of joint 'elbow': found '-0.1': expected a "
        "number in N m s/rad that is not negative"),
    Row("friction inf", urdf('friction="0.2"', 'friction="inf"'),
        "robot.urdf: line 23, <dynamics friction> of joint 'elbow': found 'inf': expected a "
        "finite number in N m"),
    Row("mimic of itself", urdf("<dynamics", '<mimic joint="elbow"/><dynamics'),
        "robot.urdf: line 20, <mimic> of joint 'elbow': found 'elbow': expected joints that move "
        "on their own in the chain: armcal's arms are open chains; --tip=arm ends it before "
        "them, and where the real robot has no such part, take it out of the file"),
    Row("mimic of no joint", urdf("<dynamics", '<mimic joint="wrist"/><dynamics'),
        "robot.urdf: line 20, <mimic> of joint 'elbow': found 'elbow': expected joints that move "
        "on their own in the chain: armcal's arms are open chains; --tip=arm ends it before "
        "them, and where the real robot has no such part, take it out of the file"),

    # Trees.
    Row("loop", added(joint("back", "hand", "base", "fixed")),
        "robot.urdf: line 25, joint 'back': expected a tree: the links arm, hand, base form "
        "a loop"),
    Row("joint onto itself", added('<link name="x"/>' + joint("self", "x", "x")),
        "robot.urdf: line 25, joint 'self': expected a tree: the links x form a loop"),
    Row("two parents", added(joint("back", "hand", "arm", "fixed")),
        "robot.urdf: line 25, <child link> of joint 'back': found 'arm': expected a link "
        "with one parent: joint 'shoulder' has it as its child already"),
    Row("two roots of the tree", added('<link name="other"/>'),
        "robot.urdf: found 'base, other': expected one root link: choose one with --base"),
    Row("no joints", written("robot.urdf", '<robot name="none"><link name="base"/></robot>'),
        "robot.urdf: expected a joint that moves a link of base link 'base'"),
    Row("two tips", added('<link name="thumb"/>' + joint("grip", "arm", "thumb")),
        "robot.urdf: found 'hand, thumb': expected one chain: choose its last link with "
        "--tip, or several, as in --tip=hand,thumb; what other joints move counts as held still "
        "(--posture). It branches at 'arm': --tip=arm has the joint that all share"),
    Row("posture of the robot's own joint", nothing,
        "robot.urdf: --posture: found 'shoulder': expected none: no joint moves anything beside "
        "the robot's own", COMMAND + " --posture=shoulder=0"),
    Row("base that is no link", nothing,
        "robot.urdf: --base: found 'bas': expected one of the links base, arm, hand", COMMAND + " --base=bas"),
    Row("tip that is no link", nothing,
        "robot.urdf: --tip: found 'hnd': expected one of the links base, arm, hand", COMMAND + " --tip=hnd"),
    Row("tip above the base", nothing,
        "robot.urdf: --tip: found 'base': expected a link that joints connect to the base "
        "link 'arm'", COMMAND + " --base=arm --tip=base"),
    Row("base is the tip", nothing,
        "robot.urdf: --tip: found 'hand': expected a link that a joint moves relative to "
        "'hand'", COMMAND + " --base=hand --tip=hand"),
    Row("more joints than the log", added('<link name="h2"/>' + joint("wrist", "hand", "h2")),
        "log.csv: row 1: missing q3 or wrist/position; the robot has 3 joints, the log "
        "holds q1..q2", COMMAND),
]),

    # No mesh is opened: these have no end, or are none of armcal's business.
    Group("URDF with meshes", COMMAND, {"log.csv": LOG, "robot.urdf": URDF.replace(
        '<link name="base"/>', '<link name="base">' + "".join(
            f'<visual> <geometry> <mesh filename="{file}"/> </geometry> </visual>'
            for file in ("/dev/zero", "file:///dev/zero", "../../../etc/passwd",
                         "package://none/base.stl")) + "</link>")}, [])]
