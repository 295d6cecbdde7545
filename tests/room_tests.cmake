# add_room_tests(SOURCES): programs of tests, one for each folder of them, and
# for each file a test of ctest that runs its suites.

# The room that a test is of: "diagnose_select" of
# calib/diagnose/select/null_test.cc.
function(room_of source variable)
  get_filename_component(room ${source} DIRECTORY)
  string(REGEX REPLACE "^(model/plant|model|calib)/" "" room ${room})
  string(REPLACE "/" "_" room ${room})
  set(${variable} ${room} PARENT_SCOPE)
endfunction()

# A test's name says where it lies: that of calib/linear/solution_test.cc is
# linear_solution_test. A folder's name is not said twice: mujoco_test.
function(test_name source variable)
  room_of(${source} room)
  get_filename_component(base ${source} NAME_WE)
  get_filename_component(folder ${source} DIRECTORY)
  get_filename_component(folder ${folder} NAME)
  if(base MATCHES "^${folder}_")
    string(REGEX REPLACE "_?${folder}$" "" room ${room})
  endif()
  string(REGEX REPLACE "^_" "" name "${room}_${base}")
  set(${variable} ${name} PARENT_SCOPE)
endfunction()

# The filter of GoogleTest that runs the suites of a file. A suite is in one
# file of its program, or it would be run twice.
function(filter_of source program variable)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
  file(STRINGS ${source} lines REGEX "^(TYPED_)?TEST(_F|_P)?[(]")
  set(suites)
  foreach(line ${lines})
    string(REGEX REPLACE "^[A-Z_]+[(]([A-Za-z0-9_]+).*" "\\1" suite "${line}")
    list(APPEND suites ${suite})
  endforeach()
  list(REMOVE_DUPLICATES suites)
  if(NOT suites)
    message(FATAL_ERROR "${source}: has no tests")
  endif()
  set(filter)
  foreach(suite ${suites})
    get_property(file GLOBAL PROPERTY ${program}_${suite})
    if(file)
      message(FATAL_ERROR "${source}: ${file} has a suite ${suite} as well")
    endif()
    set_property(GLOBAL PROPERTY ${program}_${suite} ${source})
    string(APPEND filter ":${suite}.*:*/${suite}.*:${suite}/*")
  endforeach()
  string(SUBSTRING "${filter}" 1 -1 filter)
  set(${variable} "${filter}" PARENT_SCOPE)
endfunction()

# The program of a room's tests; its libraries are ${libraries_ROOM} beside
# those of all, its further sources ${sources_ROOM}.
function(add_room room program)
  add_executable(${program} ${ARGN} ${sources_${room}})
  target_link_libraries(${program} PRIVATE tested ${libraries_${room}})
  if(PRECOMPILE)
    target_precompile_headers(${program} REUSE_FROM test_headers)
  endif()
  if(UNITY)
    set_target_properties(${program} PROPERTIES UNITY_BUILD ON
                          UNITY_BUILD_BATCH_SIZE 6)
  endif()
endfunction()

function(add_room_tests)
  if(PRECOMPILE)
    # A program without tests makes the precompiled header of all.
    file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/test_headers.cc "")
    add_executable(test_headers ${CMAKE_CURRENT_BINARY_DIR}/test_headers.cc)
    target_link_libraries(test_headers PRIVATE tested)
    target_precompile_headers(test_headers PRIVATE <Eigen/Dense>
      <Eigen/Geometry> <functional> <gmock/gmock.h> <gtest/gtest.h> <string>
      <vector>)
  endif()
  set(programs)
  foreach(source ${ARGN})
    room_of(${source} room)
    set(program ${room}_tests)
    if(source MATCHES "_long_test.cc$")
      set(program ${room}_long_tests)
    endif()
    list(APPEND programs ${program})
    list(APPEND sources_of_${program} ${source})
    set(room_of_${program} ${room})
    test_name(${source} name)
    filter_of(${source} ${program} filter)
    add_test(NAME ${name} COMMAND ${program} --gtest_filter=${filter})
    if(source MATCHES "_long_test.cc$")  # left out by ctest -LE long
      set_tests_properties(${name} PROPERTIES LABELS long)
    endif()
  endforeach()
  list(REMOVE_DUPLICATES programs)
  foreach(program ${programs})
    add_room(${room_of_${program}} ${program} ${sources_of_${program}})
  endforeach()
endfunction()
