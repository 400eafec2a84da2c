# Groups of files that are compiled as one, so that their common headers are read, and their common templates
# instantiated, once: a cold build takes less than half the time, and a changed file is compiled with two to eight
# others. The names in the unnamed namespaces of a group have to differ. A file that is not listed here is compiled alone.
option(HALYARD_UNITY_BUILD "Compile groups of files as one: a cold build is shorter" ON)

# compile_together(TARGET GROUP file...)
function(compile_together target group)
  if(NOT HALYARD_UNITY_BUILD OR NOT TARGET ${target})
    return()
  endif()
  get_target_property(folder ${target} SOURCE_DIR)
  list(TRANSFORM ARGN PREPEND ${folder}/ OUTPUT_VARIABLE files)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  set_source_files_properties(${files} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${group})
endfunction()

compile_together(halyard_transmission core arm_parameters.cpp command_history.cpp effect.cpp effects/library.cpp)
foreach(place cable joint motor sensor)
  file(GLOB effects RELATIVE ${PROJECT_SOURCE_DIR}/transmission CONFIGURE_DEPENDS
    ${PROJECT_SOURCE_DIR}/transmission/effects/${place}/*.cpp)
  compile_together(halyard_transmission ${place}_effects ${effects})
endforeach()

compile_together(halyard_model logs
  arm_log.cpp arm_model.cpp column_map.cpp homing.cpp log.cpp model_writer.cpp output_file.cpp)
compile_together(halyard_model files model_file.cpp xml/xml_reader.cpp)

compile_together(halyard_plant simulation
  controller.cpp drive_train.cpp equilibrium.cpp sensors/camera.cpp sensors/encoder.cpp simulate.cpp trajectory.cpp)

compile_together(halyard_estimators gaussian
  filters/ekf.cpp filters/fixed_lag_smoother.cpp filters/gaussian_filter.cpp filters/sr_ukf.cpp)
compile_together(halyard_estimators arm
  built_in.cpp estimator.cpp estimator_options.cpp
  filters/arm_filter.cpp filters/camera_filter.cpp filters/kinematics.cpp filters/unknown_constant.cpp)
compile_together(halyard_estimators identification
  identification/arm_family.cpp identification/block_jackknife.cpp identification/dual_ukf.cpp
  identification/identified_keys.cpp identification/identify.cpp)
compile_together(halyard_estimators process
  process/noise.cpp process/process_model.cpp process/standstill.cpp process/static_equilibrium.cpp)

compile_together(halyard_plugins estimators
  host/eigen_alignment.cpp host/estimator_module.cpp host/plugin_estimator.cpp host/shared_module.cpp)
compile_together(halyard_plugins checks host/conformance.cpp host/effect_module.cpp)

compile_together(halyard_diagnosis records
  prediction/calibrate.cpp prediction/chebyshev.cpp prediction/filtered_effect.cpp record/record.cpp)
compile_together(halyard_diagnosis fit
  fit/baseline_reach.cpp fit/block_variance.cpp fit/evidence.cpp fit/fit.cpp fit/nudged.cpp noise/channel_noise.cpp)
compile_together(halyard_diagnosis judgement
  judgement/false_discovery.cpp judgement/final_fit.cpp judgement/holdout.cpp judgement/judge.cpp
  judgement/likelihood.cpp judgement/name_probability.cpp judgement/paired_t.cpp)
compile_together(halyard_diagnosis search
  search/attribution.cpp search/candidate_round.cpp search/leaps.cpp search/naming.cpp search/refit.cpp
  search/screen.cpp search/starts.cpp)
compile_together(halyard_diagnosis search_space
  search_space/cable.cpp search_space/joint.cpp search_space/motor.cpp search_space/search_space.cpp
  search_space/sensor.cpp)
compile_together(halyard_diagnosis explanation
  explanation/curve_fit.cpp explanation/residual_signals.cpp explanation/signature.cpp explanation/spectrum.cpp
  explanation/view_sentence.cpp explanation/views.cpp)

compile_together(halyard_evaluation comparison
  comparison/compare.cpp estimator_list.cpp judgement/error_statistics.cpp judgement/serial_statistics.cpp
  run/sensor_readings.cpp)
compile_together(halyard_evaluation studies
  judgement/consistency.cpp studies/diagnosis_evaluation.cpp studies/effect_study.cpp studies/holdout_errors.cpp
  studies/motion_proposal.cpp)
compile_together(halyard_evaluation runs
  comparison/monte_carlo.cpp experiments/raven_experiments.cpp json.cpp run/contained_run.cpp
  studies/identification_study.cpp)
compile_together(halyard_evaluation sweep
  sweep/sweep_file.cpp sweep/sweep_grid.cpp sweep/sweep_merge.cpp sweep/sweep_parameter.cpp sweep/sweep_run.cpp
  sweep/sweep_store.cpp sweep/sweep_table.cpp)
compile_together(halyard_running run csv.cpp run/estimate.cpp worker/worker_task.cpp)

compile_together(halyard_report report chart.cpp chart_json.cpp page.cpp)
compile_together(halyard_app studies
  commands/check_command.cpp commands/compare_command.cpp commands/plan_command.cpp commands/plugins_command.cpp
  commands/simulate_command.cpp)
compile_together(halyard_app runs
  commands/estimate_command.cpp commands/identify_command.cpp commands/sweep_command.cpp output_check.cpp)
compile_together(halyard_app diagnosis commands/diagnose_command.cpp log_input.cpp main.cpp progress.cpp)
compile_together(halyard_app comparison_pages
  pages/comparison_figures.cpp pages/comparison_output.cpp pages/judgement_tables.cpp pages/sweep_report.cpp)
compile_together(halyard_app diagnosis_pages
  pages/diagnosis_output.cpp pages/diagnosis_report.cpp pages/view_charts.cpp)
compile_together(halyard_app identify_pages
  pages/estimator_table.cpp pages/identify_output.cpp pages/identify_report.cpp pages/plan_output.cpp)
compile_together(halyard_app experiments
  tour/experiments_command.cpp tour/experiments_report.cpp tour/tour_rigs.cpp)
compile_together(halyard_app tour
  tour/experiments_output.cpp tour/tour.cpp tour/tour_command.cpp tour/tour_report.cpp)

# The tests, which tests/CMakeLists.txt lists by their folders.
compile_together(transmission_tests acting
  transmission/effects_cable_test.cpp transmission/effects_friction_test.cpp transmission/effects_load_test.cpp
  transmission/effects_motor_test.cpp transmission/effects_sensor_test.cpp)
compile_together(model_tests files
  model/model_file_errors_test.cpp model/model_file_test.cpp model/raven_model_test.cpp
  model/xml_reader_test.cpp)
compile_together(plant_tests plant plant/integrators_test.cpp plant/plant_test.cpp)
compile_together(estimators_tests readings
  estimators/camera_filter_test.cpp estimators/noise_test.cpp estimators/sr_ukf_test.cpp)
compile_together(estimators_tests models
  estimators/ekf_test.cpp estimators/identify_test.cpp estimators/process_model_test.cpp)
compile_together(estimators_tests smoothing
  estimators/disturbance_filter_test.cpp estimators/fixed_lag_smoother_test.cpp estimators/rigid_chain_test.cpp)
compile_together(diagnosis_tests diagnosis diagnosis/diagnosis_test.cpp diagnosis/views_test.cpp)
compile_together(diagnosis_tests evidence
  diagnosis/false_discovery_test.cpp diagnosis/judge_test.cpp diagnosis/leaps_test.cpp diagnosis/record_test.cpp)
compile_together(diagnosis_tests logs diagnosis/odd_logs_test.cpp diagnosis/unknown_past_test.cpp)
compile_together(evaluation_tests tables
  evaluation/csv_test.cpp evaluation/judgement_test.cpp evaluation/sweep_merge_test.cpp)
compile_together(app_tests input app/app_test.cpp app/bad_input_test.cpp app/report_test.cpp)
compile_together(app_tests studies
  app/compare_command_test.cpp app/estimate_command_test.cpp app/sweep_command_test.cpp)
compile_together(app_tests diagnosis
  app/diagnose_command_test.cpp app/experiments_command_test.cpp app/identify_command_test.cpp app/tour_test.cpp)
