# report.html of every command, and where Chromium is there what it draws: no
# error, no request, names as text.

string(REPEAT "elbow-" 40 long)
write_arm("'</script><img src=x onerror=alert(1)>'"
          ", joint_name: '<b>elbow</b> مفصل 🦾 ${long}', limits: {lower: -2, upper: 2, velocity: 2}"
          ", limits: {lower: -2.5, upper: 2.5, velocity: 3}")
run("a log" simulate --robot=arm.yaml --duration=20 --log_rate=100
    --effects=viscous_friction@2 --out=made)
expect_code(0)
run("calibrated" calibrate --robot=arm.yaml --log=made/log.csv --out=calibrate)
expect_code(0)
run("verified" verify --robot=arm.yaml --log=made/log.csv
    --calibration=calibrate/calibration.json --out=verify)
run("diagnosed" diagnose --robot=arm.yaml --log=made/log.csv --forward=false
    --out=diagnose)
run("designed" excite --robot=arm.yaml --duration=5 --out=excite)
expect_code(0)
run("inspected" inspect --robot=arm.yaml --log=made/log.csv --out=inspect)
expect_code(0)
run("postures" excite --robot=arm.yaml --static_poses=6 --out=postures)

# provenance.json names what was read and what was written by their hashes.
file(READ ${WORK_DIR}/calibrate/provenance.json provenance)
foreach(list IN ITEMS files results)
  string(JSON last LENGTH "${provenance}" ${list})
  math(EXPR last "${last} - 1")
  foreach(k RANGE ${last})
    string(JSON path GET "${provenance}" ${list} ${k} path)
    string(JSON told GET "${provenance}" ${list} ${k} sha256)
    if(list STREQUAL results)
      string(PREPEND path calibrate/)
    endif()
    file(SHA256 ${WORK_DIR}/${path} found)
    if(NOT told STREQUAL found)
      fail("provenance.json: ${path} has another SHA-256")
    endif()
    list(APPEND told_of ${path})
  endforeach()
endforeach()
foreach(path arm.yaml made/log.csv calibrate/calibration.json)
  if(NOT path IN_LIST told_of)
    fail("provenance.json lacks ${path}")
  endif()
endforeach()
string(JSON sources GET "${provenance}" versions sources)
run("version" --version)
expect_text(out "(sources ${sources})")
# A command line that hides effects stays with the truth.
run("hidden" simulate --robot=arm.yaml --duration=5 --effects=viscous_friction@2
    --out=seen --truth=truth)
if(EXISTS ${WORK_DIR}/seen/provenance.json OR
   NOT EXISTS ${WORK_DIR}/truth/provenance.json)
  fail("provenance.json beside truth.json expected")
endif()

run("the same again" calibrate --robot=arm.yaml --log=made/log.csv --out=again)
file(READ ${WORK_DIR}/calibrate/report.html page)
file(READ ${WORK_DIR}/again/report.html other)
string(REPLACE "--out=again" "--out=calibrate" other "${other}")
if(NOT page STREQUAL other)
  fail("the same command writes another report")
endif()

run("poses" calibrate --robot=${DATA_DIR}/scara/robot.yaml --geometry=refine
    --poses=${DATA_DIR}/scara/poses.csv --out=poses)
execute_process(COMMAND awk -F, -v OFS=, "NR > 1 {$2 += $1} {print}" ${DATA_DIR}/scara/poses.csv
                OUTPUT_FILE ${WORK_DIR}/coupled.csv)
run("coupled poses" diagnose --robot=${DATA_DIR}/scara/robot.yaml --poses=coupled.csv
    --out=coupled_poses)

run("compare" compare calibrate again --robot=arm.yaml --log=made/log.csv
    --out=compare)

set(pages)
foreach(command inspect calibrate verify diagnose excite postures poses coupled_poses
        compare)
  set(file ${WORK_DIR}/${command}/report.html)
  if(NOT EXISTS ${file})
    fail("${command} must write report.html")
    continue()
  endif()
  list(APPEND pages ${file})
  file(SIZE ${file} bytes)
  if(bytes GREATER 1500000)
    fail("${command}'s report has ${bytes} bytes")
  endif()
endforeach()

find_program(chromium chromium)
if(NOT chromium)
  message("reports are not drawn: chromium is not here")
  return()
endif()
find_program(python python3 HINTS /usr/bin NO_DEFAULT_PATH)
execute_process(COMMAND ${python} ${CMAKE_CURRENT_LIST_DIR}/report_browser.py
                        ${chromium} ${pages}
                RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE err)
message("${out}")
set(case "in a browser")
if(code)
  fail("a report is not as it must be")
endif()
