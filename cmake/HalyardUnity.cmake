# Groups of files that are compiled as one, so that their common headers are read, and their common templates
# instantiated, once: a cold build takes less than half the time, and a changed file is compiled with up to a dozen
# others. The names in the unnamed namespaces of a group have to differ, and those of a test from the headers in its
# folder's support/: the compiler takes two functions of one name for overloads. A file that is not listed here is
# compiled alone.
option(HALYARD_UNITY_BUILD "Compile groups of files as one: a cold build is shorter" ON)
set(HALYARD_COMPONENTS_WITHOUT_GROUPS "" CACHE STRING "Folders whose files are compiled alone in a unity build, too")

# compile_together(TARGET GROUP file...)
function(compile_together target group)
  if(NOT HALYARD_UNITY_BUILD OR NOT TARGET ${target})
    return()
  endif()
  get_target_property(folder ${target} SOURCE_DIR)
  file(RELATIVE_PATH component ${PROJECT_SOURCE_DIR} ${folder})
  string(REGEX REPLACE "/.*" "" component ${component})
  if(component IN_LIST HALYARD_COMPONENTS_WITHOUT_GROUPS)
    return()
  endif()
  list(TRANSFORM ARGN PREPEND ${folder}/ OUTPUT_VARIABLE files)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  set_source_files_properties(${files} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${group})
endfunction()

