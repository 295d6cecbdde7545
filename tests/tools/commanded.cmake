# calibrate --controller: logs of commands, alone and with logs of torques.
set(robot --robot=${DATA_DIR}/scara/robot.yaml)
file(WRITE ${WORK_DIR}/drives.yaml "rate: 1000\nbandwidth: 8\nfeedforward: none\n")
file(WRITE ${WORK_DIR}/late.yaml
     "rate: 1000\nbandwidth: 8\nfeedforward: none\ndelay: 0.004\n")
foreach(k RANGE 1 2)
  run("log ${k}" simulate ${robot} --robot_error=.2 --controller=late.yaml --run=${k}
      --encoder_noise=5e-5 --duration=8 --effects= --out=log${k} --truth=hidden)
  expect_code(0)
endforeach()
set(loop ${robot} --controller=drives.yaml --log=log1/log.csv)

run("commands and torques" calibrate ${loop} --torque_log=log2/log.csv --trust=.2
    --export=mjcf --out=both)
expect_code(0)
expect_text(out "with the torques of log2/log.csv" "simulated minus measured positions"
            "residuals are" "drive.delay")
file(READ ${WORK_DIR}/both/calibration.json text)
string(JSON value GET "${text}" torque_logs 0)
if(NOT value STREQUAL "log2/log.csv")
  fail("calibration.json: torque_logs is ${value}")
endif()
string(JSON method GET "${text}" method)
if(NOT method STREQUAL "output_error")
  fail("calibration.json: method is ${method}")
endif()
# The drives as they were estimated, and what is drawn.
file(READ ${WORK_DIR}/both/robot.xml text)
if(NOT text MATCHES "biastype=\"affine\"" OR NOT text MATCHES "delay=")
  fail("robot.xml has no drives")
endif()
file(READ ${WORK_DIR}/both/report.html text)
if(NOT text MATCHES "\"positions\":" OR NOT text MATCHES "log2/log.csv")
  fail("report.html lacks positions or the file of torques")
endif()

run("torques without commands" calibrate ${robot} --log=log1/log.csv --torque_log=log2/log.csv)
expect_refusal(2 "--torque_log: found no --controller beside it")
run("one log as both" calibrate ${loop} --torque_log=log1/log.csv)
expect_refusal(2 "--torque_log: found 'log1/log.csv', expected names of logs that are named once")
run("equations without weights" calibrate ${loop} --torque_log=log2/log.csv --solver=batch)
expect_refusal(2 "--torque_log: expected --identification=weak and --solver=weighted")
run("no such log" calibrate ${loop} --torque_log=none.csv --out=out)
expect_refusal(3 "none.csv")
