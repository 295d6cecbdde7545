# armcal excite: a motion within its limits, what it adds to logs, postures,
# refusals.

write_arm(arm ", limits: {lower: -2, upper: 2, velocity: 2}"
          ", limits: {lower: -2.5, upper: 2.5, velocity: 3}")

run("a motion" excite --robot=arm.yaml --duration=10 --out=out)
expect_code(0)
expect_text(out "A motion of 10 s" "% of what the limits allow"
            "times those of the best of 40 random motions"
            "predicted standard deviations" "assumed, where no flag or file says")
expect_empty(err)
file(READ ${WORK_DIR}/out/excite.json json)
foreach(key designed duration periods harmonics base_frequency criterion
            criterion_value random_criterion_value limits_used clearance fourier
            joints parameters assumed termination)
  string(JSON value ERROR_VARIABLE missing GET "${json}" ${key})
  if(missing)
    fail("excite.json must hold ${key}")
  endif()
endforeach()
string(JSON used GET "${json}" limits_used)
if(used GREATER 1)
  fail("limits are used to ${used}")
endif()
file(STRINGS ${WORK_DIR}/out/trajectory.csv rows LIMIT_COUNT 2)
list(GET rows 0 header)
if(NOT header STREQUAL "t,q1,q2,qd1,qd2,qdd1,qdd2")
  fail("the trajectory's header is ${header}")
endif()
list(GET rows 1 first)
if(NOT first MATCHES "^0\\.0+,[^,]+,[^,]+,")
  fail("the trajectory begins with ${first}")
endif()
file(READ ${WORK_DIR}/out/trajectory.csv trajectory)
file(RENAME ${WORK_DIR}/out ${WORK_DIR}/motion)

run("the same again" excite --robot=arm.yaml --duration=10 --out=out)
file(READ ${WORK_DIR}/out/trajectory.csv again)
if(NOT again STREQUAL trajectory)
  fail("the same command designs another motion")
endif()

# From a motion to a calibration: what a newcomer does with it.
run("played" simulate --robot=arm.yaml --motion=motion/trajectory.csv
    --out=played)
expect_code(0)
run("what it shows" calibrate --robot=arm.yaml --log=played/log.csv)
expect_text(out "rank " "13 of 13")

# A log of one joint, and what it lacks.
run("a poor log" simulate --robot=arm.yaml --duration=10 --joints=1 --out=poor)
expect_code(0)
run("what it lacks" calibrate --robot=arm.yaml --log=poor/log.csv --out=known)
expect_code(1)
expect_text(out "not identifiable:" "to see more: move joint2")
run("what to add" excite --robot=arm.yaml --given=poor/log.csv --duration=8
    --criterion=worst --out=out)
expect_code(0)
expect_text(out "(before: not seen)")
file(REMOVE ${WORK_DIR}/poor/log.csv)
run("what to add to its calibration" excite --robot=arm.yaml
    --given=known/calibration.json --duration=8 --criterion=worst --out=out)
expect_code(0)
expect_text(out "(before: not seen)")
run("calibrations do not add up" excite --robot=arm.yaml
    --given=known/calibration.json,played/log.csv)
expect_refusal(2 "--given=" "one calibration.json alone, or logs")

run("above the floor" excite --robot=arm.yaml --duration=8 --floor=-.45
    --link_radius=.04 --out=out)
expect_code(0)
expect_text(out "and nothing comes nearer than")
file(READ ${WORK_DIR}/out/excite.json json)
string(JSON clearance GET "${json}" clearance)
if(clearance LESS 0)
  fail("the arm is ${clearance} m from the floor")
endif()

run("no such posture" excite --robot=arm.yaml --tool_box=5:6,5:6,5:6)
expect_refusal(3 "no posture keeps" "tool's box 5:6,5:6,5:6")
run("half a box" excite --robot=arm.yaml --tool_box=5:6,5:6)
expect_refusal(2 "--tool_box: found '5:6,5:6', expected x:x,y:y,z:z")
run("no such target" excite --robot=arm.yaml --target=friction)
expect_refusal(2 "--target: found 'friction'" "model, physical, geometry")
run("too little torque" excite --robot=arm.yaml --effort_limits=.01)
expect_code(1)
expect_text(out "No motion: no motion within the limits")

run("postures" excite --robot=arm.yaml --static_poses=12 --out=out)
expect_code(0)
file(STRINGS ${WORK_DIR}/out/postures.csv rows)
list(LENGTH rows count)
if(NOT count EQUAL 13)
  fail("postures.csv has ${count} lines")
endif()
run("postures that separate" excite --robot=arm.yaml --static_poses=8
    --separate=gear_ratio,eccentricity)
expect_code(0)
expect_text(out "8 postures" "gear_ratio of " "eccentricity of ")
run("no effect of poses" excite --robot=arm.yaml --static_poses=8 --separate=stribeck)
expect_refusal(2 "--separate: found 'stribeck', expected effects of poses: coupling")
