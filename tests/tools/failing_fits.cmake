# Fits that cannot work end with a verdict, exit code 1 and no number that is
# infinite or undefined. Data made from the SCARA's by awk.
set(robot --robot=${DATA_DIR}/scara/robot.yaml)

# log(file, program) writes the SCARA's log B, each row of it put through awk.
function(write_log file program)
  execute_process(COMMAND gzip -dc ${DATA_DIR}/scara/B.csv.gz
                  COMMAND awk -F, "-vOFS=," "-vCONVFMT=%.12g" "-vOFMT=%.12g"
                          "BEGIN {srand(1)} NR > 1 {${program}} {print}"
                  OUTPUT_FILE ${WORK_DIR}/${file} RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "awk or gzip failed: ${failed}")
  endif()
endfunction()

function(write_poses file program)
  execute_process(COMMAND awk -F, "-vOFS=," "-vCONVFMT=%.12g" "-vOFMT=%.12g"
                          "BEGIN {srand(1)} NR > 1 {${program}} {print}" ${DATA_DIR}/scara/poses.csv
                  OUTPUT_FILE ${WORK_DIR}/${file} RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "awk failed: ${failed}")
  endif()
endfunction()

# A negative verdict, in the text and in out/calibration.json, all numbers of
# which are finite or null.
function(expect_verdict)
  expect_code(1)
  expect_empty(err)
  expect_text(out ${ARGN})
  file(READ ${WORK_DIR}/out/calibration.json json)
  string(JSON passed GET "${json}" verdict passed)
  string(JSON reasons LENGTH "${json}" verdict reasons)
  if(passed OR reasons EQUAL 0)
    fail("calibration.json: verdict must be negative, with its reasons")
  endif()
  file(GLOB files ${WORK_DIR}/out/*.json ${WORK_DIR}/out/*.csv
       ${WORK_DIR}/out/*.urdf)
  foreach(file ${files})
    file(READ ${file} text)
    string(APPEND all "${text}")
  endforeach()
  string(TOLOWER "${out}${all}" all)
  if(all MATCHES "[^a-z]-?(nan|inf|infinity)[^a-z]")
    fail("a number that is none: ${CMAKE_MATCH_0}")
  endif()
endfunction()

write_log(still.csv "$4 = 0.1; $8 = $12 = 0; $16 = -30.478")
run("a joint that never moves" calibrate ${robot} --log=still.csv --out=out)
expect_verdict("failed     lift never moves (by 0 m at most)")

write_log(garbage.csv "for (i = 14; i <= 17; ++i) $i = 100 * (rand() - 0.5)")
run("torque that is garbage" calibrate ${robot} --log=garbage.csv --out=out)
expect_verdict("failed     the model leaves " "% of the torque unexplained")

write_log(one_garbage.csv "$17 = 100 * (rand() - 0.5)")
run("one joint's torque is garbage" calibrate ${robot} --log=one_garbage.csv --out=out)
expect_verdict("failed     the model leaves ")

write_log(gross.csv "for (i = 14; i <= 17; ++i) $i = (rand() < 0.5 ? -1 : 1) * 1e9")
run("all torque samples are outliers" calibrate ${robot} --log=gross.csv --out=out)
expect_verdict("failed     the model leaves ")

write_log(huge.csv "for (i = 14; i <= 17; ++i) $i = (rand() < 0.5 ? -1 : 1) * 1e200")
run("torque that overflows" calibrate ${robot} --log=huge.csv --out=out)
expect_verdict("not calibrated: ")

write_log(zero.csv "for (i = 14; i <= 17; ++i) $i = 0")
run("no torque" calibrate ${robot} --log=zero.csv --out=out)
expect_verdict("scara: not calibrated: the torque in the logs is zero throughout")

write_log(nothing.csv "for (i = 2; i <= 5; ++i) $i = 0.3; for (i = 6; i <= 13; ++i) $i = 0")
run("no motion" calibrate ${robot} --log=nothing.csv --out=out)
expect_verdict("not calibrated: ")

set(poses calibrate ${robot} --geometry=refine --out=out)
write_poses(three.csv "if (NR > 4) exit")
run("three poses" ${poses} --poses=three.csv)
expect_verdict("scara: not calibrated: 3 different arm positions give")

write_poses(random.csv "for (i = 5; i <= NF; ++i) $i = rand()")
run("poses that are all outliers" ${poses} --poses=random.csv)
expect_verdict("failed     the poses do not follow the joints")

write_poses(still_poses.csv "$7 += 0.2 - $3; $10 += 0.2 - $3; $3 = 0.2")
run("a joint that never moves in the poses" ${poses} --poses=still_poses.csv)
expect_verdict("failed     lift never moves (by 0 m at most): the geometry")
