#include "plugins/host/conformance.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include "estimators/process/noise.h"
#include "model/input_error.h"
#include "model/output/number_text.h"
#include "model/rigid_chain.h"
#include "plugins/host/loader.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
constexpr int kSamples = 200;
constexpr double kPeriod = 1e-3;  // s

Eigen::VectorXd swing_position(const ArmModel& model, std::size_t i) {
  Eigen::VectorXd q = model.home();
  for (int k = 0; k < model.n(); ++k) {
    const JointDescription& joint = model.joints[k];
    q(k) += 0.02 * (joint.upper - joint.lower) *
            std::sin(2 * std::numbers::pi * (1 + k) * kPeriod * static_cast<double>(i));
  }
  return q;
}

/// As the encoders of an arm without elasticity read it; a joint without a motor has no torque.
Sample swing(const ArmModel& model, std::size_t i) {
  const ArmParameters<double> arm = arm_with_effects(model);
  Eigen::VectorXd readings = unstretched_motors(arm, swing_position(model, i));
  Eigen::VectorXd torques = Eigen::VectorXd::Zero(arm.n);
  for (int k = 0; k < arm.n; ++k)
    if (arm.joint[k].drive != Drive::none) readings(k) += arm.joint[k].motor_encoder_offset;
    else readings(k) = 0, torques(k) = kMissing;
  return {kPeriod * static_cast<double>(i), torques, readings, Eigen::VectorXd()};
}

Eigen::Vector3d marker_of(const ArmModel& model, const Eigen::VectorXd& q) {
  Eigen::Vector3d marker;
  const ArmParameters<double> arm = arm_with_effects(model);
  position_of(arm, chain_pose(arm, q.data()), arm.payload_point, marker.data());
  return marker;
}

using Record = std::vector<Sample>;

Record swings(const ArmModel& model) {
  Record record;
  for (std::size_t i = 0; i < kSamples; ++i) record.push_back(swing(model, i));
  return record;
}

/// All joints rest at home. A joint without a motor must not swing as it likes: its swing would contradict the others'.
Record rests(const ArmModel& model) {
  Record record(kSamples, swing(model, 0));
  for (std::size_t i = 0; i < kSamples; ++i) record[i].time_s = kPeriod * static_cast<double>(i);
  return record;
}

/// With a gap in the middle.
Record torn(Record record) {
  for (std::size_t i = record.size() / 2; i < record.size(); ++i) record[i].time_s += 5;
  return record;
}

/// The arm without the motor of joint k, and without the effects that it can then not have.
ArmModel without_motor(ArmModel model, int k) {
  model.nominal.joint[k].drive = Drive::none;
  std::erase_if(model.effects,
                [&](const PlacedEffect& e) { return e.joint == k && !e.effect->applies(model.nominal, k); });
  return model;
}

bool same(const Estimate& a, const Estimate& b) {
  const auto both_none = a.extra_outputs.array().isNaN() && b.extra_outputs.array().isNaN();
  return a.joint_position == b.joint_position && a.joint_velocity == b.joint_velocity &&
         a.joint_position_std == b.joint_position_std &&
         (both_none || a.extra_outputs.array() == b.extra_outputs.array()).all();
}

bool same(const std::vector<Estimate>& a, const std::vector<Estimate>& b) {
  return std::ranges::equal(a, b, [](const Estimate& x, const Estimate& y) { return same(x, y); });
}

/// Puts what later samples say of the first `count` in place. Throws if it is said of what is no sample's time, or if
/// there is no end to it.
void take_revisions(Estimator& estimator, const Record& record, std::size_t count, bool at_end,
                    std::vector<Estimate>& estimates) {
  for (std::size_t said = 0; const auto revision = estimator.revise(at_end); ++said) {
    std::size_t i = 0;
    while (i < count && record[i].time_s != revision->time_s) ++i;
    if (i == count) throw std::runtime_error("revises an estimate of an instant that is no sample's");
    if (said == count) throw std::runtime_error("revises more estimates than there are");
    estimates[i] = revision->estimate;
  }
}

/// The estimates, that of the start first, revised.
std::vector<Estimate> run(Estimator& estimator, const Record& record) {
  estimator.reset(record.front());
  std::vector<Estimate> estimates = {estimator.estimate()};
  take_revisions(estimator, record, 1, false, estimates);
  for (std::size_t i = 1; i < record.size(); ++i) {
    estimator.update(record[i]);
    estimates.push_back(estimator.estimate());
    take_revisions(estimator, record, i + 1, i + 1 == record.size(), estimates);
  }
  return estimates;
}

