// A table written by hand, without the adapter that catches.
#include "behaving.h"

extern "C" const halyard_estimator_table* halyard_estimator() {
  static const auto table = [] {
    auto t = halyard::estimator_table<Behaving>("throws_its_names", "throws across the boundary");
    t.extra_output_name = [](void*, size_t) -> const char* { throw std::runtime_error("no names today"); };
    return t;
  }();
  return &table;
}
