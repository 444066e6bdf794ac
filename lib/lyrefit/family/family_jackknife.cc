#include <cmath>

#include "lyrefit/base/parallel.h"
#include "lyrefit/base/shared_observer.h"
#include "lyrefit/family/family_judge.h"
#include "lyrefit/fit/statistics.h"

namespace lyrefit {

void Jackknife(const FamilyProblem& family, const JointProblem& problem, const JointEnd& end,
               int threads, const Observer& observer, FamilyReport* report) {
  const int curves = static_cast<int>(problem.curves.size());
  const int count = family.translation.size();
  std::vector<std::vector<double>> without(curves);
  SharedObserver watch(observer, "jackknife", curves);
  watch.Begin();
  ParallelFor(curves, threads, [&](int c) {
    if (watch.Stopped()) return;
    JointProblem rest = problem;
    JointPoint start = end.point;
    rest.curves.erase(rest.curves.begin() + c);
    start.local.erase(start.local.begin() + c);
    JointOptions quick;
    quick.function_tolerance = 1e-9;
    quick.proceed = watch.Proceed();
    without[c] = RefineJointly(rest, start, quick).point.shared;
    watch.FinishJob();
  });
  if (watch.Stopped()) {
    report->interrupted = true;
    return;
  }
  const double t = StudentT95(std::max(curves - 1, 1));
  const Translation& at = family.translation;
  report->jackknife.clear();
  for (int i = 0; i < count; ++i) {
    Interval interval;
    interval.value = end.point.shared[i];
    if (std::isnan(family.fixed[i]) && curves > 2) {
      // Logarithms and conductances, as for the other intervals.
      const bool log = i == at.saturation_current || i == at.saturation_current_2;
      const bool shunt = i == at.resistance_shunt || i == at.resistance_shunt_dark;
      const auto scale = [&](double x) { return log ? std::log(x) : shunt ? 1 / x : x; };
      double mean = 0, squares = 0;
      for (const auto& shared : without) mean += scale(shared[i]) / curves;
      for (const auto& shared : without) {
        squares += (scale(shared[i]) - mean) * (scale(shared[i]) - mean);
      }
      const double error = std::sqrt(squares * (curves - 1) / curves);
      const double middle = scale(interval.value);
      const double low = middle - t * error, high = middle + t * error;
      interval.low_95 = log ? std::exp(low) : shunt ? 1 / high : low;
      interval.high_95 = log ? std::exp(high) : shunt ? (low > 0 ? 1 / low : kInfinity) : high;
      interval.standard_error = log     ? error * interval.value
                                : shunt ? error * interval.value * interval.value
                                        : error;
    }
    report->jackknife.push_back(interval);
  }
}

}  // namespace lyrefit
