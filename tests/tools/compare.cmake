# armcal compare: results of one robot that agree, and that do not.
write_arm(arm ", limits: {lower: -2, upper: 2, velocity: 2, effort: 100}"
          ", limits: {lower: -2.5, upper: 2.5, velocity: 3, effort: 50}")
foreach(run 1 2 3)
  set(hidden)
  if(run EQUAL 3)
    set(hidden --effects=payload)
  endif()
  run("log ${run}" simulate --robot=arm.yaml --duration=10 --log_rate=200
      --run=${run} ${hidden} --out=log${run})
  expect_code(0)
  run("calibrate ${run}" calibrate --robot=arm.yaml --log=log${run}/log.csv
      --out=result${run})
endforeach()

run("of one robot" compare result1 result2 --out=compared)
expect_code(0)
expect_text(out "together: squares of deviations" "the two agree within noise")
file(READ ${WORK_DIR}/compared/comparison.json json)
string(JSON agrees GET "${json}" agrees)
if(NOT agrees STREQUAL "ON" AND NOT agrees STREQUAL "true")
  fail("comparison.json: agrees is ${agrees}")
endif()
run("of a payload" compare result1 result2 result3)
expect_code(1)
expect_text(out "are of fewer than three logs"
            "A and C, B and C disagree beyond noise")
run("on a log" compare result1/calibration.json result3 --robot=arm.yaml
    --log=log2/log.csv)
expect_code(1)
expect_text(out "torque left on the log" "times what A leaves")

run("a robot with itself" compare arm.yaml arm.yaml)
expect_code(0)
run("a calibration with its robot" compare result1/robot.urdf result1)
if(code GREATER 1)
  fail("a robot beside a calibration is refused")
endif()

run("a verification" verify --robot=arm.yaml --out=verified)
run("of two kinds" compare result1 verified)
expect_refusal(2 "--results: found a verification (verified) beside a calibration")
run("one alone" compare result1)
expect_refusal(2 "--results: expected two results or more")
run("none" compare)
expect_refusal(2 "two results are needed: armcal compare A B")
run("words elsewhere" inspect arm.yaml)
expect_refusal(2 "'arm.yaml' is not a flag")
