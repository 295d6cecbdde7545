# cmake -DROOT=... -P format_test.cmake
#
# Every source file is as clang-format 14 writes it; other versions write some
# lines otherwise, so without that one this is skipped.
cmake_minimum_required(VERSION 3.25)

find_program(CLANG_FORMAT NAMES clang-format-14 clang-format)
if(CLANG_FORMAT)
  execute_process(COMMAND ${CLANG_FORMAT} --version OUTPUT_VARIABLE version)
endif()
if(NOT version MATCHES "version 14\\.")
  message("SKIPPED: clang-format 14 is not installed")
  return()
endif()

set(files)
foreach(folder model problems calib tools tests)
  file(GLOB_RECURSE found ${ROOT}/${folder}/*.h ${ROOT}/${folder}/*.cc)
  list(APPEND files ${found})
endforeach()
execute_process(COMMAND ${CLANG_FORMAT} --dry-run -Werror ${files}
                RESULT_VARIABLE result ERROR_VARIABLE differences)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${differences}\nrun clang-format -i on these files")
endif()
