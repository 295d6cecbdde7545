# calibrate --poses: the SCARA whose lengths and elbow are wrong in its file.
set(flags --robot=${DATA_DIR}/scara/robot.yaml
    --poses=${DATA_DIR}/scara/poses.csv)

run("refine" calibrate ${flags} --geometry=refine --out=result)
expect_code(0)
expect_empty(err)
expect_text(out "40, targets" "upper_arm.a                400.0000 ->     402.0000"
            "forearm.theta" "0.1000"
            "forearm.a                  300.0000 ->     299.0000"
            "upper_arm.theta .d")
file(READ ${WORK_DIR}/result/calibration.json json)
string(JSON before GET "${json}" poses before_rms)
string(JSON after GET "${json}" poses rms)
if(before LESS 0.001 OR after GREATER 0.000001)
  fail("rms before ${before} m, after ${after} m")
endif()
if(NOT EXISTS ${WORK_DIR}/result/robot.urdf)
  fail("no robot.urdf")
endif()
# Its joints have no limits, which URDF wants.
expect_text(out "robot.urdf  " "limit")

run("frame only" calibrate ${flags})
expect_code(0)
expect_text(out "base.yaw")
if(out MATCHES "forearm[.]")
  fail("--geometry=known must leave the arm alone")
endif()

# A controller that counts the elbow from the base's axis, not from the upper arm.
execute_process(COMMAND awk -F, -v OFS=, "NR > 1 {$2 += $1} {print}" ${DATA_DIR}/scara/poses.csv
                OUTPUT_FILE ${WORK_DIR}/coupled.csv)
run("coupled joints" calibrate --robot=${DATA_DIR}/scara/robot.yaml --poses=coupled.csv
    --geometry=refine --out=coupled)
expect_code(1)
expect_text(out "failed     coupling: elbow follows shoulder: q2 + k q1 with k = -1 +- ")
file(READ ${WORK_DIR}/coupled/calibration.json json)
string(JSON joint GET "${json}" poses coupling joint)
string(JSON factor GET "${json}" poses coupling factor)
if(NOT joint STREQUAL elbow OR factor LESS -1.0001 OR factor GREATER -0.9999)
  fail("the coupling of ${joint} has the factor ${factor}")
endif()

# An instrument that is said to be as good as these poses are, and a far better one.
foreach(u95 1e-6 1e-12)
  execute_process(COMMAND awk -F, -v OFS=, "{print $0, (NR > 1 ? \"${u95}\" : \"u95_1\")}"
                          ${DATA_DIR}/scara/poses.csv OUTPUT_FILE ${WORK_DIR}/u95.csv)
  run("an instrument of ${u95} m" calibrate --robot=${DATA_DIR}/scara/robot.yaml
      --poses=u95.csv --geometry=refine)
  if(u95 STREQUAL 1e-6)
    expect_code(0)
    expect_text(out "instrument u95 0.001 mm")
  else()
    expect_code(1)
    expect_text(out "failed     geometry leaves" "beside an instrument")
  endif()
endforeach()

file(READ ${DATA_DIR}/scara/poses.csv poses)
string(REPLACE "y2" "why" broken "${poses}")
file(WRITE ${WORK_DIR}/broken.csv "${broken}")
run("column missing" calibrate --robot=${DATA_DIR}/scara/robot.yaml
    --poses=broken.csv --out=none)
expect_refusal(3 "broken.csv: row 1" "y2")
run("no such geometry" calibrate ${flags} --geometry=lengths --out=none)
expect_refusal(2 "--geometry: found 'lengths', expected one of known, offsets, refine")

# Degrees that are read as radians, millimetres as metres, are told as such.
execute_process(COMMAND awk -F, -v OFS=, "NR > 1 {$1 *= 57.29578; $2 *= 57.29578; $4 *= 57.29578} {print}"
                        ${DATA_DIR}/scara/poses.csv OUTPUT_FILE ${WORK_DIR}/degrees.csv)
