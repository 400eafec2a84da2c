# halyard_estimator(NAME source...): a plug-in NAME.so, target NAME_plugin. For halyard's own plug-ins and for those of
# users, after find_package(halyard).
function(halyard_estimator name)
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
