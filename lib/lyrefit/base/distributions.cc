#include "lyrefit/base/distributions.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace lyrefit {

using boost::math::complement;

double NormalTail(double x) { return cdf(complement(boost::math::normal(), x)); }

double ChiSquaredTail(double x, double degrees) {
  return cdf(complement(boost::math::chi_squared(degrees), x));
}

// In double precision throughout: long double takes several times as long, and this is asked often.
double FisherTail(double x, double degrees_above, double degrees_below) {
  using Policy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
  const boost::math::fisher_f_distribution<double, Policy> law(degrees_above, degrees_below);
  return cdf(complement(law, x));
}

double NormalAbove(double tail) { return quantile(complement(boost::math::normal(), tail)); }

double StudentQuantile(double p, double degrees) {
  return quantile(boost::math::students_t(degrees), p);
}

}  // namespace lyrefit
