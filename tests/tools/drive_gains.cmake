# calibrate --payload_mass --payload_log: torque constants from currents. The
# simulated arm has 12 and 8 N m/A and carries 2 kg at 0.05, 0.02 m.
execute_process(COMMAND ${WRITE_PAYLOAD_LOGS} ${WORK_DIR} RESULT_VARIABLE code)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "write_payload_logs failed")
endif()
set(flags --robot=planar.yaml --log=bare.csv)
set(payload --payload_mass=2 --payload_log=payload.csv)

# The text of `key...` in calibration.json, times 10^6 and whole.
macro(micro variable)
  string(JSON text GET "${json}" ${ARGN})
  string(REGEX MATCH "^(-?)([0-9]+)([.]([0-9]*))?$" all "${text}")
  if(NOT all)
    fail("calibration.json, ${ARGN}: a number expected, found ${text}")
  endif()
  string(SUBSTRING "${CMAKE_MATCH_4}000000" 0 6 decimals)
  math(EXPR ${variable} "${CMAKE_MATCH_1}(${CMAKE_MATCH_2} * 1000000 + 1${decimals} - 1000000)")
endmacro()

# |value - truth| < 4 standard deviations, and these are below `most`.
macro(expect_within truth most value_key stddev_key)
  micro(value ${ARGN} ${value_key})
  micro(stddev ${ARGN} ${stddev_key})
  math(EXPR error "${value} - ${truth}")
  string(REPLACE "-" "" error "${error}")
  math(EXPR bound "4 * ${stddev}")
  if(error GREATER bound OR stddev GREATER ${most})
    fail("${ARGN}: ${value} +- ${stddev} found, ${truth} is true")
  endif()
endmacro()

run("gains" calibrate ${flags} ${payload} --validate=bare2.csv --out=result)
expect_code(0)
expect_empty(err)
expect_text(out "torque per current, from the known payload" "joint1" "+-"
            "N m/A" "payload of 2 kg, centre of mass x" "z not seen"
            "allows each joint's torque an error of"
            "that of the least certain constant (joint"
            "torque     currents times" "its scale known to"
            "held out")
file(READ ${WORK_DIR}/result/calibration.json json)
expect_within(12000000 120000 value stddev drive_gains 0)
expect_within(8000000 80000 value stddev drive_gains 1)
expect_within(50000 10000 com_x com_x_stddev payload)
expect_within(20000 10000 com_y com_y_stddev payload)
string(JSON unit GET "${json}" drive_gains 1 unit)
string(JSON seen GET "${json}" drive_gains 1 identifiable)
string(JSON mass GET "${json}" payload mass)
string(JSON z GET "${json}" payload com_z)
string(JSON joint_unit GET "${json}" joints 0 unit)
if(NOT "${unit}|${seen}|${mass}|${z}|${joint_unit}" STREQUAL "N m/A|ON|2.0||N m")
  fail("calibration.json: ${unit}|${seen}|${mass}|${z}|${joint_unit}")
endif()

# Gravity does not pull, and joint 1 rests while the arm carries the payload.
run("mass hidden" calibrate --robot=planar.yaml --gravity=0,0,-9.81
    --log=horizontal.csv --payload_mass=2 --payload_log=horizontal_payload.csv
    --out=hidden)
expect_code(1)
expect_text(out "not observable" "not calibrated: the torque scale is not observable"
            "cannot be told from its centre of mass and inertia")
file(READ ${WORK_DIR}/hidden/calibration.json json)
string(JSON seen GET "${json}" drive_gains 0 identifiable)
string(JSON value GET "${json}" drive_gains 0 value)
string(JSON reason GET "${json}" termination reason)
if(NOT "${seen}|${value}" STREQUAL "OFF|" OR NOT reason MATCHES "not observable")
  fail("calibration.json: ${seen}|${value}|${reason}")
endif()
if("${out}${json}" MATCHES "[^a-z](nan|inf)[^a-z]")
  fail("nan or inf as a result")
endif()

run("no payload" calibrate ${flags} --out=out)
expect_refusal(3 "bare.csv: the torque comes from currents (i1 to "
               "--torque_constants" "--payload_mass and --payload_log")
run("no such log" calibrate ${flags} --payload_mass=2 --payload_log=none.csv --out=out)
expect_refusal(3 "none.csv: cannot be opened")
run("torques instead of currents" calibrate --robot=${DATA_DIR}/scara/robot.yaml
    --log=${DATA_DIR}/scara/A.csv.gz --payload_mass=2
    --payload_log=${DATA_DIR}/scara/B.csv.gz --out=out)
expect_refusal(3 "A.csv.gz: row 1" "i1")

foreach(set
    "--payload_mass=2|--payload_mass=KG and --payload_log=FILE go together"
    "--payload_log=payload.csv|--payload_mass=KG and --payload_log=FILE go together"
    "--payload_mass=0 --payload_log=payload.csv|--payload_mass: found '0', expected one positive number"
    "--payload_mass=-1 --payload_log=payload.csv|--payload_mass: found '-1', expected one positive"
    "--payload_mass=2kg --payload_log=payload.csv|--payload_mass: found '2kg', expected a number"
    "--payload_mass=inf --payload_log=payload.csv|--payload_mass: found 'inf', expected a number"
    "--payload_mass=2 --payload_log=payload.csv,|--payload_log: found 'payload.csv,', expected file names"
    "--payload_mass=2 --payload_log=bare.csv|--payload_log names bare.csv, which is named before"
    "--payload_mass=2 --payload_log=payload.csv --torque_constants=1,2|--torque_constants is what --payload_log estimates"
    "--payload_mass=2 --payload_log=payload.csv --torque_kind=link|expected --torque_kind=current"
    "--payload_mass=2 --payload_log=payload.csv --geometry=lengths|--payload_log takes --geometry=known")
  string(REPLACE "|" ";" set "${set}")
  list(GET set 0 wrong)
  list(GET set 1 message)
  string(REPLACE " " ";" wrong "${wrong}")
  run("${wrong}" calibrate ${flags} ${wrong} --out=out)
  expect_refusal(2 "${message}")
endforeach()
