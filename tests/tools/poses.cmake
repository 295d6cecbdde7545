# calibrate --poses: the SCARA whose lengths and elbow are wrong in its file.
set(flags --robot=${DATA_DIR}/scara/robot.yaml
    --poses=${DATA_DIR}/scara/poses.csv)

run("refine" calibrate ${flags} --geometry=refine --out=result)
expect_code(0)
expect_empty(err)
expect_text(out "40, targets" "upper_arm.a                400.0000 ->     402.0000"
            "forearm.theta" "0.1000"
            "forearm.a                  300.0000 ->     299.0000"
            "upper_arm.theta cannot be told from")
file(READ ${WORK_DIR}/result/calibration.json json)
string(JSON before GET "${json}" poses before_rms)
string(JSON after GET "${json}" poses rms)
if(before LESS 0.001 OR after GREATER 0.000001)
  fail("rms before ${before} m, after ${after} m")
endif()
if(NOT EXISTS ${WORK_DIR}/result/robot.urdf)
  fail("no robot.urdf")
endif()

run("frame only" calibrate ${flags})
expect_code(0)
expect_text(out "base.yaw")
if(out MATCHES "forearm")
  fail("--geometry=known must leave the arm alone")
endif()

file(READ ${DATA_DIR}/scara/poses.csv poses)
string(REPLACE "y2" "why" broken "${poses}")
file(WRITE ${WORK_DIR}/broken.csv "${broken}")
run("column missing" calibrate --robot=${DATA_DIR}/scara/robot.yaml
    --poses=broken.csv --out=none)
expect_refusal(3 "broken.csv: row 1" "y2")
run("no such geometry" calibrate ${flags} --geometry=lengths --out=none)
expect_refusal(2 "--geometry: found 'lengths', expected one of known, offsets, refine")
