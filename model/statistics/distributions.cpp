#include "model/statistics/distributions.h"

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace halyard {

using boost::math::complement;
using boost::math::quantile;

double normal_quantile(double p) { return quantile(boost::math::normal(), p); }

double chi_square_quantile(double degrees_of_freedom, double p) {
  return quantile(boost::math::chi_squared(degrees_of_freedom), p);
}

double t_quantile(double degrees_of_freedom, double upper_tail) {
  return quantile(complement(boost::math::students_t(degrees_of_freedom), upper_tail));
}

double t_upper_tail(double degrees_of_freedom, double t) {
  return boost::math::cdf(complement(boost::math::students_t(degrees_of_freedom), t));
}

double beta_quantile(double a, double b, double upper_tail) {
  return quantile(complement(boost::math::beta_distribution<>(a, b), upper_tail));
}

}  // namespace halyard
