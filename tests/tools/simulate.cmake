# armcal simulate: logs that armcal calibrate reads, truth apart, refusals.

write_arm(arm "" "")

run("a log and its truth" simulate --robot=arm.yaml --duration=12 --out=out
    --effects=stribeck@2 --truth=secret)
expect_code(0)
expect_text(out "simulated arm: 3501 samples, 14 s" "stribeck on joint2")
expect_empty(err)
if(EXISTS ${WORK_DIR}/out/truth.json)
  fail("the truth must not lie beside the log")
endif()
file(READ ${WORK_DIR}/secret/truth.json truth)
string(JSON effect GET "${truth}" effects 0 effect)
string(JSON joint GET "${truth}" effects 0 joint_index)
if(NOT "${effect}@${joint}" STREQUAL "stribeck@2")
  fail("truth.json must name the effect, not ${effect}@${joint}")
endif()
file(READ ${WORK_DIR}/out/log.csv log)
if(log MATCHES "stribeck")
  fail("the log must not name the effect")
endif()
file(RENAME ${WORK_DIR}/out ${WORK_DIR}/first)

run("the same seed, the same bytes" simulate --robot=arm.yaml --duration=12
    --out=out --effects=stribeck@2)
file(READ ${WORK_DIR}/out/log.csv again)
if(NOT again STREQUAL log)
  fail("the log differs from that of the same command")
endif()
foreach(other --seed=1 --run=1)
  run("${other}, other bytes" simulate --robot=arm.yaml --duration=12
      --out=out --effects=stribeck@2 ${other})
  file(READ ${WORK_DIR}/out/log.csv again)
  if(again STREQUAL log)
    fail("the log is that without ${other}")
  endif()
endforeach()

