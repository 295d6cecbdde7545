# The commands of data/scara/README.md: the paper's Table 2 from the command
# line.
set(flags --robot=${DATA_DIR}/scara/robot.yaml --log=${DATA_DIR}/scara/A.csv.gz
    --geometry=lengths --joint_terms=none --bandwidth=0
    --identification=integral)

foreach(solver batch recursive)
  run("set 1, ${solver}" calibrate ${flags} --intervals=0:0.5,0.5:1,1:1.5
      --quadrature=trapezoid --solver=${solver} --out=${solver})
  expect_code(0)
  expect_empty(err)
  expect_text(out "integral model (2.27), 3 per joint" "rank       6 of 6, blocks 1/1 3/3 1/1 1/1"
              "Izz[1]" "17.55" "Izz[2]" "7.55" "a1*hx[2]" "2.343"
              "a1*hy[2]" "0.17" "m[3]" "3.11" "Izz[4]" "0.35")
  file(READ ${WORK_DIR}/${solver}/calibration.json json)
  string(JSON blocks GET "${json}" rank blocks)
  string(JSON converged GET "${json}" termination converged)
  string(JSON name GET "${json}" model_parameters 3 name)
  string(REGEX REPLACE "[ \n]" "" blocks "${blocks}")
  if(NOT "${blocks} ${converged} ${name}" STREQUAL "[1,3,1,1] ON a1*hy[2]")
    fail("calibration.json: ${blocks} ${converged} ${name}")
  endif()
  file(STRINGS ${WORK_DIR}/${solver}/covariance.csv lines)
  list(LENGTH lines count)
  if(NOT count EQUAL 7)
    fail("covariance.csv: a header and 6 rows expected")
  endif()
endforeach()

# Set 2 of motion A is symmetric in time: joint by joint it cannot work.
set(set2 --intervals=1:1.5,1.5:2,2.5:3)
run("set 2, recursive" calibrate ${flags} ${set2} --solver=recursive --out=refused)
expect_code(1)
expect_text(out "rank       6 of 6, blocks 1/1 2/3 1/1 1/1" "block 2 alone does not see"
            "scara: not calibrated: block 2 has rank 2 of 3")
file(READ ${WORK_DIR}/refused/calibration.json json)
string(JSON converged GET "${json}" termination converged)
if(converged)
  fail("calibration.json claims to have converged")
endif()
file(STRINGS ${WORK_DIR}/refused/covariance.csv lines)
list(LENGTH lines count)
if(NOT count EQUAL 1)
  fail("covariance.csv: the header alone expected")
endif()
run("set 2, batch" calibrate ${flags} ${set2} --solver=batch)
expect_code(0)
expect_text(out "17.55" "7.55")
run("two intervals, recursive" calibrate ${flags} --intervals=0:0.5,0.5:1 --solver=recursive)
expect_code(1)
expect_text(out "block 2 has rank 2 of 3")

# The default: weak form, no velocity nor acceleration taken from the log, and
# a check on a motion that it has not seen.
run("weak form" calibrate --robot=${DATA_DIR}/scara/robot.yaml
    --log=${DATA_DIR}/scara/B.csv.gz --validate=${DATA_DIR}/scara/A.csv.gz
    --geometry=lengths --joint_terms=none --bandwidth=0)
expect_code(0)
expect_text(out "weak form" "held out" "17.55" "7.55" "2.343" "0.176" "3.11" "0.35")

# Eight equations per joint for twenty parameters: Huber's weights would solve
# the wrist's exactly and drop all other joints beside them (November 2026).
run("few equations" calibrate --robot=${DATA_DIR}/scara/robot.yaml
    --log=${DATA_DIR}/scara/B.csv.gz --identification=integral)
expect_code(0)
expect_text(out "8 per joint" "rank       20 of 20" "independent errors (few equations)")
if(out MATCHES "not seen" OR NOT out MATCHES "residual 0[.][0-9]+ % of the torque")
  fail("all parameters seen and a residual below 1 % expected")
endif()

# No parameter is seen at all, so that no length can be (November 2026).
run("too short" calibrate --robot=${DATA_DIR}/scara/robot.yaml
    --log=${DATA_DIR}/scara/B.csv.gz --crop=0:0.25 --geometry=all_lengths)
expect_code(0)
expect_text(out "only products with moments seen" "directions not identifiable")