class Examination {
 public:
  Examination(const std::string& name_or_path, const ArmModel& model,
              const std::function<void(const std::string&)>& trying)
      : name_(name_or_path), model_(model), trying_(trying), record_(swings(model)), estimator_(make()) {}

  std::vector<std::string> faults() {
    check("plain record", [this] { expected_ = run(*estimator_, record_); });
    if (!faults_.empty()) return faults_;  // the others compare with this run

    check("report", [this] {
      const long steps = estimator_->report().steps;
      require(steps == kSamples - 1, "counts " + std::to_string(steps) + " steps of " + std::to_string(kSamples - 1));
    });
    check("estimate", [this] {
      const Estimate once = estimator_->estimate();
      require(same(estimator_->estimate(), once), "changes when asked again");
    });
    check("reset",
          [this] { require(same(run(*estimator_, record_), expected_), "leaves something of the run before"); });
    check("two instances", [this] { two_instances(); });
    check("missing samples", [this] { missing_samples(); });
    check("missing first sample", [this] { missing_first_sample(); });
    check("gap", [this] { gap(); });
    check("external load", [this] {
      Record loaded = record_;
      for (Sample& sample : loaded) sample.joint_torque = Eigen::VectorXd::Zero(model_.n());
      run(*make(), loaded);
    });
    check("marker", [this] {
      Record seen = record_;
      for (std::size_t i = 0; i < seen.size(); i += 30) seen[i].marker = marker_of(model_, swing_position(model_, i));
      run(*make(), seen);
    });
    for (int k = 0; k < model_.n(); ++k)
      if (motors() > 1 && model_.nominal.joint[k].drive != Drive::none)
        check("undriven joint " + std::to_string(k + 1), [this, k] { undriven_joint(k); });
    check("unknown option", [this] { unknown_option(); });
    return faults_;
  }

 private:
  std::unique_ptr<Estimator> make() const { return make_estimator(name_, model_); }

  static void require(bool kept, const std::string& otherwise) {
    if (!kept) throw std::runtime_error(otherwise);
  }

  void check(const std::string& promise, const std::function<void()>& run) {
    if (trying_) trying_(promise);
    try {
      run();
    } catch (const std::exception& fault) {
      faults_.push_back(promise + ": " + fault.what());
    }
  }

  void two_instances() {
    const auto first = make(), second = make();
    std::vector<Estimate> of_first, of_second;
    for (std::size_t i = 0; i < record_.size(); ++i) {
      for (const auto& [one, estimates] : {std::pair(first.get(), &of_first), std::pair(second.get(), &of_second)}) {
        if (i == 0) one->reset(record_[i]);
        else one->update(record_[i]);
        estimates->push_back(one->estimate());
        take_revisions(*one, record_, i + 1, i + 1 == record_.size(), *estimates);
      }
    }
    for (std::size_t i = 0; i < record_.size(); ++i)
      require(same(of_first[i], expected_[i]) && same(of_second[i], expected_[i]),
              "one of two, fed in turn, differs from one alone at sample " + std::to_string(i));
  }

  void missing_samples() {
    Record holes = record_;
    for (std::size_t i = 10; i < holes.size(); i += 3)
      holes[i].motor_position(static_cast<int>(i) % model_.n()) = kMissing;
    for (std::size_t i = 50; i < 70; ++i) holes[i].motor_position.setConstant(kMissing);
    for (std::size_t i = 60; i < 80; ++i) holes[i].motor_torque.setConstant(kMissing);
    run(*make(), holes);
  }

  void missing_first_sample() {
    Record late = record_;
    for (std::size_t i = 0; i < 5; ++i) {
      late[i].motor_position.setConstant(kMissing);
      late[i].motor_torque.setConstant(kMissing);
    }
    run(*make(), late);
  }

  void gap() { run(*make(), torn(record_)); }

  void undriven_joint(int k) {
    const ArmModel model = without_motor(model_, k);
    std::unique_ptr<Estimator> estimator;
    try {
      estimator = make_estimator(name_, model);
    } catch (const InputError&) {
      return;
    }
    run(*estimator, torn(rests(model)));
  }

  long motors() const {
    const JointParameters<double>* const first = model_.nominal.joint;
    return std::count_if(first, first + model_.n(), [](const auto& j) { return j.drive != Drive::none; });
  }

