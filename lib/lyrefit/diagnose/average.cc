#include "lyrefit/diagnose/average.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <queue>
#include <utility>

#include "lyrefit/base/median.h"
#include "lyrefit/model/make_readings.h"
#include "lyrefit/model/reading.h"

namespace lyrefit {
namespace {

// Finds where averages of neighbouring readings must end. `off`: current of each reading minus that
// of a model; `sigma`: noise deviation of each reading, in the same unit.

constexpr int kReach = 3;  // neighbours on either side

// Distance of `off` at reading k from the median of its neighbours in the same stretch. 0 for fewer
// than two neighbours.
double OffNeighbours(const std::vector<Reading>& points, const std::vector<double>& off, int k) {
  std::array<double, 2 * kReach> around;
  auto end = around.begin();
  const int last = std::min(k + kReach, static_cast<int>(points.size()) - 1);
  for (int i = std::max(0, k - kReach); i <= last; ++i) {
    if (i != k && points[i].segment == points[k].segment) *end++ = off[i];
  }
  if (end - around.begin() < 2) return 0;
  const auto middle = around.begin() + (end - around.begin()) / 2;
  std::nth_element(around.begin(), middle, end);
  return std::fabs(off[k] - *middle);
}

// The most significant jump within readings `begin` to `end` - 1.
struct Jump {
  int begin = 0;
  int at = 0;  // first reading after the jump
  int end = 0;
  double square = 0;  // squared size in standard errors, with a straight line fitted too

  bool operator<(const Jump& other) const { return square < other.square; }
};

Jump FindJump(int begin, int end, const std::vector<double>& off,
              const std::vector<double>& sigma) {
  constexpr int kFewestBeside = 3;
  Jump jump{begin, begin, end, 0};
  const double n = end - begin, middle = begin + 0.5 * (n - 1);
  if (end - begin < 2 * kFewestBeside) return jump;
  double mean = 0, variance = 0, along = 0;
  for (int k = begin; k < end; ++k) {
    mean += off[k] / n;
    variance += sigma[k] * sigma[k] / n;
    along += (k - middle) * off[k];
  }
  const double moment = n * (n * n - 1) / 12;  // sum of (k - middle)^2
  const double slope = along / moment;
  double above = 0;  // sum of the residuals of the line from k on
  for (int k = end - 1; k - begin >= kFewestBeside; --k) {
    above += off[k] - mean - slope * (k - middle);
    const double after = end - k, before = n - after;
    if (after < kFewestBeside) continue;
    // Squared norm of the step function at k after projection off constant and line. Off the
    // constant it is after * before / n; its product with k - middle is after * before / 2.
    const double free = after * before / n - std::pow(0.5 * after * before, 2) / moment;
    const double square = above * above / (free * variance);
    if (!(square > jump.square)) continue;
    jump.square = square;
    jump.at = k;
  }
  return jump;
}

// Marks readings that are further from the median of their neighbours than noise explains. It marks
// at most a hundred, the furthest first.
void MarkSudden(const std::vector<Reading>& points, const std::vector<double>& off,
                const std::vector<double>& sigma, std::vector<char>* alone) {
  constexpr double kFar = 4.5, kUsual = 1000;  // limit in standard deviations for kUsual readings
  constexpr double kOfMiddle = 1.25;           // variance of a reading minus the median of six
  constexpr std::size_t kMost = 100;
  // A reading alone competes with averages, not with all readings. To keep the rate of chance
  // outliers independent of the number of readings, its squared limit grows by 4 ln(times).
  const double times = std::max(static_cast<double>(points.size()) / kUsual, 1.0);
  const double far = std::sqrt(kFar * kFar + 4 * kOfMiddle * kOfMiddle * std::log(times));
  std::vector<std::pair<double, int>> sudden;
  for (int k = 0; k < static_cast<int>(points.size()); ++k) {
    const double distance = OffNeighbours(points, off, k);
    if (distance > far * sigma[k]) sudden.emplace_back(distance / sigma[k], k);
  }
  if (sudden.size() > kMost) {
    std::nth_element(sudden.begin(), sudden.begin() + kMost, sudden.end(), std::greater<>());
    sudden.resize(kMost);
  }
  for (const auto& [distance, k] : sudden) (*alone)[k] = 1;
}

// Splits groups, each given by its first reading, where `off` jumps within a group. A jump must
// exceed what noise about a straight line explains. At most fifty splits, the most significant
// first.
std::vector<int> CutAtJumps(std::vector<int> first, const std::vector<double>& off,
                            const std::vector<double>& sigma) {
  constexpr double kSure =
      6;  // standard errors; exceeded by chance in 0.2 % of sweeps of a million readings
  constexpr int kMost = 50;
  std::priority_queue<Jump> jumps;
  const auto look = [&](int begin, int end) {
    const Jump jump = FindJump(begin, end, off, sigma);
    if (jump.square > kSure * kSure) jumps.push(jump);
  };
  for (std::size_t g = 0; g + 1 < first.size(); ++g) look(first[g], first[g + 1]);
  for (int cuts = 0; cuts < kMost && !jumps.empty(); ++cuts) {
    const Jump jump = jumps.top();
    jumps.pop();
    first.push_back(jump.at);
    look(jump.begin, jump.at);
    look(jump.at, jump.end);
  }
  std::sort(first.begin(), first.end());
  return first;
}

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
