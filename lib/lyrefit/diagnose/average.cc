#include "lyrefit/diagnose/average.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/median.h"
#include "lyrefit/diagnose/fit_effect.h"
#include "lyrefit/law/make_readings.h"

namespace lyrefit {
namespace {

constexpr int kEnough = 300;          // readings that show as much as more would
constexpr int kFewestInStretch = 40;  // averages of a monotone stretch that shapes need

// Base model and noise of all readings.
struct FittedBase {
  Workbench bench;
  LawFit fit;
  Noise noise;
};

FittedBase FitAllReadings(const Measurement& measurement, const Law& base, Watch* watch) {
  const std::size_t count = measurement.readings.points.size();
  FittedBase shape;
  shape.bench.readings = std::make_shared<const Readings>(measurement.readings);
  shape.bench.sigma.assign(count, 1e-3);
  shape.bench.used.assign(count, 1);
  shape.bench.watch = watch;
  for (const int k : measurement.values.at_lower) shape.bench.used[k] = 0;
  for (const int k : measurement.values.at_voltage_limit) shape.bench.used[k] = 0;
  if (count <= kQuickToFit) shape.bench.watch = nullptr;
  shape.fit = FitBase(shape.bench, base);
  shape.bench.watch = watch;
  if (shape.fit.usable) shape.noise = SettleNoise(measurement, &shape.bench, &shape.fit);
  return shape;
}

// Further from the middle of its neighbours than noise goes.
bool Sudden(const FittedBase& shape, const std::vector<double>& off, int k) {
  constexpr int kReach = 3;
  constexpr double kFar = 4.5;
  const std::vector<Reading>& points = shape.bench.readings->points;
  std::vector<double> around;
  for (int i = std::max(0, k - kReach); i <= k + kReach; ++i) {
    if (i == k || i >= static_cast<int>(points.size())) continue;
    if (points[i].segment == points[k].segment) around.push_back(off[i]);
  }
  if (around.size() < 2) return false;
  return std::fabs(off[k] - UpperMedian(std::move(around))) > kFar * shape.bench.sigma[k];
}

// Readings of a stretch in lots of `size`, those alone by themselves.
void Divide(int first, int last, int size, const std::vector<char>& alone,
            std::vector<std::vector<int>>* lots) {
  bool open = false;
  for (int k = first; k < last; ++k) {
    if (alone[k] != 0) {
      lots->push_back({k});
      open = false;
      continue;
    }
    if (!open || static_cast<int>(lots->back().size()) >= size) lots->emplace_back();
    lots->back().push_back(k);
    open = true;
  }
}

Reading Mean(const Readings& readings, const std::vector<int>& lot,
             const std::vector<double>& off) {
  Reading mean = readings.points[lot.front()];
  const double n = static_cast<double>(lot.size());
  double voltage = 0, x = 0, rate = 0, irradiance = 0, distance = 0, square = 0;
  for (const int k : lot) {
    const Reading& r = readings.points[k];
    voltage += r.voltage / n;
    x += r.x / n;
    rate += r.rate / n;
    irradiance += r.irradiance / n;
    distance += off[k] / n;
    square += off[k] * off[k] / n;
  }
  if (lot.size() > 1) {
    mean.voltage = voltage;
    mean.x = x;
    mean.rate = rate;
    mean.irradiance = irradiance;
  }
  mean.current = distance;  // the model's current is added where all are known
  mean.weight = n;
  mean.scatter = std::max(0.0, square - distance * distance);
  return mean;
}

// Of the mean of each lot of independent errors; empty where these are.
std::vector<double> ErrorsOfMeans(const std::vector<double>& errors,
                                  const std::vector<std::vector<int>>& lots) {
  std::vector<double> means;
  if (errors.empty()) return means;
  for (const std::vector<int>& lot : lots) {
    double squares = 0;
    for (const int k : lot) squares += errors[k] * errors[k];
    means.push_back(std::sqrt(squares) / static_cast<double>(lot.size()));
  }
  return means;
}

// Positions of the averages that stand for the given readings.
std::vector<int> Translated(const std::vector<int>& of, const std::vector<int>& readings) {
  std::vector<int> result;
  result.reserve(readings.size());
  for (const int k : readings) result.push_back(of[k]);
  return result;
}

// The same fit as seen by all readings.
LawFit Seen(const Workbench& bench, LawFit fit) {
  fit.current.assign(bench.readings->points.size(), 0.0);
  LawWorkspace workspace;
  fit.usable = fit.usable && EvaluateLaw(fit.law, *bench.readings, fit.p.data(), &workspace,
                                         fit.current.data(), nullptr);
  if (!fit.usable) return fit;
  Eigen::VectorXd residual(static_cast<int>(fit.current.size()));
  for (int k = 0; k < residual.size(); ++k) {
    residual[k] = fit.current[k] - bench.readings->points[k].current;
  }
  fit.sum = Whiten(bench, residual).squaredNorm();
  return fit;
}

// Fitted to all readings from where the averages left it.
LawFit Refitted(const Measurement& measurement, LawFit fit, Workbench* bench, Noise* noise) {
  fit = Seen(*bench, std::move(fit));
  if (!fit.usable) return fit;
  *noise = SettleNoise(measurement, bench, &fit);
  return fit;
}

}  // namespace

bool IsLong(const Readings& readings) {
  return 2 * static_cast<int>(readings.points.size()) >= 3 * kEnough;
}

Averaged Average(const Measurement& measurement, const Law& base, Watch* watch) {
  const Readings& readings = measurement.readings;
  const ValueFindings& values = measurement.values;
  const int count = static_cast<int>(readings.points.size());
  const FittedBase shape = FitAllReadings(measurement, base, watch);
  std::vector<double> off(count, 0.0);
  std::vector<char> alone(count, shape.fit.usable ? 0 : 1);
  for (int k = 0; shape.fit.usable && k < count; ++k) {
    off[k] = readings.points[k].current - shape.fit.current[k];
  }
  for (int k = 0; shape.fit.usable && k < count; ++k) alone[k] = Sudden(shape, off, k) ? 1 : 0;
  for (const auto* set : {&values.clipped, &values.at_lower, &values.at_voltage_limit}) {
    for (const int k : *set) alone[k] = 1;
  }
  Averaged averaged;
  averaged.measurement = measurement;
  Readings& averages = averaged.measurement.readings;
  for (int first = 0, last = 0; first < count; first = last) {
    while (last < count && readings.points[last].segment == readings.points[first].segment) ++last;
    const int size = std::min((count + kEnough / 2) / kEnough, (last - first) / kFewestInStretch);
    Divide(first, last, std::max(size, 1), alone, &averaged.members);
  }
  std::vector<Reading>& means = averages.points;
  means.clear();
  std::vector<int> of(count);
  ValueFindings& of_means = averaged.measurement.values;
  of_means.rounding = ErrorsOfMeans(values.rounding, averaged.members);
  of_means.bin_rounding = ErrorsOfMeans(values.bin_rounding, averaged.members);
  averaged.measurement.stated_sigma = ErrorsOfMeans(measurement.stated_sigma, averaged.members);
  for (const std::vector<int>& lot : averaged.members) {
    for (const int k : lot) of[k] = static_cast<int>(means.size());
    means.push_back(Mean(readings, lot, off));
  }
  of_means.clipped = Translated(of, values.clipped);
  of_means.at_lower = Translated(of, values.at_lower);
  of_means.at_voltage_limit = Translated(of, values.at_voltage_limit);
  std::vector<double> model(means.size(), 0.0);
  LawWorkspace workspace;
  const bool known = shape.fit.usable && EvaluateLaw(shape.fit.law, averages, shape.fit.p.data(),
                                                     &workspace, model.data(), nullptr);
  for (std::size_t k = 0; k < means.size(); ++k) {
    const std::vector<int>& lot = averaged.members[k];
    if (known && lot.size() > 1) {
      means[k].current += model[k];
    } else {
      means[k].current = readings.points[lot.front()].current;
    }
  }
  averages.traits.readings = static_cast<int>(means.size());
  SetStepTimes(&averages);
  SetRangeCurrents(&averages);
  return averaged;
}

Selection OnAllReadings(const Selection& found, const Averaged& averaged,
                        const Measurement& measurement) {
  Selection all = found;
  const auto readings = std::make_shared<const Readings>(measurement.readings);
  const std::size_t count = readings->points.size();
  const auto widen = [&](Workbench* bench) {
    const std::vector<char> used = bench->used;
    bench->readings = readings;
    bench->correlation = bench->path = 0;
    bench->sigma.assign(count, 1e-3);
    bench->used.assign(count, 1);
    for (std::size_t lot = 0; lot < used.size(); ++lot) {
      for (const int k : averaged.members[lot]) bench->used[k] = used[lot];
    }
  };
  widen(&all.bench);
  widen(&all.base_bench);
  Noise noise;
  all.base = Refitted(measurement, found.base, &all.base_bench, &noise);
  all.extended = Refitted(measurement, found.extended, &all.bench, &all.noise);
  all.outliers.clear();
  for (const int lot : found.outliers) {
    const std::vector<int>& members = averaged.members[lot];
    all.outliers.insert(all.outliers.end(), members.begin(), members.end());
  }
  for (Rival& trial : all.trials) {
    if (trial.fit.usable) trial.fit = Seen(all.base_bench, trial.fit);
  }
  for (Rival& rival : all.below) rival.fit = Seen(all.bench, rival.fit);
  all.without.clear();
  for (std::size_t c = 0; c < all.causes.size(); ++c) {
    all.without.push_back(FitWithout(all.bench, all.extended, static_cast<int>(c)));
  }
  return all;
}

}  // namespace lyrefit