execute_process(COMMAND awk -F, -v OFS=, "NR > 1 {for (k = NF - 5; k <= NF; ++k) $k *= 1000} {print}"
                        ${DATA_DIR}/scara/poses.csv OUTPUT_FILE ${WORK_DIR}/millimetres.csv)
foreach(command calibrate diagnose)
  run("${command} of degrees" ${command} --robot=${DATA_DIR}/scara/robot.yaml --poses=degrees.csv --out=none)
  expect_refusal(2 "--poses: joint positions are degrees" "'q1 [deg]'")
  run("${command} of millimetres" ${command} --robot=${DATA_DIR}/scara/robot.yaml
      --poses=millimetres.csv --out=none)
  expect_refusal(2 "--poses: lengths are millimetres" "'x1 [mm]'")
endforeach()

# Poses that took no part, and a file that is not there.
run("calibration with poses held out" calibrate ${flags} --geometry=refine
    --validate=${DATA_DIR}/scara/poses.csv --out=validated)
expect_code(0)
expect_text(out "validation 40 poses: 1.8" "what was measured" "target1.x")
run("no poses to validate" calibrate ${flags} --validate=nowhere.csv --out=none)
expect_refusal(3 "nowhere.csv")

# Joints by their names alone.
file(READ ${DATA_DIR}/scara/poses.csv poses)
string(REPLACE "q1,q2,q3,q4," "shoulder,elbow,lift,wrist," named "${poses}")
file(WRITE ${WORK_DIR}/named.csv "${named}")
run("joints by name" calibrate --robot=${DATA_DIR}/scara/robot.yaml --poses=named.csv)
expect_code(0)
expect_text(out "40, targets")

# diagnose --poses: geometry is all that is wrong with these, and then it is not.
run("diagnosed" diagnose ${flags} --out=diagnosed)
expect_code(0)
expect_text(out "The poses show no effect beyond the geometry" "robot.urdf  " "limit")
run("diagnosed coupling" diagnose --robot=${DATA_DIR}/scara/robot.yaml
    --poses=coupled.csv --out=diagnosed_coupling)
expect_code(1)
expect_text(out "The geometry lacks coupling of elbow with shoulder" "k -1 +-")
file(READ ${WORK_DIR}/diagnosed_coupling/pose_diagnosis.json json)
string(JSON name GET "${json}" effects 0 effect)
string(JSON verdict GET "${json}" verdict)
if(NOT name STREQUAL coupling OR NOT verdict STREQUAL explained)
  fail("${name} is named, the verdict is ${verdict}")
endif()
# What a controller adds to its joints, and poses that took no part.
foreach(file correction.c correction.csv robot.urdf)
  if(NOT EXISTS ${WORK_DIR}/diagnosed/${file})
    fail("no ${file}")
  endif()
endforeach()
foreach(part fitted held_out)
  set(other 0)
  if(part STREQUAL held_out)
    set(other 1)
  endif()
  execute_process(COMMAND awk -F, "NR == 1 || (NR % 4 == 0) == ${other}"
                          ${WORK_DIR}/coupled.csv OUTPUT_FILE ${WORK_DIR}/${part}.csv)
endforeach()
run("poses held out" diagnose --robot=${DATA_DIR}/scara/robot.yaml --poses=fitted.csv
    --validate=held_out.csv --out=held_out)
expect_text(out "10 held-out poses")
file(READ ${WORK_DIR}/held_out/pose_diagnosis.json json)
string(JSON before GET "${json}" correction validation before)
string(JSON after GET "${json}" correction validation after)
if(before LESS 0.1 OR after GREATER 0.0001)
  fail("held-out poses: ${before} m before, ${after} m after")
endif()

run("poses and a log" diagnose ${flags} --log=log.csv)
expect_code(2)
expect_text(err "--poses and --log: expected one of them")
run("no such effect" diagnose ${flags} --without=gremlins)
expect_code(2)
expect_text(err "gremlins" "gear_ratio")
