# A user's effect as truth, unknown to the model: found by its name, at its joint, with its size, and then part of the
# model that estimators read.
file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
set(effects --effects ${MODULE})

function(halyard)
  execute_process(COMMAND ${HALYARD} ${ARGN} WORKING_DIRECTORY ${FOLDER} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endfunction()
halyard(simulate ${SCENARIO} --out log.csv ${effects})
halyard(diagnose --model ${MODEL} --data log.csv --out out ${effects})
halyard(estimate --model out/model.xml --estimator ekf --data log.csv --out est.csv ${effects})

file(READ ${FOLDER}/out/diagnosis.json diagnosis)
string(JSON count LENGTH ${diagnosis} effects)
string(JSON name GET ${diagnosis} effects 0 effect)
string(JSON joint GET ${diagnosis} effects 0 joint)
string(JSON rise GET ${diagnosis} effects 0 parameters rise value)
# The truth is a rise of 0.8 N m; 5 % is far more than the interval of the fit.
if(NOT (count EQUAL 1 AND name STREQUAL tight_spot AND joint EQUAL 2 AND rise GREATER 0.76 AND rise LESS 0.84))
  message(FATAL_ERROR "expected tight_spot of joint 2 with a rise of 0.8 N m:\n${diagnosis}")
endif()

# Without the module the revised model names an effect that nobody knows.
execute_process(COMMAND ${HALYARD} check out/model.xml WORKING_DIRECTORY ${FOLDER}
  RESULT_VARIABLE code ERROR_VARIABLE error OUTPUT_QUIET)
if(NOT (code EQUAL 2 AND error MATCHES "tight_spot.*unknown effect"))
  message(FATAL_ERROR "expected a refusal of tight_spot: ${code} ${error}")
endif()
