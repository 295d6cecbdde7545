# Logs that cannot be used as they are: exit code 3 and one line that names
# file, row, column, value and expectation.
set(header "t,q1,q2,tau1,tau2")
set(rows)
foreach(k RANGE 10 40)
  math(EXPR sign "1 - 2 * (${k} % 2)")
  list(APPEND rows "1.${k},0.${k},${sign}.5,2.${k},-0.${k}")
endforeach()
file(WRITE ${WORK_DIR}/robot.yaml "convention: standard
links:
  - {joint: revolute, a: 0.4}
  - {joint: revolute, a: 0.3}
")

# Writes a log whose row `row` (the header is row 1) is `text`.
function(write_log name header row text)
  set(lines "${header}" ${rows})
  if(row GREATER 1)
    math(EXPR at "${row} - 1")
    list(REMOVE_AT lines ${at})
    list(INSERT lines ${at} "${text}")
  endif()
  list(JOIN lines "\n" content)
  file(WRITE ${WORK_DIR}/${name} "${content}\n")
endfunction()

macro(calibrate log)
  run("${log}" calibrate --robot=robot.yaml --log=${log} --out=out ${ARGN})
endmacro()

write_log(good.csv "${header}" 1 "")
calibrate(good.csv)
expect_code(0)
if(NOT EXISTS ${WORK_DIR}/out/calibration.json)
  fail("out/calibration.json expected")
endif()

calibrate(absent.csv)
expect_refusal(3 "absent.csv: cannot be opened: No such file")
calibrate(good.csv --validate=absent.csv)
expect_refusal(3 "absent.csv: cannot be opened")

write_log(column.csv "t,q1,q2,tau1,other" 1 "")
calibrate(column.csv)
expect_refusal(3 "column.csv: row 1: missing tau2" "the robot has 2 joints, the log holds tau1")
write_log(no_time.csv "x,q1,q2,tau1,tau2" 1 "")
calibrate(no_time.csv)
expect_refusal(3 "no_time.csv: row 1" "time")
write_log(joints.csv "t,q1,q2,tau1,q3" 1 "")
calibrate(joints.csv)
expect_refusal(3 "joints.csv: row 1: wrong number of joints: the robot has 2 joints, the log holds q1..q3")

write_log(nan.csv "${header}" 5 "1.13,0.1,nan,0.1,0.1")
calibrate(nan.csv)
expect_refusal(3 "nan.csv: row 5, column q2: found 'nan': expected a finite number")
write_log(text.csv "${header}" 5 "1.13,0.1,0.1,off,0.1")
calibrate(text.csv)
expect_refusal(3 "text.csv: row 5, column tau1: found 'off': expected a finite number")
write_log(back.csv "${header}" 5 "1.05,0.1,0.1,0.1,0.1")
calibrate(back.csv)
expect_refusal(3 "back.csv: row 5, column t: found '1.05': time runs backwards, the row before has 1.12")
write_log(short.csv "${header}" 5 "1.13,0.1,0.1,0.1")
calibrate(short.csv)
expect_refusal(3 "short.csv: row 5" "expected 5")

# What is wrong where nobody looks does no harm.
write_log(unused.csv "t,q1,q2,tau1,tau2,note" 5 "1.13,0.1,0.1,0.1,0.1,nan")
set(lines)
file(STRINGS ${WORK_DIR}/unused.csv lines)
list(TRANSFORM lines APPEND ",text" REGEX "^1[.](1[0-24-9]|[2-4])")
list(JOIN lines "\n" content)
file(WRITE ${WORK_DIR}/unused.csv "${content}\n")
calibrate(unused.csv)
expect_code(0)

# A gzip stream whose end is missing, first in the log, then in the held-out
# one, when work is done already.
execute_process(COMMAND head -c 20000 ${DATA_DIR}/scara/A.csv.gz
                OUTPUT_FILE ${WORK_DIR}/cut.csv.gz)
set(scara --robot=${DATA_DIR}/scara/robot.yaml --out=out)
run("truncated gzip" calibrate ${scara} --log=cut.csv.gz)
expect_refusal(3 "cut.csv.gz: row " "the gzip stream ends early, the file is truncated")
run("truncated held-out gzip" calibrate ${scara} --log=${DATA_DIR}/scara/A.csv.gz
    --validate=cut.csv.gz)
expect_refusal(3 "cut.csv.gz: row " "truncated")

calibrate(good.csv --crop=10:11)
expect_refusal(3 "good.csv: found '0 samples': expected at least 3 samples")
calibrate(good.csv --bandwidth=1000)
expect_refusal(3 "--bandwidth: found '1000': expected 0, or less than half the sample rate")
calibrate(good.csv --validate=good.csv)
expect_refusal(2 "--validate names good.csv, which --log calibrates on")
calibrate(good.csv,good.csv)
expect_refusal(2 "--log names good.csv twice")
calibrate(good.csv --torque_kind=current)
expect_refusal(3 "good.csv" "--torque_constants")
calibrate(good.csv --torque_constants=1,2,3)
expect_refusal(3 "--torque_constants: found '1 2 3': expected one value per joint, the robot has 2")
calibrate(good.csv --identification=integral --intervals=0:9)
expect_refusal(3 "good.csv: --intervals: 1 of 1 intervals cannot be used; expected each to lie within the log")

# A result that cannot be written: the file `blocked` is no folder.
file(WRITE ${WORK_DIR}/blocked "")
run("blocked" calibrate --robot=robot.yaml --log=good.csv --out=blocked/out)
expect_refusal(3 "blocked/out: --out: cannot be written")
