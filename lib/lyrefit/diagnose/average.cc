#include "lyrefit/diagnose/average.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "lyrefit/base/groups.h"
#include "lyrefit/base/median.h"
#include "lyrefit/diagnose/breaks.h"
#include "lyrefit/model/make_readings.h"

namespace lyrefit {
namespace {

constexpr int kEnough = 300;          // sufficient number of averages in all
constexpr int kFewestInStretch = 40;  // smallest number of averages of a monotone stretch

// Marks readings at an instrument limit, which are not averaged.
std::vector<char> SetApart(const Measurement& measurement) {
  const ValueFindings& values = measurement.values;
  std::vector<char> alone(measurement.readings.points.size(), 0);
  for (const auto* set : {&values.clipped, &values.at_lower, &values.at_voltage_limit}) {
    for (const int k : *set) alone[k] = 1;
  }
  return alone;
}

// Groups readings within each monotone stretch. Readings marked in `alone` form their own groups.
Grouping GroupStretches(const Readings& readings, const std::vector<char>& alone) {
  const int count = static_cast<int>(readings.points.size());
  GroupRule stretch, within;
  for (const Reading& r : readings.points) stretch.place.push_back(r.segment);
  within.alone = alone;
  const Grouping stretches = GroupByRule(count, stretch);
  Grouping first;
  for (int s = 0; s < GroupCount(stretches); ++s) {
    const int begin = stretches[s], end = stretches[s + 1];
    within.most = std::min((count + kEnough / 2) / kEnough, (end - begin) / kFewestInStretch);
    AppendGroups(begin, end, within, &first);
  }
  first.push_back(count);
  return first;
}

// Mean of readings `begin` to `end` - 1. Its current is the mean of `off`, the distance from a
// model.
Reading Mean(const std::vector<Reading>& points, int begin, int end,
             const std::vector<double>& off) {
  Reading mean = points[begin];
  const double n = end - begin;
  double voltage = 0, x = 0, rate = 0, irradiance = 0, distance = 0, square = 0;
  for (int k = begin; k < end; ++k) {
    const Reading& r = points[k];
    voltage += r.voltage / n;
    x += r.x / n;
    rate += r.rate / n;
    irradiance += r.irradiance / n;
    distance += off[k] / n;
    square += off[k] * off[k] / n;
  }
  if (end - begin > 1) {
    mean.voltage = voltage;
    mean.x = x;
    mean.rate = rate;
    mean.irradiance = irradiance;
  }
  mean.current = distance;
  mean.weight = n;
  mean.scatter = std::max(0.0, square - distance * distance);
  return mean;
}

// The measurement with one point per group. Its currents are means of `off`, the distance from a
// model.
Averaged TakeMeans(const Measurement& measurement, Grouping first, const std::vector<double>& off) {
  const ValueFindings& values = measurement.values;
  Averaged averaged;
  averaged.measurement = measurement;
  Measurement& means = averaged.measurement;
  means.values.rounding = MeanErrors(first, values.rounding);
  means.values.bin_rounding = MeanErrors(first, values.bin_rounding);
  means.stated_sigma = MeanErrors(first, measurement.stated_sigma);
  means.values.clipped = GroupsWith(first, values.clipped);
  means.values.at_lower = GroupsWith(first, values.at_lower);
  means.values.at_voltage_limit = GroupsWith(first, values.at_voltage_limit);
  std::vector<Reading>& points = means.readings.points;
  points.clear();
  for (std::size_t g = 0; g + 1 < first.size(); ++g) {
    points.push_back(Mean(measurement.readings.points, first[g], first[g + 1], off));
  }
  means.readings.traits.readings = static_cast<int>(points.size());
  averaged.first = std::move(first);
  return averaged;
}

// Possible irradiance steps lie between two readings, so the candidate times are set between the
// last reading of one average and the first of the next.
void SetStepTimesBetween(const Readings& readings, const Grouping& first, DataTraits* traits) {
  traits->step_times.clear();
  for (std::size_t g = 2; traits->single && g + 2 < first.size(); ++g) {
    const Reading &before = readings.points[first[g] - 1], &after = readings.points[first[g]];
    traits->step_times.push_back(0.5 * (before.x + after.x));
  }
}

// All readings with equal weights, without those at a limit. The result refers to `measurement`,
// which must outlive it.
WeightedData WeightedDataOf(const Measurement& measurement) {
  const std::size_t count = measurement.readings.points.size();
  WeightedData weighted;
  weighted.readings = {std::shared_ptr<const Readings>(), &measurement.readings};
  weighted.sigma.assign(count, 1e-3);
  weighted.used.assign(count, 1);
  for (const int k : measurement.values.at_lower) weighted.used[k] = 0;
  for (const int k : measurement.values.at_voltage_limit) weighted.used[k] = 0;
  return weighted;
}

// Current of the fit at every reading; false if the law cannot be evaluated.
bool CurrentsAt(const Readings& readings, const LawFit& fit, std::vector<double>* current) {
  current->assign(readings.points.size(), 0.0);
  LawWorkspace workspace;
  return EvaluateLaw(fit.law, readings, fit.p.data(), &workspace, current->data(), nullptr);
}

// The base model fitted to plain means of the currents. It is accurate enough to describe the
// curvature within groups.
LawFit FitPlainMeans(const Measurement& measurement, const Law& base,
                     const ProgressReporter& progress) {
  std::vector<double> currents;
  for (const Reading& r : measurement.readings.points) currents.push_back(r.current);
  const Averaged plain =
      TakeMeans(measurement, GroupStretches(measurement.readings, SetApart(measurement)), currents);
  WeightedData weighted = WeightedDataOf(plain.measurement);
  if (plain.measurement.readings.points.size() > kQuickToFit) weighted.progress = progress;
  return FitBase(weighted, base);
}

}  // namespace

bool IsLong(const Readings& readings) {
  return 2 * static_cast<int>(readings.points.size()) >= 3 * kEnough;
}

Averaged Average(const Measurement& measurement, const Law& base,
                 const ProgressReporter& progress) {
  const Readings& readings = measurement.readings;
  LawFit fit = FitPlainMeans(measurement, base, progress);
  const bool known = fit.usable && CurrentsAt(readings, fit, &fit.current);
  if (!known) fit.current.assign(readings.points.size(), 0.0);
  std::vector<double> off;
  for (std::size_t k = 0; k < readings.points.size(); ++k) {
    off.push_back(readings.points[k].current - fit.current[k]);
  }
  std::vector<char> alone = SetApart(measurement);
  WeightedData weighted = WeightedDataOf(measurement);
  TakeNoise(measurement, fit, &weighted);
  MarkSudden(readings.points, off, weighted.sigma, &alone);
  Averaged averaged =
      TakeMeans(measurement, CutAtJumps(GroupStretches(readings, alone), off, weighted.sigma), off);
  Readings& means = averaged.measurement.readings;
  std::vector<double> model(means.points.size(), 0.0);
  if (known) CurrentsAt(means, fit, &model);
  for (std::size_t k = 0; k < means.points.size(); ++k) {
    const int first = averaged.first[k];
    if (averaged.first[k + 1] - first > 1) {
      means.points[k].current += model[k];
    } else {
      means.points[k].current = readings.points[first].current;
    }
  }
  SetStepTimesBetween(readings, averaged.first, &means.traits);
  SetRangeCurrents(&means);
  return averaged;
}

AtReadings AtItsReadings(const Selection& selection) {
  AtReadings at;
  at.weighted = selection.weighted;
  at.noise = selection.noise;
  at.base = selection.base.current;
  at.extended = selection.extended.current;
  at.first = EachAlone(at.base.size());
  if (!CurrentsAt(*at.weighted.readings, WithoutEffects(selection.extended), &at.without)) {
    at.without.assign(at.base.size(), kUnknown);
  }
  return at;
}

AtReadings AtItsReadings(const Selection& selection, const Averaged& averaged,
                         const Measurement& measurement) {
  const Readings& readings = measurement.readings;
  const auto currents = [&](const LawFit& fit) {
    std::vector<double> at;
    if (!CurrentsAt(readings, fit, &at)) at.assign(readings.points.size(), kUnknown);
    return at;
  };
  AtReadings at;
  at.first = averaged.first;
  at.weighted = WeightedDataOf(measurement);
  for (std::size_t g = 0; g + 1 < at.first.size(); ++g) {
    std::fill(at.weighted.used.begin() + at.first[g], at.weighted.used.begin() + at.first[g + 1],
              selection.weighted.used[g]);
  }
  LawFit extended = selection.extended;
  extended.current = currents(selection.extended);
  const bool plain = extended.law.effects.empty();
  at.base = plain && selection.base.p == extended.p ? extended.current : currents(selection.base);
  at.without = plain ? extended.current : currents(WithoutEffects(extended));
  at.noise = TakeNoise(measurement, extended, &at.weighted);
  at.extended = std::move(extended.current);
  return at;
}

}  // namespace lyrefit
