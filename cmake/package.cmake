# cpack -G DEB: armcal_VERSION_ARCH.deb and armcal-dev_VERSION_ARCH.deb.
set(CPACK_PACKAGE_NAME armcal)
set(CPACK_PACKAGE_CONTACT "armcal developers <armcal@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY
    "calibrates robot arms from logs and diagnoses their sim-to-real gap")
set(description "\
Estimates the dynamics and the geometry of a robot arm from noisy logs of
joint positions and torques (or motor currents) and from measured poses, each
number with a standard deviation; checks them on other logs and against
Simbody; writes robot files for simulators; and says which effect its model
still lacks.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_COMPONENT_RUNTIME_DESCRIPTION ${description})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME armcal)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)

set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
    "${description}\nThis package has the libraries and headers for programs.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME armcal-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
string(REPLACE ";" ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
       "${development_packages}")
include(CPack)
