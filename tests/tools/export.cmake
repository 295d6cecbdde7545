# --export: robots in other formats, which armcal reads again.
write_arm(arm ", limits: {lower: -2, upper: 2, velocity: 2, effort: 100}"
          ", limits: {lower: -2.5, upper: 2.5, velocity: 3, effort: 50}")
run("a log" simulate --robot=arm.yaml --duration=10 --log_rate=100 --out=made)
expect_code(0)

run("convert" inspect --robot=arm.yaml --export=urdf,mjcf,sdf,yaml --out=files)
expect_code(0)
expect_text(out "robot.xml  MJCF has no field for velocity limits"
            "robot.sdf  SDF leaves gravity to the world")
file(READ ${WORK_DIR}/files/inspect.json json)
string(JSON count LENGTH "${json}" robot_files)
string(JSON format GET "${json}" robot_files 1 format)
string(JSON loss GET "${json}" robot_files 1 losses 0)
if(NOT count EQUAL 4 OR NOT format STREQUAL "mjcf" OR
   NOT loss MATCHES "velocity limits")
  fail("inspect.json: robot_files ${count} ${format} ${loss}")
endif()

# The same robot, the same calibration: of the first figures a log gives.
function(fitted file)
  run("calibrate ${file}" calibrate --robot=${file} --log=made/log.csv
      --export=mjcf,yaml --out=fitted)
  expect_code(0)
  file(READ ${WORK_DIR}/fitted/calibration.json json)
  set(figures "")
  foreach(k RANGE 5)
    string(JSON value GET "${json}" model_parameters ${k} value)
    string(SUBSTRING "${value}000000000000" 0 13 value)
    list(APPEND figures "${value}")
  endforeach()
  string(JSON files LENGTH "${json}" robot_files)
  set(result "${files} ${figures}" PARENT_SCOPE)
endfunction()
fitted(arm.yaml)
set(from_table "${result}")
fitted(files/robot.yaml)
set(from_yaml "${result}")
fitted(files/robot.xml)
if(NOT result STREQUAL from_table OR NOT from_yaml STREQUAL from_table)
  fail("calibrated apart: ${from_table}, ${from_yaml}, ${result}")
endif()
run("what was written" inspect --robot=fitted/robot.xml)
if(code EQUAL 3)
  fail("armcal does not read its own robot.xml")
endif()

run("an unknown format" calibrate --robot=arm.yaml --log=made/log.csv
    --export=mjcf,xml --out=bad)
expect_refusal(2 "--export: found 'xml', expected one of urdf, mjcf, mjcf_plain, sdf, yaml, isaac")
run("nowhere to write" inspect --robot=arm.yaml --export=sdf)
expect_refusal(2 "--export needs --out=FOLDER")

# Robots drawn from the posterior: as many as asked for, in the formats asked
# for, and none of an earlier run among them.
function(expect_samples)
  file(GLOB found RELATIVE ${WORK_DIR}/drawn/samples
       ${WORK_DIR}/drawn/samples/*)
  list(SORT found)
  if(NOT found STREQUAL "${ARGN}")
    fail("samples/ has ${found}, expected ${ARGN}")
  endif()
endfunction()
run("samples" calibrate --robot=arm.yaml --log=made/log.csv
    --export=samples:3,mjcf --out=drawn)
expect_text(out "samples  3 robots")
expect_samples(robot_1.urdf robot_1.xml robot_2.urdf robot_2.xml robot_3.urdf
               robot_3.xml)
run("a drawn robot" inspect --robot=drawn/samples/robot_3.xml)
if(code EQUAL 3)
  fail("armcal does not read its own sample")
endif()
file(WRITE ${WORK_DIR}/drawn/samples/mine "of the user")
run("fewer samples" calibrate --robot=arm.yaml --log=made/log.csv
    --export=samples:2 --out=drawn)
expect_samples(mine robot_1.urdf robot_2.urdf)
run("no number" calibrate --robot=arm.yaml --log=made/log.csv
    --export=samples:0 --out=bad)
expect_refusal(2 "--export: found 'samples:0', expected samples:N with N robots")
run("samples of a file" inspect --robot=arm.yaml --export=samples:2 --out=bad)
expect_refusal(2 "--export: found 'samples', expected formats alone")
run("a robot of model parameters" calibrate --robot=arm.yaml --log=made/log.csv
    --estimate=linear --export=samples:2 --out=bad)
expect_refusal(2 "--estimate: found 'linear', expected refined or auto with --export")
