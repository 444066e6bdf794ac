#include "lyrefit/diagnose/stands_still.h"

#include <cmath>

namespace lyrefit {

bool StandsStill(const Workbench& bench, const LawFit& fit, int reading) {
  constexpr double kPlausible = 3.5;
  const std::vector<Reading>& points = bench.readings->points;
  const int last = static_cast<int>(points.size()) - 1;
  const auto apart = [&](int k) {
    return k < 0 || k > last || points[k].segment != points[reading].segment;
  };
  if (!apart(reading - 1) && !apart(reading + 1)) return false;
  Readings alone = *bench.readings;
  alone.points = {points[reading]};
  alone.points[0].rate = 0;
  double current = 0;
  LawWorkspace workspace;
  return EvaluateLaw(fit.law, alone, fit.p.data(), &workspace, &current, nullptr) &&
         std::fabs(current - points[reading].current) < kPlausible * bench.sigma[reading];
}

}  // namespace lyrefit
