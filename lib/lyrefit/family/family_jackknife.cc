#include <algorithm>
#include <cmath>

#include "lyrefit/base/observer.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/estimate/fit/statistics.h"
#include "lyrefit/family/family_judge.h"
#include "lyrefit/model/extended_set.h"

namespace lyrefit {

std::optional<std::vector<Interval>> Jackknife(const ReportedFit& fit,
                                               const std::vector<Estimate>& estimates, int threads,
                                               const Observer& observer) {
  const FamilyProblem& family = fit.family;
  const JointProblem& problem = fit.problem;
  const JointEnd& end = fit.end;
  const int curves = static_cast<int>(problem.curves.size());
  const int count = family.translation.size();
  std::vector<std::vector<double>> without(curves);
  const ProgressReporter progress(observer, "jackknife", curves);
  ParallelFor(curves, threads, [&](int c) {
    if (progress.Stopped()) return;
    JointProblem rest = problem;
    JointPoint start = end.point;
    rest.curves.erase(rest.curves.begin() + c);
    start.local.erase(start.local.begin() + c);
    JointOptions quick;
    quick.function_tolerance = 1e-9;
    quick.stop = progress.stop();
    without[c] = ReportedShared(family.translation, RefineJointly(rest, start, quick).point.shared);
    progress.Step();
  });
  if (progress.Stopped()) return {};
  const double t = StudentT95(std::max(curves - 1, 1));
  const std::vector<double> whole = ReportedShared(family.translation, end.point.shared);
  std::vector<Interval> intervals;
  intervals.reserve(count);
  for (int i = 0; i < count; ++i) {
    Interval interval;
    interval.value = whole[i];
    if (std::isnan(family.fixed[i]) && curves > 2) {
      const ParameterKind kind = family.translation.parameters[i].kind;
      double mean = 0, squares = 0;
      for (const auto& shared : without) mean += ToScale(kind, shared[i]) / curves;
      for (const auto& shared : without) {
        const double off = ToScale(kind, shared[i]) - mean;
        squares += off * off;
      }
      const double error = std::sqrt(squares * (curves - 1) / curves);
      interval = SymmetricInterval(whole[i], error / StepOnScale(kind, whole[i], 1), t, kind,
                                   estimates[i].bounds);
    }
    intervals.push_back(interval);
  }
  return intervals;
}

}  // namespace lyrefit
