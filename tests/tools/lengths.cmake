# calibrate --geometry=lengths and all_lengths: a robot file with the lengths
# that the linear calibration recovered.
execute_process(COMMAND ${WRITE_LENGTH_LOGS} ${WORK_DIR} RESULT_VARIABLE code)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "write_length_logs failed")
endif()

# A decimal number of calibration.json, times 10^6 and whole.
function(micro variable)
  string(JSON text GET "${json}" ${ARGN})
  if(NOT text MATCHES "^(-?)([0-9]+)[.]([0-9]+)$")
    fail("calibration.json, ${ARGN}: a number expected, found ${text}")
  endif()
  string(SUBSTRING "${CMAKE_MATCH_3}000000" 0 6 decimals)
  math(EXPR value "${CMAKE_MATCH_1}(${CMAKE_MATCH_2} * 1000000 + 1${decimals} - 1000000)")
  set(${variable} ${value} PARENT_SCOPE)
endfunction()

# Held out, percent of the torque: `found` is at most 5 % above `reference`.
function(expect_as_good found reference)
  math(EXPR scaled "${found} * 100")
  math(EXPR bound "${reference} * 105")
  if(scaled GREATER bound)
    fail("residual ${found}, at most 5 % above ${reference} expected")
  endif()
endfunction()

set(percent validation_stacked_residual_percent)
foreach(geometry lengths all_lengths)
  run("${geometry}" calibrate --robot=ur5.urdf --log=training.csv
      --validate=held_out.csv --geometry=${geometry} --bandwidth=0
      --joint_terms=viscous --estimate=refined --out=${geometry})
  expect_code(0)
  expect_empty(err)
  expect_text(out "length " "link2.a" "robot for a simulator" "held out"
              "lengths    " "link2.a" "taken for exact")
  file(READ ${WORK_DIR}/${geometry}/calibration.json json)
  micro(refined ${percent})
  micro(linear linear ${percent})
  expect_as_good(${refined} ${linear})
  # Lengths of the linear calibration, which the robot has.
  string(JSON count LENGTH "${json}" geometry)
  string(JSON lengths GET "${json}" geometry)
  if(count LESS 4 OR NOT lengths MATCHES "\"link2.a\".*\"link3.a\"")
    fail("calibration.json: ${count} lengths: ${lengths}")
  endif()
  # What was written, read again and believed, predicts as well.
  run("robot.urdf of ${geometry}" calibrate --robot=${geometry}/robot.urdf
      --log=training.csv --validate=held_out.csv --bandwidth=0 --trust=1e-5
      --joint_terms=viscous --estimate=refined --out=${geometry}_again)
  expect_code(0)
  file(READ ${WORK_DIR}/${geometry}_again/calibration.json json)
  micro(again ${percent})
  expect_as_good(${again} ${linear})
endforeach()

# The file's own lengths, believed, do not: the comparison can fail.
run("the file's lengths" calibrate --robot=ur5.urdf --log=training.csv
    --validate=held_out.csv --bandwidth=0 --joint_terms=viscous
    --estimate=refined --out=file)
file(READ ${WORK_DIR}/file/calibration.json json)
micro(wrong ${percent})
math(EXPR scaled "${wrong} * 100")
math(EXPR bound "${linear} * 105")
if(NOT scaled GREATER bound)
  fail("wrong lengths must show: ${wrong}, and ${linear} without them")
endif()

# A DH table; gravity along its axes hides the lengths: they stay the file's.
run("scara" calibrate --robot=${DATA_DIR}/scara/robot.yaml
    --log=${DATA_DIR}/scara/B.csv.gz --validate=${DATA_DIR}/scara/A.csv.gz
    --geometry=lengths --joint_terms=none --bandwidth=0 --estimate=refined
    --out=scara)
expect_code(0)
expect_text(out "only products with moments seen" "robot for a simulator"
            "lengths    upper_arm.a" "as in the file: not seen alone")
file(READ ${WORK_DIR}/scara/robot.urdf urdf)
if(NOT urdf MATCHES "xyz=\"0.4 0 0\"")
  fail("robot.urdf: the elbow at 0.4 m expected")
endif()

run("another model" calibrate --robot=${DATA_DIR}/scara/robot.yaml
    --log=${DATA_DIR}/scara/B.csv.gz --joint_terms=none --bandwidth=0
    --identification=differential --estimate=refined)
expect_code(1)
expect_text(out "no robot file: it takes the weak form")
