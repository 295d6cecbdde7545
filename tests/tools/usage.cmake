# What armcal says about itself and about wrong command lines.
set(robot --robot=${DATA_DIR}/scara/robot.yaml)
set(log --log=${DATA_DIR}/scara/A.csv.gz)

foreach(flag --help -h help)
  run("help by ${flag}" ${flag})
  expect_code(0)
  expect_text(out "usage: armcal COMMAND --flags" "calibrate" "--help lists its flags")
  expect_empty(err)
endforeach()

run("nothing at all")
expect_code(2)
expect_text(err "usage: armcal COMMAND --flags")
expect_empty(out)

run("version" --version)
expect_code(0)
set(number "[0-9]+\\.[0-9.]+")
if(NOT out MATCHES "^armcal ${number} \\(sources [0-9a-f]+\\)\nCeres 2\\.[0-9.]+, Eigen 3\\.[0-9.]+, \
Simbody 3\\.[0-9.]+\nzlib 1\\.[0-9.]+, zstd ${number}, LZ4 ${number}, SQLite \
3\\.[0-9.]+, matio ${number}, HDF5 ${number}, oneTBB ${number}\n$")
  fail("armcal X.Y and the versions of its libraries expected")
endif()

set(version "${out}")
run("the same by a word" version)
if(NOT out STREQUAL version)
  fail("armcal version differs from armcal --version")
endif()
run("all help of no command" --helpfull)
expect_code(0)
expect_text(out "usage: armcal COMMAND --flags")

run("help of a command" calibrate --help)
expect_code(0)
expect_text(out "usage: armcal calibrate --flags" "--robot=FILE " "--log=FILES "
            "--geometry=WORD " "--json " "armcal calibrate --helpfull"
            "--solver" "examples" "  armcal calibrate --robot=")
set(short "${out}")
run("the same help" help calibrate)
if(NOT out STREQUAL short)
  fail("armcal help calibrate differs from armcal calibrate --help")
endif()
run("all of its help" calibrate --helpfull)
expect_code(0)
expect_text(out "--robot=FILE " "--solver=WORD " "weighted (noise of every joint")
set(full "${out}")
run("all of it the other way" help calibrate --all)
if(NOT out STREQUAL full)
  fail("armcal help calibrate --all differs from armcal calibrate --helpfull")
endif()

# Help fits a screen, and its examples are command lines that armcal takes:
# their files are not there, and nothing else is wrong (simulate lists effects).
foreach(command calibrate verify diagnose simulate excite inspect reduce merge
        compare watch)
  run("help of ${command}" ${command} --help)
  string(REGEX MATCHALL "\n" lines "${out}")
  list(LENGTH lines count)
  if(count LESS 20 OR count GREATER 50)
    fail("help of ${command} has ${count} lines, 20 to 50 expected")
  endif()
  if(out MATCHES " \n" OR out MATCHES "[^\n]{81}")
    fail("help has blanks at a line's end or lines over 80 columns")
  endif()
  string(REGEX MATCHALL "\n  armcal [^\n|]+" examples "${out}")
  if(NOT examples)
    fail("help of ${command} has no examples")
  endif()
  foreach(example ${examples})
    string(REGEX REPLACE "^\n  armcal " "" example "${example}")
    separate_arguments(flags UNIX_COMMAND "${example}")
    run("${example}" ${flags})
    if(NOT "${code} ${err}" MATCHES "^3 armcal: (arm\\.(urdf|yaml)|monday)" AND
       NOT example MATCHES "list_effects")
      fail("exit code 3 for the robot file that is not there expected")
    endif()
  endforeach()
endforeach()

run("unknown command" calibrat)
expect_refusal(2 "unknown command 'calibrat'" "did you mean calibrate?" "armcal --help")
run("unlike any command" frobnicate)
expect_refusal(2 "unknown command 'frobnicate'; see armcal --help")
run("flags before the command" ${robot} calibrate)
expect_refusal(2 "unknown command '--robot=")

