#include "diagnosis/prediction/prediction.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "diagnosis/prediction/driven_start.h"
#include "diagnosis/prediction/filtered_effect.h"
#include "diagnosis/prediction/lane_drive.h"
#include "diagnosis/prediction/measured_units.h"
#include "estimators/process/instruction_set.h"
#include "transmission/arm_fields.h"

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
Lanes compared(const Record& record, const std::vector<double>& measured, std::size_t at, const Signal& x) {
  const std::size_t reach = record.compare.size() / 2, size = record.size;
  Lanes sum = 0.0;
  double weight = 0;
  for (std::size_t t = at - std::min(at, reach); t <= std::min(at + reach, size - 1); ++t) {
    const double w = record.compare[t + reach - at] * measured[t];
    if (w > 0) sum += Lanes(w) * x(t);
    weight += w;
  }
  return sum / Lanes(weight);
}

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Predictions of a record by hypotheses with the same effects.
class Prediction {
 public:
  Prediction(const Record& record, const std::vector<Hypothesis>& hypotheses, int stride)
      : record_(record),
        hypotheses_(hypotheses),
        stride_(stride),
        inputs_(driven_inputs(record)),
        history_(whole_history(record, inputs_)),
        filtered_(hypotheses[0].effects, hypotheses[0].nominal, record.motion_sigma),
        n_states_(lift_transmission<double>(hypotheses[0].nominal, hypotheses[0].effects).n_states()),
        state_size_(2 * record.n + n_states_),
        all_(hypotheses.size()) {}

  std::vector<Residuals> run() {
    find_movers();
    find_starts();
    states_.resize(replayed_.empty() ? 0 : movers_.size());
    tbb::parallel_for(std::size_t{0}, batches(movers_.size()), [&](std::size_t b) { drive(b * kLaneWidth); });
    tbb::parallel_for(std::size_t{0}, batches(replayed_.size()), [&](std::size_t b) { replay(b * kLaneWidth); });
    return std::move(all_);
  }

 private:
  static std::size_t batches(std::size_t count) { return (count + kLaneWidth - 1) / kLaneWidth; }

  /// Hypotheses with the same motion are integrated once, by the first of them, and replayed for the others.
  void find_movers() {
    std::map<std::vector<double>, std::size_t> known;
    mover_of_.resize(hypotheses_.size());
    for (std::size_t h = 0; h < hypotheses_.size(); ++h) {
      const auto [entry, is_new] = known.try_emplace(motion_key(hypotheses_[h], record_), movers_.size());
      mover_of_[h] = entry->second;
      (is_new ? movers_ : replayed_).push_back(h);
    }
  }

  /// Start and eigenvalues of each mover, and a scheme for all that can be integrated.
  void find_starts() {
    starts_.resize(movers_.size());
    spectra_.resize(movers_.size());
    tbb::parallel_for(std::size_t{0}, movers_.size(), [&](std::size_t i) {
      const Hypothesis& h = hypotheses_[movers_[i]];
      starts_[i] = unstretched_state(h, record_, inputs_[0]);
      spectra_[i] = eigenvalues_of(h, record_, standing(inputs_[0]), starts_[i]);
    });
    std::vector<std::vector<Eigenvalues>> able;
    for (std::size_t i = 0; i < movers_.size(); ++i)
      if (is_able(i)) able.push_back(spectra_[i]);
    scheme_ = scheme_for(able, record_.dt);
  }

  bool is_able(std::size_t mover) const {
    return !spectra_[mover].empty() && stages_for(spectra_[mover], record_.dt) > 0;
  }

