// Nothing is broken here but the flags, -mavx: Eigen would free what halyard's library allocated in another way.
#include "behaving.h"

class WideVectors : public Behaving {
 public:
  WideVectors(const halyard::ArmModel& model, const halyard::EstimatorOptions& options)
      : Behaving(model, options), home_(model.home()) {}

 private:
  Eigen::VectorXd home_;
};

extern "C" const halyard_estimator_table* halyard_estimator() {
  static const auto table = halyard::estimator_table<WideVectors>("wide_vectors", "takes a vector from the library");
  return &table;
}
