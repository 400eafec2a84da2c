# halyard_effects(NAME source...): a module of effects NAME.so, target NAME_effects, for `halyard COMMAND --effects`.
function(halyard_effects name)
  if(NOT TARGET halyard::transmission)
    message(FATAL_ERROR "halyard_effects(${name}): needs find_package(halyard COMPONENTS transmission)")
  endif()
  add_library(${name}_effects MODULE ${ARGN})
  target_link_libraries(${name}_effects PRIVATE halyard::transmission)
  # Hidden, so that no inline function of another module, compiled with other flags, takes the place of one of its own.
  set_target_properties(${name}_effects PROPERTIES
    OUTPUT_NAME ${name}
    PREFIX ""
    SUFFIX .so
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON)
endfunction()
