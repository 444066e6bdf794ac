#include "lyrefit/base/distributions.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace lyrefit {

using boost::math::complement;

namespace {

// Double precision throughout. Boost's default, long double, takes several times as long for no
// needed accuracy. Under valgrind, long double has fewer digits than its type promises, and the
// algorithms do not terminate.
using Policy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
using Normal = boost::math::normal_distribution<double, Policy>;
using ChiSquared = boost::math::chi_squared_distribution<double, Policy>;
using Fisher = boost::math::fisher_f_distribution<double, Policy>;
using Student = boost::math::students_t_distribution<double, Policy>;

}  // namespace

double NormalTail(double x) { return cdf(complement(Normal(), x)); }

double ChiSquaredTail(double x, double degrees) { return cdf(complement(ChiSquared(degrees), x)); }

double FisherTail(double x, double degrees_above, double degrees_below) {
  if (!(x > 0)) return 1;
  return cdf(complement(Fisher(degrees_above, degrees_below), x));
}

double NormalAbove(double tail) { return quantile(complement(Normal(), tail)); }

double StudentQuantile(double p, double degrees) { return quantile(Student(degrees), p); }

}  // namespace lyrefit
