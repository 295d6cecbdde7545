# The same log in other formats: calibrations have the same digits as from CSV.
# And what is refused.

# same_calibration(CSV files...): each file gives what the CSV gives.
function(same_calibration csv)
  run("${csv}" calibrate --robot=arm.yaml --log=${csv} --out=csv
      --torque_constants_stddev=0)
  if(code GREATER 1)
    fail("a calibration expected")
  endif()
  file(READ ${WORK_DIR}/csv/calibration.json expected)
  foreach(log ${ARGN})
    set(flags --torque_constants_stddev=0)
    if(log MATCHES "two_topics")
      list(APPEND flags --topics=effort:/torques)
    endif()
    run("${log}" calibrate --robot=arm.yaml --log=${log} --out=other ${flags})
    file(READ ${WORK_DIR}/other/calibration.json json)
    string(REPLACE "${log}" "${csv}" json "${json}")
    if(NOT json STREQUAL expected)
      fail("gives another calibration than the same log as CSV")
    endif()
    file(REMOVE_RECURSE ${WORK_DIR}/other)
  endforeach()
endfunction()

write_arm(arm "" "")
run("a log" simulate --robot=arm.yaml --duration=20 --log_rate=100 --out=made)
expect_code(0)
find_program(python python3 HINTS /usr/bin NO_DEFAULT_PATH)
execute_process(COMMAND ${python} ${CMAKE_CURRENT_LIST_DIR}/../write_npz.py
                ${WORK_DIR}/made/log.csv ${WORK_DIR}/npz RESULT_VARIABLE failed)
if(failed)
  fail("write_npz.py failed: python3-numpy of tools/setup.sh is needed")
endif()
same_calibration(made/log.csv npz/columns.npz npz/signals.npz npz/named.npz)
# A pipe gives its bytes once, whatever they are of, and logs are read twice.
foreach(made made/log.csv npz/named.npz)
  execute_process(
    COMMAND sh -c "rm -f piped && mkfifo piped && cat '${made}' > piped &"
    WORKING_DIRECTORY ${WORK_DIR} OUTPUT_QUIET ERROR_QUIET TIMEOUT 10)
  same_calibration(made/log.csv piped)
endforeach()
run("single precision" calibrate --robot=arm.yaml --log=npz/single.npz)
expect_code(0)

# Bags and .mat, written by others (data/log_formats/README.md).
file(COPY ${DATA_DIR}/log_formats/log.csv ${FORMATS_DIR}/ DESTINATION ${WORK_DIR}/few)
set(formats log.db3 zstd.mcap lz4.mcap plain.mcap big_endian.mcap
    two_topics.mcap split v4.mat v5.mat v73.mat)
list(TRANSFORM formats PREPEND few/ OUTPUT_VARIABLE files)
same_calibration(few/log.csv ${files})
# The long log too, where there is a Python with their packages.
find_program(bag_python python3 HINTS $ENV{BAG_PYTHON})
execute_process(COMMAND ${bag_python} ${CMAKE_CURRENT_LIST_DIR}/../write_bags.py
                ${WORK_DIR}/made/log.csv ${WORK_DIR}/many RESULT_VARIABLE failed
                ERROR_QUIET)
if(failed)
  message("no bags of the long log: write_bags.py lacks its packages; "
          "BAG_PYTHON=FOLDER says where a python3 is that has them")
else()
  list(TRANSFORM formats PREPEND many/ OUTPUT_VARIABLE files)
  same_calibration(made/log.csv ${files})
endif()

# Poses come by the same door.
execute_process(COMMAND ${python} -c "import sys, numpy as np
p = np.genfromtxt(sys.argv[1], delimiter=',', names=True)
np.savez(sys.argv[2], **{name: p[name] for name in p.dtype.names})"
                ${DATA_DIR}/scara/poses.csv ${WORK_DIR}/poses.npz)
file(COPY ${DATA_DIR}/scara/poses.csv DESTINATION ${WORK_DIR})
set(scara --robot=${DATA_DIR}/scara/robot.yaml --geometry=refine)
run("poses" calibrate ${scara} --poses=poses.csv)
set(expected "${out}")
run("poses as npz" calibrate ${scara} --poses=poses.npz)
string(REPLACE "poses.npz" "poses.csv" out "${out}")
if(NOT code EQUAL 0 OR NOT out STREQUAL expected)
  fail("the same as from CSV expected: ${expected}")
endif()

foreach(refusal
    "short.npz|array q: found '2200 rows': expected 2201, as many as the array of times"
    "timeless.npz|row 1: no time column: expected t, time"
    "nan.npz|row 7, column tau1: found 'nan'"
    "cut.npz|is a zip archive without its directory"
    "damaged.npz|is damaged in "
    "objects.npz|row 1: no torque: missing tau1")
  string(REPLACE "|" ";" refusal "${refusal}")
  list(POP_FRONT refusal name)
  run("${name}" calibrate --robot=arm.yaml --log=npz/${name} --out=out)
  expect_refusal(3 "npz/${name}: ${refusal}")
endforeach()

run("topics" calibrate --robot=arm.yaml --log=few/two_arms.mcap
    --topics=/joint_states,torque:/torques)
expect_refusal(2 "--topics: found 'torque:/torques', expected a topic's name, or one of position, velocity")
run("sensor without a name" calibrate --robot=arm.yaml --log=few/wrench.mcap --topics=wrench:)
expect_refusal(2 "--topics: found 'wrench:', expected a topic's name, or one of position, velocity")
run("topic twice" calibrate --robot=arm.yaml --log=few/wrench.mcap --topics=wrench:/ft,wrench:/ft)
expect_refusal(2 "--topics: names 'wrench:/ft' twice")
run("sensor" inspect --robot=arm.yaml --log=few/wrench.mcap --topics=wrench:/ft)
if(code GREATER 1)
  fail("a bag with a force-torque sensor is read: ${err}")
endif()
run("topic not there" inspect --robot=arm.yaml --log=few/log.db3 --topics=/states)
expect_refusal(3 "few/log.db3: topic /states: is not in the bag; the bag has /joint_states (sensor_msgs/msg/JointState), /chatter (std_msgs/msg/String)")
run("no efforts" inspect --robot=arm.yaml --log=few/nan_effort.mcap)
expect_text(err "the effort of joint1, joint2 is empty or NaN in all messages")
