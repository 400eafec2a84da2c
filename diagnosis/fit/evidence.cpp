#include "diagnosis/fit/evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "diagnosis/record/coarse_record.h"
#include "diagnosis/record/resting.h"
#include "diagnosis/record/sampled_column.h"
#include "model/input_error.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

constexpr double kRowRate = 50;            ///< residual rows a second; they are band-limited to 20 Hz
constexpr double kCorrelationTime = 0.25;  ///< s; residuals of a motion closer than this say the same
constexpr double kTorqueFloor = 0.01;      ///< of the torque's root mean square
constexpr double kResolutionFloor = 0.3;   ///< of the joint encoder's resolution: its rounding's deviation

constexpr double kCoarseStep = 4e-3;  ///< s; below a quarter of a period of what the motion's filter passes

/// Of the positions of joint k.
Span joint_span_of(const std::vector<Record>& records, const ArmModel& model, int k) {
  const ArmParameters<double>& arm = model.nominal;
  Span span{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  const auto see = [&span](double q) { span = {std::min(span.first, q), std::max(span.last, q)}; };
  const UnstretchedJoints unstretched(arm);
  Eigen::VectorXd q_m(arm.n), q, undriven = model.home();
  for (const Record& record : records) {
    if (record.has_joint(k)) {
      for (const double reading : record.joint[k]) see(reading - arm.joint[k].joint_encoder_offset);
      continue;
    }
    for (std::size_t i = 0; i < record.size; ++i) {
      for (int j = 0; j < arm.n; ++j) {
        q_m(j) = record.motor_angle[j][i] - arm.joint[j].motor_encoder_offset;
        if (arm.joint[j].drive == Drive::none)
          undriven(j) = record.motor_angle[j][i] - arm.joint[j].joint_encoder_offset;
      }
      unstretched.solve(q_m, undriven, q);
      see(q(k));
    }
  }
  return span;
}

}  // namespace

Evidence::Evidence(std::vector<Record> data, const ArmModel& model, Split split)
    : n_(model.n()), grid_(std::make_shared<Grid>()) {
  if (data.empty()) throw InputError("no log to compare the model with; expected at least one");
  grid_->records = std::move(data);
  double total = 0, dt = records().front().dt;
  for (const Record& r : records()) total += r.dt * static_cast<double>(r.size), dt = std::min(dt, r.dt);
  grid_->stride = std::max(1, static_cast<int>(std::lround(1 / (kRowRate * dt))));
  // The autocorrelation of white noise behind a Gaussian filter is exp(-t² / (4 σ²)).
  const double noise_s = 2 * std::sqrt(std::numbers::pi) * records().front().filter_sigma();
  noise_rows_ = std::max(1.0, noise_s / (grid_->stride * dt));
  block_s_ = std::clamp(total / 60, kCorrelationTime, 1.0);

  channel_rows_.assign(channels(), 0);
  fit_count_.assign(channels(), 0);
  int blocks = 0;
  for (std::size_t r = 0; r < records().size(); ++r) {
    grid_->records[r].place = r;
    first_block_.push_back(blocks);
    blocks = add_rows(static_cast<int>(r), model, split);
  }
  if (row_channel_.empty())
    throw InputError(records().front().source +
                     ": nothing to compare: no joint sensor, and no motor that moves with a known torque");
  find_correlated_rows();
  block_count_.assign(blocks / 2 + 1, std::vector<int>(channels(), 0));
  for (const Place& p : places_)
    if (!p.fit) ++block_count_[p.block][p.channel];
  noise_ = channel_noise(records(), {model.nominal, model.effects});
  coarse_ = coarse_grid(*grid_);
  find_floors(model);
  find_spans(model);
}

int Evidence::add_rows(int r, const ArmModel& model, Split split) {
  const Record& record = records()[r];
  int end = first_block_[r];
  for (int c = 0; c < channels(); ++c) {
    const int k = c % n_;
    const bool joint = c >= n_;
    if (joint ? !record.has_joint(k) : !record.has_torque(k)) continue;
    const std::vector<double>& valid = joint ? record.joint_valid[k] : record.torque_valid[k];
    const double v_s = slowest_smoothing(model, k);
    for (std::size_t i = 0; i < record.size; i += grid_->stride) {
      if (valid[i] == 0 || (!joint && rests(record, k, i, v_s))) continue;
      const int block = block_of(r, i);
      const int index = static_cast<int>(i) / grid_->stride;
      const double time = record.time(i) + record.clock_shift;
      if (split == Split::none) add_row({r, c, index, block, true}, time);
      else add_row({r, c, index, block / 2, !decides(r, i)}, time);
      end = std::max(end, block + 1);
    }
  }
  return end;
}

int Evidence::block_of(int r, std::size_t i) const {
  return first_block_[r] + static_cast<int>(records()[r].dt * static_cast<double>(i) / block_s_);
}

void Evidence::add_row(const Place& place, double time) {
  places_.push_back(place);
  ++channel_rows_[place.channel];
  if (!place.fit) return;
  row_channel_.push_back(place.channel);
  row_block_.push_back(place.block);
  row_record_.push_back(place.record);
  row_time_.push_back(time);
  ++fit_count_[place.channel];
}

