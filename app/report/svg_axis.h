#pragma once
/// An axis of a static picture.

#include <span>
#include <vector>

namespace halyard::report {

/// Maps numbers to 0..1, evenly or by their logarithm.
class SvgAxis {
 public:
  /// From the least to the greatest of the finite numbers, on a logarithmic axis of the positive ones; `rounded` widens
  /// it to whole ticks. Without any number, or with a single one, there is some room around it.
  SvgAxis(std::span<const double> numbers, bool is_logarithmic, bool rounded);

  /// NaN for a number that the axis cannot show.
  double place(double number) const;
  /// Even steps of 1, 2 or 5; on a logarithmic axis powers of ten, and if these are few some of their multiples, or
  /// even steps, so that there are two at least.
  std::vector<double> ticks() const;

 private:
  bool is_logarithmic_;
  double from_ = 0, to_ = 1;  ///< of the logarithms
};

}  // namespace halyard::report
