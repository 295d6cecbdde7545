# Logs as NumPy writes them: the same digits as from CSV, and what is refused.

file(WRITE ${WORK_DIR}/arm.yaml "name: arm
gravity: [0, -9.81, 0]
convention: standard
links:
  - {joint: revolute, a: .4, mass: 5, com: [-.2, 0, 0], inertia: [.01, .07, .07],
     viscous: 2, coulomb: 3, armature: .3}
  - {joint: revolute, a: .3, mass: 3, com: [-.15, 0, 0], inertia: [.01, .03, .03],
     viscous: 1, coulomb: 2, armature: .2}
")
run("a log" simulate --robot=arm.yaml --duration=20 --log_rate=100 --out=made)
expect_code(0)
find_program(python python3 HINTS /usr/bin NO_DEFAULT_PATH)
execute_process(COMMAND ${python} ${CMAKE_CURRENT_LIST_DIR}/../write_npz.py
                ${WORK_DIR}/made/log.csv ${WORK_DIR}/npz RESULT_VARIABLE failed)
if(failed)
  fail("write_npz.py failed: python3-numpy of tools/setup.sh is needed")
endif()

run("from CSV" calibrate --robot=arm.yaml --log=made/log.csv --out=csv)
expect_code(0)
file(READ ${WORK_DIR}/csv/calibration.json expected)
foreach(name columns signals named)
  run("${name}" calibrate --robot=arm.yaml --log=npz/${name}.npz --out=${name})
  expect_code(0)
  file(READ ${WORK_DIR}/${name}/calibration.json json)
  string(REPLACE "npz/${name}.npz" "made/log.csv" json "${json}")
  if(NOT json STREQUAL expected)
    fail("${name}.npz gives another calibration than the same log as CSV")
  endif()
endforeach()
run("single precision" calibrate --robot=arm.yaml --log=npz/single.npz)
expect_code(0)

run("too few rows" calibrate --robot=arm.yaml --log=npz/short.npz)
expect_refusal(3 "npz/short.npz: array q" "as many as the array of times")
run("no time" calibrate --robot=arm.yaml --log=npz/timeless.npz)
expect_refusal(3 "npz/timeless.npz: has no array of times: expected t, time")
run("not a number" calibrate --robot=arm.yaml --log=npz/nan.npz)
expect_refusal(3 "npz/nan.npz: row 7, column tau1: found 'nan'")
run("cut off" calibrate --robot=arm.yaml --log=npz/cut.npz)
expect_refusal(3 "npz/cut.npz: is a zip archive without its directory")
run("damaged" calibrate --robot=arm.yaml --log=npz/damaged.npz)
expect_refusal(3 "npz/damaged.npz: is damaged in ")
run("objects" calibrate --robot=arm.yaml --log=npz/objects.npz)
expect_refusal(3 "npz/objects.npz: row 1: no torque: missing tau1")
