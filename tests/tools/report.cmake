# report.html of every command, and where Chromium is there what it draws: no
# error, no request, names as text.

write_arm("'</script><img src=x onerror=alert(1)>'"
          ", joint_name: '<b>elbow</b>', limits: {lower: -2, upper: 2, velocity: 2}"
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
run("postures" excite --robot=arm.yaml --static_poses=6 --out=postures)

run("the same again" calibrate --robot=arm.yaml --log=made/log.csv --out=again)
file(READ ${WORK_DIR}/calibrate/report.html page)
file(READ ${WORK_DIR}/again/report.html other)
string(REPLACE "--out=again" "--out=calibrate" other "${other}")
if(NOT page STREQUAL other)
  fail("the same command writes another report")
endif()

find_program(chromium chromium)
foreach(command calibrate verify diagnose excite postures)
  set(file ${WORK_DIR}/${command}/report.html)
  if(NOT EXISTS ${file})
    fail("${command} must write report.html")
    continue()
  endif()
  file(SIZE ${file} bytes)
  if(bytes GREATER 1500000)
    fail("${command}'s report has ${bytes} bytes")
  endif()
  if(NOT chromium)
    message("reports are not drawn: chromium is not here")
    continue()
  endif()
  execute_process(
    COMMAND ${chromium} --headless --no-sandbox --disable-gpu --disable-quic
            --no-first-run --disable-background-networking
            --disable-component-update --disable-sync
            --user-data-dir=${WORK_DIR}/browser --virtual-time-budget=5000
            --enable-logging=stderr --dump-dom file://${file}
    TIMEOUT 60 OUTPUT_VARIABLE dom ERROR_VARIABLE said)
  if(said MATCHES "CONSOLE[^\n]*")
    fail("${command}'s report says in the browser: ${CMAKE_MATCH_0}")
  endif()
  if(NOT dom MATCHES "data-ready=.true.")
    fail("${command}'s report is not drawn to its end")
  endif()
  if(dom MATCHES "<img" OR NOT dom MATCHES "&lt;img src=x")
    fail("${command}'s report takes a name for HTML")
  endif()
  if(command MATCHES "calibrate|verify|diagnose" AND
     NOT dom MATCHES "<canvas")
    fail("${command}'s report draws no torques")
  endif()
endforeach()
