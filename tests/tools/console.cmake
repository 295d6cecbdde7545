# What a run says and where: text, --json, --quiet, flag files, and outputs that
# take nothing.
set(robot --robot=${DATA_DIR}/scara/robot.yaml)
set(log --log=${DATA_DIR}/scara/B.csv.gz)

# Each command's JSON on stdout is the file in --out; --quiet is silent there.
write_arm(arm ", limits: {lower: -2, upper: 2, velocity: 2, effort: 100}"
          ", limits: {lower: -2.5, upper: 2.5, velocity: 3, effort: 50}")
set(simulate simulate --duration=12 --log_rate=100)
set(inspect inspect --log=made/log.csv)
set(calibrate calibrate --log=made/log.csv)
set(verify verify)
set(excite excite --duration=4)
set(diagnose diagnose --log=made/log.csv --noforward)
foreach(pair simulate/truth inspect/inspect calibrate/calibration
        verify/verification excite/excite diagnose/diagnosis)
  get_filename_component(command ${pair} DIRECTORY)
  get_filename_component(file ${pair} NAME)
  run("${command} --json" ${${command}} --robot=arm.yaml --json --out=made)
  if(NOT code MATCHES "^[01]$")
    fail("a result expected")
  endif()
  set(expected ${code})
  expect_empty(err)
  file(READ ${WORK_DIR}/made/${file}.json json)
  if(NOT out STREQUAL json)
    fail("stdout must be ${file}.json")
  endif()
  run("${command} --quiet" ${${command}} --robot=arm.yaml --quiet --out=quiet)
  expect_code(${expected})
  expect_empty(out)
  expect_empty(err)
endforeach()
run("effects for programs" simulate --list_effects --json)
string(JSON effect ERROR_VARIABLE error GET "${out}" 0 effect)
if(error OR NOT effect STREQUAL "viscous_friction")
  fail("a list of effects in JSON expected")
endif()

# Notes on what was read are text for people, and warnings otherwise.
file(WRITE ${WORK_DIR}/bare.urdf "<robot name=\"bare\"><link name=\"base\"/>
<link name=\"arm\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\"
izz=\"9\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>
<joint name=\"j\" type=\"revolute\"><parent link=\"base\"/><child link=\"arm\"/>
<axis xyz=\"0 0 1\"/><limit lower=\"-1\" upper=\"1\" velocity=\"1\" effort=\"1\"/>
</joint></robot>")
run("a note" verify --robot=bare.urdf)
expect_text(out "note       the inertia of link")
expect_empty(err)
foreach(flag --quiet --json)
  run("a note and ${flag}" verify --robot=bare.urdf ${flag})
  expect_text(err "armcal: note: the inertia of link")
  if(out MATCHES "note")
    fail("the note stands on stdout")
  endif()
endforeach()

# No colours but on a terminal; tests/terminal.py looks at those.
run("a verdict" verify --robot=arm.yaml)
expect_text(out "\narm: verified\n")

# An output that takes nothing is an error, and --out is whole all the same.
macro(run_shell case_name script)
  set(case "${case_name}")
  file(REMOVE_RECURSE ${WORK_DIR}/out)
  execute_process(COMMAND bash -c "${script}" ${ARMCAL}
                  WORKING_DIRECTORY ${WORK_DIR} RESULT_VARIABLE code
                  OUTPUT_VARIABLE out ERROR_VARIABLE err)
endmacro()
foreach(pair "a full disk|>/dev/full|No space left" "a closed stdout|>&-|Bad file")
  string(REPLACE "|" ";" pair "${pair}")
  list(GET pair 0 name)
  list(GET pair 1 redirection)
  list(GET pair 2 reason)
  foreach(command "--help" "help --man" "verify --robot=arm.yaml"
          "verify --robot=arm.yaml --json --out=out")
    run_shell("${name}: ${command}" "\"$0\" ${command} ${redirection}")
    expect_code(3)
    expect_text(err "armcal: standard output: cannot be written: ${reason}")
  endforeach()
  file(READ ${WORK_DIR}/out/verification.json json)
  if(NOT json MATCHES "^{.*}\n$")
    fail("verification.json is not whole")
  endif()
endforeach()
run_shell("a reader that has gone" "set -o pipefail; \"$0\" help --man | true")
if(NOT code MATCHES "^(141|0)$")
  fail("the end by SIGPIPE expected")
endif()

# --flagfile: the command line counts; file and line where something is wrong.
file(WRITE ${WORK_DIR}/run.flags "# a run
--robot=${DATA_DIR}/scara/robot.yaml\r
  ${log}

--bandwidth=0
--geometry=lengths
--joint-terms=none\n")
run("a flag file" calibrate --flagfile=run.flags --json)
expect_code(0)
set(of_file "${out}")
run("the same flags" calibrate ${robot} ${log} --bandwidth=0 --geometry=lengths
    --joint_terms=none --json)
if(NOT out STREQUAL of_file)
  fail("flags of a file must do what those of a command line do")
endif()
run("less than no threads" calibrate --flagfile=run.flags --threads=-1)
expect_refusal(2 "--threads: found '-1', expected a number of threads, or 0")
run("the command line counts" calibrate --joint_terms=viscous
    --flagfile=run.flags --json)
expect_text(out "viscous[1]")
foreach(pair
    "--robot=a.yaml\n--lgo=a.csv|line 2: unknown flag --lgo of armcal calibrate\; did you mean --log?"
    "--robot=a.yaml\n--robot=b.yaml|line 2: --robot is given twice"
    "--flagfile=more.flags|line 1: a flag file cannot name another one"
    "robot=a.yaml|line 1: found 'robot=a.yaml', expected --flag=value"
    "--robot a.yaml|line 1: found '--robot a.yaml', expected --flag=value"
    "\n--robot|line 2: --robot needs a value"
    "--interval=x|line 1: --interval: found 'x', expected a number"
    "${robot}\n${log}\n\n--bandwidth=6Hz|line 4: --bandwidth: found '6Hz', expected a number")
  string(REPLACE "|" ";" pair "${pair}")
  list(GET pair 0 text)
  list(GET pair 1 message)
  file(WRITE ${WORK_DIR}/bad.flags "${text}\n")
  run("${text}" calibrate --flagfile=bad.flags)
  expect_refusal(2 "bad.flags: ${message}")
endforeach()
run("no such flag file" calibrate --flagfile=none.flags)
expect_refusal(3 "none.flags: --flagfile: cannot be read: No such file")
run("two flag files" calibrate --flagfile=run.flags --flagfile=run.flags)
expect_refusal(2 "--flagfile is given twice")