run("unknown flag" calibrate --lgo=a.csv)
expect_refusal(2 "unknown flag --lgo of armcal calibrate" "did you mean --log?"
               "armcal calibrate --help")
run("a switch turned off" diagnose --noforward ${robot})
expect_refusal(2 "--log=FILE is needed")
run("no switch" diagnose --norobot)
expect_refusal(2 "unknown flag --norobot")
run("unlike any flag" calibrate --frobnicate)
expect_refusal(2 "unknown flag --frobnicate of armcal calibrate; see")
run("a flag of glog" calibrate --logtostderr=1)
expect_refusal(2 "unknown flag --logtostderr")
run("a word that is no flag" calibrate ${robot} ${log} more)
expect_refusal(2 "'more' is not a flag")

run("a pattern that no shell filled in" calibrate ${robot} "--log=*.csv")
expect_refusal(2 "--log: found '*.csv', expected file names" "paste -sd,")

run("no robot" calibrate)
expect_refusal(2 "--robot=FILE is needed")
run("no log" calibrate ${robot})
expect_refusal(2 "--log=FILE is needed")
run("no value" calibrate --log)
expect_refusal(2 "--log needs a value")
run("two logs in two flags" calibrate ${robot} ${log} ${log})
expect_refusal(2 "--log is given twice; several values go into one flag, with commas")
run("a log twice" calibrate ${robot} ${log},${DATA_DIR}/scara/A.csv.gz)
expect_refusal(2 "--log names" "A.csv.gz twice")
run("held out of itself" calibrate ${robot} ${log}
    --validate=${DATA_DIR}/scara/A.csv.gz)
expect_refusal(2 "--validate names" "A.csv.gz, which --log calibrates on")
run("an empty file name" calibrate ${robot} ${log},)
expect_refusal(2 "--log: found '" "expected file names")

foreach(pair
    "--bandwidth=6Hz|--bandwidth: found '6Hz', expected a number"
    "--bandwidth=-1|--bandwidth: found '-1', expected a frequency in Hz, or 0"
    "--interval=abc|--interval: found 'abc', expected a number"
    "--interval=-2|--interval: found '-2', expected a length in s above 0"
    "--interval=inf|--interval: found 'inf', expected a length in s above 0"
    "--window=0|--window: found '0', expected one positive number"
    "--crop=3|--crop: found '3', expected t0:t1 in s"
    "--crop=3:1|--crop: found '3:1', expected t0 before t1"
    "--intervals=0:|--intervals: found '0:', expected t1:t2 with both ends"
    "--gravity=0,0|--gravity: found '0,0', expected three numbers"
    "--solver=fast|--solver: found 'fast', expected one of weighted, batch, recursive"
    "--solver=weigthed|expected one of weighted, batch, recursive\; did you mean weighted?"
    "--geometry=x|--geometry: found 'x', expected one of known"
    "--joint_terms=stiction|--joint_terms: found 'stiction', expected one of viscous"
    "--joint_terms=viscous,viscous|--joint_terms: found 'viscous,viscous', expected viscous only once"
    "--coulomb_width=2deg|--coulomb_width: found '2deg', expected auto")
  string(REPLACE "|" ";" pair "${pair}")
  list(GET pair 0 flag)
  list(GET pair 1 message)
  run("${flag}" calibrate ${robot} ${log} ${flag} --out=out)
  expect_refusal(2 "${message}")
endforeach()

# Absurd lengths: refused or a result, never a crash (November 2026).
run("a bandwidth below the log's" calibrate ${robot} ${log} --bandwidth=1e-9)
expect_refusal(3 "--bandwidth: found '1e-09'" "period is shorter than the log, 4 s")
foreach(flags "--window=1e300" "--identification=integral;--interval=1e300")
  run("${flags}" calibrate ${robot} ${log} ${flags})
  expect_code(1)
  expect_text(out "no stretch of motion that is long enough")
endforeach()
run("an endless interval" calibrate ${robot} ${log} --identification=integral
    --intervals=0:1e300)
expect_refusal(3 "--intervals: 1 of 1 intervals cannot be used")
