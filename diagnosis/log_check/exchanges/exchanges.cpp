#include "diagnosis/log_check/exchanges/exchanges.h"

#include "model/homing.h"
#include "model/name_list.h"

namespace halyard {
namespace {

/// "exchanged with motor_position_2", "exchanged in a circle with motor_position_2, motor_position_3"
std::string described(const ColumnCircle& circle) {
  std::vector<std::string> others;
  for (std::size_t i = 1; i < circle.size(); ++i) others.push_back(circle[i].name());
  return (circle.size() > 2 ? "exchanged in a circle with " : "exchanged with ") + listed(others);
}

}  // namespace

std::vector<ColumnCircle> circles_of(Signals Log::*signal, const std::vector<int>& joints, const std::vector<int>& p) {
  std::vector<ColumnCircle> circles;
  std::vector<bool> seen(p.size(), false);
  for (std::size_t first = 0; first < p.size(); ++first) {
    ColumnCircle circle;
    for (std::size_t i = first; !seen[i]; i = p[i]) seen[i] = true, circle.push_back({signal, joints[i]});
    if (circle.size() > 1) circles.push_back(circle);
  }
  return circles;
}

LogUnderCheck after_exchange(LogUnderCheck c, const std::vector<ColumnCircle>& circles) {
  for (const ColumnCircle& circle : circles) c.exchange(circle);
  home_encoders(c.log, c.model);
  return c;
}

void reject_exchange(LogUnderCheck& c, const ColumnCircle& circle, const std::string& seen,
                     const std::string& or_else) {
  c.reject(circle[0].name(), "seems to be " + described(circle) + ": " + seen,
           "exchange them with " + c.exchange_options(circle) + or_else);
  c.exchange(circle);
  home_encoders(c.log, c.model);
}

}  // namespace halyard
