# diagnose: simulated logs of an arm, with and without what its file lacks.

write_arm(arm "" "")
set(robot --robot=arm.yaml)

# Runs of one true robot, whose numbers are 2 % off the file's.
macro(simulate folder run)
  run("simulate ${folder}" simulate ${robot} --duration=40 --robot_error=0.02
      --run=${run} --out=${folder} --truth=truth_${folder} ${ARGN})
  expect_code(0)
endmacro()
simulate(before 1)
simulate(after 2 --effects=payload:mass=0.5kg)
simulate(rippled 3 --effects=torque_ripple@2:amplitude=.1)
simulate(again 4 --effects=torque_ripple@2:amplitude=.1)

# json(key...) sets `value` of diagnosis.json.
macro(json)
  file(READ ${WORK_DIR}/out/diagnosis.json text)
  string(JSON value GET "${text}" ${ARGN})
endmacro()
function(expect_json expected)
  json(${ARGN})
  if(NOT value STREQUAL expected)
    fail("diagnosis.json: ${ARGN}: ${value}, expected ${expected}")
  endif()
endfunction()
function(expect_between low high)
  json(${ARGN})
  if(value LESS low OR value GREATER high)
    fail("diagnosis.json: ${ARGN}: ${value}, expected ${low} to ${high}")
  endif()
endfunction()

run("what changed since a reference" diagnose ${robot} --log=after/log.csv
    --reference=before/log.csv --out=out)
expect_code(0)
expect_empty(err)
expect_text(out "Changed since the reference: payload" "which effect" "payload: mass"
            "held-out torque, rms" "joint1" "joint2" "held-out gap"
            "noise told from: reference")
expect_json(explained verdict)
expect_json(payload effects 0 effect)
expect_json(0 effects 0 joint_index)
expect_json(reference floor_source)
expect_json(mass effects 0 estimates 0 name)
expect_json(kg effects 0 estimates 0 unit)
expect_between(.47 .53 effects 0 estimates 0 value)
expect_between(90 101 gap torque removed_percent)

# One log of the robot as it was does not tell how logs of it differ.
simulate(dragged 2 --effects=viscous_friction@2:drag=1)
run("friction since a reference" diagnose ${robot} --log=dragged/log.csv
    --reference=before/log.csv --noforward --out=out)
expect_text(out "Changed since the reference: more viscous friction on joint2"
            "a second log of the robot as it was")
simulate(earlier 6)
run("friction since two logs" diagnose ${robot} --log=dragged/log.csv
    --reference=before/log.csv,earlier/log.csv --noforward --out=out)
expect_text(out "more viscous friction on joint2")
if(out MATCHES "a second log of the robot")
  fail("a second reference is asked for where there are two")
endif()

run("the log it is compared with" diagnose ${robot} --log=before/log.csv
    --reference=before/log.csv --out=out)
expect_code(0)
json(verdict)
string(JSON found LENGTH "${text}" effects)
if(NOT found EQUAL 0)
  fail("nothing changed between a log and itself")
endif()

run("an effect of one joint, judged on another log" diagnose ${robot}
    --log=rippled/log.csv --validate=again/log.csv --out=out)
expect_text(out "torque ripple on joint2")
expect_json(torque_ripple effects 0 effect)
expect_json(2 effects 0 joint_index)
expect_json(joint2 effects 0 joint)

run("an effect that is not to be considered" diagnose ${robot}
    --log=rippled/log.csv --without=torque_ripple,position_friction --out=out)
expect_json(unknown verdict)

run("an effect of one joint, again" diagnose ${robot}
    --log=rippled/log.csv --validate=again/log.csv --modules=python,c
    --out=out)
file(READ ${WORK_DIR}/out/diagnosis.json once)
run("the same command, the same bytes" diagnose ${robot}
    --log=rippled/log.csv --validate=again/log.csv --modules=python,c
    --out=out)
file(READ ${WORK_DIR}/out/diagnosis.json twice)
if(NOT once STREQUAL twice)
  fail("the same command must give the same bytes")
endif()

# The laws as sources, which compare themselves with armcal's.
function(tests_itself)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${WORK_DIR}/out
                  RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(result)
    fail("${ARGN}: ${said}")
  endif()
endfunction()
find_program(python python3 HINTS /usr/bin NO_DEFAULT_PATH)
tests_itself(${python} -B effects.py --test)
tests_itself(cc -std=c99 -Wall -Wextra -Werror -DEFFECTS_TEST effects.c -lm
             -o effects_test)
tests_itself(./effects_test)

# Robots drawn from what it knows, each with its effects, which the module reads.
run("drawn robots" diagnose ${robot} --log=rippled/log.csv
    --validate=again/log.csv --noforward --modules=python
    --export=samples:2,mjcf,mjcf_plain --out=drawn)
