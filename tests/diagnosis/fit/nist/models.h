#pragma once
/// The equations of NIST's nonlinear problems: y(b, x, x_2), for numbers and for numbers with derivatives.

#include <ceres/jet.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>

namespace halyard {

/// Each problem has at most nine parameters.
using NistJet = ceres::Jet<double, 9>;

class NistModel {
 public:
  template <class F>
  NistModel(F f) : number_(f), jet_(f) {}  // NOLINT(google-explicit-constructor): a table of lambdas
  double operator()(const double* b, double x, double x_2) const { return number_(b, x, x_2); }
  NistJet operator()(const NistJet* b, double x, double x_2) const { return jet_(b, x, x_2); }

 private:
  double (*number_)(const double* b, double x, double x_2);
  NistJet (*jet_)(const NistJet* b, double x, double x_2);
};

#define HALYARD_NIST_MODEL(expression) \
  [](const auto* b, [[maybe_unused]] double x, [[maybe_unused]] double x_2) { return expression; }

/// Model of each problem by its name. Nelson's observation is log y.
inline const std::map<std::string, NistModel>& nist_models() {
  using std::atan, std::cos, std::exp, std::pow, std::sin, std::sqrt;
  static constexpr double pi = std::numbers::pi;
  static const NistModel exponential_rise = HALYARD_NIST_MODEL(b[0] * (1.0 - exp(-b[1] * x))),
                         chwirut = HALYARD_NIST_MODEL(exp(-b[0] * x) / (b[1] + b[2] * x)),
                         lanczos =
                             HALYARD_NIST_MODEL(b[0] * exp(-b[1] * x) + b[2] * exp(-b[3] * x) + b[4] * exp(-b[5] * x)),
                         gauss = HALYARD_NIST_MODEL(b[0] * exp(-b[1] * x) +
                                                    b[2] * exp(-(x - b[3]) * (x - b[3]) / (b[4] * b[4])) +
                                                    b[5] * exp(-(x - b[6]) * (x - b[6]) / (b[7] * b[7]))),
                         cubic_by_cubic = HALYARD_NIST_MODEL((b[0] + x * (b[1] + x * (b[2] + x * b[3]))) /
                                                             (1.0 + x * (b[4] + x * (b[5] + x * b[6]))));
  static const std::map<std::string, NistModel> all = {
      {"Misra1a", exponential_rise},
      {"Misra1b", HALYARD_NIST_MODEL(b[0] * (1.0 - 1.0 / ((1.0 + b[1] * x / 2.0) * (1.0 + b[1] * x / 2.0))))},
      {"Misra1c", HALYARD_NIST_MODEL(b[0] * (1.0 - 1.0 / sqrt(1.0 + 2.0 * b[1] * x)))},
      {"Misra1d", HALYARD_NIST_MODEL(b[0] * b[1] * x / (1.0 + b[1] * x))},
      {"Chwirut1", chwirut},
      {"Chwirut2", chwirut},
      {"Lanczos1", lanczos},
      {"Lanczos2", lanczos},
      {"Lanczos3", lanczos},
      {"Gauss1", gauss},
      {"Gauss2", gauss},
      {"Gauss3", gauss},
      {"DanWood", HALYARD_NIST_MODEL(b[0] * pow(x, b[1]))},
      {"Kirby2", HALYARD_NIST_MODEL((b[0] + x * (b[1] + x * b[2])) / (1.0 + x * (b[3] + x * b[4])))},
      {"Hahn1", cubic_by_cubic},
      {"Nelson", HALYARD_NIST_MODEL(b[0] - b[1] * x * exp(-b[2] * x_2))},
      {"MGH17", HALYARD_NIST_MODEL(b[0] + b[1] * exp(-x * b[3]) + b[2] * exp(-x * b[4]))},
      {"Roszman1", HALYARD_NIST_MODEL(b[0] - b[1] * x - atan(b[2] / (x - b[3])) / pi)},
      {"ENSO", HALYARD_NIST_MODEL(b[0] + b[1] * cos(pi * x / 6) + b[2] * sin(pi * x / 6) +
                                  b[4] * cos(2 * pi * x / b[3]) + b[5] * sin(2 * pi * x / b[3]) +
                                  b[7] * cos(2 * pi * x / b[6]) + b[8] * sin(2 * pi * x / b[6]))},
      {"MGH09", HALYARD_NIST_MODEL(b[0] * x * (x + b[1]) / (x * (x + b[2]) + b[3]))},
      {"Thurber", cubic_by_cubic},
      {"BoxBOD", exponential_rise},
      {"Rat42", HALYARD_NIST_MODEL(b[0] / (1.0 + exp(b[1] - b[2] * x)))},
      {"MGH10", HALYARD_NIST_MODEL(b[0] * exp(b[1] / (x + b[2])))},
      {"Eckerle4", HALYARD_NIST_MODEL(b[0] / b[1] * exp(-0.5 * (x - b[2]) * (x - b[2]) / (b[1] * b[1])))},
      {"Rat43", HALYARD_NIST_MODEL(b[0] / pow(1.0 + exp(b[1] - b[2] * x), 1.0 / b[3]))},
      {"Bennett5", HALYARD_NIST_MODEL(b[0] * pow(b[1] + x, -1.0 / b[2]))},
  };
  return all;
}

#undef HALYARD_NIST_MODEL

}  // namespace halyard
