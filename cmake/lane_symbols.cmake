# Fails if one of OBJECTS that is compiled once per instruction set defines a symbol that the linker may share with
# other files (weak code, unique): code of a wider instruction set would run where it cannot.
#   cmake -DNM=<nm> -DOBJECTS=<list> -P lane_symbols.cmake
set(checked 0)
foreach(object IN LISTS OBJECTS)
  if(NOT object MATCHES "_(generic|avx2|avx512)\\.(cpp|dir)")
    continue()
  endif()
  execute_process(COMMAND ${NM} -C ${object} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[0-9a-f]+ [Wu] [^\n]*" shared "${symbols}")
  if(shared)
    message(FATAL_ERROR "${object} shares code: ${shared}")
  endif()
  math(EXPR checked "${checked} + 1")
endforeach()
if(checked EQUAL 0)
  message(FATAL_ERROR "no object of one instruction set among: ${OBJECTS}")
endif()
message("${checked} files share no code")
