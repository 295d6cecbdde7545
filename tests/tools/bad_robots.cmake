# Robot files that cannot be used as they are: exit code 3 and one line that
# names file, line, element, value and expectation.
file(WRITE ${WORK_DIR}/log.csv "t,q1,q2,tau1,tau2\n0,0,0,0,0\n1,1,1,1,1\n2,0,1,1,1\n")

macro(calibrate robot)
  run("${robot}" calibrate --robot=${robot} --log=log.csv --out=out)
endmacro()

# Writes a good two-joint URDF with one text replaced.
function(write_urdf name old new)
  set(text "<?xml version=\"1.0\"?>
<robot name=\"two\">
  <link name=\"base\"/>
  <link name=\"arm\">
    <inertial>
      <mass value=\"2\"/>
      <inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/>
    </inertial>
  </link>
  <link name=\"hand\"/>
  <joint name=\"shoulder\" type=\"revolute\">
    <parent link=\"base\"/> <child link=\"arm\"/> <axis xyz=\"0 0 1\"/>
    <limit lower=\"-1\" upper=\"1\" effort=\"9\" velocity=\"9\"/>
  </joint>
  <joint name=\"elbow\" type=\"revolute\">
    <parent link=\"arm\"/> <child link=\"hand\"/> <axis xyz=\"0 1 0\"/>
    <limit lower=\"-1\" upper=\"1\" effort=\"9\" velocity=\"9\"/>
  </joint>
</robot>
")
  string(REPLACE "${old}" "${new}" changed "${text}")
  if(changed STREQUAL text AND NOT old STREQUAL "")
    message(SEND_ERROR "${name}: '${old}' is not in the URDF")
  endif()
  file(WRITE ${WORK_DIR}/${name} "${changed}")
endfunction()

write_urdf(good.urdf "" "")
calibrate(good.urdf)
if(NOT code MATCHES "^[01]$")  # three rows calibrate nothing, but are read
  fail("exit code 0 or 1 expected")
endif()

calibrate(absent.urdf)
expect_refusal(3 "absent.urdf: cannot be opened")
file(WRITE ${WORK_DIR}/robot.txt "")
calibrate(robot.txt)
expect_refusal(3 "robot.txt: found '.txt': expected a robot file that ends in .urdf")

write_urdf(unit.urdf "mass value=\"2\"" "mass value=\"2kg\"")
calibrate(unit.urdf)
expect_refusal(3 "unit.urdf: line 6, <mass value> of link 'arm': found '2kg': expected a number in kg")
write_urdf(comma.urdf "mass value=\"2\"" "mass value=\"2,5\"")
calibrate(comma.urdf)
expect_refusal(3 "comma.urdf: line 6, <mass value> of link 'arm': found '2,5': expected a number in kg")
write_urdf(negative.urdf "mass value=\"2\"" "mass value=\"-2\"")
calibrate(negative.urdf)
expect_refusal(3 "negative.urdf: line 6, <mass value> of link 'arm': found '-2'" "not negative")
write_urdf(type.urdf "\"elbow\" type=\"revolute\"" "\"elbow\" type=\"rotary\"")
calibrate(type.urdf)
expect_refusal(3 "type.urdf: line 15, <joint type> of joint 'elbow': found 'rotary': expected revolute, continuous, prismatic")
write_urdf(doctype.urdf "<robot" "<!DOCTYPE robot [<!ENTITY m \"2\">]>\n<robot")
calibrate(doctype.urdf)
expect_refusal(3 "doctype.urdf: line 2: found '<!DOCTYPE'" "expected no DOCTYPE")
write_urdf(loop.urdf "</robot>" "<joint name=\"back\" type=\"fixed\">
    <parent link=\"hand\"/> <child link=\"base\"/> </joint> </robot>")
calibrate(loop.urdf)
expect_refusal(3 "loop.urdf: line " "joint 'back'" "expected a tree" "arm, hand, base form a loop")
write_urdf(parents.urdf "</robot>" "<joint name=\"back\" type=\"fixed\">
    <parent link=\"hand\"/> <child link=\"arm\"/> </joint> </robot>")
calibrate(parents.urdf)
expect_refusal(3 "parents.urdf: line " "joint 'back': found 'arm': expected a link with one parent")
write_urdf(cut.urdf "</robot>" "")
calibrate(cut.urdf)
expect_refusal(3 "cut.urdf: line ")

# The same in a DH table.
function(write_dh name link)
  file(WRITE ${WORK_DIR}/${name} "convention: standard
links:
  - {joint: revolute, a: 0.4}
  - {${link}}
")
endfunction()
write_dh(unit.yaml "joint: revolute, mass: 2kg")
calibrate(unit.yaml)
expect_refusal(3 "unit.yaml: line 4, links[2].mass: found '2kg': expected a number in kg")
write_dh(negative.yaml "joint: revolute, mass: -2")
calibrate(negative.yaml)
expect_refusal(3 "negative.yaml: line 4, links[2].mass: found '-2'" "not negative")
write_dh(type.yaml "joint: ball")
calibrate(type.yaml)
expect_refusal(3 "type.yaml: line 4, links[2].joint: found 'ball': expected one of revolute, continuous, prismatic")
write_dh(key.yaml "joint: revolute, aa: 1")
calibrate(key.yaml)
expect_refusal(3 "key.yaml: line 4" "aa")
write_dh(joints.yaml "joint: revolute}\n  - {joint: revolute")
calibrate(joints.yaml)
expect_refusal(3 "log.csv: row 1" "the robot has 3 joints")
