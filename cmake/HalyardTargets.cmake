# Targets of this project: halyard_<component>, seen by others as halyard::<component>.

# Warnings for this project's own code; not exported.
add_library(halyard_warnings INTERFACE)
target_compile_options(halyard_warnings INTERFACE -Wall -Wextra -Wno-psabi)

# Where the loader looks for shared libraries ("run path"): in folders relative to the file that needs them, $ORIGIN. A
# target that is installed is linked with its final run path. If CMake changed it at installation instead, it would pad
# the one of the build tree with ':', and the loader takes an empty entry for the current folder.
set(CMAKE_BUILD_RPATH_USE_ORIGIN ON)

# halyard_run_path(TARGET BUILT INSTALLED): the run path of a target that is in the folder BUILT after the build and in
# INSTALLED after the installation.
function(halyard_run_path target built installed)
  file(RELATIVE_PATH from_installed ${installed} ${CMAKE_INSTALL_FULL_LIBDIR})
  file(RELATIVE_PATH from_built ${built} ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
  set(run_path "\$ORIGIN/${from_installed}" "\$ORIGIN/${from_built}")
  list(TRANSFORM run_path REPLACE "/$" "")
  list(REMOVE_DUPLICATES run_path)
  set_target_properties(${target} PROPERTIES BUILD_WITH_INSTALL_RPATH ON INSTALL_RPATH "${run_path}")
endfunction()

# halyard_install(argument...): install(), unless halyard is a part of another project that does not install it.
function(halyard_install)
  if(HALYARD_INSTALL)
    install(${ARGV})
  endif()
endfunction()

# halyard_library(COMPONENT source...): the library of a component of the package, warnings on, headers found from the
# root.
function(halyard_library component)
  add_library(halyard_${component} ${ARGN})
  add_library(halyard::${component} ALIAS halyard_${component})
  set_target_properties(halyard_${component} PROPERTIES EXPORT_NAME ${component} VERSION ${PROJECT_VERSION} SOVERSION 0
    BUILD_WITH_INSTALL_RPATH ON INSTALL_RPATH "\$ORIGIN")
  target_include_directories(halyard_${component} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/halyard>)
  target_link_libraries(halyard_${component} PRIVATE $<BUILD_INTERFACE:halyard_warnings>)
  # A library calls its own inline functions, not those of the same name of a program or component that is optimised
  # less.
  target_link_options(halyard_${component} PRIVATE LINKER:-Bsymbolic-functions)
  target_compile_features(halyard_${component} PUBLIC cxx_std_20)
  set_property(GLOBAL APPEND PROPERTY HALYARD_COMPONENTS ${component})
  halyard_install(TARGETS halyard_${component} EXPORT halyard-${component}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
endfunction()

# halyard_optimise_a_little(TARGET): for code that takes longer to optimise than it ever runs.
function(halyard_optimise_a_little target)
  target_compile_options(${target} PRIVATE $<$<NOT:$<CONFIG:Debug>>:-O1>)
endfunction()

# share_precompiled_header(TARGET FIRST header...): precompiles the headers for the target FIRST, and has them used by
# TARGET, which is compiled with the same options.
function(share_precompiled_header target first)
  set_target_properties(${target} PROPERTIES DEFINE_SYMBOL "")  # TARGET_EXPORTS, which would tell the targets apart
  if(target STREQUAL first)
    list(TRANSFORM ARGN PREPEND ${PROJECT_SOURCE_DIR}/)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  else()
    target_precompile_headers(${target} REUSE_FROM ${first})
  endif()
endfunction()

# halyard_lane_files(COMPONENT STEM): STEM_generic.cpp, STEM_avx2.cpp, STEM_avx512.cpp, one file per instruction set, of
# which one is chosen at run time. They are optimised in every configuration: a function that is not inlined there would
# be left, compiled for its set, where the linker may give it to all. For the same reason GCC must not guess the targets
# of virtual calls. The sign of a zero and floating-point exceptions mean nothing in these files; the compiler may then
# choose between two results without a branch. Loops over a few numbers must not become calls of memset and memcpy. The
# same templates are instantiated elsewhere over double, where the sanitizers check them. The presets for
# coverage, fuzzing, mutants and the fast tests with sanitizers have the generic files alone (HALYARD_WIDE_LANES).
option(HALYARD_SANITIZE_LANES "In a build with sanitizers, check the lane files too: GCC takes minutes for each" OFF)
set(halyard_lane_options -O3 -fno-signed-zeros -fno-trapping-math -fno-math-errno
  $<$<CXX_COMPILER_ID:GNU>:-fno-devirtualize-speculatively> $<$<CXX_COMPILER_ID:GNU>:-fno-tree-loop-distribute-patterns>)
if(NOT HALYARD_SANITIZE_LANES)
  list(APPEND halyard_lane_options -fno-sanitize=all)
endif()
# Otherwise GCC copies wide vectors in pieces of 16 bytes, and the processor waits when it loads them whole.
set(wide_moves $<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,12>>)
set(halyard_avx2_options -mavx2 -mfma $<${wide_moves}:-mmove-max=256> $<${wide_moves}:-mstore-max=256>)
set(halyard_avx512_options -mavx512f -mavx512dq -mfma $<${wide_moves}:-mmove-max=512> $<${wide_moves}:-mstore-max=512>)
option(HALYARD_WIDE_LANES "Compile lane files and effects for AVX2 and AVX-512 too, for x86-64" ON)
set(halyard_wide_sets "")
if(HALYARD_WIDE_LANES AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(halyard_wide_sets avx2 avx512)
endif()
function(halyard_lane_files component stem)
  set_source_files_properties(${stem}_generic.cpp PROPERTIES COMPILE_OPTIONS "${halyard_lane_options};-O2")
  target_sources(halyard_${component} PRIVATE ${stem}_generic.cpp)
  foreach(set ${halyard_wide_sets})
    set_source_files_properties(${stem}_${set}.cpp PROPERTIES
      COMPILE_OPTIONS "${halyard_lane_options};${halyard_${set}_options}")
    target_sources(halyard_${component} PRIVATE ${stem}_${set}.cpp)
  endforeach()
endfunction()

# halyard_effect_copies(source...): the code of effects over Dual and Lanes, once more for each wider instruction set
# (transmission/effects/built_in.h), as objects of the library of the transmission. Only GCC inlines all that these
# functions call; with another compiler effects have their generic code alone.
function(halyard_effect_copies)
  if(NOT halyard_wide_sets OR NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    return()
  endif()
  target_compile_definitions(halyard_transmission PRIVATE HALYARD_WIDE_EFFECTS)
  foreach(set ${halyard_wide_sets})
    add_library(halyard_effects_${set} OBJECT ${ARGN})
    target_compile_definitions(halyard_effects_${set} PRIVATE HALYARD_EFFECT_SET=${set})
    target_compile_options(halyard_effects_${set} PRIVATE -Wno-psabi ${halyard_lane_options} ${halyard_${set}_options})
    target_include_directories(halyard_effects_${set} PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/include)
    target_link_libraries(halyard_effects_${set} PRIVATE Eigen3::Eigen halyard_warnings)
    target_compile_features(halyard_effects_${set} PRIVATE cxx_std_20)
    set_target_properties(halyard_effects_${set} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_sources(halyard_transmission PRIVATE $<TARGET_OBJECTS:halyard_effects_${set}>)
  endforeach()
endfunction()

# halyard_headers(COMPONENT header...): headers of a component that are installed.
function(halyard_headers component)
  foreach(header ${ARGN})
    get_filename_component(folder ${header} DIRECTORY)
    halyard_install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/halyard/${component}/${folder})
  endforeach()
endfunction()
