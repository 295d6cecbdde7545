# calibrate --estimate: a physically consistent robot file beside the model
# parameters, which armcal reads again.
file(WRITE ${WORK_DIR}/scara.yaml "name: scara
gravity: [0, 0, 9.8]
convention: standard
links:
  - {joint: revolute, a: 0.4, mass: 20, com: [-0.2, 0, 0], inertia: [0.1, 0.5, 0.5]}
  - {joint: revolute, a: 0.3, mass: 8, com: [-0.1, 0, 0], inertia: [0.1, 0.2, 0.2]}
  - {joint: prismatic, mass: 2, inertia: [0.1, 0.1, 0.1]}
  - {joint: revolute, mass: 1, inertia: [0.1, 0.1, 0.1]}
")
set(flags --robot=scara.yaml --log=${DATA_DIR}/scara/B.csv.gz
    --validate=${DATA_DIR}/scara/A.csv.gz --joint_terms=none --bandwidth=0)

run("linear" calibrate ${flags} --estimate=linear --out=linear)
expect_code(0)
if(out MATCHES "robot for a simulator|no robot file" OR
   EXISTS ${WORK_DIR}/linear/robot.urdf)
  fail("--estimate=linear must not make a robot")
endif()
file(READ ${WORK_DIR}/linear/calibration.json json)
string(JSON estimate GET "${json}" estimate)
if(NOT estimate STREQUAL "linear")
  fail("calibration.json: estimate ${estimate}")
endif()

run("refined" calibrate ${flags} --estimate=refined --out=refined)
expect_code(0)
expect_empty(err)
expect_text(out "robot for a simulator" "residual of this robot" "held out"
            "robot.urdf  URDF has no field for gravity, which here is 0 0 9.8")
if(out MATCHES "[^a-z]nan[^a-z]" OR out MATCHES " \n")
  fail("nan, or blanks at a line's end")
endif()
file(READ ${WORK_DIR}/refined/calibration.json json)
string(JSON estimate GET "${json}" estimate)
string(JSON converged GET "${json}" refined converged)
string(JSON count LENGTH "${json}" linear joints)
string(JSON name GET "${json}" parameters 0 name)
if(NOT "${estimate} ${converged} ${count} ${name}" STREQUAL "refined ON 4 link1.mass")
  fail("calibration.json: ${estimate} ${converged} ${count} ${name}")
endif()
foreach(file robot.urdf parameters_covariance.csv covariance.csv)
  if(NOT EXISTS ${WORK_DIR}/refined/${file})
    fail("no ${file}")
  endif()
endforeach()

# The file that was written is a robot file; from there nothing changes.
run("robot.urdf again" calibrate --robot=refined/robot.urdf --gravity=0,0,9.8
    --log=${DATA_DIR}/scara/B.csv.gz --joint_terms=none --bandwidth=0
    --estimate=refined --out=again)
expect_code(0)
expect_text(out "17.55" "7.55" "robot for a simulator")
if(NOT EXISTS ${WORK_DIR}/again/robot_without_meshes.urdf)
  fail("no robot_without_meshes.urdf")
endif()

file(READ ${WORK_DIR}/scara.yaml yaml)
string(REPLACE "mass: 2, inertia: [0.1, 0.1, 0.1]" "d: 0" yaml "${yaml}")
file(WRITE ${WORK_DIR}/massless.yaml "${yaml}")
run("no mass to start from" calibrate --robot=massless.yaml
    --log=${DATA_DIR}/scara/B.csv.gz --joint_terms=none --bandwidth=0
    --estimate=refined)
expect_code(1)
expect_text(out "no robot file: the robot file gives link link3 no mass")
run("no mass, and none asked for" calibrate --robot=massless.yaml
    --log=${DATA_DIR}/scara/B.csv.gz --joint_terms=none --bandwidth=0)
expect_code(0)
expect_text(out "no robot file: the robot file gives link link3 no mass")

foreach(pair
    "--trust=0|--trust: found '0', expected a relative standard deviation above 0"
    "--trust=-0.5|--trust: found '-0.5', expected a relative"
    "--trust=nan|--trust: found 'nan', expected a relative"
    "--trust=inf|--trust: found 'inf', expected a relative"
    "--trust=much|--trust: found 'much', expected a number"
    "--estimate=best|--estimate: found 'best', expected one of auto, refined, linear"
    "--estimate=linear --geometry=refine|--estimate: found 'linear', expected refined or auto"
    "--length_trust=0|--length_trust: found '0', expected a standard deviation in m above 0"
    "--angle_trust=-1|--angle_trust: found '-1', expected a standard deviation in rad above 0")
  string(REPLACE "|" ";" pair "${pair}")
  list(GET pair 0 flag)
  list(GET pair 1 message)
  separate_arguments(given UNIX_COMMAND "${flag}")
  run("${flag}" calibrate ${flags} ${given} --out=out)
  expect_refusal(2 "${message}")
endforeach()