# Two joints of one MJCF body: the link between them has no mass, and the file is
# as whole as one without it.
file(WRITE ${WORK_DIR}/two.xml
     "<mujoco><worldbody><body name='a' pos='0 0 .2'><joint name='q1' axis='0 0 1'/>
<inertial pos='0 0 .1' mass='3' diaginertia='.03 .03 .02'/><body name='b' pos='0 0 .3'>
<joint name='q2' axis='0 1 0'/><joint name='q3' axis='1 0 0'/>
<inertial pos='0 0 .2' mass='2' diaginertia='.02 .02 .01'/></body></body></worldbody></mujoco>")
file(WRITE ${WORK_DIR}/loop.yaml "rate: 1000\nbandwidth: 8\nfeedforward: none\n")
run("two joints of one body" simulate --robot=two.xml --duration=12 --robot_error=.2
    --encoder_noise=5e-5 --controller=loop.yaml --effects= --out=two)
expect_code(0)
run("their commands" calibrate --robot=two.xml --controller=loop.yaml --log=two/log.csv --out=found)
expect_code(0)
if(out MATCHES "b_q2[.]")
  fail("a link without mass has nothing to estimate")
endif()
# The first moment that carries the body, of all the most certain: what was hidden, to .003 kg m.
file(READ ${WORK_DIR}/two/truth.json truth)
string(JSON name GET "${truth}" parameters 23 name)
string(JSON hidden GET "${truth}" parameters 23 value)
string(REGEX MATCH "b[.]hz +0[.]4 -> +([0-9.]+)" found "${out}")
execute_process(COMMAND awk "BEGIN {d = ${CMAKE_MATCH_1} - ${hidden}; exit d * d > 9e-6}"
                RESULT_VARIABLE is_off)
if(NOT name STREQUAL b.hz OR is_off)
  fail("${name} is ${CMAKE_MATCH_1} kg m, not ${hidden} kg m")
endif()

# Another run is of the same robot.
foreach(k 1 2)
  run("run ${k}" simulate --robot=arm.yaml --duration=2 --out=out --run=${k}
      --robot_error=0.1 --effects=payload:mass=0.5kg)
  file(READ ${WORK_DIR}/out/truth.json truth)
  string(JSON parameters${k} GET "${truth}" parameters)
  string(JSON mass GET "${truth}" effects 0 values 0 value)
  if(NOT mass MATCHES "^0\\.(5|4999999)")
    fail("a payload of 0.5 kg was asked for, ${mass} kg is in truth.json")
  endif()
endforeach()
if(NOT parameters1 STREQUAL parameters2)
  fail("two runs are of two robots")
endif()

# Sizes in SI units hold together, in any order, and beyond what is drawn.
macro(expect_size effect index expected)
  run("${effect}" simulate --robot=arm.yaml --duration=2 --out=out
      "--effects=${effect}")
  expect_code(0)
  file(READ ${WORK_DIR}/out/truth.json truth)
  string(JSON size GET "${truth}" effects 0 values ${index} value)
  if(NOT size MATCHES "${expected}")
    fail("${effect}: ${size} is in truth.json")
  endif()
endmacro()
set(stiffness "stiffness=20000N m/rad")
set(damping "damping=20N m s/rad")
expect_size("elasticity@2:${stiffness},${damping}" 0 "^(20000|19999\\.999)")
expect_size("elasticity@2:${stiffness},${damping}" 1 "^(20|19\\.9999)")
expect_size("elasticity@2:${damping},${stiffness}" 0 "^(20000|19999\\.999)")
expect_size("elasticity@2:${damping},${stiffness}" 1 "^(20|19\\.9999)")

# Where the links were is told of gears that yield, and of no others.
file(STRINGS ${WORK_DIR}/out/links.csv rows)
list(LENGTH rows links)
file(STRINGS ${WORK_DIR}/out/log.csv rows)
list(LENGTH rows samples)
if(NOT links EQUAL samples)
  fail("links.csv has ${links} rows, log.csv ${samples}")
endif()
file(REMOVE_RECURSE ${WORK_DIR}/out)
expect_size("payload:mass=3kg" 0 "^(3|2\\.9999)")
if(EXISTS ${WORK_DIR}/out/links.csv)
  fail("an arm without a gear has links.csv")
endif()

# What simulate writes, calibrate takes; as currents and with lost, jittering
# samples too.
run("currents" simulate --robot=arm.yaml --duration=12 --out=out
    --torque_constants=2,3 --temperature --jitter=0.0005 --lost=0.01)
expect_code(0)
file(STRINGS ${WORK_DIR}/out/log.csv header LIMIT_COUNT 1)
if(NOT header STREQUAL "t,q1,q2,qd1,qd2,i1,i2,qref1,qref2,temp1,temp2,simulated")
  fail("the header is ${header}")
endif()
file(RENAME ${WORK_DIR}/out ${WORK_DIR}/second)
run("calibrate reads it" calibrate --robot=arm.yaml --log=second/log.csv
    --torque_constants=2,3 --bandwidth=8)
expect_code(0)
expect_text(out "currents times 2 3 N m/A")

run("the list" simulate --list_effects)
expect_code(0)
expect_text(out "viscous_friction@JOINT" "payload" "has none for" "gyroscope")

run("point to point along a file's motion" simulate --robot=arm.yaml
    --motion=first/log.csv --out=out --encoder_noise=0 --torque_noise=0)
expect_code(0)

# Refusals.
macro(refuse name code)
  run("${name}" simulate --robot=arm.yaml --out=out ${ARGN})
endmacro()
refuse("unknown effect" 2 --effects=stribek@2)
expect_refusal(2 "--effects: found 'stribek', expected an effect, such as stribeck")
refuse("effect without its joint" 2 --effects=stribeck)
expect_refusal(2 "expected stribeck@JOINT")
refuse("effect with a joint too many" 2 --effects=base_tilt@1)
expect_refusal(2 "expected base_tilt without a joint")
refuse("no such joint" 2 --effects=stribeck@3)
expect_refusal(2 "found '3', expected a joint, 1 to 2")
refuse("no such parameter" 2 --effects=stribeck@1:size=3)
expect_refusal(2 "found 'size', expected a parameter of stribeck")
refuse("a parameter that is no number" 2 --effects=payload:mass=heavy)
expect_refusal(2 "found 'mass=heavy', expected mass=NUMBER")
refuse("a parameter out of range" 3 --effects=payload:mass=50)
expect_refusal(3 "effect payload" "mass = 50: expected")
refuse("a size that cannot be" 2 --effects=payload:mass=900kg)
expect_refusal(2 "found 'mass=900kg', expected" "kg")
refuse("a size that a parameter decides" 2
       "--effects=elasticity@2:windup=.003,${stiffness}")
expect_refusal(2 "stiffness=20000" "no parameter of elasticity")
refuse("two sizes that one parameter decides" 2
       "--effects=asymmetric_friction@1:asymmetric=1N m s/rad,viscous=2N m s/rad")
expect_refusal(2 "viscous=2" "no parameter of asymmetric_friction")
refuse("half a wave" 2 "--effects=torque_ripple@1:harmonic=20.4 1/rad")
expect_refusal(2 "harmonic=20.4" "it can only be 20")
refuse("a unit that it has not" 2 --effects=payload:mass=3Nm)
expect_refusal(2 "payload has no mass in Nm; it has mass kg, com_x m")
refuse("a rate that does not divide" 2 --log_rate=300)
expect_refusal(2 "--log_rate: found '300'"
               "expected Hz that divide the controller's rate of 1000")
refuse("a negative duration" 2 --duration=-1)
expect_refusal(2 "--duration: found '-1', expected a number from 0.1 to 10000")
refuse("too large a motion" 2 --size=2)
expect_refusal(2 "--size: found '2', expected a number from 0 to 1")
refuse("a constant that is none" 2 --torque_constants=0,1)
expect_refusal(2 "--torque_constants: found '0,1', expected numbers above 0")
run("results that cannot be written" simulate --robot=arm.yaml --duration=1
    --out=/proc/x --truth=half)
expect_refusal(3 "/proc/x: --out: cannot be written")
if(EXISTS ${WORK_DIR}/half/truth.json)
  fail("the truth was written without its log")
endif()
file(WRITE ${WORK_DIR}/weak.yaml "torque_limit: [1, 1]\n")
run("an arm that does not follow" simulate --robot=arm.yaml --out=out
    --duration=2 --controller=weak.yaml)
expect_text(out "do not suit this robot" "joint1 does not follow")
refuse("a rest that never ends" 2 --standstill=1e8)
expect_refusal(2 "--standstill: found '1e+08', expected a number from 0 to 10000")
refuse("a step that never ends" 2 --step=1e-9)
expect_refusal(2 "--step: found '1e-09', expected a number from 1e-05 to 0.01")
file(WRITE ${WORK_DIR}/fast.yaml "rate: 1000000000\n")
refuse("a controller that never rests" 3 --controller=fast.yaml)
expect_refusal(3 "fast.yaml" "rate" "expected a rate from 1 to 20000 Hz")
file(WRITE ${WORK_DIR}/slow.csv "t,q1,q2\n0,0,0\n1e6,.1,0\n2e6,.1,.1\n3e6,0,0\n")
refuse("a motion of weeks" 3 --motion=slow.csv)
expect_refusal(3 "slow.csv: found '3e+06 s': expected a motion of at most")
refuse("joints that are not there" 2 --joints=1,3)
expect_refusal(2 "--joints: found '1,3', expected numbers from 1 to 2")
refuse("noise for one joint too many" 2 --torque_noise=1,2,3)
expect_refusal(2 "--torque_noise: found '1,2,3', expected one number or 2")
refuse("a motion that is not there" 3 --motion=nowhere.csv)
expect_refusal(3 "nowhere.csv")
run("no folder" simulate --robot=arm.yaml)
expect_refusal(2 "--out=DIR is needed")
file(WRITE ${WORK_DIR}/light.yaml "convention: standard
links:
  - {joint: revolute, a: .4}
")
run("a robot without masses" simulate --robot=light.yaml --out=out)
expect_refusal(3 "light.yaml: link link1" "it has no mass")
file(WRITE ${WORK_DIR}/flat.yaml "name: flat
convention: standard
links:
  - {joint: revolute, a: .4, mass: 2, com: [0, 0, 0], inertia: [.01, .01, .9]}
")
run("an inertia that cannot be" simulate --robot=flat.yaml --duration=2 --out=flat)
expect_code(0)
expect_text(out "no body has the inertia of link1")
