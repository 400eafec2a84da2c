#include "diagnosis/prediction/prediction.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <tuple>

#include "diagnosis/motion/lane_drive.h"
#include "diagnosis/prediction/lane_residuals.h"
#include "diagnosis/prediction/motion_key.h"
#include "diagnosis/prediction/recent_residuals.h"
#include "diagnosis/prediction/room.h"
#include "diagnosis/prediction/shared_lanes.h"
#include "diagnosis/prediction/side_by_side.h"
#include "diagnosis/prediction/start/driven_start.h"
#include "diagnosis/prediction/start/let_down.h"
#include "diagnosis/record/common_clock.h"
#include "model/machine/first_failure.h"

namespace halyard {
namespace {

/// For the widest instruction set of this processor.
const LaneDrive& kernel() { return lane_drives().front(); }

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

CommandHistory whole_history(const Record& record, const std::vector<DrivenInput>& inputs) {
  CommandHistory history(record.n, std::numeric_limits<double>::infinity());
  // The history holds a command for a sample; the record's are those of the instant.
  for (std::size_t i = 0; i < record.size; ++i) history.push(record.time(i) - 0.5 * record.dt, inputs[i].torque);
  return history;
}

/// A hypothesis on its way to its residuals.
struct Job {
  const Hypothesis* hypothesis;
  std::size_t request;
  Residuals* residuals;
  std::vector<double> motion = {};  ///< motion_key()
  std::size_t mover = 0;            ///< the first job of the request with the same motion: itself, if it is integrated
  bool is_replayed_later = false;
  bool is_known = false;                         ///< its residuals need not be computed
  std::optional<RecentResiduals::Key> key = {};  ///< of what is computed, to be kept
  std::optional<std::size_t> twin = {};          ///< a job with the same key, whose residuals it takes
  DrivenState<double> start = {};
  std::vector<Eigenvalues> spectrum = {};
  bool is_able = false;             ///< can be integrated
  std::vector<double> states = {};  ///< [sample * own state size], if another job is replayed from them
};

/// All requests about one record at one stride.
class Prediction {
 public:
  Prediction(const Record& record, int stride, RecentResiduals* recent)
      : record_(record),
        stride_(stride),
        recent_(recent),
        inputs_(driven_inputs(record)),
        history_(whole_history(record, inputs_)) {}

  Prediction(const Prediction&) = delete;  // jobs have pointers to its hypotheses
  bool is_of(const Record& record, int stride) const { return &record_ == &record && stride_ == stride; }

  void add(const std::vector<Hypothesis>& hypotheses, std::vector<Residuals>& residuals) {
    residuals.resize(hypotheses.size());
    for (std::size_t h = 0; h < hypotheses.size(); ++h) {
      const Hypothesis* const own = record_.clock_shift == 0
                                        ? &hypotheses[h]
                                        : &on_own_clocks_.emplace_back(on_own_clock(record_, hypotheses[h]));
      jobs_.push_back({own, n_requests_, &residuals[h]});
    }
    ++n_requests_;
  }

  void run() {
    find_movers();
    find_starts();
    if (recent_) recall();
    std::vector<std::size_t> movers, replayed;
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      Job& job = jobs_[i];
      if (!is_able(job)) *job.residuals = unknown_residuals(record_, stride_);
      else if (job.mover != i && !job.is_known) replayed.push_back(i), jobs_[job.mover].is_replayed_later = true;
    }
    for (std::size_t i = 0; i < jobs_.size(); ++i)
      if (is_able(jobs_[i]) && jobs_[i].mover == i && (!jobs_[i].is_known || jobs_[i].is_replayed_later))
        movers.push_back(i);
    each_batch(movers, [&](const std::vector<std::size_t>& batch) { drive(batch); });
    each_batch(replayed, [&](const std::vector<std::size_t>& batch) { replay(batch); });
    for (Job& job : jobs_) {
      if (job.key) recent_->keep(std::move(*job.key), *job.residuals);
      if (job.twin) *job.residuals = *jobs_[*job.twin].residuals;
    }
  }

 private:
  bool is_able(const Job& job) const { return jobs_[job.mover].is_able; }

  /// Takes what was predicted lately, and finds jobs that ask for the same.
  void recall() {
    std::map<RecentResiduals::Key, std::size_t> first;
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      Job& job = jobs_[i];
      if (!is_able(job)) continue;
      RecentResiduals::Key key(*job.hypothesis, record_, stride_, schemes_[job.request], job.mover != i);
      if (!key.can_be_found()) continue;
      const auto [same, is_new] = first.try_emplace(key, i);
      if (!is_new) {
        job.twin = same->second;
      } else if (auto known = recent_->find(key)) {
        *job.residuals = std::move(*known);
        job.is_known = true;
      } else {
        job.key = std::move(key);
      }
      job.is_known = job.is_known || job.twin;
    }
  }

