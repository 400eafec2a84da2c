#pragma once
/// Quantiles and tails of the distributions that tests and intervals use. Boost's take seconds to compile in each file
/// that includes them. So only one source file does, and all other code calls these functions.

namespace halyard {

/// The value below which a standard normal number is with probability p.
double normal_quantile(double p);
/// The value below which χ² of so many degrees of freedom is with probability p.
double chi_square_quantile(double degrees_of_freedom, double p);
/// The value that Student's distribution exceeds with probability `upper_tail`.
double t_quantile(double degrees_of_freedom, double upper_tail);
/// The probability of a value of Student's distribution above t.
double t_upper_tail(double degrees_of_freedom, double t);
/// The value that the beta distribution of the shapes a, b exceeds with probability `upper_tail`.
double beta_quantile(double a, double b, double upper_tail);

}  // namespace halyard
