# calibrate --trajectory: what it writes, and what it does not go with.
set(flags --robot=${DATA_DIR}/scara/robot.yaml --log=${DATA_DIR}/scara/B.csv.gz
    --validate=${DATA_DIR}/scara/A.csv.gz --geometry=lengths --joint_terms=none)

run("measured" calibrate ${flags} --out=measured)
expect_code(0)
file(READ ${WORK_DIR}/measured/calibration.json json)
string(JSON trajectory GET "${json}" trajectory)
string(JSON noise ERROR_VARIABLE absent GET "${json}" joints 0 encoder_noise_stddev)
if(NOT trajectory STREQUAL "measured" OR NOT absent)
  fail("calibration.json: ${trajectory}, encoder noise ${noise}")
endif()

run("corrected" calibrate ${flags} --trajectory=corrected --out=corrected)
expect_code(0)
expect_empty(err)
expect_text(out "trajectories corrected" "encoder noise"
            "held out")
file(READ ${WORK_DIR}/corrected/calibration.json json)
string(JSON trajectory GET "${json}" trajectory)
string(JSON noise GET "${json}" joints 3 encoder_noise_stddev)
string(JSON value GET "${json}" model_parameters 0 value)
if(NOT trajectory STREQUAL "corrected" OR NOT noise LESS 1e-4)
  fail("calibration.json: ${trajectory}, encoder noise ${noise}")
endif()
if(value LESS 17.54 OR value GREATER 17.56)  # X11 = 17.55 of Table 2
  fail("X11 = ${value}")
endif()

foreach(other identification=differential solver=batch estimate=refined)
  run("with ${other}" calibrate ${flags} --trajectory=corrected --${other} --out=no)
  expect_code(2)
  expect_text(err "--trajectory: found 'corrected', expected --")
endforeach()
run("unknown" calibrate ${flags} --trajectory=splined --out=no)
expect_code(2)
expect_text(err "--trajectory" "splined" "measured" "corrected")
