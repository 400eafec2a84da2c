#include "diagnosis/judgement/paired_t.h"

#include <cmath>

#include "model/statistics/distributions.h"

namespace halyard {

Paired paired(const std::vector<double>& differences) {
  const double n = static_cast<double>(differences.size());
  double sum = 0, square = 0;
  for (const double d : differences) sum += d;
  for (const double d : differences) square += std::pow(d - sum / n, 2);
  const double error = n > 1 ? std::sqrt(square / (n * (n - 1))) : 0;
  return {sum, error > 0 ? sum / n / error : 0, static_cast<int>(differences.size())};
}

double p_value(const Paired& p) {
  if (p.pairs < 3) return 1;
  return t_upper_tail(p.pairs - 1, p.t);
}

}  // namespace halyard
