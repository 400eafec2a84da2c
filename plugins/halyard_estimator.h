#ifndef HALYARD_PLUGINS_HALYARD_ESTIMATOR_H_
#define HALYARD_PLUGINS_HALYARD_ESTIMATOR_H_
/*
 * The contract between halyard and an estimator in a shared module: one exported function that returns one table.
 * Plain C: only integers, text and double* cross the boundary. Authors in C++ include plugins/estimator_plugin.hpp,
 * which fills the table from a class.
 *
 *   n   number of joints of the model
 *   m   number of motors whose position was measured at an instant, 0..n
 *
 * Memory belongs to the caller; a pointer is valid during the call only. Vectors [n] start with the joint at the base.
 * SI units; joint quantities are in rad, N m at a revolute joint and in m, N at a prismatic joint.
 *
 * The host makes one call of an instance at a time. It calls reset() before update(), estimate() and revise(). Several
 * instances may be in use at once, each on its own thread. A function must not let an exception out, end the process,
 * or change the floating-point mode.
 */

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Increases when anything below changes its meaning or place. */
#define HALYARD_ESTIMATOR_INTERFACE 2

/* Results of a call. Every result but HALYARD_OK comes with a message. */
#define HALYARD_OK 0
#define HALYARD_REFUSED 1 /* a user's error: a model, an option or a record that the estimator cannot work with */
#define HALYARD_FAILED 2  /* any other failure, such as a state that is no longer finite */

/* Arguments of create(). */
typedef struct halyard_config {
  const char* model_xml;            /* the model file's text: the arm with its effects */
  const char* model_source;         /* its path, for messages */
  size_t n_joints;                  /* n */
  size_t n_options;                 /* number of options; refuse a name that you do not know */
  const char* const* option_names;  /* [n_options] */
  const char* const* option_values; /* [n_options] */
} halyard_config;

/* One row of a log. A joint without a drive has no motor. Its motor_torque is NaN and its motor_position is 0; if the
 * log has these columns, they hold the log's values instead. Do not use these entries, and give no innovation for such
 * a joint. */
typedef struct halyard_sample {
  double time_s;                /* increases from call to call */
  const double* motor_torque;   /* [n] commanded from this time on, N m; NaN: missing, hold the last one */
  const double* motor_position; /* [n] measured at this time, rad; NaN: missing, do not correct with it */
  /* [n] measured external load; NULL: none. Never NaN: a missing cell repeats the last value. It is 0 before the first
   * value and at a joint without such a sensor. */
  const double* joint_torque;
  const double* marker; /* [3] position of the marker at the tool, from a camera, m, base frame; NULL: not seen */
} halyard_sample;

/* Innovation of one measurement. An estimator that does not know cov(nu) sets m = 0. */
typedef struct halyard_innovation {
  size_t m;   /* number of entries of nu */
  double* nu; /* room for [n]: measured minus predicted position of the measured motors, base first, rad */
  /* Room for [n x n]; holds a lower triangular [m x m] matrix, row by row without gaps: S_root S_root' = cov(nu). */
  double* S_root;
  int32_t accepted; /* 0: gated out, belief unchanged; 1 on entry */
} halyard_innovation;

/* Estimated state of the joints. */
typedef struct halyard_estimate {
  double* joint_position;     /* [n] */
  double* joint_velocity;     /* [n] */
  double* joint_position_std; /* [n] one standard deviation; 0 where the estimator has none */
  /* [names x n] row by row, one row per extra_output_name(). NaN on entry; leave NaN where a joint has no value. */
  double* extra_outputs;
} halyard_estimate;

/* Counts since reset(). */
typedef struct halyard_report {
  int64_t steps;            /* samples processed by update() */
  int64_t repaired_factors; /* factorisations that failed and were repaired */
  int64_t gated;            /* measurements that were not accepted */
} halyard_report;

/* The table. All entries but the last two are required. message: message_size bytes for one line and its zero byte. */
typedef struct halyard_estimator_table {
  uint32_t interface_version; /* HALYARD_ESTIMATOR_INTERFACE of the headers that the module was built with */
  uint32_t table_size;        /* sizeof(halyard_estimator_table) */
  const char* name;           /* name for users: at most 64 letters, digits, '_', '-' */
  const char* description;    /* one line */

  /* Makes an instance. */
  int (*create)(const halyard_config* config, void** instance, char* message, size_t message_size);
  void (*destroy)(void* instance);
  /* Starts or restarts at a first sample, with the arm at rest. */
  int (*reset)(void* instance, const halyard_sample* first, char* message, size_t message_size);
  /* Predicts to the sample's time with the previous sample's torque, then corrects with this sample's positions. */
  int (*update)(void* instance, const halyard_sample* sample, halyard_innovation* innovation, char* message,
                size_t message_size);
  /* The estimate at the last sample's time. */
  int (*estimate)(void* instance, halyard_estimate* estimate, char* message, size_t message_size);
  int (*report)(void* instance, halyard_report* report, char* message, size_t message_size);

  /* Name of extra output i of every joint, used as a column name: letters, digits, '_', '-'. Returns NULL beyond the
   * last name. The names of an instance do not change. If the table's entry is NULL, there are no extra outputs. */
  const char* (*extra_output_name)(void* instance, size_t i);
  /* Gives a revised estimate of a sample that came since reset(): sets time_s to the time of that sample and fills
   * `estimate`. time_s is NaN on entry; leave it NaN if there is no further revision. After reset() and after each
   * update(), the host calls revise() repeatedly until it gives no further revision. at_end is 1 after the last sample.
   * A revision replaces all earlier estimates of that sample, so it must fill `estimate` as estimate() does,
   * `extra_outputs` included. If the table's entry is NULL, estimates are never revised. */
  int (*revise)(void* instance, int32_t at_end, double* time_s, halyard_estimate* estimate, char* message,
                size_t message_size);
} halyard_estimator_table;

#if defined(__GNUC__)
#define HALYARD_EXPORT __attribute__((visibility("default")))
#else
#define HALYARD_EXPORT
#endif

/* The function that a module exports. The table keeps its address while the module is loaded. */
HALYARD_EXPORT const halyard_estimator_table* halyard_estimator(void);

#ifdef __cplusplus
}
#endif

#endif
