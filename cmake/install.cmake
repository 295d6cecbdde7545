# cmake --install BUILD, and packages by cpack -G DEB: `runtime` is the program
# with its manual page and completion, `development` the libraries with headers
# for find_package(armcal).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Manual and completion, as the program itself writes them.
set(documents ${CMAKE_CURRENT_BINARY_DIR}/documents)
set(completions share/bash-completion/completions/armcal
    share/zsh/vendor-completions/_armcal
    share/fish/vendor_completions.d/armcal.fish)
set(written ${documents}/armcal.1.gz ${documents}/changelog.gz)
set(commands COMMAND sh -c
    "$<TARGET_FILE:armcal> help --man | gzip -9n > ${documents}/armcal.1.gz"
    COMMAND sh -c
    "gzip -9n < ${PROJECT_SOURCE_DIR}/CHANGELOG.md > ${documents}/changelog.gz")
foreach(file ${completions})
  string(REGEX REPLACE "^share/(bash|zsh|fish).*" "\\1" shell ${file})
  list(APPEND written ${documents}/${file})
  list(APPEND commands COMMAND sh -c
       "$<TARGET_FILE:armcal> completion ${shell} > ${documents}/${file}")
  get_filename_component(folder ${file} DIRECTORY)
  file(MAKE_DIRECTORY ${documents}/${folder})
  install(FILES ${documents}/${file} DESTINATION ${folder} COMPONENT runtime)
endforeach()
add_custom_command(OUTPUT ${written} ${commands} VERBATIM
                   DEPENDS armcal ${PROJECT_SOURCE_DIR}/CHANGELOG.md)
add_custom_target(documents ALL DEPENDS ${written})
install(TARGETS armcal COMPONENT runtime)
install(FILES ${documents}/armcal.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1
        COMPONENT runtime)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/armcal
        COMPONENT runtime)
# Debian's policy: the licence of a package is the file `copyright`, beside a
# changelog.
foreach(package armcal armcal-dev)
  set(component runtime)
  if(package STREQUAL armcal-dev)
    set(component development)
  endif()
  install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
          RENAME copyright COMPONENT ${component})
  install(FILES ${documents}/changelog.gz COMPONENT ${component}
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package})
endforeach()

# Headers are included as here, "model/robot/robot.h", from include/armcal.
set(headers ${CMAKE_INSTALL_INCLUDEDIR}/armcal)
foreach(library ${exported})
  set_target_properties(${library} PROPERTIES OUTPUT_NAME armcal_${library})
  target_compile_features(${library} PUBLIC cxx_std_17)
  target_include_directories(${library} INTERFACE
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${headers}>)
endforeach()
# What programs link: all of the libraries.
add_library(all_of_armcal INTERFACE)
set_target_properties(all_of_armcal PROPERTIES EXPORT_NAME armcal)
target_link_libraries(all_of_armcal INTERFACE ${exported})
# Installed are the doors, what makes their arguments, and what these include:
# nothing else of the libraries is promised to programs.
set(public calib/calibrate.h calib/compare.h calib/diagnose.h calib/excite.h
    calib/inspect.h calib/merge.h calib/verify.h calib/watch.h model/dynamics/forward_dynamics.h
    model/dynamics/inverse_dynamics.h model/log_files/log_reader.h
    model/robot/kinematics.h model/robot_files/robot_reader.h
    model/robot_files/urdf_writer.h)
set(header 0)
list(LENGTH public count)
while(header LESS count)
  list(GET public ${header} file)
  file(STRINGS ${file} includes REGEX "^#include \"")
  foreach(include ${includes})
    string(REGEX REPLACE "^#include \"(.*)\".*" "\\1" include "${include}")
    list(APPEND public ${include})
  endforeach()
  list(REMOVE_DUPLICATES public)
  list(LENGTH public count)
  math(EXPR header "${header} + 1")
endwhile()
foreach(file ${public})
  get_filename_component(folder ${file} DIRECTORY)
  install(FILES ${file} DESTINATION ${headers}/${folder} COMPONENT development)
endforeach()
install(TARGETS ${exported} all_of_armcal EXPORT armcal COMPONENT development)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/armcal)
install(EXPORT armcal NAMESPACE armcal:: FILE armcalTargets.cmake
        DESTINATION ${package} COMPONENT development)

# A program that links static libraries links what those need as well.
set(find_dependencies "")
foreach(dependency ${dependencies})
  string(APPEND find_dependencies "find_dependency(${dependency})\n")
endforeach()
configure_package_config_file(cmake/armcalConfig.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/armcalConfig.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(
  ${CMAKE_CURRENT_BINARY_DIR}/armcalConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/armcalConfig.cmake
        ${CMAKE_CURRENT_BINARY_DIR}/armcalConfigVersion.cmake
        DESTINATION ${package} COMPONENT development)

if(PROJECT_IS_TOP_LEVEL)
  include(cmake/package.cmake)
endif()