  /// Jobs of a request with the same motion are integrated once, by the first of them, and replayed for the others.
  void find_movers() {
    tbb::parallel_for(std::size_t{0}, jobs_.size(),
                      [&](std::size_t i) { jobs_[i].motion = motion_key(*jobs_[i].hypothesis, record_); });
    std::map<std::pair<std::size_t, std::vector<double>>, std::size_t> known;
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      jobs_[i].mover = i;
      if (std::ranges::any_of(jobs_[i].motion, [](double x) { return std::isnan(x); }))
        continue;  // no key has an order
      jobs_[i].mover = known.try_emplace({jobs_[i].request, std::move(jobs_[i].motion)}, i).first->second;
    }
  }

  /// Start and eigenvalues of each mover, and for each request a scheme for all movers that can be integrated.
  void find_starts() {
    tbb::parallel_for(std::size_t{0}, jobs_.size(), [&](std::size_t i) {
      Job& job = jobs_[i];
      if (job.mover != i || !has_room(job.hypothesis->effects, record_.n)) return;
      const DrivenInput held = held_before(record_, inputs_[0]);
      job.start = unstretched_state(*job.hypothesis, record_, held);
      job.spectrum = eigenvalues_of(*job.hypothesis, record_, held, job.start);
      job.is_able = !job.spectrum.empty() && stages_for(job.spectrum, record_.dt, record_.most_stages) > 0;
    });
    std::vector<std::vector<std::vector<Eigenvalues>>> able(n_requests_);
    for (const Job& job : jobs_)
      if (job.is_able) able[job.request].push_back(job.spectrum);
    for (const auto& spectra : able) schemes_.push_back(scheme_for(spectra, record_.dt));
  }

  /// Calls work for batches that fill the lanes with jobs of the same scheme, jobs with the same effects beside each
  /// other.
  template <class Work>
  void each_batch(std::vector<std::size_t> jobs, const Work& work) const {
    std::vector<const std::vector<PlacedEffect>*> lists;
    std::vector<std::tuple<int, int, std::size_t>> kind(jobs_.size());
    for (const std::size_t i : jobs) {
      const RungeKuttaChebyshev& scheme = schemes_[jobs_[i].request];
      kind[i] = {scheme.steps, scheme.stages, index_of_list(jobs_[i].hypothesis->effects, lists)};
    }
    std::ranges::stable_sort(jobs, {}, [&](std::size_t i) { return kind[i]; });
    std::vector<std::vector<std::size_t>> batches;
    CommonEffects common;
    for (const std::size_t i : jobs) {
      CommonEffects more = common;
      more.add(jobs_[i].hypothesis->effects);
      const bool fits = !batches.empty() && batches.back().size() < kLaneWidth && n_states_with(more) <= kMaxStates &&
                        has_same_scheme(batches.back()[0], i);
      if (fits) {
        batches.back().push_back(i);
        common = std::move(more);
      } else {
        batches.push_back({i});
        common = {};
        common.add(jobs_[i].hypothesis->effects);
      }
    }
    tbb::parallel_for(std::size_t{0}, batches.size(), [&](std::size_t b) { work(batches[b]); });
  }

  static std::size_t index_of_list(const std::vector<PlacedEffect>& effects,
                                   std::vector<const std::vector<PlacedEffect>*>& known) {
    const auto found =
        std::ranges::find_if(known, [&](const auto* list) { return std::ranges::equal(*list, effects, same_name); });
    if (found != known.end()) return static_cast<std::size_t>(found - known.begin());
    known.push_back(&effects);
    return known.size() - 1;
  }

  int n_states_with(const CommonEffects& common) const { return 2 * record_.n + common.n_states(); }
  bool has_same_scheme(std::size_t i, std::size_t j) const {
    const RungeKuttaChebyshev &a = schemes_[jobs_[i].request], &b = schemes_[jobs_[j].request];
    return a.steps == b.steps && a.stages == b.stages;
  }

  SharedLanes lanes_of(const std::vector<std::size_t>& batch) const {
    std::vector<const Hypothesis*> hypotheses;
    for (const std::size_t i : batch) hypotheses.push_back(jobs_[i].hypothesis);
    return {std::move(hypotheses), record_};
  }

  void drive(const std::vector<std::size_t>& batch) {
    const SharedLanes lanes = lanes_of(batch);
    const bool keeps = std::ranges::any_of(batch, [&](std::size_t i) { return jobs_[i].is_replayed_later; });
    std::vector<Lanes> out(record_.size * 2 * record_.n);
    std::vector<Lanes> path(keeps ? record_.size * (2 * record_.n + lanes.n_states()) : 0);
    integrate(lanes, batch, out, path);
    take(batch, out);
    for (std::size_t l = 0; l < batch.size(); ++l)
      if (jobs_[batch[l]].is_replayed_later) jobs_[batch[l]].states = states_of_lane(lanes, l, path);
  }

  /// Brings the arm to the start of the record, adds the pasts, and drives it along the record.
  void integrate(const SharedLanes& lanes, const std::vector<std::size_t>& batch, std::vector<Lanes>& out,
                 std::vector<Lanes>& path) const {
    const RungeKuttaChebyshev& scheme = schemes_[jobs_[batch[0]].request];
    DrivenState<Lanes> x = {};
    Lanes rate[kMaxJoints], acceleration[kMaxJoints];
    for (int l = 0; l < kLaneWidth; ++l) {
      const Job& job = jobs_[batch[l < std::ssize(batch) ? l : 0]];
      const UnstretchedMotion motion = unstretched_motion(*job.hypothesis, record_.first_motion);
      for (int k = 0; k < record_.n; ++k) {
        x.q[k].set(l, job.start.q[k]);
        if (!record_.first_motion.is_there()) continue;
        rate[k].set(l, motion.rate(k));
        acceleration[k].set(l, motion.acceleration(k));
      }
    }
    bring_to_start(lanes.transmission(), scheme, record_, inputs_[0], history_, rate, acceleration, x);
    lanes.add_past(x.z);
    kernel().drive(lanes.transmission(), inputs_.data(), record_.size, record_.start, record_.dt, scheme, &history_, x,
                   out.data(), path.empty() ? nullptr : path.data());
  }

  /// [q, q', z] of a hypothesis at each sample, with the states of its own effects alone.
  std::vector<double> states_of_lane(const SharedLanes& lanes, std::size_t lane, const std::vector<Lanes>& path) const {
    const std::size_t moving = 2 * record_.n, size = moving + lanes.n_states();
    std::vector<double> states;
    states.reserve(record_.size * (moving + lanes.states_of(lane).size()));
    const int l = static_cast<int>(lane);
    for (std::size_t i = 0; i < record_.size; ++i) {
      const Lanes* row = path.data() + i * size;
      for (std::size_t k = 0; k < moving; ++k) states.push_back(row[k][l]);
      for (const int s : lanes.states_of(lane)) states.push_back(row[moving + s][l]);
    }
    return states;
  }

  /// Outputs of jobs that share the motion of a mover.
  void replay(const std::vector<std::size_t>& batch) {
    const SharedLanes lanes = lanes_of(batch);
    const std::size_t moving = 2 * record_.n, size = moving + lanes.n_states();
    std::vector<Lanes> out(record_.size * moving), path(record_.size * size, Lanes(0.0));
    for (int l = 0; l < kLaneWidth; ++l) {
      const std::size_t lane = l < std::ssize(batch) ? static_cast<std::size_t>(l) : 0;
      const double* of_mover = jobs_[jobs_[batch[lane]].mover].states.data();
      for (std::size_t i = 0; i < record_.size; ++i) {
        Lanes* row = path.data() + i * size;
        for (std::size_t k = 0; k < moving; ++k) row[k].set(l, *of_mover++);
        for (const int s : lanes.states_of(lane)) row[moving + s].set(l, *of_mover++);
      }
    }
    kernel().replay(lanes.transmission(), inputs_.data(), record_.size, record_.start, record_.dt, &history_,
                    path.data(), out.data());
    take(batch, out);
  }

  void take(const std::vector<std::size_t>& batch, const std::vector<Lanes>& out) const {
    std::vector<LaneOwner> owners;
    for (const std::size_t i : batch) owners.push_back({jobs_[i].hypothesis, jobs_[i].residuals});
    take_residuals(record_, history_, stride_, out, owners);
  }

  const Record& record_;
  int stride_;
  RecentResiduals* recent_;
  std::vector<DrivenInput> inputs_;
  CommandHistory history_;
  std::deque<Hypothesis> on_own_clocks_;  ///< of the jobs, if the record's clock is not the common one
  std::vector<Job> jobs_;
  std::size_t n_requests_ = 0;
  std::vector<RungeKuttaChebyshev> schemes_;  ///< [request]
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

std::vector<std::vector<Residuals>> predict_at_once(const std::vector<PredictionRequest>& requests) {
  std::vector<std::vector<Residuals>> residuals(requests.size());
  std::deque<Prediction> predictions;
  for (std::size_t r = 0; r < requests.size(); ++r) {
    const auto& [record, hypotheses, stride, recent] = requests[r];
    auto of_record = std::ranges::find_if(
        predictions, [record = record, stride = stride](const Prediction& p) { return p.is_of(*record, stride); });
    if (of_record == predictions.end()) {
      predictions.emplace_back(*record, stride, recent);
      of_record = std::prev(predictions.end());
    }
    of_record->add(*hypotheses, residuals[r]);
  }
  for_each_in_parallel(predictions.size(), [&](std::size_t p) { predictions[p].run(); });
  return residuals;
}

std::vector<std::vector<Residuals>> predict(const std::vector<PredictionRequest>& requests) {
  SideBySide* const beside = SideBySide::of_this_thread();
  return beside ? beside->predict(requests) : predict_at_once(requests);
}

std::vector<Residuals> predict(const Record& record, const std::vector<Hypothesis>& hypotheses, int stride) {
  return std::move(predict({PredictionRequest{&record, &hypotheses, stride}})[0]);
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
