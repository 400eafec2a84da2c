#pragma once
/// The data of a diagnosis: records divided into blocks of time. Every other block is for fitting and the rest for
/// deciding, so that gains are measured on data that the fit did not use.

#include <memory>
#include <span>

#include "diagnosis/noise/channel_noise.h"
#include "diagnosis/prediction/recent_residuals.h"

namespace halyard {

struct Span {
  double first, last;
};

/// Mean squares of residuals, one entry for each channel (0..n-1 torque, n..2n-1 joint), and sums for each block.
struct Score {
  std::vector<double> mean_square;             ///< [2n] over the deciding blocks; 0 without data
  std::vector<double> fit_mean_square;         ///< [2n] over the fitting blocks
  std::vector<std::vector<double>> block_sum;  ///< [deciding block][2n] sums of squares
  std::vector<double> deciding;                ///< residuals of the deciding rows
  bool finite = true;
};

/// Which blocks a fit uses.
enum class Split {
  alternate,  ///< every other block; the rest decide
  none,       ///< all: for the final fit of hypotheses that were chosen already. Nothing decides
};

class Evidence {
 public:
  /// Estimates the noise of each channel with the model as given. Throws InputError if nothing can be compared.
  Evidence(std::vector<Record> data, const ArmModel& model, Split split = Split::alternate);

  /// The same rows, blocks and floors for hypotheses that resemble `base`, at two thirds of the cost: the motion is
  /// integrated on a grid of up to 4 ms, whose error at `base` is known and taken off.
  ///
  ///   r(h) = r_fine(base) + r_coarse(h) - r_coarse(base)
  ///
  /// Null if there is no such grid with the same rows, or if `base` cannot be integrated on it.
  std::unique_ptr<Evidence> coarse_around(const Hypothesis& base) const;
  /// Null, too, if the error at `base`, as root mean square over a channel's fitting rows, is more than most[channel].
  std::unique_ptr<Evidence> coarse_around(const Hypothesis& base, const std::vector<double>& most) const;

  int n() const { return n_; }
  int channels() const { return 2 * n_; }
  const std::vector<Record>& records() const { return grid_->records; }

  /// Stacked residuals of the fitting blocks for each hypothesis, [hypothesis][row]; empty if not finite.
  std::vector<std::vector<double>> fit_rows(const std::vector<Hypothesis>& hypotheses) const;
  /// The channel of each fitting row.
  const std::vector<int>& row_channel() const { return row_channel_; }
  /// The block of each fitting row; rows of all channels share their blocks.
  const std::vector<int>& row_block() const { return row_block_; }
  /// The record of each fitting row and its time, s; rows of a channel follow each other.
  const std::vector<int>& row_record() const { return row_record_; }
  const std::vector<double>& row_time() const { return row_time_; }
  /// Mean squares on both kinds of blocks.
  Score score(const Hypothesis& hypothesis) const;
  /// Σ a b over the rows of each deciding block and channel; a, b: one number for each deciding row. [block][2n]
  std::vector<std::vector<double>> block_products(const std::vector<double>& a, const std::vector<double>& b) const;
  /// True if Split::alternate leaves sample i of record r to a deciding block.
  bool decides(int r, std::size_t i) const { return block_of(r, i) % 2 != 0; }
  /// Samples in each deciding block and channel: [block][2n].
  const std::vector<std::vector<int>>& block_count() const { return block_count_; }