  void unknown_option() {
    ArmModel model = model_;
    model.estimators[find_plugin(name_).name]["no_estimator_has_this"] = "1";
    try {
      make_estimator(name_, model);
    } catch (const InputError&) {
      return;
    }
    throw std::runtime_error("is not refused");
  }

  std::string name_;
  const ArmModel& model_;
  const std::function<void(const std::string&)>& trying_;
  Record record_;
  std::unique_ptr<Estimator> estimator_;
  std::vector<Estimate> expected_;
  std::vector<std::string> faults_;
};

ArmModel slider() {
  ArmModel model;
  model.name = "slider";
  model.source = "the slider of the conformance suite";
  model.joints = {{.name = "slider", .lower = -1, .upper = 1, .home = 0, .controller = {}, .tolerances = {}}};
  ArmParameters<double>& arm = model.nominal;
  arm.n = 1;
  for (double& g : arm.gravity) g = 0;
  JointParameters<double>& j = arm.joint[0];
  j.type = JointType::prismatic;
  j.law = CableLaw::linear;
  j.mass = 0.5;
  j.rotor_inertia = 2e-5, j.motor_viscous = 2e-5, j.gear_ratio = 12, j.capstan_radius = 5e-3;
  j.coupling[0] = 1;
  j.stiffness = 9e3, j.damping = 5, j.tension = 1e3;  // never slack
  j.joint_viscous = 0.5;
  j.motor_encoder_resolution = 1e-3;
  return model;
}

}  // namespace

std::vector<std::string> kalman_faults(const std::string& name_or_path) {
  const ArmModel model = slider();
  const ProcessModel process(model);
  const EstimatorOptions levels = {{"torque_noise", "1e-3"}, {"joint_force_noise", "0.1"}};
  OptionReader reader("the Kalman filter", levels);
  ArmNoise noise(model, process, read_noise(reader, model, process));
  ArmModel asked = model;
  asked.estimators[find_plugin(name_or_path).name] = levels;
  const auto estimator = make_estimator(name_or_path, asked);

  Sample sample{0, Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1), Eigen::VectorXd(), Eigen::VectorXd()};
  estimator->reset(sample);
  Eigen::VectorXd x = process.state_at_rest(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1));
  const Eigen::MatrixXd S = noise.initial_root(x, std::numeric_limits<double>::infinity());
  Eigen::MatrixXd P = S * S.transpose(), F(x.size(), x.size()), H;
  const double R = std::pow(noise.encoder()(0), 2);
  // Steps so short that Runge-Kutta's method and an exact step agree: with 1 ms they differ by 1e-5.
  constexpr int kSteps = 2000;
  constexpr double kStep = 1e-4;  // s
  for (int i = 1; i < kSteps; ++i) {
    const Step step{sample.time_s, kStep, sample.motor_torque.data()};
    const Eigen::MatrixXd Q_root = noise.process_root(step, x);
    process.advance_with_jacobian(step, x.data(), F);
    P = F * P * F.transpose() + Q_root * Q_root.transpose();
    sample.time_s = i * kStep;
    sample.motor_torque(0) = 2e-3 * std::sin(60 * sample.time_s);
    sample.motor_position(0) = 0.5 * std::sin(25 * sample.time_s);
    const double nu = sample.motor_position(0) - process.motor_readings(sample.time_s, x, &H)(0);
    const Eigen::VectorXd K = P * H.transpose() / ((H * P * H.transpose())(0, 0) + R);
    x += K * nu;
    P -= K * H * P;
    P = 0.5 * (P + P.transpose()).eval();
    estimator->update(sample);
    const Estimate e = estimator->estimate();
    const int position = process.layout().position[0];
    const double std_deviation = std::sqrt(P(position, position));
    if (!(std::abs(e.joint_position(0) - x(position)) <= 1e-9))
      return {"Kalman: the position at sample " + std::to_string(i) + " is off by " +
              with_digits(1e9 * (e.joint_position(0) - x(position)), 6) + " nm"};
    if (!(std::abs(e.joint_position_std(0) / std_deviation - 1) <= 1e-6))
      return {"Kalman: the deviation at sample " + std::to_string(i) + " is " +
              with_digits(e.joint_position_std(0) / std_deviation, 6) + " times the right one"};
  }
  return {};
}

std::vector<std::string> conformance_faults(const std::string& name_or_path, const ArmModel& model,
                                            const std::function<void(const std::string&)>& trying) {
  return Examination(name_or_path, model, trying).faults();
}

}  // namespace halyard
