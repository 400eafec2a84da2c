#include "diagnosis/explanation/residual_signals.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/record/common_clock.h"
#include "model/rigid_chain.h"
#include "transmission/coupling.h"
#include "transmission/transmission.h"

namespace halyard {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kStep = 0.01;  ///< s; residuals are band-limited to 20 Hz

/// Position, rate and acceleration of all joints at one instant. [n]
struct Motion {
  Eigen::VectorXd q, v, a;
};

class JointObserver {
 public:
  JointObserver(const Record& record, const FullPrediction& prediction, const Hypothesis& h, int joint)
      : record_(record),
        prediction_(prediction),
        transmission_(h.nominal, on_own_clock(record, h).effects),
        arm_(transmission_.arm()),
        n_(arm_.n),
        k_(joint),
        z_(transmission_.n_states(), 0.0),
        z_dot_(z_) {
    // Kinematics without stretch are linear.
    from_motors_.resize(n_, n_);
    from_undriven_.resize(n_, n_);
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(n_);
    for (int j = 0; j < n_; ++j) {
      from_motors_.col(j) = unstretched_joints(arm_, Eigen::VectorXd::Unit(n_, j), none);
      from_undriven_.col(j) = unstretched_joints(arm_, none, Eigen::VectorXd::Unit(n_, j));
    }
    Eigen::MatrixXd paths = path_matrix(arm_);
    for (int j = 0; j < n_; ++j)
      if (arm_.joint[j].drive == Drive::none) paths.row(j) = Eigen::RowVectorXd::Unit(n_, j);
    load_of_force_ = paths.transpose().inverse();
    all_cables_seen_ = arm_.joint[k_].drive == Drive::cable;
    for (int j = 0; j < n_; ++j)
      all_cables_seen_ = all_cables_seen_ && arm_.joint[j].drive != Drive::rigid && record_.has_joint(j);
  }

  /// Appends every stride-th sample of the record.
  void observe(int stride, ResidualSignals& out);

 private:
  /// The sensors' errors at sample i: reading less truth.
  void sensor_errors(std::size_t i, JointSignals<double>* s) const {
    for (int j = 0; j < n_; ++j) {
      s[j].motor_angle = record_.motor_angle[j][i];
      s[j].motor_rate = record_.motor_rate[j][i];
      s[j].joint_position = record_.has_joint(j) ? record_.joint[j][i] : 0.0;
    }
    transmission_.sensor_errors(record_.time(i), z_.data(), s);
  }

  Motion unstretched(std::size_t i, const JointSignals<double>* s) const {
    Eigen::VectorXd angle(n_), rate(n_), acceleration(n_), undriven(n_);
    for (int j = 0; j < n_; ++j) {
      angle(j) = record_.motor_angle[j][i] - s[j].motor_error;
      rate(j) = record_.motor_rate[j][i];
      acceleration(j) = record_.motor_acceleration[j][i];
      // A joint without a motor moves as the record says in place of a motor.
      undriven(j) = record_.motor_angle[j][i] - arm_.joint[j].joint_encoder_offset;
    }
    return {from_motors_ * angle + from_undriven_ * undriven, from_motors_ * rate + from_undriven_ * rate,
            from_motors_ * acceleration + from_undriven_ * acceleration};
  }

  Motion measured(std::size_t i, const JointSignals<double>* s) const {
    Motion m{Eigen::VectorXd(n_), Eigen::VectorXd(n_), Eigen::VectorXd(n_)};
    const std::size_t reach = std::max<std::size_t>(1, std::lround(kStep / record_.dt));
    const std::size_t before = i - std::min(i, reach), after = std::min(i + reach, record_.size - 1);
    const double h = 0.5 * record_.dt * static_cast<double>(after - before);
    const bool is_centred = after - i == i - before;  // not at the ends of a record
    for (int j = 0; j < n_; ++j) {
      const std::vector<double>& q = record_.joint[j];
      m.q(j) = q[i] - s[j].joint_error;
      m.v(j) = (q[after] - q[before]) / (2 * h);
      m.a(j) = is_centred ? (q[after] - 2 * q[i] + q[before]) / (h * h) : kNone;
    }
    return m;
  }

  Eigen::VectorXd needed_force(const Motion& m) const {
    Eigen::VectorXd force(n_);
    inverse_dynamics(arm_, chain_pose(arm_, m.q.data()), m.v.data(), m.a.data(), force.data());
    return force;
  }

  /// Takes the effects' states over one sample, and tells the force on joint k by the measured motion.
  double force_on_joint(std::size_t i, const Motion& m, JointSignals<double>* s) {
    for (int j = 0; j < n_; ++j) {
      s[j].command = record_.has_torque(j) ? record_.torque[j][i] : 0.0;
      s[j].motor_angle = record_.motor_angle[j][i] - s[j].motor_error;
      s[j].joint_position = m.q(j);
      s[j].joint_rate = m.v(j);
      s[j].external_force = record_.external[j].empty() ? 0.0 : record_.external[j][i];
    }
    transmission_.evaluate(record_.time(i), nullptr, z_.data(), s, z_dot_.data());
    for (std::size_t e = 0; e < z_.size(); ++e) z_[e] += record_.dt * z_dot_[e];
    return s[k_].joint_force;
  }

