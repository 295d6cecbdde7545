# An installed armcal: a program builds on its libraries, the manual page and
# the completion are there; and the Debian package has what it needs.
macro(do case_name)
  set(case "${case_name}")
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${WORK_DIR}
                  RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE err)
  expect_code(0)
endmacro()
function(expect_files root)
  foreach(file ${ARGN})
    if(NOT EXISTS ${root}/${file})
      fail("${root}/${file} expected")
    endif()
  endforeach()
endfunction()
set(of_program bin/armcal share/man/man1/armcal.1.gz
    share/bash-completion/completions/armcal
    share/zsh/vendor-completions/_armcal
    share/fish/vendor_completions.d/armcal.fish share/doc/armcal/copyright)

set(prefix ${WORK_DIR}/prefix)
do("install" ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})
expect_files(${prefix} ${of_program} include/armcal/model/robot/robot.h)
# Truth for blind tests is no part of the libraries.
if(EXISTS ${prefix}/include/armcal/model/plant/hidden)
  fail("model/plant/hidden must not be installed")
endif()

file(GLOB_RECURSE headers ${prefix}/include/armcal/*.h)
list(LENGTH headers count)
if(count GREATER 64)
  fail("${count} headers are installed, expected at most 64: the doors and what "
       "they include")
endif()

get_filename_component(root ${DATA_DIR} DIRECTORY)
set(ENV{CXX} "${CXX}")  # sanitizers' libraries need theirs
set(ENV{CXXFLAGS} "${CXXFLAGS}")
do("the examples find armcal" ${CMAKE_COMMAND} -S ${root}/examples/cpp
   -B example -DCMAKE_PREFIX_PATH=${prefix})
do("the examples are built" ${CMAKE_COMMAND} --build example)
write_arm(arm "" "")
run("a log" simulate --robot=arm.yaml --duration=12 --log_rate=100 --out=made)
run("a log with a payload" simulate --robot=arm.yaml --duration=12
    --log_rate=100 --effects=payload:mass=2kg --run=1 --out=loaded)
do("calibrate" example/calibrate arm.yaml made/log.csv)
expect_text(out " +- " " N m s/rad" "arm: 13 model parameters")
expect_files(${WORK_DIR} calibrated/calibration.json calibrated/covariance.csv)
# What armcal itself writes of the same log.
run("armcal calibrates" calibrate --robot=arm.yaml --log=made/log.csv
    --bandwidth=10 --out=same)
foreach(file calibration.json covariance.csv outliers.csv)
  file(SHA256 ${WORK_DIR}/calibrated/${file} of_example)
  file(SHA256 ${WORK_DIR}/same/${file} of_armcal)
  if(NOT of_example STREQUAL of_armcal)
    fail("${file} of the example is not that of armcal")
  endif()
endforeach()
do("diagnose" example/diagnose arm.yaml loaded/log.csv made/log.csv)
expect_text(out "explained\npayload " " % of the gap")
do("verify" example/verify arm.yaml made/log.csv)
expect_text(out "Simbody")
do("excite" example/excite arm.yaml)
expect_files(${WORK_DIR} motion/trajectory.csv motion/excite.json)
do("pendulum" example/pendulum)
expect_text(out "viscous[1] = 0.3" " N m s/rad")
set(case "a wrong log")
execute_process(COMMAND example/calibrate arm.yaml arm.yaml
                WORKING_DIRECTORY ${WORK_DIR} RESULT_VARIABLE code
                OUTPUT_VARIABLE out ERROR_VARIABLE err)
expect_code(3)
expect_text(err "arm.yaml: ")

# The program's package; that of the libraries takes seconds to compress.
find_program(shlibdeps dpkg-shlibdeps)
if(NOT shlibdeps)
  message("no package is made: dpkg-dev is not here (tools/setup.sh)")
  return()
endif()
do("package" cpack --config ${BUILD_DIR}/CPackConfig.cmake
   -G DEB -B deb -D CPACK_COMPONENTS_ALL=runtime)
file(GLOB package ${WORK_DIR}/deb/armcal_*.deb)
do("what it says" dpkg-deb -f ${package})
expect_text(out "Depends: " "libsimbody3" "Description: " "Package: armcal\n")
do("what it holds" dpkg-deb -x ${package} unpacked)
expect_files(${WORK_DIR}/unpacked/usr ${of_program})
do("it runs" unpacked/usr/bin/armcal --version)
expect_text(out "armcal ")
