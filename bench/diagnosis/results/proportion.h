#pragma once
/// A proportion k / n of trials, and the 95 % interval of the probability behind it.

#include <fmt/format.h>

#include <boost/math/distributions/binomial.hpp>
#include <string>

namespace halyard::blind {

struct Proportion {
  int hits = 0, of = 0;

  void count(bool hit) { hits += hit, ++of; }
  double value() const { return of > 0 ? static_cast<double>(hits) / of : 0; }
  /// Clopper and Pearson, 95 %.
  double lower() const { return of > 0 ? Binomial::find_lower_bound_on_p(of, hits, 0.025) : 0; }
  double upper() const { return of > 0 ? Binomial::find_upper_bound_on_p(of, hits, 0.025) : 1; }
  /// "18/20", "90.0 %", "68.3 to 98.8 %" as three cells of a table.
  std::string cells() const {
    if (of == 0) return "0/0 | - | -";
    return fmt::format("{}/{} | {:.1f} % | {:.1f} to {:.1f} %", hits, of, 100 * value(), 100 * lower(), 100 * upper());
  }

 private:
  using Binomial = boost::math::binomial_distribution<>;
};

}  // namespace halyard::blind
