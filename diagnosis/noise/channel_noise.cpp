#include "diagnosis/noise/channel_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "diagnosis/log_check/robust.h"
#include "diagnosis/noise/delay_free.h"
#include "diagnosis/noise/ripple_free.h"
#include "model/statistics/quantile.h"

namespace halyard {
namespace {

constexpr double kLowest = 10;  ///< Hz; below it the errors of a model are
constexpr double kSegment = 1;  ///< s, and at least so many samples:
constexpr int kFewestSamples = 64;
constexpr int kShortestRun = 16;     ///< samples: of shorter runs nothing is told
constexpr double kHighest = 80;      ///< Hz; an encoder's rounding is not white far above what is compared
constexpr double kBand = 2;          ///< from the lower edge of a band to the upper
constexpr double kLineFrom = 22;     ///< Hz: above what is compared
constexpr double kLineTo = 150;      ///< Hz: above, the filter of the record leaves nothing to see
constexpr double kLineOver = 30;     ///< times its surroundings: by chance once in e^20 bins
constexpr double kSurroundings = 8;  ///< Hz on either side

constexpr double kMedianOverMean = std::numbers::ln2;  ///< of the power of noise in very many segments

/// The same of n segments, by the median as median() takes it: 1 of one.
double median_over_mean(std::size_t n) {
  double sum = 0;
  for (std::size_t i = n - n / 2; i <= n; ++i) sum += 1 / static_cast<double>(i);
  return sum;
}

/// Mean of the bins of [from, to); infinite if there is none.
double mean_of_band(const std::vector<double>& density, double resolution, double from, double to) {
  double sum = 0, count = 0;
  for (std::size_t b = 0; b < density.size(); ++b)
    if (const double f = static_cast<double>(b) * resolution; f >= from && f < to) sum += density[b], count += 1;
  return count > 0 ? sum / count : std::numeric_limits<double>::infinity();
}

/// The bins that stand out of their surroundings, each with its neighbours as one line.
std::vector<NoiseLine> lines_of(const std::vector<double>& density, double resolution) {
  std::vector<NoiseLine> lines;
  // A Hann window spreads a sine over two bins on either side.
  constexpr std::size_t kSpread = 2;
  const auto first = std::max(kSpread, static_cast<std::size_t>(std::ceil(kLineFrom / resolution)));
  const auto last = std::min(density.size(), static_cast<std::size_t>(kLineTo / resolution));
  const auto reach = static_cast<std::size_t>(kSurroundings / resolution);
  for (std::size_t b = first; b + kSpread < last; ++b) {
    const auto from = density.begin() + static_cast<std::ptrdiff_t>(b - kSpread);
    if (density[b] < *std::max_element(from, from + 2 * kSpread + 1)) continue;
    std::vector<double> around;
    for (std::size_t i = b - std::min(b, reach); i < std::min(density.size(), b + reach + 1); ++i)
      if (i + kSpread < b || i > b + kSpread) around.push_back(density[i]);
    if (around.empty()) continue;
    const double ground = median(around);
    if (!(density[b] > kLineOver * ground)) continue;
    double power = 0;
    for (std::size_t i = b - kSpread; i <= b + kSpread; ++i) power += std::max(0.0, density[i] - ground) * resolution;
    // A line is no noise: the median over segments is its mean, which the density's correction has enlarged.
    lines.push_back({static_cast<double>(b) * resolution, std::sqrt(2 * power * kMedianOverMean)});
  }
  return lines;
}

/// Standard deviation of a compared sample in white noise of this spectral density.
double in_band_of(double density, double nyquist, double filter_sigma) {
  return std::sqrt(std::min(density * nyquist, density / (4 * std::sqrt(std::numbers::pi) * filter_sigma)));
}

/// The noise, at least what the model states for the sensor.
ChannelNoise at_least(double stated, ChannelNoise noise, double nyquist, double filter_sigma) {
  noise.white = std::max(noise.white, stated);
  noise.in_band = std::max(noise.in_band, in_band_of(stated * stated / nyquist, nyquist, filter_sigma));
  return noise;
}

/// What a channel measured without what the model predicted, on the samples that its sensor took.
struct ChannelSamples {
  std::vector<std::vector<double>> runs;          ///< evenly spaced, one for each record
  std::vector<std::vector<double>> motor_angle;   ///< of a torque: the motor's, at the same samples
  std::vector<std::vector<double>> command_rate;  ///< of a torque: the command's, N m/s
  double interval = 0;                            ///< s, the same in all runs

