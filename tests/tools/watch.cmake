# armcal watch: events of a finished log, of a pipe and of a file that grows; what
# is refused; the page in a browser.
write_arm(arm ", limits: {lower: -2, upper: 2, velocity: 2, effort: 100}"
          ", limits: {lower: -2.5, upper: 2.5, velocity: 3, effort: 50}")
foreach(run 1 2 3)
  set(hidden)
  if(run EQUAL 3)
    set(hidden "--effects=payload:mass=0.8kg")
  endif()
  run("log ${run}" simulate --robot=arm.yaml --duration=20 --log_rate=500
      --run=${run} ${hidden} --out=log${run})
  expect_code(0)
endforeach()
run("calibrate" calibrate --robot=arm.yaml --log=log1/log.csv --out=result)
expect_code(0)
set(watch watch --robot=arm.yaml --calibration=result --learn=10)

run("of nothing" ${watch} --log=log2/log.csv)
expect_code(0)
expect_text(out "learned" "nothing has changed")
run("of too little" watch --robot=arm.yaml --calibration=result --log=log2/log.csv
    --learn=60 --out=short)
expect_code(1)
expect_text(out "so nothing was tested; give a smaller --learn (it is 60 s of motion)")
file(READ ${WORK_DIR}/short/watch.json text)
string(JSON learned GET "${text}" learned)
if(learned)
  fail("watch.json: nothing was learned")
endif()
run("of a payload" ${watch} --log=log3/log.csv --out=out)
expect_code(1)
expect_text(out "payload" "other than calibrated" "payload.mass" "changes were told")
foreach(file watch.json events.jsonl provenance.json)
  if(NOT EXISTS ${WORK_DIR}/out/${file})
    fail("${file} must be written")
  endif()
endforeach()

# The second log behind the first, as if it went on.
execute_process(COMMAND awk -F, -v OFS=, "FNR == 1 {if (NR == 1) print; next} \
NR != FNR {$1 += 22.002} {print}" log2/log.csv log3/log.csv
                WORKING_DIRECTORY ${WORK_DIR} OUTPUT_FILE ${WORK_DIR}/joined.csv)
run("of a payload later" ${watch} --log=joined.csv --json)
expect_code(1)
expect_text(out "\"event\":\"learned\"" "\"event\":\"payload\"" "\"event\":\"summary\"")
set(of_joined "${out}")
set(case "of a pipe")
execute_process(COMMAND cat joined.csv
                COMMAND ${ARMCAL} ${watch} --log=- --json
                WORKING_DIRECTORY ${WORK_DIR}
                RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE err)
expect_code(1)
string(REPLACE "joined.csv" "standard input" expected "${of_joined}")
if(NOT out STREQUAL expected)
  fail("a pipe tells other things than its file")
endif()
execute_process(COMMAND sed "9000s/,.*/,half a ro/;9001s/^[0-9.]*/-5/" joined.csv
                WORKING_DIRECTORY ${WORK_DIR} OUTPUT_FILE ${WORK_DIR}/bad.csv)
run("of bad rows" ${watch} --log=bad.csv --follow --idle=1)
expect_code(1)
expect_text(out "row skipped" "row 9000" "row skipped" "row 9001"
            "time runs backwards" "2 skipped")
run("of bad rows, finished" ${watch} --log=bad.csv)
expect_code(3)
expect_text(err "bad.csv: row 9000")

run("no calibration" watch --robot=arm.yaml --log=log2/log.csv)
expect_refusal(2 "--calibration is needed")
run("no log" ${watch})
expect_refusal(2 "--log is needed")
run("two logs" ${watch} --log=log1/log.csv,log2/log.csv)
expect_refusal(2 "expected one log to watch, found 2")
run("too wide" ${watch} --log=log2/log.csv --bandwidth=100)
expect_refusal(2 "--bandwidth: found 100 Hz with a log of 500 rows a second")
run("no false alarm ever" ${watch} --log=log2/log.csv --false_alarms=0)
expect_refusal(2 "--false_alarms: found 0, expected more than 0")
run("a gzip that grows" ${watch} --log=${DATA_DIR}/scara/A.csv.gz --follow)
expect_refusal(3 "only CSV can be followed")
run("a folder that grows" ${watch} --log=log1 --follow)
expect_refusal(3 "is a folder: a bag that is being written")

find_program(chromium chromium)
if(NOT chromium)
  message("the page is not drawn: chromium is not here")
  return()
endif()
find_program(python python3 HINTS /usr/bin NO_DEFAULT_PATH)
execute_process(COMMAND ${python} ${CMAKE_CURRENT_LIST_DIR}/watch_browser.py
                        ${chromium} ${ARMCAL} joined.csv
                WORKING_DIRECTORY ${WORK_DIR}
                RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE err)
message("${out}")
set(case "in a browser")
if(code)
  fail("the page is not as it must be")
endif()
