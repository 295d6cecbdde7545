# What only shows on a terminal, and what signals do.
find_program(python python3 HINTS /usr/bin NO_DEFAULT_PATH)
write_arm(arm "" "")
set(case "terminal.py")
execute_process(COMMAND ${python} -B ${CMAKE_CURRENT_LIST_DIR}/../terminal.py ${ARMCAL}
                WORKING_DIRECTORY ${WORK_DIR} RESULT_VARIABLE code
                OUTPUT_VARIABLE out ERROR_VARIABLE err)
expect_code(0)