  /// Integrates movers first, first + 1, ... side by side.
  void drive(std::size_t first) {
    const std::size_t count = std::min<std::size_t>(kLaneWidth, movers_.size() - first);
    std::vector<Lanes> out(record_.size * 2 * record_.n), path(states_.empty() ? 0 : record_.size * state_size_);
    // A lane that cannot be integrated is filled with one that can, and reported.
    const Hypothesis* able = nullptr;
    for (std::size_t l = 0; l < count; ++l)
      if (is_able(first + l)) able = &hypotheses_[movers_[first + l]];
    if (able) {
      const Hypothesis* filled[kLaneWidth];
      DrivenState<Lanes> x;
      for (int k = 0; k < record_.n; ++k) x.v[k] = 0.0;
      for (int k = 0; k < n_states_; ++k) x.z[k] = 0.0;
      for (int l = 0; l < kLaneWidth; ++l) {
        const std::size_t i = first + std::min<std::size_t>(l, count - 1);
        filled[l] = is_able(i) ? &hypotheses_[movers_[i]] : able;
        for (int k = 0; k < record_.n; ++k) x.q[k].set(l, starts_[i].q[k]);
      }
      integrate(filled, x, out, path);
    }
    std::vector<Taken> taken;
    for (std::size_t l = 0; l < count; ++l) taken.push_back({movers_[first + l], is_able(first + l)});
    take(out, taken);
    for (std::size_t l = 0; l < count && !states_.empty(); ++l) {
      states_[first + l].resize(path.size());
      for (std::size_t i = 0; i < path.size(); ++i) states_[first + l][i] = path[i][static_cast<int>(l)];
    }
  }

  /// Lowers the arm onto its cables with the motors held, adds the pasts, and drives it along the record.
  void integrate(const Hypothesis* const (&lane)[kLaneWidth], DrivenState<Lanes>& x, std::vector<Lanes>& out,
                 std::vector<Lanes>& path) const {
    const Transmission<Lanes> transmission = pack_hypotheses(lane, filtered_);
    const std::vector<DrivenInput> held(static_cast<std::size_t>(kLetDown / record_.dt) + 1, standing(inputs_[0]));
    std::vector<Lanes> unused(held.size() * 2 * record_.n);
    const double before = record_.start - record_.dt * static_cast<double>(held.size());
    kernel().drive(transmission, held.data(), held.size(), before, record_.dt, scheme_, &history_, x, unused.data(),
                   nullptr);
    for (int l = 0; l < kLaneWidth; ++l) {
      const std::vector<double> past = past_states(*lane[l], record_);
      for (int k = 0; k < n_states_; ++k) x.z[k].set(l, x.z[k][l] + past[k]);
    }
    kernel().drive(transmission, inputs_.data(), record_.size, record_.start, record_.dt, scheme_, &history_, x,
                   out.data(), path.empty() ? nullptr : path.data());
  }

  /// Outputs of hypotheses that share the motion of a mover.
  void replay(std::size_t first) {
    const std::size_t count = std::min<std::size_t>(kLaneWidth, replayed_.size() - first);
    const Hypothesis* lane[kLaneWidth];
    std::vector<Lanes> out(record_.size * 2 * record_.n), path(record_.size * state_size_);
    for (std::size_t l = 0; l < kLaneWidth; ++l) {
      const std::size_t h = replayed_[first + std::min(l, count - 1)];
      lane[l] = &hypotheses_[h];
      const std::vector<double>& of_mover = states_[mover_of_[h]];
      for (std::size_t i = 0; i < path.size(); ++i) path[i].set(static_cast<int>(l), of_mover[i]);
    }
    kernel().replay(pack_hypotheses(lane, filtered_), inputs_.data(), record_.size, record_.start, record_.dt,
                    &history_, path.data(), out.data());
    std::vector<Taken> taken;
    for (std::size_t l = 0; l < count; ++l) {
      const std::size_t h = replayed_[first + l];
      taken.push_back({h, all_[movers_[mover_of_[h]]].finite});
    }
    take(out, taken);
  }

  /// A hypothesis in a lane, and whether that lane was integrated.
  struct Taken {
    std::size_t hypothesis;
    bool able;
  };

