#include "lyrefit/diagnose/material.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/fit/fit_report.h"

namespace lyrefit {
double DevicePower(const Workbench& bench, const LawFit& fit) {
  const Readings& measured = *bench.readings;
  Readings grid = measured;
  grid.points.clear();
  Reading at = measured.points.front();
  for (const Reading& r : measured.points) {
    if (r.irradiance > at.irradiance) at = r;
  }
  at.x = at.rate = 0;
  const double top = 1.1 * measured.pivot_voltage;
  constexpr int kPoints = 400;
  for (int k = 0; k <= kPoints; ++k) {
    at.voltage = top * k / kPoints;
    at.current = at.irradiance > 0 ? 1 : 0;
    grid.points.push_back(at);
  }
  Law law = fit.law;
  law.effects.clear();
  std::vector<double> p(fit.p.begin(), fit.p.begin() + fit.law.base_size());
  for (std::size_t e = 0; e < fit.law.effects.size(); ++e) {
    if (fit.law.effects[e]->where != Where::kDevice) continue;
    law.effects.push_back(fit.law.effects[e]);
    const int first = fit.law.Offset(static_cast<int>(e));
    p.insert(p.end(), fit.p.begin() + first, fit.p.begin() + first + fit.law.effects[e]->size());
  }
  LawWorkspace workspace;
  std::vector<double> current(grid.points.size());
  if (!EvaluateLaw(law, grid, p.data(), &workspace, current.data(), nullptr)) return kUnknown;
  int best = 0;
  const auto power = [&](int k) { return grid.points[k].voltage * current[k]; };
  for (int k = 1; k <= kPoints; ++k) best = power(k) > power(best) ? k : best;
  double peak = power(best);
  if (best > 0 && best < kPoints) {  // the parabola's top
    const double a = power(best - 1), b = power(best), c = power(best + 1);
    const double bend = a - 2 * b + c;
    if (bend < 0) peak = b - (a - c) * (a - c) / (8 * bend);
  }
  return peak * measured.scale.cells * measured.scale.current_A;
}

LawFit TakenOut(const LawFit& fit, int index) {
  LawFit rest = fit;
  const int first = fit.law.Offset(index), size = fit.law.effects[index]->size();
  rest.p.erase(rest.p.begin() + first, rest.p.begin() + first + size);
  rest.law.effects.erase(rest.law.effects.begin() + index);
  return rest;
}

LawFit WithoutEffects(const LawFit& fit) {
  LawFit rest = fit;
  rest.p.resize(fit.law.base_size());
  rest.law.effects.clear();
  return rest;
}

Without MakeWithout(const Workbench& bench, const LawFit& fit) {
  return {fit, PlainBasis(bench, fit), DevicePower(bench, fit)};
}

EffectSize SizeOf(const Workbench& bench, const LawFit& with, int index, const LawFit& without) {
  return SizeOf(bench, with, index, MakeWithout(bench, without));
}

EffectSize SizeOf(const Workbench& bench, const LawFit& with, int index, const Without& without) {
  constexpr double kReach = 1.96;
  EffectSize size;
  size.current = Departure(bench, without.fit, without.basis, with.current);
  const double power = DevicePower(bench, with);
  size.power = power / without.power - 1;
  if (with.law.effects[index]->where == Where::kDevice) {
    size.recoverable = DevicePower(bench, TakenOut(with, index)) / power - 1;
  }
  size.power_error = kReach * bench.path;
  const double statistic = (without.fit.sum - with.sum) / NoiseVariance(bench, with);
  size.reach = statistic > kReach * kReach ? kReach / std::sqrt(statistic) : 1;
  return size;
}

bool IsMaterial(const EffectSize& size, const Floors& floors) {
  const double certain = 1 - size.reach;
  return size.current * certain >= floors.current ||
         // False where there is no power.
         std::fabs(size.power) * certain - size.power_error >= floors.power;
}

}  // namespace lyrefit