void Evidence::find_correlated_rows() {
  // Time that the rows of a channel cover. Within a sensor's holes it goes on, but for long ones; while a motor rests,
  // whose torque is not compared, it does not.
  std::vector<double> seconds(channels(), 0);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Place& place = places_[i];
    const double a_row = grid_->stride * records()[place.record].dt;
    double until_next = a_row;
    if (i + 1 < places_.size() && places_[i + 1].record == place.record && places_[i + 1].channel == place.channel)
      until_next = (places_[i + 1].index - place.index) * a_row;
    const bool goes_on = place.channel >= n_ && until_next <= kCorrelationTime;
    seconds[place.channel] += goes_on ? until_next : a_row;
  }
  correlated_rows_.assign(channels(), 1);
  for (int c = 0; c < channels(); ++c)
    if (has_channel(c)) correlated_rows_[c] = std::max(1.0, kCorrelationTime * channel_rows_[c] / seconds[c]);
}

void Evidence::find_floors(const ArmModel& model) {
  floor_.assign(channels(), 0);
  std::vector<double> square(n_, 0), count(n_, 0);
  for (const Place& p : places_)
    if (p.channel < n_)
      square[p.channel] += std::pow(records()[p.record].torque[p.channel][p.index * grid_->stride], 2),
          count[p.channel] += 1;
  for (int k = 0; k < n_; ++k) {
    const JointParameters<double>& j = model.nominal.joint[k];
    if (count[k] > 0) floor_[k] = kTorqueFloor * std::sqrt(square[k] / count[k]);
    for (const Record& record : records()) {
      if (!record.has_joint(k)) continue;
      const double told = j.joint_encoder_resolution;
      floor_[n_ + k] =
          std::max(floor_[n_ + k], kResolutionFloor * (told > 0 ? told : smallest_step(record.joint_samples[k])));
    }
  }
  resolved_ = floor_;
  for (int c = 0; c < channels(); ++c) floor_[c] = std::max(floor_[c], noise_[c].in_band);
}

