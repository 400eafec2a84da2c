#pragma once
/// Sensor noise of each channel, estimated from a log, and lines in the spectrum above the compared band.
///
/// The errors of a model are slow: they follow the motion. What lies above 10 Hz is mostly noise of the sensors, so the
/// spectrum of measured minus predicted tells how large that noise is:
///
///   S(f)     = median over segments of 2 Δ |Σ w e exp(-2πi f t)|² / Σ w² / ln 2     spectral density, unit² / Hz
///   S_white  = least mean of S over the bands 10 to 20, 20 to 40, 40 to 80 Hz that begin below 0.7 f_N; of a sensor
///              with f_N <= 15 Hz the mean over 2/3 f_N to f_N
///   white²   = S_white f_N
///   in_band² = S_white / (4 √π σ_t),   at most white²
///
///   e        residual of the model as given, before the comparing filter
///   Δ        mean sample interval of the sensor, s
///   f_N      Nyquist frequency 1 / (2 Δ), Hz; of a torque at most the cut-off of the record's filter of the motion
///   w        Hann window over a segment of one second; segments overlap by half
///   ln 2     median over mean of an exponential distribution, which the spectral density of noise has
///   σ_t      standard deviation of both filters of a record together (record.h), s
///
/// A joint sensor has at least the noise that the model states. Logs of different sample rates are estimated each with
/// its own Δ; the variance is their mean over time.
/// The parts of a torque's residual that repeat with the motor's angle (ripple_free.h), or go with the rate of its
/// command (delay_free.h), do not count.
/// The median ignores segments with a jump or an impact, and those in which samples are left out and the rest joined.
/// The least of the three bands ignores resonances and hum, because each lies in one band only. A record's filter, of
/// standard deviation σ_m in time, attenuates the torque by exp(-(2π f σ_m)²); S is corrected for it.
/// Source: Welch, IEEE Trans. Audio Electroacoust. 15 (1967), with the median in place of the mean.

#include <vector>

#include "diagnosis/prediction/prediction.h"

namespace halyard {

/// A narrow line of a spectrum: hum of the mains, a resonance, chatter.
struct NoiseLine {
  double frequency = 0;  ///< Hz
  double amplitude = 0;  ///< of the sine, unit of the channel
};

struct ChannelNoise {
  /// Standard deviation of a single sample; of a torque: of what lies below f_N, at most 60 Hz with kFitBand.
  double white = 0;
  double in_band = 0;  ///< standard deviation of a compared sample, after the record's filters
  std::vector<NoiseLine> lines;
};

/// Spectral density of a residual over segments of its samples.
struct NoiseDensity {
  std::vector<double> of_bin;  ///< one-sided: the median over the segments, over ln 2 as of noise in very many
  double too_large = 1;        ///< expected density of white noise in so many segments, over the true one
};

/// The noise in a density.
///   density       bin b is the frequency b * resolution
///   nyquist       Hz
///   filter_sigma  σ_t of both filters of a record, s
ChannelNoise noise_of_density(const NoiseDensity& density, double resolution, double nyquist, double filter_sigma);

/// Median density over the segments of evenly spaced samples; segments with NaN do not count. Empty: no segment.
///   interval  s, from a sample to the next
///   segment   samples of a segment
NoiseDensity median_density(const std::vector<std::vector<double>>& samples, double interval, int segment);

/// [2n] as the channels of Residuals; zero where a channel has no data or the hypothesis cannot be integrated.
std::vector<ChannelNoise> channel_noise(const std::vector<Record>& records, const Hypothesis& given);

}  // namespace halyard