  const Record& record_;
  const FullPrediction& prediction_;
  const Transmission<double> transmission_;
  const ArmParameters<double>& arm_;
  const int n_, k_;
  std::vector<double> z_, z_dot_;  ///< states of the effects along the measured motion
  Eigen::MatrixXd from_motors_, from_undriven_, load_of_force_;
  bool all_cables_seen_ = false;
};

/// The direction of the last motion faster than `least`; of the first one before that.
class Direction {
 public:
  Direction(const std::vector<double>& rate, double least) : least_(least) {
    for (const double r : rate)
      if (std::abs(r) > least_) {
        last_ = r > 0 ? 1 : -1;
        break;
      }
  }
  double at(double rate) {
    if (std::abs(rate) > least_) last_ = rate > 0 ? 1 : -1;
    return last_;
  }

 private:
  double least_;
  double last_ = 1;
};

/// Directions along a stretch of a signal that begins at `first`; slower than a fiftieth of its usual rate is no
/// motion.
void append_directions(const std::vector<double>& rate, std::size_t first, double smoothing, std::vector<double>& out) {
  const std::vector<double> own(rate.begin() + static_cast<std::ptrdiff_t>(first), rate.end());
  double square = 0;
  for (const double r : own) square += r * r;
  Direction direction(own, std::max(smoothing, 0.02 * std::sqrt(square / static_cast<double>(own.size()))));
  for (const double r : own) out.push_back(direction.at(r));
}

void JointObserver::observe(int stride, ResidualSignals& out) {
  const JointParameters<double>& joint = arm_.joint[k_];
  const bool driven = joint.drive != Drive::none;
  // The path to this joint passes joints whose prediction has to be there.
  bool stretch_known = joint.drive == Drive::cable;
  for (int j = 0; j < n_; ++j)
    if (joint.coupling[j] != 0 && prediction_.joint_reading[j].empty()) stretch_known = false;

  for (std::size_t i = 0; i < record_.size; ++i) {
    const bool told = i % static_cast<std::size_t>(stride) == 0;
    if (!told && !all_cables_seen_) continue;
    JointSignals<double> s[kMaxJoints];
    sensor_errors(i, s);
    const bool joint_valid = record_.has_joint(k_) && record_.joint_valid[k_][i] > 0;
    double joint_torque = kNone;
    if (all_cables_seen_) {
      const Motion m = measured(i, s);
      const double force = force_on_joint(i, m, s);
      if (told && joint_valid) joint_torque = force - needed_force(m)(k_);
    }
    if (!told) continue;
    const Motion implied = unstretched(i, s);
    const auto residual = [&](ResidualKind kind) -> std::vector<double>& {
      return out.residual[static_cast<std::size_t>(kind)];
    };
    if (record_.has_joint(k_)) {
      const double reading = joint_valid ? record_.joint[k_][i] : kNone;
      residual(ResidualKind::joint_position).push_back(reading - prediction_.joint_reading[k_][i]);
      if (driven) residual(ResidualKind::transmission).push_back(implied.q(k_) - (reading - s[k_].joint_error));
    }
    if (all_cables_seen_)
      residual(ResidualKind::joint_torque).push_back(std::isfinite(joint_torque) ? joint_torque : kNone);
    if (record_.has_torque(k_)) {
      // At standstill friction takes any value that balance asks for.
      const bool counts =
          record_.torque_valid[k_][i] > 0 && std::abs(record_.motor_rate[k_][i]) >= 2 * joint.motor_smoothing;
      residual(ResidualKind::motor_torque).push_back(counts ? prediction_.torque_residual[k_][i] : kNone);
    }

    out.time.push_back(record_.time(i) + record_.clock_shift);
    out.joint_position.push_back(implied.q(k_));
    out.joint_rate.push_back(implied.v(k_));
    out.motor_rate.push_back(record_.motor_rate[k_][i]);
    out.motor_angle.push_back(record_.motor_angle[k_][i]);
    out.capstan_angle.push_back(record_.motor_angle[k_][i] / joint.gear_ratio);
    Eigen::VectorXd force = needed_force(implied);
    for (int j = 0; j < n_; ++j)
      if (!record_.external[j].empty()) force(j) -= record_.external[j][i];
    out.load.push_back((load_of_force_ * force)(k_));
    if (stretch_known) {
      double x = joint.motor_travel() * (record_.motor_angle[k_][i] - s[k_].motor_error);
      for (int j = 0; j < n_; ++j)
        if (joint.coupling[j] != 0)
          x -= path_per_joint(joint, j) * (prediction_.joint_reading[j][i] - s[j].joint_error);
      out.stretch.push_back(x);
    }
  }
}

}  // namespace

ResidualSignals residual_signals(const std::vector<Record>& records, const std::vector<FullPrediction>& predictions,
                                 const Hypothesis& hypothesis, int joint) {
  ResidualSignals out;
  for (std::size_t r = 0; r < records.size(); ++r) {
    const int stride = std::max(1, static_cast<int>(std::lround(kStep / records[r].dt)));
    out.dt = std::max(out.dt, records[r].dt * stride);
    const std::size_t first = out.time.size();
    JointObserver(records[r], predictions[r], hypothesis, joint).observe(stride, out);
    const JointParameters<double>& j = hypothesis.nominal.joint[joint];
    append_directions(out.joint_rate, first, j.joint_smoothing, out.joint_direction);
    append_directions(out.motor_rate, first, j.motor_smoothing, out.motor_direction);
  }
  // A signal that some records lack is not known.
  for (std::vector<double>* s : {&out.residual[0], &out.residual[1], &out.residual[2], &out.residual[3], &out.stretch})
    if (s->size() != out.time.size()) s->clear();
  return out;
}

}  // namespace halyard
