# What `cmake --install` adds to what the components install themselves: data, templates, and the package that
# find_package(halyard) reads. As a part of another project halyard has its data in the source tree.
if(NOT PROJECT_IS_TOP_LEVEL)
  set(halyard_DATA_DIR ${PROJECT_SOURCE_DIR}/examples PARENT_SCOPE)
endif()
if(NOT HALYARD_INSTALL)
  return()
endif()
include(CMakePackageConfigHelpers)

set(HALYARD_PLUGIN_DIR ${CMAKE_INSTALL_LIBDIR}/halyard/plugins)
set(HALYARD_DATA_DIR ${CMAKE_INSTALL_DATADIR}/halyard)
set(HALYARD_PROGRAM ${CMAKE_INSTALL_BINDIR}/halyard)
set(HALYARD_WORKER ${CMAKE_INSTALL_LIBEXECDIR}/halyard/halyard_worker)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples/raven2 ${PROJECT_SOURCE_DIR}/examples/measured
  DESTINATION ${HALYARD_DATA_DIR}
  FILES_MATCHING PATTERN "*.xml" PATTERN "*.csv" PATTERN "*.md")
foreach(kind estimator effect program)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples/out_of_tree_${kind}/ DESTINATION ${HALYARD_DATA_DIR}/templates/${kind}
    FILES_MATCHING PATTERN "*.cpp" PATTERN "CMakeLists.txt")
endforeach()
install(FILES ${PROJECT_BINARY_DIR}/include/halyard/version.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/halyard)

# Of each component, read from what its library is linked with: other components, and packages whose targets a user of
# it meets. A shared library keeps what it links privately to itself, a static one leaves that to its users.
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/halyard)
get_property(HALYARD_COMPONENTS GLOBAL PROPERTY HALYARD_COMPONENTS)
set(HALYARD_COMPONENT_NEEDS "")
foreach(component ${HALYARD_COMPONENTS})
  get_target_property(linked halyard_${component} INTERFACE_LINK_LIBRARIES)
  set(components "")
  set(packages "")
  foreach(library ${linked})
    if(library MATCHES "halyard(_|::)([a-z]+)" AND CMAKE_MATCH_2 IN_LIST HALYARD_COMPONENTS)
      list(APPEND components ${CMAKE_MATCH_2})
    elseif(library MATCHES "([A-Za-z0-9_]+)::")
      list(APPEND packages ${CMAKE_MATCH_1})
    endif()
  endforeach()
  string(APPEND HALYARD_COMPONENT_NEEDS
    "set(_halyard_components_of_${component} ${components})\nset(_halyard_packages_of_${component} ${packages})\n")
  install(EXPORT halyard-${component} NAMESPACE halyard:: DESTINATION ${package_folder})
endforeach()

configure_package_config_file(
  ${PROJECT_SOURCE_DIR}/cmake/halyardConfig.cmake.in ${PROJECT_BINARY_DIR}/halyardConfig.cmake
  INSTALL_DESTINATION ${package_folder}
  PATH_VARS HALYARD_PLUGIN_DIR HALYARD_DATA_DIR HALYARD_PROGRAM HALYARD_WORKER)
# Before 1.0 a minor version may change the C++ interfaces.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/halyardConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/halyardConfig.cmake
  ${PROJECT_BINARY_DIR}/halyardConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/HalyardEffects.cmake
  ${PROJECT_SOURCE_DIR}/cmake/HalyardEstimator.cmake
  DESTINATION ${package_folder})
