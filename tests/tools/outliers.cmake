# calibrate --loss: torque samples that are wrong are listed, and kept by
# --loss=squared. The SCARA's log B with noise of 1 % and six samples that are
# wrong by 3 N m, from lines 301 to 801 of the file.
execute_process(COMMAND gzip -dc ${DATA_DIR}/scara/B.csv.gz
                COMMAND awk -F, "-vOFS=,"
                "function noise() {return sqrt(-2 * log(1 - rand())) * cos(6.283185307 * rand())}
                 BEGIN {srand(1); split(\"14 10 3 0.4\", s, \" \")}
                 NR > 1 {for (i = 1; i <= 4; ++i) $(13 + i) += 0.01 * s[i] * noise()}
                 NR > 300 && NR % 100 == 1 && NR < 850 {$15 += 3}
                 {print}"
                OUTPUT_FILE ${WORK_DIR}/spoiled.csv RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "awk or gzip failed: ${failed}")
endif()
set(flags --robot=${DATA_DIR}/scara/robot.yaml --log=spoiled.csv)

foreach(loss auto huber cauchy tukey)
  run("loss ${loss}" calibrate ${flags} --loss=${loss} --out=out)
  expect_code(0)
  expect_text(out "outliers   6 of elbow: torque samples beyond 8 noise deviations")
  file(STRINGS ${WORK_DIR}/out/outliers.csv lines)
  list(LENGTH lines count)
  list(GET lines 0 header)
  if(NOT "${count} ${header}" STREQUAL "7 log,row,time,joint,value,residual")
    fail("outliers.csv: ${count} lines, ${header}")
  endif()
  set(row 201)
  list(REMOVE_AT lines 0)
  foreach(line ${lines})
    math(EXPR row "${row} + 100")
    if(NOT line MATCHES "^\"spoiled.csv\",${row},[0-9.]+,\"elbow\",")
      fail("outliers.csv: ${line} instead of row ${row}")
    endif()
  endforeach()
  file(READ ${WORK_DIR}/out/calibration.json json)
  string(JSON count GET "${json}" outlier_count)
  string(JSON listed LENGTH "${json}" outliers)
  string(JSON joint GET "${json}" outliers 5 joint)
  string(JSON row GET "${json}" outliers 5 row)
  string(JSON spikes GET "${json}" joints 1 spikes)
  string(JSON source GET "${json}" joints 1 noise_source)
  string(JSON noise GET "${json}" joints 1 sample_noise_stddev)
  if(NOT "${count} ${listed} ${joint} ${row} ${spikes} ${source}" STREQUAL "6 6 elbow 801 6 residual")
    fail("calibration.json: ${count} ${listed} ${joint} ${row} ${spikes} ${source}")
  endif()
  if(noise LESS 0.08 OR noise GREATER 0.12)
    fail("calibration.json: noise ${noise} instead of 0.1 N m")
  endif()
endforeach()

run("squared" calibrate ${flags} --loss=squared --out=out)
expect_code(0)
file(READ ${WORK_DIR}/out/outliers.csv list)
if(out MATCHES "outliers" OR NOT list STREQUAL "log,row,time,joint,value,residual\n")
  fail("squared must keep all samples")
endif()
run("no such loss" calibrate ${flags} --loss=lorentz)
expect_refusal(2 "--loss: found 'lorentz', expected one of auto, huber, cauchy, tukey, squared")

foreach(loss auto huber cauchy tukey squared)
  run("poses, ${loss}" calibrate --robot=${DATA_DIR}/scara/robot.yaml
      --poses=${DATA_DIR}/scara/poses.csv --geometry=refine --loss=${loss})
  expect_code(0)
  expect_text(out "upper_arm.a                400.0000 ->     402.0000")
endforeach()
