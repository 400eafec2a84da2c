# What `cmake --install` adds to what the rooms install themselves: the examples' data, and the package that
# find_package(halyard) reads.
include(CMakePackageConfigHelpers)

set(HALYARD_PLUGIN_DIR ${CMAKE_INSTALL_LIBDIR}/halyard/plugins)
set(HALYARD_DATA_DIR ${CMAKE_INSTALL_DATADIR}/halyard)
set(HALYARD_PROGRAM ${CMAKE_INSTALL_BINDIR}/halyard)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples/raven2 ${PROJECT_SOURCE_DIR}/examples/measured
  DESTINATION ${HALYARD_DATA_DIR}
  FILES_MATCHING PATTERN "*.xml" PATTERN "*.csv" PATTERN "*.md")

# A shared library brings along what it links, a static one leaves that to its users.
set(HALYARD_STATIC_DEPENDENCIES "")
if(NOT BUILD_SHARED_LIBS)
  foreach(package tinyxml2 Boost TBB Ceres)
    string(APPEND HALYARD_STATIC_DEPENDENCIES "find_dependency(${package})\n")
  endforeach()
endif()

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/halyard)
configure_package_config_file(
  ${PROJECT_SOURCE_DIR}/cmake/halyardConfig.cmake.in ${PROJECT_BINARY_DIR}/halyardConfig.cmake
  INSTALL_DESTINATION ${package_folder}
  PATH_VARS HALYARD_PLUGIN_DIR HALYARD_DATA_DIR HALYARD_PROGRAM)
# Before 1.0 a minor version may change the C++ interfaces.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/halyardConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/halyardConfig.cmake
  ${PROJECT_BINARY_DIR}/halyardConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/HalyardEffects.cmake
  ${PROJECT_SOURCE_DIR}/cmake/HalyardEstimator.cmake
  DESTINATION ${package_folder})
install(EXPORT halyard-targets NAMESPACE halyard:: FILE halyardTargets.cmake DESTINATION ${package_folder})
