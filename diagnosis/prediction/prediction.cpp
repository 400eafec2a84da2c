#include "diagnosis/prediction/prediction.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "diagnosis/prediction/filtered_effect.h"
#include "diagnosis/prediction/lane_drive.h"
#include "estimators/eigen_modes.h"
#include "estimators/process/instruction_set.h"
#include "transmission/arm_fields.h"
#include "transmission/coupling.h"
#include "transmission/jacobian.h"

namespace halyard {
namespace {

/// Before a record starts the arm is let down onto its cables with the motors held, for this long: what the cables
/// remember of loading (hysteresis, slack, a dead zone) is then as after a real start. A past adds to that.
constexpr double kLetDown = 0.8;

/// For the widest instruction set of this processor.
LaneDrive lane_drive() {
  const InstructionSet set = instruction_sets().front();
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return avx512_lane_drive();
  if (set == InstructionSet::avx2) return avx2_lane_drive();
#endif
  (void)set;
  return generic_lane_drive();
}

std::vector<DrivenInput> driven_inputs(const Record& record) {
  std::vector<DrivenInput> inputs(record.size);
  for (std::size_t i = 0; i < record.size; ++i)
    for (int k = 0; k < record.n; ++k) {
      inputs[i].motor_angle[k] = record.motor_angle[k][i];
      inputs[i].motor_rate[k] = record.motor_rate[k][i];
      inputs[i].motor_acceleration[k] = record.motor_acceleration[k][i];
      inputs[i].torque[k] = record.has_torque(k) ? record.torque[k][i] : 0.0;
      inputs[i].external[k] = record.external[k].empty() ? 0.0 : record.external[k][i];
    }
  return inputs;
}

/// The input with the motors at rest.
DrivenInput standing(DrivenInput u) {
  for (int k = 0; k < kMaxJoints; ++k) u.motor_rate[k] = u.motor_acceleration[k] = 0;
  return u;
}

CommandHistory whole_history(const Record& record, const std::vector<DrivenInput>& inputs) {
  CommandHistory history(record.n, std::numeric_limits<double>::infinity());
  // The history holds a command for a sample; the record's are those of the instant.
  for (std::size_t i = 0; i < record.size; ++i) history.push(record.time(i) - 0.5 * record.dt, inputs[i].torque);
  return history;
}

/// seen: the effects as the record shows them.
Transmission<Lanes> pack_hypotheses(const Hypothesis* const* lane, const FilteredEffects& seen) {
  ArmParameters<double> arms[kLaneWidth];
  std::vector<EffectInstance<Lanes>> effects;
  for (std::size_t e = 0; e < lane[0]->effects.size(); ++e) effects.push_back({seen[e], lane[0]->effects[e].joint, {}});
  for (int l = 0; l < kLaneWidth; ++l) {
    arms[l] = lane[l]->nominal;
    for (std::size_t e = 0; e < effects.size(); ++e)
      for (int i = 0; i < kMaxEffectParameters; ++i) effects[e].p[i].set(l, lane[l]->effects[e].p[i]);
  }
  return Transmission<Lanes>(pack(arms), std::move(effects));
}

/// Of all effects, one after another.
std::vector<double> past_states(const Hypothesis& h, const Record& record) {
  std::vector<double> all;
  for (std::size_t e = 0; e < h.effects.size(); ++e) {
    const int states = h.effects[e].effect->n_states();
    for (int s = 0; s < states; ++s)
      all.push_back(record.place < 0 ? 0.0 : h.past_state(e, static_cast<std::size_t>(record.place * states + s)));
  }
  return all;
}

/// Jacobian of the driven state [q, q', z] at x.
Eigen::MatrixXd driven_jacobian(const Transmission<Dual>& transmission, const Record& record, const DrivenInput& u,
                                const DrivenState<double>& x) {
  const int n = record.n, m = transmission.n_states(), size = 2 * n + m;
  Eigen::VectorXd at(size), rate(size);
  at << Eigen::Map<const Eigen::VectorXd>(x.q, n), Eigen::Map<const Eigen::VectorXd>(x.v, n),
      Eigen::Map<const Eigen::VectorXd>(x.z, m);
  Eigen::MatrixXd J(size, size);
  const auto rate_at = [&](const Dual* y, Dual* y_dot) {
    DrivenState<Dual> state, state_rate;
    std::copy(y, y + n, state.q);
    std::copy(y + n, y + 2 * n, state.v);
    std::copy(y + 2 * n, y + size, state.z);
    ChainOverStep<Dual> chain;
    chain_over_step(transmission.arm(), state, 0.0, chain);
    driven_derivative<Dual>(transmission, &chain, record.start, nullptr, u, state, state_rate, nullptr, nullptr);
    std::copy(state_rate.q, state_rate.q + n, y_dot);
    std::copy(state_rate.v, state_rate.v + n, y_dot + n);
    std::copy(state_rate.z, state_rate.z + m, y_dot + 2 * n);
  };
  jacobian(rate_at, at, rate, J);
  return J;
}

/// Where the joints stand at the record's first sample if no cable is stretched; at rest, effects without a past.
DrivenState<double> unstretched_state(const Hypothesis& h, const Record& record, const DrivenInput& u) {
  const int n = record.n;
  const ArmParameters<double> arm = lift_transmission<double>(h.nominal, h.effects).arm();
  Eigen::VectorXd q_m(n), q_undriven(n);
  for (int k = 0; k < n; ++k) {
    q_m(k) = u.motor_angle[k] - arm.joint[k].motor_encoder_offset;
    q_undriven(k) = u.motor_angle[k] - arm.joint[k].joint_encoder_offset;
  }
  const Eigen::VectorXd q = unstretched_joints(arm, q_m, q_undriven);
  DrivenState<double> x = {};
  for (int k = 0; k < n; ++k) x.q[k] = q(k);
  return x;
}

/// In motion, from x on, where each cable pulls as hard as its motor ever did: a cable may be stiffer there, and the
/// joints' Coulomb friction no longer damps.
DrivenState<double> working_state(const Hypothesis& h, const Record& record, const DrivenInput& u,
                                  DrivenState<double> x) {
  const Transmission<double> transmission = lift_transmission<double>(h.nominal, h.effects);
  const ArmParameters<double>& arm = transmission.arm();
  for (int k = 0; k < arm.n; ++k) {
    if (arm.joint[k].drive != Drive::cable || !record.has_torque(k)) continue;
    double most = 0;
    for (const double torque : record.torque[k]) most = std::max(most, std::abs(torque));
    const double wanted = most / arm.joint[k].motor_travel(), from = x.q[k];
    constexpr double kFirst = 1e-6;  // rad | m, then twice as far each time
    constexpr int kMostDoublings = 18;
    for (int i = 0; i < kMostDoublings; ++i) {
      x.q[k] = from + std::ldexp(kFirst, i);
      JointSignals<double> s[kMaxJoints];
      for (int j = 0; j < arm.n; ++j) s[j].motor_angle = u.motor_angle[j], s[j].joint_position = x.q[j];
      double z_dot[kMaxStates];
      transmission.evaluate(record.start, nullptr, x.z, s, z_dot);
      if (std::abs(s[k].cable_force_joint) >= wanted) break;
    }
  }
  constexpr double kBeyondSmoothing = 10;
  for (int k = 0; k < arm.n; ++k) x.v[k] = kBeyondSmoothing * arm.joint[k].joint_smoothing;
  return x;
}

/// With the motors held: at rest at x, and as it works. Empty if they cannot be told.
std::vector<Eigenvalues> eigenvalues_of(const Hypothesis& h, const Record& record, const DrivenInput& held,
                                        const DrivenState<double>& x) {
  const Transmission<Dual> transmission = lift_transmission<Dual>(h.nominal, h.effects);
  std::vector<Eigenvalues> spectra;
  for (const DrivenState<double>& at : {x, working_state(h, record, held, x)}) {
    const Eigen::MatrixXd J = driven_jacobian(transmission, record, held, at);
    if (!J.allFinite()) return {};
    const Eigen::VectorXcd lambda = eigenvalues(J);
    spectra.emplace_back(lambda.begin(), lambda.end());
  }
  return spectra;
}

/// Everything that the motion of the joints depends on if the motors move as they were measured: not what acts between
/// the command and the rotor, nor what a joint's sensor adds.
std::vector<double> motion_key(const Hypothesis& h, const Record& record) {
  const ArmParameters<double> arm = lift_transmission<double>(h.nominal, h.effects).arm();
  std::vector<double> key = past_states(h, record);
  const auto append = [&](const auto& entry) { key.push_back(static_cast<double>(entry)); };
  for_each_arm_field([&](const ArmField&, const auto& value) { for_each_entry(append, value); }, arm);
  for (int k = 0; k < arm.n; ++k) {
    const auto append_if_it_moves = [&](const ArmField& field, const auto& value) {
      // A joint without a motor moves as its own sensor says.
      const bool of_moving_sensor = field.influence == Influence::sensor_reading && arm.joint[k].drive == Drive::none;
      if (field.influence == Influence::motion || of_moving_sensor) for_each_entry(append, value);
    };
    for_each_joint_field(append_if_it_moves, arm.joint[k]);
  }
  constexpr unsigned kMotor = static_cast<unsigned>(EffectStage::command) | static_cast<unsigned>(EffectStage::motor);
  for (const PlacedEffect& e : h.effects)
    if ((e.effect->stages() & ~kMotor) != 0 || e.effect->n_states() > 0)
      key.insert(key.end(), e.p, e.p + kMaxEffectParameters);
  return key;
}

/// Takes off the mean: where the zero of an encoder is unknown, that is what it says.
void take_off_mean(std::vector<double>& residual) {
  double sum = 0, count = 0;
  for (const double e : residual)
    if (!std::isnan(e)) sum += e, count += 1;
  for (double& e : residual) e -= sum / count;
}

/// K_c * x around a sample that can be compared, over the samples that were measured.
template <class Signal>
double compared(const Record& record, const std::vector<double>& measured, std::size_t at, const Signal& x) {
  const std::size_t reach = record.compare.size() / 2, size = record.size;
  double sum = 0, weight = 0;
  for (std::size_t t = at - std::min(at, reach); t <= std::min(at + reach, size - 1); ++t) {
    const double w = record.compare[t + reach - at] * measured[t];
    if (w > 0) sum += w * x(t);
    weight += w;
  }
  return sum / weight;
}

}  // namespace

double Hypothesis::past_state(std::size_t effect, std::size_t i) const {
  return effect < past.size() && i < past[effect].size() ? past[effect][i] : 0.0;
}

void Hypothesis::set_past_state(std::size_t effect, std::size_t i, double value) {
  if (past.size() <= effect) past.resize(effect + 1);
  if (past[effect].size() <= i) past[effect].resize(i + 1, 0.0);
  past[effect][i] = value;
}

Hypothesis without_effect(Hypothesis h, std::size_t place) {
  h.effects.erase(h.effects.begin() + static_cast<std::ptrdiff_t>(place));
  if (place < h.past.size()) h.past.erase(h.past.begin() + static_cast<std::ptrdiff_t>(place));
  return h;
}

std::vector<Residuals> predict(const Record& record, const std::vector<Hypothesis>& hypotheses, int stride) {
  static const LaneDrive kernel = lane_drive();
  const int n = record.n;
  const std::size_t rows = (record.size + stride - 1) / stride;
  const std::vector<DrivenInput> inputs = driven_inputs(record);
  const CommandHistory history = whole_history(record, inputs);
  std::vector<Residuals> all(hypotheses.size());
  if (all.empty()) return all;
  const FilteredEffects seen(hypotheses[0].effects, hypotheses[0].nominal, record.motion_sigma);

  // Hypotheses that move alike are integrated once, by the first of them, and replayed by the others.
  std::vector<std::size_t> movers, others, mover_of(hypotheses.size());
  std::map<std::vector<double>, std::size_t> known;
  for (std::size_t h = 0; h < hypotheses.size(); ++h) {
    const auto [entry, is_new] = known.try_emplace(motion_key(hypotheses[h], record), movers.size());
    mover_of[h] = entry->second;
    (is_new ? movers : others).push_back(h);
  }

  std::vector<DrivenState<double>> starts(movers.size());
  std::vector<std::vector<Eigenvalues>> spectra(movers.size());
  tbb::parallel_for(std::size_t{0}, movers.size(), [&](std::size_t i) {
    const Hypothesis& h = hypotheses[movers[i]];
    starts[i] = unstretched_state(h, record, inputs[0]);
    spectra[i] = eigenvalues_of(h, record, standing(inputs[0]), starts[i]);
  });
  const auto is_able = [&](std::size_t i) { return !spectra[i].empty() && stages_for(spectra[i], record.dt) > 0; };
  std::vector<std::vector<Eigenvalues>> able_spectra;
  for (std::size_t i = 0; i < movers.size(); ++i)
    if (is_able(i)) able_spectra.push_back(spectra[i]);
  const Chebyshev scheme = scheme_for(able_spectra, record.dt);
  const int n_states = lift_transmission<double>(hypotheses[0].nominal, hypotheses[0].effects).n_states();
  const int state_size = 2 * n + n_states;
  std::vector<std::vector<double>> states(others.empty() ? 0 : movers.size());  // [mover][sample][state_size]

  // Residuals of one lane out of what drive and replay write.
  const auto take = [&](const std::vector<Lanes>& out, int lane, bool able, Residuals& r) {
    r.finite = able;
    r.channel.assign(2 * n, {});
    for (int k = 0; k < n; ++k) {
      std::vector<double>&torque = r.channel[k], &joint = r.channel[n + k];
      if (record.has_torque(k)) torque.assign(rows, std::numeric_limits<double>::quiet_NaN());
      if (record.has_joint(k)) joint.assign(rows, std::numeric_limits<double>::quiet_NaN());
      for (std::size_t i = 0; r.finite && i < rows; ++i) {
        const std::size_t at = i * stride;
        const auto tau = [&](std::size_t t) { return out[t * 2 * n + k][lane]; };
        const auto error = [&](std::size_t t) { return record.joint[k][t] - out[t * 2 * n + n + k][lane]; };
        if (!std::isfinite(tau(at)) || !std::isfinite(out[at * 2 * n + n + k][lane])) r.finite = false;
        if (!torque.empty() && record.torque_valid[k][at] > 0)
          torque[i] = compared(record, record.torque_measured[k], at, tau);
        if (!joint.empty() && record.joint_valid[k][at] > 0)
          joint[i] = compared(record, record.joint_measured[k], at, error);
      }
      const JointParameters<double>& sensors = hypotheses[0].nominal.joint[k];
      if (!sensors.motor_zero_known || !sensors.joint_zero_known) take_off_mean(joint);
    }
  };

  const auto batches = [](std::size_t count) { return (count + kLaneWidth - 1) / kLaneWidth; };
  tbb::parallel_for(std::size_t{0}, batches(movers.size()), [&](std::size_t b) {
    const std::size_t first = b * kLaneWidth, count = std::min<std::size_t>(kLaneWidth, movers.size() - first);
    const Hypothesis* lane[kLaneWidth];
    DrivenState<Lanes> x;
    for (int k = 0; k < n; ++k) x.q[k] = x.v[k] = 0.0;
    for (int k = 0; k < n_states; ++k) x.z[k] = 0.0;
    for (std::size_t l = 0; l < kLaneWidth; ++l) {
      const std::size_t i = first + std::min(l, count - 1);
      lane[l] = is_able(i) ? &hypotheses[movers[i]] : nullptr;
      for (int k = 0; k < n; ++k) x.q[k].set(static_cast<int>(l), starts[i].q[k]);
    }
    // A lane that cannot be integrated is replaced by one that can, and reported.
    const Hypothesis* able = nullptr;
    for (std::size_t l = 0; l < count; ++l)
      if (lane[l]) able = lane[l];
    std::vector<Lanes> out(record.size * 2 * n), path(states.empty() ? 0 : record.size * state_size);
    if (able) {
      const Hypothesis* filled[kLaneWidth];
      for (int l = 0; l < kLaneWidth; ++l) filled[l] = lane[l] ? lane[l] : able;
      const Transmission<Lanes> transmission = pack_hypotheses(filled, seen);
      const std::vector<DrivenInput> held(static_cast<std::size_t>(kLetDown / record.dt) + 1, standing(inputs[0]));
      std::vector<Lanes> unused(held.size() * 2 * n);
      const double before = record.start - record.dt * static_cast<double>(held.size());
      kernel.drive(transmission, held.data(), held.size(), before, record.dt, scheme, &history, x, unused.data(),
                   nullptr);
      for (int l = 0; l < kLaneWidth; ++l) {
        const std::vector<double> past = past_states(*filled[l], record);
        for (int k = 0; k < n_states; ++k) x.z[k].set(l, x.z[k][l] + past[k]);
      }
      kernel.drive(transmission, inputs.data(), record.size, record.start, record.dt, scheme, &history, x, out.data(),
                   path.empty() ? nullptr : path.data());
    }
    for (std::size_t l = 0; l < count; ++l) {
      take(out, static_cast<int>(l), lane[l] != nullptr, all[movers[first + l]]);
      if (states.empty()) continue;
      states[first + l].resize(path.size());
      for (std::size_t i = 0; i < path.size(); ++i) states[first + l][i] = path[i][static_cast<int>(l)];
    }
  });

  tbb::parallel_for(std::size_t{0}, batches(others.size()), [&](std::size_t b) {
    const std::size_t first = b * kLaneWidth, count = std::min<std::size_t>(kLaneWidth, others.size() - first);
    const Hypothesis* lane[kLaneWidth];
    std::vector<Lanes> out(record.size * 2 * n), path(record.size * state_size);
    for (std::size_t l = 0; l < kLaneWidth; ++l) {
      const std::size_t h = others[first + std::min(l, count - 1)];
      lane[l] = &hypotheses[h];
      const std::vector<double>& of_mover = states[mover_of[h]];
      for (std::size_t i = 0; i < path.size(); ++i) path[i].set(static_cast<int>(l), of_mover[i]);
    }
    kernel.replay(pack_hypotheses(lane, seen), inputs.data(), record.size, record.start, record.dt, &history,
                  path.data(), out.data());
    for (std::size_t l = 0; l < count; ++l) {
      const std::size_t h = others[first + l];
      take(out, static_cast<int>(l), all[movers[mover_of[h]]].finite, all[h]);
    }
  });
  return all;
}

FullPrediction predict_fully(const Record& record, const Hypothesis& hypothesis) {
  const Residuals r = predict(record, {hypothesis}, 1)[0];
  FullPrediction full;
  full.torque_residual.assign(r.channel.begin(), r.channel.begin() + record.n);
  full.joint_reading.resize(record.n);
  for (int k = 0; k < record.n; ++k) {
    if (!record.has_joint(k)) continue;
    full.joint_reading[k].resize(record.size);
    for (std::size_t i = 0; i < record.size; ++i)
      full.joint_reading[k][i] = record.joint[k][i] - r.channel[record.n + k][i];
  }
  return full;
}

}  // namespace halyard
