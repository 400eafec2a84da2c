# Targets of this project: halyard_<room>, seen by others as halyard::<room>.

# Warnings for this project's own code; not exported.
add_library(halyard_warnings INTERFACE)
target_compile_options(halyard_warnings INTERFACE -Wall -Wextra -Wno-psabi)

# halyard_library(ROOM source...): the library of a room, warnings on, headers found from the root.
function(halyard_library room)
  add_library(halyard_${room} ${ARGN})
  add_library(halyard::${room} ALIAS halyard_${room})
  set_target_properties(halyard_${room} PROPERTIES EXPORT_NAME ${room} VERSION ${PROJECT_VERSION} SOVERSION 0
    INSTALL_RPATH "\$ORIGIN")
  target_include_directories(halyard_${room} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/halyard>)
  target_link_libraries(halyard_${room} PRIVATE $<BUILD_INTERFACE:halyard_warnings>)
  target_compile_features(halyard_${room} PUBLIC cxx_std_20)
  install(TARGETS halyard_${room} EXPORT halyard-targets
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
endfunction()

# halyard_headers(ROOM header...): headers of a room that are installed.
function(halyard_headers room)
  foreach(header ${ARGN})
    get_filename_component(folder ${header} DIRECTORY)
    install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/halyard/${room}/${folder})
  endforeach()
endfunction()
