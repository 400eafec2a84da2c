# halyard_estimator(NAME source...): a plug-in NAME.so, target NAME_plugin. For halyard's own plug-ins and for those of
# users, after find_package(halyard).
function(halyard_estimator name)
  if(NOT TARGET halyard::plugins)
    message(FATAL_ERROR "halyard_estimator(${name}): needs find_package(halyard COMPONENTS plugins)")
  endif()
  add_library(${name}_plugin MODULE ${ARGN})
  target_link_libraries(${name}_plugin PRIVATE halyard::plugins)
  # Hidden, so that no inline function of another module, compiled with other flags, takes the place of one of its own.
  set_target_properties(${name}_plugin PROPERTIES
    OUTPUT_NAME ${name}
    PREFIX ""
    SUFFIX .so
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON)
endfunction()

# halyard_estimator_test(NAME MODEL [KALMAN]): a test of CTest that runs the conformance suite over the plug-in NAME,
# tried with the arm of MODEL.xml. KALMAN: it is a Kalman filter with halyard's noise, and is held against the
# textbook's.
function(halyard_estimator_test name model)
  cmake_parse_arguments(is "KALMAN" "" "" ${ARGN})
  if(TARGET halyard_app)
    set(program $<TARGET_FILE:halyard_app>)
  elseif(EXISTS "${halyard_PROGRAM}")
    set(program ${halyard_PROGRAM})
  else()
    message(FATAL_ERROR "halyard_estimator_test(${name}): the program halyard is not built; set HALYARD_BUILD_PROGRAM")
  endif()
  add_test(NAME ${name}.conformance
    COMMAND ${program} check $<TARGET_FILE:${name}_plugin> --model ${model} $<$<BOOL:${is_KALMAN}>:--kalman>
    COMMAND_EXPAND_LISTS)
endfunction()
