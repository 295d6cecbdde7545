# armcal inspect: a clean log, one with a fault, the mended one, refusals.

write_arm(arm ", limits: {lower: -2, upper: 2, velocity: 2, effort: 100}"
          ", limits: {lower: -2.5, upper: 2.5, velocity: 3, effort: 50}")
run("a log" simulate --robot=arm.yaml --duration=20 --log_rate=100 --out=made)
expect_code(0)

run("nothing wrong" inspect --robot=arm.yaml --log=made/log.csv --out=out)
expect_code(0)
expect_text(out "arm: 2 joints" "nothing wrong was found" "made/log.csv"
            "13 of 13 directions of the model parameters show"
            "nothing wrong was found")
expect_empty(err)

# The torque of joint 2 has its sign changed.
file(STRINGS ${WORK_DIR}/made/log.csv rows)
list(GET rows 0 header)
string(REPLACE "," ";" names "${header}")
list(FIND names tau2 column)
set(wrong "${header}\n")
list(REMOVE_AT rows 0)
foreach(row ${rows})
  string(REPLACE "," ";" values "${row}")
  list(GET values ${column} tau)
  if(tau MATCHES "^-")
    string(SUBSTRING "${tau}" 1 -1 tau)
  else()
    string(PREPEND tau "-")
  endif()
  list(REMOVE_AT values ${column})
  list(INSERT values ${column} "${tau}")
  string(REPLACE ";" "," row "${values}")
  string(APPEND wrong "${row}\n")
endforeach()
file(WRITE ${WORK_DIR}/wrong.csv "${wrong}")

run("a wrong sign" inspect --robot=arm.yaml --log=wrong.csv --out=out --fix)
expect_code(1)
expect_text(out "the torque of joint2 has the wrong sign"
            "fixed_1.csv is the log so")
file(READ ${WORK_DIR}/out/inspect.json json)
string(JSON finding GET "${json}" logs 0 findings 0 finding)
string(JSON joint GET "${json}" logs 0 findings 0 joint_index)
if(NOT "${finding}@${joint}" STREQUAL "torque_sign@2")
  fail("inspect.json names ${finding}@${joint}")
endif()
file(RENAME ${WORK_DIR}/out/fixed_1.csv ${WORK_DIR}/fixed.csv)
run("mended" inspect --robot=arm.yaml --log=fixed.csv)
expect_code(0)
expect_text(out "nothing wrong was found")

run("the robot alone" inspect --robot=arm.yaml)
expect_code(0)
run("nowhere to write" inspect --robot=arm.yaml --log=made/log.csv --fix)
expect_refusal(2 "--fix needs --out=FOLDER")
run("no robot" inspect --log=made/log.csv)
expect_refusal(2 "--robot")