  /// Residuals of the hypotheses in the first lanes of what drive or replay wrote.
  void take(const std::vector<Lanes>& out, const std::vector<Taken>& taken) {
    const int n = record_.n;
    for (const Taken& t : taken) {
      all_[t.hypothesis].finite = t.able;
      all_[t.hypothesis].channel.assign(2 * n, {});
    }
    for (int k = 0; k < n; ++k) {
      const auto residual = [&, k](std::size_t t) { return out[t * 2 * n + k]; };
      const auto reading = [&, k](std::size_t t) { return out[t * 2 * n + n + k]; };
      const auto error = [&, k](std::size_t t) { return Lanes(record_.joint[k][t]) - reading(t); };
      check_finite(taken, residual);
      check_finite(taken, reading);
      if (record_.has_torque(k)) take_channel(taken, k, record_.torque_valid[k], record_.torque_measured[k], residual);
      if (record_.has_joint(k)) take_channel(taken, n + k, record_.joint_valid[k], record_.joint_measured[k], error);
      for (const Taken& t : taken) finish(t.hypothesis, k);
    }
  }

  /// Marks the hypotheses whose signal is not finite at a compared sample.
  template <class Signal>
  void check_finite(const std::vector<Taken>& taken, const Signal& signal) {
    Lanes sum = 0.0;
    for (std::size_t i = 0; i < rows(); ++i) sum += Lanes(0.0) * signal(i * stride_);
    for (std::size_t l = 0; l < taken.size(); ++l)
      if (!std::isfinite(sum[static_cast<int>(l)])) all_[taken[l].hypothesis].finite = false;
  }

  template <class Signal>
  void take_channel(const std::vector<Taken>& taken, int c, const std::vector<double>& valid,
                    const std::vector<double>& measured, const Signal& signal) {
    for (const Taken& t : taken) all_[t.hypothesis].channel[c].assign(rows(), kNone);
    for (std::size_t i = 0; i < rows(); ++i) {
      const std::size_t at = i * stride_;
      if (!(valid[at] > 0)) continue;
      const Lanes row = compared(record_, measured, at, signal);
      for (std::size_t l = 0; l < taken.size(); ++l) all_[taken[l].hypothesis].channel[c][i] = row[static_cast<int>(l)];
    }
  }

  void finish(std::size_t h, int k) {
    Residuals& r = all_[h];
    if (record_.has_torque(k)) {
      // Otherwise a hypothesis by which the motor makes less than it was commanded would win by shrinking the data.
      const double ratio = acting_over_commanded(record_, hypotheses_[h], k, history_);
      for (double& e : r.channel[k]) e /= ratio;
    }
    const JointParameters<double>& sensors = hypotheses_[0].nominal.joint[k];
    if (!sensors.motor_zero_known || !sensors.joint_zero_known) take_off_mean(r.channel[record_.n + k]);
  }

  std::size_t rows() const { return (record_.size + stride_ - 1) / stride_; }
  static const LaneDrive& kernel() {
    static const LaneDrive widest = lane_drive();
    return widest;
  }

  const Record& record_;
  const std::vector<Hypothesis>& hypotheses_;
  int stride_;
  std::vector<DrivenInput> inputs_;
  CommandHistory history_;
  FilteredEffects filtered_;
  int n_states_, state_size_;
  std::vector<std::size_t> movers_, replayed_;  ///< hypotheses that are integrated, and those that are replayed
  std::vector<std::size_t> mover_of_;           ///< [hypothesis] index in movers_
  std::vector<DrivenState<double>> starts_;     ///< [mover]
  std::vector<std::vector<Eigenvalues>> spectra_;
  Chebyshev scheme_;
  std::vector<std::vector<double>> states_;  ///< [mover][sample * state_size], if anything is replayed
  std::vector<Residuals> all_;
};

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
  return hypotheses.empty() ? std::vector<Residuals>{} : Prediction(record, hypotheses, stride).run();
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