compile_together(halyard_transmission core arm_parameters.cpp command_history.cpp effect.cpp effects/library.cpp lanes/instruction_set.cpp)
foreach(place cable joint motor sensor)
  file(GLOB effects RELATIVE ${PROJECT_SOURCE_DIR}/transmission CONFIGURE_DEPENDS
    ${PROJECT_SOURCE_DIR}/transmission/effects/${place}/*.cpp)
  foreach(target halyard_transmission halyard_effects_avx2 halyard_effects_avx512)
    compile_together(${target} ${place}_effects ${effects})
  endforeach()
endforeach()

compile_together(halyard_model model
  arm_log.cpp arm_model.cpp column_map.cpp homing.cpp input/cell_text.cpp input/text_file.cpp log.cpp
  machine/memory_limit.cpp model_file.cpp
  output/file_lock.cpp output/folder_lock.cpp output/locked_file.cpp output/number_text.cpp output/output_files.cpp
  output/read_files.cpp output/unfinished.cpp output/utf8.cpp
  xml/arm_checks.cpp xml/field_reader.cpp xml/model_writer.cpp)

compile_together(halyard_simbody simbody integrators/simbody_integrator.cpp simbody_arm.cpp)
compile_together(halyard_plant simulation
  arm_plant.cpp controller.cpp drive_train.cpp equilibrium.cpp integrators/integrator.cpp
  integrators/sundials_integrator.cpp lanes/plant_kernels.cpp xml/scenario_file.cpp xml/scenario_writer.cpp
  sensors/camera.cpp sensors/encoder.cpp simulate.cpp
  trajectory.cpp)
compile_together(halyard_plant own_chain integrators/rosenbrock_integrator.cpp integrators/step_matrix.cpp newton_euler_arm.cpp)

compile_together(halyard_estimators filters
  built_in.cpp eigen_modes.cpp estimator.cpp estimator_options.cpp
  filters/arm_filter.cpp filters/camera_filter.cpp filters/disturbance_filter.cpp filters/ekf.cpp
  filters/fixed_lag_smoother.cpp filters/gaussian_filter.cpp filters/kinematics.cpp filters/sr_ukf.cpp
  filters/start_readings.cpp filters/unknown_constant.cpp log_sample.cpp)
compile_together(halyard_estimators process
  identification/arm_family.cpp identification/block_jackknife.cpp identification/dual_ukf.cpp
  identification/identified_keys.cpp identification/identify.cpp
  matrix/matrix_kernels.cpp matrix/mean_shift.cpp matrix/phi_functions.cpp process/exponential_step.cpp process/held_torques.cpp process/noise.cpp
  process/plain/plain_transmission.cpp process/process_model.cpp process/standstill.cpp process/static_equilibrium.cpp)

compile_together(halyard_plugins estimators
  host/eigen_alignment.cpp host/estimator_module.cpp host/loader.cpp host/plugin_estimator.cpp host/shared_module.cpp)
compile_together(halyard_plugins checks host/conformance.cpp host/effect_module.cpp)

compile_together(halyard_diagnosis records
  calibration/calibrate.cpp calibration/torque_comparison.cpp explanation/curve_fit.cpp
  explanation/estimates.cpp explanation/headline.cpp explanation/lines_above_band.cpp explanation/residual_signals.cpp
  explanation/signature.cpp explanation/spectrum.cpp explanation/view_sentence.cpp explanation/views.cpp
  motion/chebyshev.cpp motion/lane_drive.cpp
  prediction/start/driven_start.cpp prediction/filtered_effect.cpp prediction/measured_units.cpp record/record.cpp
  record/resting.cpp record/settling.cpp record/start_of_motion.cpp search_space/cable.cpp search_space/joint.cpp
  search_space/motor.cpp search_space/search_space.cpp
  search_space/sensor.cpp)
compile_together(halyard_diagnosis prediction
  prediction/lane_residuals.cpp prediction/start/let_down.cpp prediction/motion_key.cpp prediction/prediction.cpp
  prediction/shared_lanes.cpp
  prediction/side_by_side.cpp)
compile_together(halyard_diagnosis log_check
  log_check/agreement.cpp log_check/clock.cpp log_check/columns/column_samples.cpp log_check/columns/columns.cpp
  log_check/columns/counters.cpp log_check/columns/end_of_counter.cpp log_check/exchanges/assignment.cpp
  log_check/exchanges/joint_exchanges.cpp log_check/exchanges/motor_exchanges.cpp
  log_check/exchanges/position_exchanges.cpp log_check/exchanges/torque_exchanges.cpp log_check/log_check.cpp
  log_check/log_under_check.cpp log_check/outliers.cpp log_check/own_readings.cpp log_check/positions.cpp
  log_check/robust.cpp log_check/torques/needed_torques.cpp log_check/torques/saturating_torque.cpp
  log_check/torques/torque_columns.cpp log_check/torques/torques.cpp log_check/zeros.cpp)
compile_together(halyard_diagnosis fit
  calibration/lateness.cpp fit/baseline_reach.cpp fit/beyond_numbers.cpp fit/block_variance.cpp
  fit/bounded_least_squares.cpp fit/complementary.cpp fit/evidence.cpp fit/fit.cpp fit/fit_parameter.cpp fit/nudged.cpp
  noise/channel_noise.cpp noise/delay_free.cpp noise/ripple_free.cpp planning/change_detector.cpp planning/plan.cpp
  planning/planner.cpp rehearsal/drawn_effect.cpp rehearsal/motion_range.cpp rehearsal/rehearsal.cpp
  rehearsal/rehearse.cpp rehearsal/rehearsed_log.cpp rehearsal/true_names.cpp)
compile_together(halyard_diagnosis judgement
  diagnose.cpp holdout/adoption.cpp holdout/holdout.cpp holdout/prediction_interval.cpp
  judgement/false_discovery.cpp judgement/final_fit.cpp judgement/judge.cpp
  judgement/likelihood.cpp judgement/name_probability.cpp judgement/nested_gain.cpp judgement/paired_t.cpp
  round/candidate_round.cpp round/joint_proposal.cpp round/refit.cpp round/sparse_selection.cpp
  search/attribution.cpp search/compete.cpp search/naming.cpp search/pair_rivals.cpp search/revision.cpp
  starts/leaps.cpp starts/screen.cpp starts/starts.cpp)

compile_together(halyard_evaluation studies
  comparison/compare.cpp estimator_list.cpp judgement/consistency.cpp judgement/error_statistics.cpp
  judgement/serial_statistics.cpp run/sensor_readings.cpp studies/diagnosis_evaluation.cpp studies/effect_study.cpp
  studies/holdout_errors.cpp studies/motion_proposal.cpp)
compile_together(halyard_evaluation runs
  comparison/assumed_noise.cpp comparison/monte_carlo.cpp experiments/raven_experiments.cpp json.cpp run/contained_run.cpp
  run/tried_effects.cpp studies/identification_study.cpp sweep/measures/sweep_limits.cpp
  sweep/measures/sweep_measure.cpp sweep/parameters/axis_keys.cpp
  sweep/parameters/estimator_option.cpp sweep/parameters/scenario_number.cpp sweep/sweep_cells.cpp sweep/sweep_design.cpp
  sweep/sweep_file.cpp sweep/sweep_grid.cpp sweep/sweep_merge.cpp sweep/sweep_parameter.cpp sweep/sweep_run.cpp sweep/sweep_store.cpp
  sweep/sweep_summary.cpp sweep/sweep_table.cpp this_program.cpp)
compile_together(halyard_running run csv.cpp run/estimate.cpp worker/worker_task.cpp)

compile_together(halyard_report report chart.cpp chart_json.cpp page.cpp)
compile_together(halyard_app commands
  command_line.cpp commands/check_command.cpp commands/compare_command.cpp commands/diagnose_command.cpp
  commands/estimate_command.cpp commands/identify_command.cpp commands/plan_command.cpp commands/plugins_command.cpp
  commands/simulate_command.cpp commands/sweep_command.cpp commands/sweep_slurm_command.cpp interruption.cpp log_input.cpp main.cpp output_check.cpp
  progress.cpp run_estimate.cpp slurm/slurm_array.cpp sweep_options.cpp terminal/terminal.cpp
  tour/experiments_command.cpp tour/tour_command.cpp)
compile_together(halyard_app pages
  pages/comparison_figures.cpp pages/comparison_output.cpp pages/diagnosis/diagnosis_report.cpp
  pages/diagnosis/view_charts.cpp pages/estimator_table.cpp
  pages/identify_output.cpp pages/identify_report.cpp pages/judgement_tables.cpp
  pages/sweep/sweep_charts.cpp pages/sweep/sweep_pictures.cpp pages/sweep/sweep_report.cpp
  pages/plan_output.cpp tour/experiments_report.cpp)
compile_together(halyard_app tour
  pages/diagnosis/diagnosis_output.cpp tour/experiments_output.cpp tour/tour.cpp tour/tour_report.cpp
  tour/tour_rigs.cpp)

# The tests, which tests/CMakeLists.txt lists by their folders: those of a component in groups of so
# many files, 0 for all.
foreach(group transmission:6 model:0 plant:2 estimators:8 plugins:0 diagnosis:14 evaluation:0 app:0 bench:9)
  string(REPLACE ":" ";" group ${group})
  list(POP_FRONT group component files)
  if(HALYARD_UNITY_BUILD AND TARGET ${component}_tests)
    set_target_properties(${component}_tests PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${files})
  endif()
endforeach()
