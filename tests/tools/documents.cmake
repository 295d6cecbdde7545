# What the documents say: the commands in them run, and docs/calibrate.md names
# every flag and every key of calibration.json.
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

# Runs the sh blocks of a document that call armcal, from the repository's root
# as they are meant, but with results in WORK_DIR.
function(run_blocks document)
  file(READ ${root}/${document} rest)
  set(blocks 0)
  take_block(sh block)
  while(NOT block STREQUAL "")
    if(block MATCHES "build/armcal")
      math(EXPR blocks "${blocks} + 1")
      set(case "${document}, block ${blocks}")
      string(REPLACE "build/armcal" "${ARMCAL}" block "${block}")
      string(REPLACE "armcal-out" "${WORK_DIR}" block "${block}")
      execute_process(COMMAND bash -e -c "${block}" WORKING_DIRECTORY ${root}
                      RESULT_VARIABLE code OUTPUT_VARIABLE out
                      ERROR_VARIABLE err)
      expect_code(0)
      expect_text(out "rank       6 of 6")
    endif()
    take_block(sh block)
  endwhile()
  if(blocks EQUAL 0)
    message(SEND_ERROR "${document}: no block that calls armcal")
  endif()
endfunction()

run_blocks(README.md)
run_blocks(data/scara/README.md)
run_blocks(docs/calibrate.md)

file(READ ${root}/docs/calibrate.md text)
run("flags" calibrate --help)
string(REGEX MATCHALL "\n  --[a-z_]+" flags "${out}")
foreach(flag ${flags})
  string(STRIP "${flag}" flag)
  if(NOT text MATCHES "`${flag}=")
    fail("docs/calibrate.md does not explain ${flag}")
  endif()
endforeach()

run("keys" calibrate --robot=${DATA_DIR}/scara/robot.yaml
    --log=${DATA_DIR}/scara/B.csv.gz --validate=${DATA_DIR}/scara/A.csv.gz
    --geometry=lengths --out=out)
expect_code(0)
file(READ ${WORK_DIR}/out/calibration.json json)
string(REGEX MATCHALL "\"[a-z_0-9]+\":" keys "${json}")
list(REMOVE_DUPLICATES keys)
foreach(key ${keys})
  string(REGEX REPLACE "[\":]" "" key "${key}")
  if(NOT text MATCHES "`${key}(\\[\\])?`")
    fail("docs/calibrate.md does not explain the key ${key}")
  endif()
endforeach()

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