  double duration() const {
    double samples = 0;
    for (const std::vector<double>& run : runs) samples += static_cast<double>(run.size());
    return samples * interval;
  }
};

/// Puts a run to those of its sample rate.
void add_run(std::vector<ChannelSamples>& by_rate, double interval, std::vector<double> run,
             std::vector<double> motor_angle = {}, std::vector<double> command_rate = {}) {
  constexpr double kSame = 0.1;  // of the interval
  if (run.empty()) return;
  auto same = std::ranges::find_if(
      by_rate, [&](const ChannelSamples& s) { return std::abs(s.interval - interval) < kSame * s.interval; });
  if (same == by_rate.end()) same = by_rate.insert(same, {{}, {}, {}, interval});
  same->runs.push_back(std::move(run));
  same->motor_angle.push_back(std::move(motor_angle));
  same->command_rate.push_back(std::move(command_rate));
}

/// The sensor's own samples: between them, the readings of a record are interpolated, which attenuates noise.
std::vector<ChannelSamples> joint_samples(const std::vector<Record>& records, const std::vector<Residuals>& unfiltered,
                                          int k) {
  std::vector<ChannelSamples> by_rate;
  for (std::size_t r = 0; r < records.size(); ++r) {
    const Record& record = records[r];
    if (!record.has_joint(k)) continue;
    const auto predicted = [&](std::size_t i) { return record.joint[k][i] - unfiltered[r].channel[record.n + k][i]; };
    std::vector<double> run, times;
    for (const SensorSample& s : record.joint_samples[k]) {
      const double at = (s.time - record.start) / record.dt;
      if (!(at >= 0 && at < static_cast<double>(record.size - 1))) continue;
      const auto i = static_cast<std::size_t>(at);
      const double e = s.value - std::lerp(predicted(i), predicted(i + 1), at - static_cast<double>(i));
      if (std::isfinite(e)) run.push_back(e), times.push_back(s.time);
    }
    add_run(by_rate, mean_interval(times), std::move(run));
  }
  return by_rate;
}

std::vector<ChannelSamples> torque_samples(const std::vector<Record>& records, const std::vector<Residuals>& unfiltered,
                                           int k) {
  std::vector<ChannelSamples> by_rate;
  for (std::size_t r = 0; r < records.size(); ++r) {
    if (!records[r].has_torque(k)) continue;
    const std::vector<double>&residual = unfiltered[r].channel[k], &command = records[r].torque[k];
    std::vector<double> times, run, angle, rate;
    for (std::size_t i = 0; i < residual.size(); ++i) {
      if (!std::isfinite(residual[i])) continue;
      const std::size_t before = i - std::min<std::size_t>(i, 1), after = std::min(i + 1, command.size() - 1);
      times.push_back(records[r].time(i));
      run.push_back(residual[i]);
      angle.push_back(records[r].motor_angle[k][i]);
      rate.push_back((command[after] - command[before]) / (records[r].dt * static_cast<double>(after - before)));
    }
    add_run(by_rate, mean_interval(times), std::move(run), std::move(angle), std::move(rate));
  }
  return by_rate;
}

/// σ_t of a record's filter of the motion, and of both filters, s.
struct Filters {
  double motion_sigma = 0, both_sigma = 0;
};

/// is_torque: the filter of the motion has attenuated it.
ChannelNoise noise_of(const ChannelSamples& samples, const Filters& filters, bool is_torque) {
  int segment = std::max(kFewestSamples, static_cast<int>(std::lround(kSegment / samples.interval)));
  // A short log of a slow sensor has fewer samples: then its longest run is the only segment.
  int longest = 0;
  for (const std::vector<double>& run : samples.runs) longest = std::max(longest, static_cast<int>(run.size()));
  if (longest >= kShortestRun) segment = std::min(segment, longest - longest % 2);
  NoiseDensity density = median_density(samples.runs, samples.interval, segment);
  const double resolution = 1 / (samples.interval * segment);
  double highest = 0.5 / samples.interval;
  if (is_torque) {
    const double omega_sigma = 2 * std::numbers::pi * filters.motion_sigma;
    // Above its cut-off the record's filter leaves too little of the torque to divide by.
    highest = std::min(highest, 1 / omega_sigma);
    for (std::size_t b = 0; b < density.of_bin.size(); ++b)
      density.of_bin[b] *= std::exp(std::pow(omega_sigma * static_cast<double>(b) * resolution, 2));
  }
  return noise_of_density(density, resolution, highest, filters.both_sigma);
}

ChannelNoise torque_noise(ChannelSamples samples, const Filters& filters) {
  // So many sines fit a part of any noise: in the narrowest band of 30 s of noise less than a tenth of its size.
  constexpr double kByChance = 0.8;
  ChannelNoise noise = noise_of(samples, filters, true);
  const auto take_if_less = [&](const std::vector<std::vector<double>>& runs) {
    const ChannelNoise without = noise_of({runs, {}, {}, samples.interval}, filters, true);
    if (without.white < kByChance * noise.white) noise.white = without.white, noise.in_band = without.in_band;
  };
  samples.runs = ripple_free(std::move(samples.runs), samples.motor_angle);
  take_if_less(samples.runs);
  take_if_less(delay_free(std::move(samples.runs), samples.command_rate, samples.interval));
  return noise;
}

/// Of a channel whose records have different sample rates: the mean variance over their time.
template <class Estimate>
ChannelNoise over_rates(const std::vector<ChannelSamples>& by_rate, const Estimate& estimate) {
  ChannelNoise all;
  double time = 0, longest = 0, white = 0, in_band = 0;
  for (const ChannelSamples& samples : by_rate) {
    ChannelNoise noise = estimate(samples);
    const double t = samples.duration();
    time += t, white += t * std::pow(noise.white, 2), in_band += t * std::pow(noise.in_band, 2);
    if (t > longest) longest = t, all.lines = std::move(noise.lines);
  }
  if (time > 0) all.white = std::sqrt(white / time), all.in_band = std::sqrt(in_band / time);
  return all;
}

}  // namespace

NoiseDensity median_density(const std::vector<std::vector<double>>& samples, double interval, int segment) {
  Eigen::FFT<double> fft;
  std::vector<double> window(segment);
  double power = 0;
  for (int i = 0; i < segment; ++i) {
    window[i] = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * (i + 0.5) / segment);
    power += window[i] * window[i];
  }
  const int bins = segment / 2;
  std::vector<std::vector<double>> at(bins);
  std::vector<double> part(segment);
  std::vector<std::complex<double>> amplitude;
  for (const std::vector<double>& run : samples)
    for (std::size_t first = 0; first + segment <= run.size(); first += segment / 2) {
      double mean = 0;
      for (int i = 0; i < segment; ++i) mean += run[first + i] / segment;
      if (!std::isfinite(mean)) continue;
      for (int i = 0; i < segment; ++i) part[i] = window[i] * (run[first + i] - mean);
      fft.fwd(amplitude, part);
      for (int b = 0; b < bins; ++b) at[b].push_back(2 * interval * std::norm(amplitude[b]) / power);
    }
  NoiseDensity density;
  if (at.empty() || at[0].empty()) return density;
  density.too_large = median_over_mean(at[0].size()) / kMedianOverMean;
  for (const std::vector<double>& of_bin : at) density.of_bin.push_back(median(of_bin) / kMedianOverMean);
  return density;
}

