#ifndef HALYARD_PLUGINS_HALYARD_ESTIMATOR_H_
#define HALYARD_PLUGINS_HALYARD_ESTIMATOR_H_
/*
 * The contract between halyard and an estimator in a shared module: one exported function that returns one table.
 * Plain C: what crosses is sizes, text and double*. Authors in C++ include plugins/estimator_plugin.hpp, which fills
 * the table from a class.
 *
 *   n   joints of the model
 *   m   motors whose position was measured at an instant, 0..n
 *
 * Memory belongs to the caller; a pointer is valid during the call only. Vectors [n] count joints from the base.
 * SI units; joint quantities are rad, N m where a joint is revolute and m, N where it is prismatic.
 *
 * An instance gets one call at a time, reset() before any other. Several instances may be in use at once, each on a
 * thread of its own. No function lets an exception out, ends the process, or changes the floating-point mode.
 */

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Counts up when anything below changes its meaning or place. */
#define HALYARD_ESTIMATOR_INTERFACE 2

/* Results of a call. Anything but HALYARD_OK comes with a message. */
#define HALYARD_OK 0
#define HALYARD_REFUSED 1 /* the user's doing: a model, an option or a record that the estimator cannot work with */
#define HALYARD_FAILED 2  /* anything else, such as a state that cannot be kept finite */

/* What an instance is made from. */
typedef struct halyard_config {
  const char* model_xml;            /* the model file's text: the arm with its effects */
  const char* model_source;         /* its path, for messages */
  size_t n_joints;                  /* n */
  size_t n_options;                 /* options given to this estimator; an unknown one is to be refused */
  const char* const* option_names;  /* [n_options] */
  const char* const* option_values; /* [n_options] */
} halyard_config;

/* One row of a log. A joint without drive has no motor: what stands for it, a torque of NaN and a position of 0 unless
 * the log has such columns all the same, is not to be used, and no innovation belongs to it. */
typedef struct halyard_sample {
  double time_s;                /* increases from call to call */
  const double* motor_torque;   /* [n] commanded from this time on, N m; NaN: missing, the last one is held */
  const double* motor_position; /* [n] measured at this time, rad; NaN: missing, no correction from it */
  /* [n] measured external load; NULL: none. Never NaN: where a cell is missing the last one stands, 0 before the first
   * and for a joint without such a sensor. */
  const double* joint_torque;
  const double* marker; /* [3] where a camera saw the marker at the tool, m, base frame; NULL: not seen */
} halyard_sample;

/* What one measurement said that the prediction did not. An estimator that does not know cov(nu) says m = 0. */
typedef struct halyard_innovation {
  size_t m;         /* how many numbers of nu are given */
  double* nu;       /* room for [n]: measured minus predicted of the motors that were measured, from the base on, rad */
  double* S_root;   /* room for [n x n]; [m x m] row by row without gaps: lower, S_root S_root' = cov(nu) */
  int32_t accepted; /* 0: gated out, belief unchanged; 1 on entry */
} halyard_innovation;

/* What is believed of the joints. */
typedef struct halyard_estimate {
  double* joint_position;     /* [n] */
  double* joint_velocity;     /* [n] */
  double* joint_position_std; /* [n] one standard deviation; 0 where the estimator has none */
  /* [names x n] row by row, names as extra_output_name() tells; NaN, as it is on entry: nothing of that joint. */
  double* extra_outputs;
} halyard_estimate;

/* Counts since reset. */
typedef struct halyard_report {
  int64_t steps;            /* samples taken by update() */
  int64_t repaired_factors; /* square-root factors that were lost and rebuilt */
  int64_t gated;            /* measurements not accepted */
} halyard_report;

/* The table. All entries but the last two are needed. message: message_size bytes for a line, ended by a zero byte. */
typedef struct halyard_estimator_table {
  uint32_t interface_version; /* HALYARD_ESTIMATOR_INTERFACE of the headers that the module was built with */
  uint32_t table_size;        /* sizeof(halyard_estimator_table) */
  const char* name;           /* what users call it: letters, digits, '_', '-', at most 64 */
  const char* description;    /* one line */

  /* Makes an instance. */
  int (*create)(const halyard_config* config, void** instance, char* message, size_t message_size);
  void (*destroy)(void* instance);
  /* Starts, or starts anew, at a first sample, at rest. */
  int (*reset)(void* instance, const halyard_sample* first, char* message, size_t message_size);
  /* Predicts to the sample's time under the torque of the sample before, then corrects by its motor positions. */
  int (*update)(void* instance, const halyard_sample* sample, halyard_innovation* innovation, char* message,
                size_t message_size);
  /* At the last sample's time. */
  int (*estimate)(void* instance, halyard_estimate* estimate, char* message, size_t message_size);
  int (*report)(void* instance, halyard_report* report, char* message, size_t message_size);

  /* What else is estimated of every joint, as a column is called: letters, digits, '_', '-'. NULL beyond the last name.
   * The names of an instance do not change. NULL for the entry: nothing else. */
  const char* (*extra_output_name)(void* instance, size_t i);
  /* The next estimate of an earlier sample that later ones have improved: its time, one of those given since reset(),
   * and what is believed of it now; NaN for the time, as it is on entry: there is none. Called after reset() and each
   * update() until there is none; at_end is 1 after the last sample. A revision takes the place of all that was said of
   * that sample: it has to fill `estimate` as estimate() does, `extra_outputs` included. NULL for the entry: estimates
   * are never revised. */
  int (*revise)(void* instance, int32_t at_end, double* time_s, halyard_estimate* estimate, char* message,
                size_t message_size);
} halyard_estimator_table;

#if defined(__GNUC__)
#define HALYARD_EXPORT __attribute__((visibility("default")))
#else
#define HALYARD_EXPORT
#endif

/* What a module exports. The table stays where it is as long as the module is loaded. */
HALYARD_EXPORT const halyard_estimator_table* halyard_estimator(void);

#ifdef __cplusplus
}
#endif

#endif