  /// Root mean square below which a channel's residual does not matter: what its sensor resolves, or its noise if that
  /// is larger. A joint's sensor resolves its rounding. For a motor's torque the limit is a fraction of the torque's
  /// own size. [2n]
  const std::vector<double>& floor() const { return floor_; }
  /// The part of the floor that is not noise: what each channel's sensor resolves. [2n]
  const std::vector<double>& resolved() const { return resolved_; }
  /// Noise of each channel. [2n]
  const std::vector<ChannelNoise>& noise() const { return noise_; }
  /// Root mean square of a change of the fitting rows, divided by the floor of its channel; the largest of all
  /// channels.
  double over_floor(const std::vector<double>& change) const;
  bool exceeds_floor(const std::vector<double>& change, double times) const { return over_floor(change) > times; }
  /// Number of a channel's rows that equal one independent sample, because residuals are correlated: those of 0.25 s. A
  /// slow sensor has fewer rows in this time than a fast one.
  double correlated_rows(int c) const { return correlated_rows_[c]; }
  /// The same for a sensor's white noise, which only the filters of a record correlate.
  double noise_rows() const { return noise_rows_; }
  /// From the first to the last sample of all records, s.
  Span time_span() const { return time_span_; }
  /// From the first to the last instant at which a motor, or a joint without one, moves: faster than a twentieth of its
  /// greatest speed, s. A motor that is never as fast as twice its `smoothing` speed stands still.
  Span moving_span() const { return moving_span_; }
  /// Range of joint k's motion, from its sensor or from the motors.
  Span joint_span(int k) const { return joint_span_[k]; }
  /// Range of motor k's angle, rad; of a joint without a motor: of the joint's own motion.
  Span motor_span(int k) const { return motor_span_[k]; }
  /// Greatest speed of motor k, rad/s; of a joint without a motor: of the joint.
  double greatest_speed(int k) const { return greatest_speed_[k]; }
  /// Number of fitting rows of a channel.
  int fit_count(int c) const { return fit_count_[c]; }
  bool has_channel(int c) const { return channel_rows_[c] > 0; }

 private:
  /// Records, and what was predicted of them lately.
  struct Grid {
    static constexpr std::size_t kMostRecent = 64
                                               << 20;  ///< bytes of residuals that are kept; a minute has some 300 kB
    std::vector<Record> records;
    int stride = 1;  ///< samples from a row to the next
    RecentResiduals recent{kMostRecent};
  };
  /// What coarse_around() takes off.
  struct Correction {
    Hypothesis base;
    std::vector<Residuals> fine;  ///< [record] residuals of `base`
  };
  Evidence(const Evidence&) = default;
  /// [record][hypothesis]
  std::vector<std::vector<Residuals>> predict_all(const std::vector<Hypothesis>& hypotheses) const;
  std::vector<std::vector<Residuals>> predict_on_own_grid(const std::vector<Hypothesis>& hypotheses) const;
  struct Place {
    int record;
    int channel;
    int index;
    int block;
    bool fit;
  };

  static std::shared_ptr<Grid> coarse_grid(const Grid& fine);
  /// Adds the rows of record r. Returns the first block of the next record.
  int add_rows(int r, const ArmModel& model, Split split);
  /// The block of sample i of record r, over all records.
  int block_of(int r, std::size_t i) const;
  void add_row(const Place& place, double time);
  /// Sets m of each channel, once all rows are there.
  void find_correlated_rows();
  void find_floors(const ArmModel& model);
  void find_spans(const ArmModel& model);
  void find_moving_span(const ArmModel& model);

  int n_;
  std::vector<double> correlated_rows_;
  double noise_rows_ = 1;
  double block_s_ = 1;
  std::shared_ptr<Grid> grid_;    ///< of the predictions
  std::shared_ptr<Grid> coarse_;  ///< of coarse_around(); null: there is none
  std::optional<Correction> correction_;
  std::vector<int> first_block_;  ///< [record]
  std::vector<Place> places_;
  std::vector<int> row_channel_, row_block_, row_record_;
  std::vector<double> row_time_;
  std::vector<int> channel_rows_, fit_count_;
  std::vector<std::vector<int>> block_count_;
  std::vector<ChannelNoise> noise_;
  std::vector<double> floor_, resolved_;
  Span time_span_ = {}, moving_span_ = {};
  std::vector<Span> joint_span_, motor_span_;
  std::vector<double> greatest_speed_;
};

}  // namespace halyard
