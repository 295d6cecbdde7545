# The same input gives the same bytes, whenever and wherever a command runs, in
# any time zone and on any number of threads.

write_arm(arm "" "")

# All results of the commands, in a folder of its own; arguments are the same,
# as reports hold them, and so is the log, byte by byte.
function(run_all folder threads)
  file(MAKE_DIRECTORY ${WORK_DIR}/${folder})
  file(COPY ${WORK_DIR}/arm.yaml DESTINATION ${WORK_DIR}/${folder})
  set(log --log=simulated/log.csv)
  foreach(arguments
      "simulate;--duration=20;--out=simulated;--truth=secret;--effects=stribeck@2"
      "calibrate;${log};--out=calibrated"
      "diagnose;${log};--trust=.05;--out=diagnosed"
      "verify;${log};--out=verified" "excite;--out=excited"
      "reduce;${log};--out=factors")
    list(GET arguments 0 case)
    execute_process(COMMAND ${CMAKE_COMMAND} -E env ${ARGN} ${ARMCAL} ${arguments}
                    --robot=arm.yaml --threads=${threads}
                    WORKING_DIRECTORY ${WORK_DIR}/${folder}
                    RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE err)
    if(NOT code MATCHES "^[01]$")
      fail("it must run")
    endif()
    file(WRITE ${WORK_DIR}/${folder}/${case}.txt "${out}")
  endforeach()
endfunction()
run_all(here 1 TZ=UTC)
run_all(elsewhere/far/away 3 TZ=Asia/Kathmandu LC_ALL=C.UTF-8)

set(case "the same again")
file(GLOB_RECURSE files RELATIVE ${WORK_DIR}/here ${WORK_DIR}/here/*)
file(GLOB_RECURSE others RELATIVE ${WORK_DIR}/elsewhere/far/away
     ${WORK_DIR}/elsewhere/far/away/*)
list(LENGTH files count)
if(NOT files STREQUAL others OR count LESS 20)
  fail("the same files expected: ${files} and ${others}")
endif()
foreach(name ${files})
  file(READ ${WORK_DIR}/here/${name} one)
  file(READ ${WORK_DIR}/elsewhere/far/away/${name} other)
  # The number of threads is an argument, of which reports keep a record.
  string(REPLACE "\"--threads=3\"" "\"--threads=1\"" other "${other}")
  if(NOT one STREQUAL other)
    fail("${name} differs from that of the first run")
  endif()
endforeach()