ChannelNoise noise_of_density(const NoiseDensity& density, double resolution, double nyquist, double filter_sigma) {
  ChannelNoise noise;
  if (density.of_bin.empty()) return noise;
  double white = std::numeric_limits<double>::infinity();
  // A slow sensor has the upper third of its spectrum alone. Of several bands the least is too small by chance, by as
  // much as the median of few segments is too large.
  if (nyquist <= 1.5 * kLowest)
    white = mean_of_band(density.of_bin, resolution, nyquist * 2 / 3, nyquist) / density.too_large;
  else
    for (double from = kLowest; from < std::min(0.7 * nyquist, kHighest); from *= kBand)
      white = std::min(white, mean_of_band(density.of_bin, resolution, from, std::min(kBand * from, nyquist)));
  if (!std::isfinite(white)) return noise;
  noise.white = std::sqrt(white * nyquist);
  noise.in_band = in_band_of(white, nyquist, filter_sigma);
  noise.lines = lines_of(density.of_bin, resolution);
  return noise;
}

std::vector<ChannelNoise> channel_noise(const std::vector<Record>& records, const Hypothesis& given) {
  const int n = records.front().n;
  std::vector<ChannelNoise> noise(2 * n);
  std::vector<Residuals> unfiltered;
  Filters filters;
  for (Record record : records) {
    filters.motion_sigma = std::max(filters.motion_sigma, record.motion_sigma);
    filters.both_sigma = std::max(filters.both_sigma, record.filter_sigma());
    record.compare = {1};
    record.compare_sigma = 0;  // samples are compared as they are
    // A reading between grid points needs the prediction at both, also where nothing was measured.
    record.joint_measured = record.joint_valid;
    unfiltered.push_back(predict(record, {given}, 1)[0]);
    if (!unfiltered.back().finite) return noise;
  }
  for (int k = 0; k < n; ++k) {
    noise[k] = over_rates(torque_samples(records, unfiltered, k),
                          [&](const ChannelSamples& samples) { return torque_noise(samples, filters); });
    const double stated = given.nominal.joint[k].joint_encoder_noise;
    noise[n + k] = over_rates(joint_samples(records, unfiltered, k), [&](const ChannelSamples& samples) {
      return at_least(stated, noise_of(samples, filters, false), 0.5 / samples.interval, filters.both_sigma);
    });
  }
  return noise;
}

}  // namespace halyard