expect_text(out "samples  2 robots")
file(READ ${WORK_DIR}/drawn/diagnosis.json text)
string(JSON value GET "${text}" samples count)
if(NOT value EQUAL 2)
  fail("diagnosis.json: ${value} samples")
endif()
file(GLOB found RELATIVE ${WORK_DIR}/drawn/samples ${WORK_DIR}/drawn/samples/*)
list(SORT found)
set(expected effects_1.json effects_2.json robot_1.urdf robot_1.xml
    robot_1_plain.xml robot_2.urdf robot_2.xml robot_2_plain.xml)
if(NOT found STREQUAL "${expected}")
  fail("samples/ has ${found}, expected ${expected}")
endif()
file(STRINGS ${WORK_DIR}/drawn/samples.csv table)
list(LENGTH table rows)
list(GET table 0 header)
if(NOT rows EQUAL 3 OR NOT header MATCHES
   "\"link1.mass\".*\"effects.torque_ripple.joint2.sine\"")
  fail("samples.csv: ${rows} rows, ${header}")
endif()
foreach(r 1 2)
  file(READ ${WORK_DIR}/drawn/samples/effects_${r}.json text)
  string(JSON effect GET "${text}" effects 0 effect)
  string(JSON ripple_${r} GET "${text}" effects 0 parameters 0 value)
  run("a drawn robot" inspect --robot=drawn/samples/robot_${r}.urdf)
  if(code EQUAL 3 OR NOT effect STREQUAL torque_ripple)
    fail("samples/ has a robot that is none, or with ${effect}")
  endif()
  execute_process(COMMAND ${python} -B -c "import effects
effects.Effects('samples/effects_${r}.json', beside='urdf')"
                  WORKING_DIRECTORY ${WORK_DIR}/drawn RESULT_VARIABLE result
                  ERROR_VARIABLE said)
  if(result)
    fail("effects.py of samples/effects_${r}.json: ${said}")
  endif()
endforeach()
if(ripple_1 STREQUAL ripple_2)
  fail("two drawn robots have the same effect: ${ripple_1}")
endif()
run("none at all" diagnose ${robot} --log=rippled/log.csv --export=samples:0
    --out=out)
expect_refusal(2 "--export: found 'samples:0', expected samples:N with N robots")
run("of measured poses" diagnose ${robot} --poses=poses.csv --export=samples:2
    --out=out)
expect_refusal(2 "--poses and --export: expected one of them")

# A calibration: of a file whose masses and friction are wrong and that has no
# armature, on one log of the true arm; then what other logs say is missing.
file(READ ${WORK_DIR}/arm.yaml yaml)
string(REGEX REPLACE ", armature: [.0-9]+" "" yaml "${yaml}")
string(REPLACE "mass: 5" "mass: 4.2" yaml "${yaml}")
string(REPLACE "mass: 3" "mass: 3.5" yaml "${yaml}")
string(REPLACE "viscous: 2" "viscous: 1.5" yaml "${yaml}")
file(WRITE ${WORK_DIR}/poor.yaml "${yaml}")
set(poor --robot=poor.yaml)
run("calibrate" calibrate ${poor} --log=before/log.csv --out=calibrated)
expect_code(0)
simulate(unchanged 5)
run("the calibrated robot" diagnose ${poor} --calibration=calibrated
    --log=unchanged/log.csv --out=out)
expect_code(0)
expect_empty(err)
foreach(list effects ladder)
  json(${list})
  string(JSON found LENGTH "${text}" ${list})
  if(NOT found EQUAL 0)
    fail("diagnosis.json: ${list} of a calibrated robot: ${value}")
  endif()
endforeach()
expect_json(calibrated calibration)
expect_json(reference calibration_logs)
expect_json("the calibration's own logs are the reference (before/log.csv)"
            data 0 finding)
expect_between(.5 2 gap torque nominal)
run("what hangs on the calibrated robot" diagnose ${poor}
    --calibration=calibrated/calibration.json --log=after/log.csv --out=out)
expect_json(explained verdict)
expect_json(payload effects 0 effect)
expect_between(.43 .57 effects 0 estimates 0 value)
expect_between(90 101 gap torque removed_percent)
run("what its motor lacks" diagnose ${poor} --calibration=calibrated
    --log=rippled/log.csv --out=out)
expect_json(torque_ripple effects 0 effect)
expect_json(2 effects 0 joint_index)
file(RENAME ${WORK_DIR}/before ${WORK_DIR}/elsewhere)
run("without its own logs" diagnose ${poor} --calibration=calibrated
    --log=after/log.csv --out=out)
expect_json(payload effects 0 effect)
expect_json("the calibration's own logs are not known" data 0 finding)
file(RENAME ${WORK_DIR}/elsewhere ${WORK_DIR}/before)
run("since a reference, too" diagnose ${poor} --calibration=calibrated
    --reference=unchanged/log.csv --log=after/log.csv --out=out)
expect_json(payload effects 0 effect)
expect_between(.47 .53 effects 0 estimates 0 value)
run("the log that it was calibrated on" diagnose ${poor}
    --calibration=calibrated --log=before/log.csv --out=out)
expect_text(out "note       the calibration was fitted to before/log.csv")
run("the folder of a calibration" verify ${poor} --calibration=calibrated)
expect_code(0)

run("a calibration of another file" diagnose ${robot} --calibration=calibrated
    --log=after/log.csv)
expect_refusal(3 "calibrated/calibration.json" "what the robot file has for"
               "give the file that was calibrated")
run("no calibration there" diagnose ${poor} --calibration=nowhere
    --log=after/log.csv)
expect_refusal(3 "nowhere: cannot be opened")
run("calibrate for itself" calibrate ${poor} --log=before/log.csv
    --estimate=linear --out=linear)
run("a linear calibration" diagnose ${poor} --calibration=linear
    --log=after/log.csv)
expect_refusal(3 "expected 'refined'" "run armcal calibrate --estimate=refined")
file(REMOVE ${WORK_DIR}/calibrated/parameters_posterior.csv)
run("a calibration without its posterior" diagnose ${poor}
    --calibration=calibrated --log=after/log.csv)
expect_refusal(3 "calibrated/parameters_posterior.csv: cannot be opened")

run("no folder asked for" diagnose ${robot} --log=before/log.csv)
expect_code(0)
if(EXISTS ${WORK_DIR}/diagnosis.json OR EXISTS ${WORK_DIR}/out)
  fail("nothing was to be written")
endif()

# Refusals.
run("no log" diagnose ${robot} --out=out)
expect_refusal(2 "--log")
run("no robot" diagnose --log=before/log.csv --out=out)
expect_refusal(2 "--robot")
run("a log that is not there" diagnose ${robot} --log=nowhere.csv --out=out)
expect_refusal(3 "nowhere.csv")
run("a reference that is not there" diagnose ${robot} --log=before/log.csv
    --reference=nowhere.csv --out=out)
expect_refusal(3 "nowhere.csv")
run("a trust that is none" diagnose ${robot} --log=before/log.csv --trust=-1
    --out=out)
expect_refusal(2 "--trust")
run("an effect that is none" diagnose ${robot} --log=before/log.csv
    --without=sorcery --out=out)
expect_refusal(2 "--without: found 'sorcery'" "stribeck")
run("held out from itself" diagnose ${robot} --log=before/log.csv
    --validate=before/log.csv --out=out)
expect_refusal(2 "--validate names before/log.csv")
run("no bandwidth" diagnose ${robot} --log=before/log.csv --bandwidth=0 --out=out)
expect_refusal(3 "--bandwidth: found '0': expected a frequency above 0 Hz")
run("above what was sampled" diagnose ${robot} --log=before/log.csv
    --bandwidth=200 --out=out)
expect_refusal(3 "--bandwidth: found '200'" "less than half the sample rate")
run("a part of a moment" diagnose ${robot} --log=before/log.csv --crop=5:8
    --bandwidth=2 --out=out)
expect_refusal(3 "before/log.csv: no motion is left of it")
run("a part of a moment, with a reference" diagnose ${robot} --log=after/log.csv
    --crop=5:5.2 --bandwidth=8 --reference=before/log.csv --out=out)
expect_refusal(3 "after/log.csv: no motion is left of it")
run("a flag of another command" diagnose ${robot} --log=before/log.csv
    --payload_mass=1 --out=out)
expect_refusal(2 "payload_mass")
file(WRITE ${WORK_DIR}/broken.csv "t,q1,q2,tau1,tau2
0,0,0,0,0
.01,0,zero,0,0
")
run("a log with a word in it" diagnose ${robot} --log=broken.csv --out=out)
expect_refusal(3 "broken.csv" "zero")
file(WRITE ${WORK_DIR}/positions.csv "t,q1,q2\n0,0,0\n.01,0,0\n.02,0,0\n")
run("a log without torques" diagnose ${robot} --log=positions.csv --out=out)
expect_refusal(3 "positions.csv")
set(rows "t,q1,q2,tau1,tau2\n")
foreach(k RANGE 1 9)
  string(APPEND rows "${k}e-2,0,0,0,0\n")
endforeach()
file(WRITE ${WORK_DIR}/short.csv "${rows}")
run("a log of a moment" diagnose ${robot} --log=short.csv --out=out)
expect_refusal(3 "a frequency in Hz whose period is shorter than the log, 0.08 s")
run("results that cannot be written" diagnose ${robot} --log=before/log.csv
    --out=/proc/x)
expect_refusal(3 "/proc/x: --out: cannot be written")
