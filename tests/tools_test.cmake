# cmake -DARMCAL=... -DBUILD_DIR=... -DDATA_DIR=... -DWORK_DIR=... -DCASES=... -P tools_test.cmake
#
# Runs the armcal binary as a person would and matches what it prints, its exit
# code and what it leaves on disk. CASES is one of the files in tests/tools/.
cmake_minimum_required(VERSION 3.25)

file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR})

# run(name, flags...) runs `armcal flags...` in WORK_DIR and sets `code`, `out`
# and `err`, for the expectations below. The folder out is removed before.
macro(run case_name)
  set(case "${case_name}")
  file(REMOVE_RECURSE ${WORK_DIR}/out)
  execute_process(COMMAND ${ARMCAL} ${ARGN} WORKING_DIRECTORY ${WORK_DIR}
                  RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE err)
endmacro()

# arm.yaml: two links that swing in a vertical plane. `first` and `second` are
# more of a joint's entries, each after a comma.
function(write_arm name first second)
  file(WRITE ${WORK_DIR}/arm.yaml "name: ${name}
gravity: [0, -9.81, 0]
convention: standard
links:
  - {joint: revolute, a: .4, mass: 5, com: [-.2, 0, 0], inertia: [.01, .07, .07],
     viscous: 2, coulomb: 3, armature: .3${first}}
  - {joint: revolute, a: .3, mass: 3, com: [-.15, 0, 0], inertia: [.01, .03, .03],
     viscous: 1, coulomb: 2, armature: .2${second}}
")
endfunction()

# Tells the first thing that is wrong with a run; the others follow from it.
function(fail text)
  get_property(failed GLOBAL PROPERTY failed_case)
  if(failed STREQUAL case)
    return()
  endif()
  set_property(GLOBAL PROPERTY failed_case "${case}")
  message(SEND_ERROR "${case}: ${text}\nexit code ${code}\n"
                     "--- stdout ---\n${out}\n--- stderr ---\n${err}")
endfunction()

function(expect_code expected)
  if(NOT code STREQUAL expected)
    fail("exit code ${expected} expected")
  endif()
endfunction()

# Each of the texts stands in `stream` (out or err), after the one before it.
function(expect_text stream)
  set(rest "${${stream}}")
  foreach(text ${ARGN})
    string(FIND "${rest}" "${text}" at)
    if(at EQUAL -1)
      fail("std${stream} must hold: ${text}")
      return()
    endif()
    string(LENGTH "${text}" length)
    math(EXPR at "${at} + ${length}")
    string(SUBSTRING "${rest}" ${at} -1 rest)
  endforeach()
endfunction()

function(expect_empty stream)
  if(NOT "${${stream}}" STREQUAL "")
    fail("std${stream} must be empty")
  endif()
endfunction()

# One line on stderr, which begins with "armcal: " and holds the texts in this
# order; nothing on stdout; no result left behind.
function(expect_refusal expected_code)
  expect_code(${expected_code})
  expect_empty(out)
  if(NOT err MATCHES "^armcal: [^\n]+\n$")
    fail("one line on stderr expected")
  endif()
  expect_text(err ${ARGN})
  if(EXISTS ${WORK_DIR}/out)
    fail("the folder out was left behind")
  endif()
endfunction()

include(${CASES})