void Evidence::find_spans(const ArmModel& model) {
  time_span_ = {records().front().start, records().front().start};
  for (const Record& r : records())
    time_span_ = {std::min(time_span_.first, r.start + r.clock_shift),
                  std::max(time_span_.last, r.time(r.size - 1) + r.clock_shift)};
  for (int k = 0; k < n_; ++k) {
    joint_span_.push_back(joint_span_of(records(), model, k));
    Span span{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    double fastest = 0;
    for (const Record& r : records()) {
      const auto [low, high] = std::ranges::minmax(r.motor_angle[k]);
      span = {std::min(span.first, low), std::max(span.last, high)};
      for (const double rate : r.motor_rate[k]) fastest = std::max(fastest, std::abs(rate));
    }
    motor_span_.push_back(span);
    greatest_speed_.push_back(fastest);
  }
  find_moving_span(model);
}

void Evidence::find_moving_span(const ArmModel& model) {
  constexpr double kMoves = 0.05;     // of the greatest speed
  constexpr double kRounding = 1e-6;  // rad/s | m/s; above what the filter makes of a constant
  const auto stands_still = [&](int k) {
    const bool driven = model.nominal.joint[k].drive != Drive::none;
    return greatest_speed_[k] <= std::max(kRounding, driven ? 2 * slowest_smoothing(model, k) : 0);
  };
  moving_span_ = {time_span_.last, time_span_.first};
  for (const Record& r : records())
    for (int k = 0; k < n_; ++k)
      for (std::size_t i = stands_still(k) ? r.size : 0; i < r.size; ++i)
        if (std::abs(r.motor_rate[k][i]) > kMoves * greatest_speed_[k]) {
          const double time = r.time(i) + r.clock_shift;
          moving_span_ = {std::min(moving_span_.first, time), std::max(moving_span_.last, time)};
        }
  if (moving_span_.last < moving_span_.first) moving_span_ = time_span_;
}

/// The coarsest grid up to kCoarseStep that has all rows.
std::shared_ptr<Evidence::Grid> Evidence::coarse_grid(const Grid& fine) {
  constexpr double kSame = 1e-6;  // of a step: logs of one rate differ by the rounding of their times
  const double dt = fine.records.front().dt;
  int times = 1;
  for (int t = 2; t * dt < 1.01 * kCoarseStep; ++t)
    if (fine.stride % t == 0) times = t;
  if (times == 1 || std::ranges::any_of(fine.records, [&](const Record& r) { return std::abs(r.dt / dt - 1) > kSame; }))
    return nullptr;
  auto coarse = std::make_shared<Grid>();
  for (const Record& record : fine.records) coarse->records.push_back(coarse_record(record, times));
  coarse->stride = fine.stride / times;
  return coarse;
}

std::unique_ptr<Evidence> Evidence::coarse_around(const Hypothesis& base) const {
  return coarse_around(base, std::vector<double>(channels(), std::numeric_limits<double>::infinity()));
}

std::unique_ptr<Evidence> Evidence::coarse_around(const Hypothesis& base, const std::vector<double>& most) const {
  if (!coarse_) return nullptr;
  std::unique_ptr<Evidence> coarse(new Evidence(*this));
  coarse->grid_ = coarse_;
  coarse->coarse_ = nullptr;
  Correction correction{base, {}};
  for (std::vector<Residuals>& residuals : predict_all({base})) {
    if (!residuals[0].finite) return nullptr;
    correction.fine.push_back(std::move(residuals[0]));
  }
  const std::vector<std::vector<Residuals>> of_coarse = coarse->predict_all({base});
  for (const std::vector<Residuals>& residuals : of_coarse)
    if (!residuals[0].finite) return nullptr;
  std::vector<double> square(channels(), 0);
  for (const Place& p : places_)
    if (p.fit)
      square[p.channel] += std::pow(
          of_coarse[p.record][0].channel[p.channel][p.index] - correction.fine[p.record].channel[p.channel][p.index],
          2);
  for (int c = 0; c < channels(); ++c)
    if (square[c] > fit_count_[c] * most[c] * most[c]) return nullptr;
  coarse->correction_ = std::move(correction);
  return coarse;
}

std::vector<std::vector<Residuals>> Evidence::predict_all(const std::vector<Hypothesis>& hypotheses) const {
  if (!correction_) return predict_on_own_grid(hypotheses);
  // In one request all have the same steps, so that errors of the grid are alike.
  std::vector<Hypothesis> with_base = hypotheses;
  with_base.push_back(correction_->base);
  std::vector<std::vector<Residuals>> all = predict_on_own_grid(with_base);
  for (std::size_t r = 0; r < all.size(); ++r) {
    const Residuals base = std::move(all[r].back());
    all[r].pop_back();
    for (Residuals& of_h : all[r])
      for (std::size_t c = 0; c < of_h.channel.size(); ++c)
        for (std::size_t i = 0; i < of_h.channel[c].size(); ++i)
          of_h.channel[c][i] += correction_->fine[r].channel[c][i] - base.channel[c][i];
  }
  return all;
}

std::vector<std::vector<Residuals>> Evidence::predict_on_own_grid(const std::vector<Hypothesis>& hypotheses) const {
  std::vector<PredictionRequest> requests;
  for (const Record& record : records()) requests.push_back({&record, &hypotheses, grid_->stride, &grid_->recent});
  return predict(requests);
}

std::vector<std::vector<double>> Evidence::fit_rows(const std::vector<Hypothesis>& hypotheses) const {
  std::vector<std::vector<double>> rows(hypotheses.size());
  const std::vector<std::vector<Residuals>> of_record = predict_all(hypotheses);
  for (std::size_t h = 0; h < hypotheses.size(); ++h) {
    bool finite = true;
    for (const auto& residuals : of_record) finite = finite && residuals[h].finite;
    if (!finite) continue;
    rows[h].reserve(row_channel_.size());
    for (const Place& p : places_)
      if (p.fit) rows[h].push_back(of_record[p.record][h].channel[p.channel][p.index]);
  }
  return rows;
}

double Evidence::over_floor(const std::vector<double>& change) const {
  std::vector<double> square(channels(), 0), count(channels(), 0);
  for (std::size_t r = 0; r < change.size(); ++r) {
    square[row_channel_[r]] += change[r] * change[r];
    count[row_channel_[r]] += 1;
  }
  double most = 0;
  for (int c = 0; c < channels(); ++c) {
    const double rms = count[c] > 0 ? std::sqrt(square[c] / count[c]) : 0;
    if (rms > 0) most = std::max(most, rms / floor_[c]);
  }
  return most;
}

std::vector<std::vector<double>> Evidence::block_products(const std::vector<double>& a,
                                                          const std::vector<double>& b) const {
  std::vector<std::vector<double>> sums(block_count_.size(), std::vector<double>(channels(), 0));
  std::size_t row = 0;
  for (const Place& p : places_) {
    if (p.fit) continue;
    sums[p.block][p.channel] += a[row] * b[row];
    ++row;
  }
  return sums;
}

Score Evidence::score(const Hypothesis& hypothesis) const {
  Score s;
  s.mean_square.assign(channels(), 0);
  s.fit_mean_square.assign(channels(), 0);
  std::vector<double> fit_count(channels(), 0), count(channels(), 0);
  const std::vector<std::vector<Residuals>> of_record = predict_all({hypothesis});
  for (const auto& residuals : of_record) s.finite = s.finite && residuals[0].finite;
  if (!s.finite) return s;
  for (const Place& p : places_) {
    const double e = of_record[p.record][0].channel[p.channel][p.index];
    if (p.fit) {
      s.fit_mean_square[p.channel] += e * e, fit_count[p.channel] += 1;
    } else {
      s.mean_square[p.channel] += e * e, count[p.channel] += 1;
      s.deciding.push_back(e);
    }
  }
  s.block_sum = block_products(s.deciding, s.deciding);
  for (int c = 0; c < channels(); ++c) {
    if (count[c] > 0) s.mean_square[c] /= count[c];
    if (fit_count[c] > 0) s.fit_mean_square[c] /= fit_count[c];
  }
  return s;
}

}  // namespace halyard
