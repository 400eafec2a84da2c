#include "plant/sensors/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace halyard {

void add_camera(const Camera& camera, const double* point, const Log& truth, std::uint64_t seed, ArmPlant& plant,
                Log& measured) {
  constexpr std::uint64_t kStream = 0x63616d657261;  // numbers of its own: other noise stays as it is without a camera
  std::mt19937_64 random(seed ^ kStream);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> share(0, 1);
  const std::vector<double>& time = truth.time;
  measured.marker.assign(3, std::vector<double>(time.size(), std::numeric_limits<double>::quiet_NaN()));
  Eigen::VectorXd q(truth.n_joints);
  double next = 0;  // frame
  for (std::size_t i = 0; i < time.size(); ++i) {
    constexpr double kRounding = 1e-9;  // s
    if (time[i] < next / camera.rate_hz - kRounding) continue;
    next = std::floor((time[i] + kRounding) * camera.rate_hz) + 1;
    const double lost = share(random);
    Eigen::Vector3d error;
    for (double& e : error) e = normal(random);
    const double exposed = time[i] - camera.latency_s;
    if (exposed < time[0] - kRounding || lost < camera.dropout) continue;

    const auto after = std::upper_bound(time.begin(), time.begin() + static_cast<std::ptrdiff_t>(i) + 1, exposed);
    const std::size_t b = std::min<std::size_t>(std::max<std::ptrdiff_t>(after - time.begin(), 1), time.size() - 1);
    const double part = std::clamp((exposed - time[b - 1]) / (time[b] - time[b - 1]), 0.0, 1.0);
    for (int k = 0; k < truth.n_joints; ++k)
      q(k) = (1 - part) * truth.joint_position[k][b - 1] + part * truth.joint_position[k][b];
    const Eigen::Vector3d seen = plant.position_of(point, q) + camera.noise_m * error;
    for (int axis = 0; axis < 3; ++axis) measured.marker[axis][i] = seen(axis);
  }
}

}  // namespace halyard
