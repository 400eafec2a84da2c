// A table written by hand, without the adapter that catches.
#include "behaving.h"

namespace {

int throwing_update(void*, const halyard_sample* sample, halyard_innovation*, char*, size_t) {
  if (sample->time_s > 2) return HALYARD_FAILED;  // without a message
  if (sample->time_s > 1) throw 1;                // no std::exception
  throw std::runtime_error("nobody caught this");
}

}  // namespace

extern "C" const halyard_estimator_table* halyard_estimator() {
  static const auto table = [] {
    auto t = halyard::estimator_table<Behaving>("lets_exceptions_out", "throws across the boundary");
    t.update = throwing_update;
    return t;
  }();
  return &table;
}
