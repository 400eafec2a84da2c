#include "diagnosis/noise/delay_free.h"

#include <algorithm>
#include <cmath>

namespace halyard {

std::vector<std::vector<double>> delay_free(std::vector<std::vector<double>> residual,
                                            const std::vector<std::vector<double>>& command_rate, double interval) {
  constexpr double kLag = 0.01;  // s; passes 10 to 80 Hz
  const auto lag = static_cast<std::size_t>(std::max(1.0, std::round(kLag / interval)));
  double product = 0, square = 0;
  for (std::size_t r = 0; r < residual.size(); ++r)
    for (std::size_t i = lag; i < residual[r].size(); ++i) {
      const double e = residual[r][i] - residual[r][i - lag], rate = command_rate[r][i] - command_rate[r][i - lag];
      if (!std::isfinite(e) || !std::isfinite(rate)) continue;
      product += e * rate, square += rate * rate;
    }
  if (!(square > 0)) return residual;
  const double delay = product / square;
  for (std::size_t r = 0; r < residual.size(); ++r)
    for (std::size_t i = 0; i < residual[r].size(); ++i) residual[r][i] -= delay * command_rate[r][i];
  return residual;
}

}  // namespace halyard
