# What the documents say: the commands in them run and print what stands there,
# and the page of a command names all of its flags and keys.
get_filename_component(root ${DATA_DIR} DIRECTORY)

# Cuts the next block of a language off the front of `rest`; empty if none.
macro(take_block language block)
  set(${block} "")
  string(FIND "${rest}" "```${language}\n" begin)
  if(NOT begin EQUAL -1)
    string(LENGTH "```${language}\n" fence)
    math(EXPR begin "${begin} + ${fence}")
    string(SUBSTRING "${rest}" ${begin} -1 rest)
    string(FIND "${rest}" "```" end)
    string(SUBSTRING "${rest}" 0 ${end} ${block})
    string(SUBSTRING "${rest}" ${end} -1 rest)
  endif()
endmacro()

# tests/documents.py runs the blocks and compares what they print.
set(case "documents")
find_program(python python3 HINTS /usr/bin NO_DEFAULT_PATH)
execute_process(COMMAND ${python} ${root}/tests/documents.py --armcal=${ARMCAL}
                --root=${root} --work=${WORK_DIR}/documents
                RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE err)
message("${out}")
expect_code(0)

set(case "examples in documents")
execute_process(COMMAND ${python} ${root}/tools/paste_examples.py --check
                RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE err)
message("${out}")
expect_code(0)

# The examples of both formats are read; they are too short for a result.
file(READ ${root}/docs/robot_files.md rest)
take_block(yaml robot)
file(WRITE ${WORK_DIR}/robot.yaml "${robot}")
file(WRITE ${WORK_DIR}/one.csv "t,q1,tau1\n0,0.1,1\n1,0.2,1\n2,0.4,2\n")
run("robot_files.md" calibrate --robot=robot.yaml --log=one.csv)
if(NOT code MATCHES "^[01]$")
  fail("the example of docs/robot_files.md is refused")
endif()
file(READ ${root}/docs/logs.md rest)
take_block(csv log)
file(WRITE ${WORK_DIR}/two.csv "${log}0.004,0.12,0.53,3.2,0.4\n")
file(WRITE ${WORK_DIR}/two.yaml "convention: standard\nlinks:
  - {joint: revolute, a: 1}\n  - {joint: revolute, a: 1}\n")
run("logs.md" calibrate --robot=two.yaml --log=two.csv)
if(NOT code MATCHES "^[01]$")
  fail("the example of docs/logs.md is refused")
endif()
