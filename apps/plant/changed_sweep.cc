#include "plant/changed_sweep.h"

#include <boost/math/special_functions/fpclassify.hpp>  // pchip.hpp of Boost 1.74 lacks it

#include <boost/math/interpolators/pchip.hpp>
#include <cmath>
#include <utility>

#include "lyrefit/base/roots.h"

namespace lyrefit {
namespace {

// Ends and step of the voltages of a sweep, in parts of Voc.
constexpr double kFirstV = -0.15, kLastV = 1.08, kStepV = 0.01;
// What the series resistance of a usual module takes at Isc, in parts of Voc.
constexpr double kUsualResistance = 0.04;
// Voltage over a conducting bypass diode and its cable.
constexpr double kBypass_V = 0.5;
// Slope of the diode exponential of a usual module in parts of Voc, for a sweep of figures alone.
constexpr double kUsualSlope = 0.05;
// A usual module with a series resistance that gives the maximum power.
double UsualVoltage(double current, double resistance) {
  return 1 + kUsualSlope * std::log(std::max(1 - current, 1e-9)) - resistance * current;
}

// Currents of a sweep of which only the maximum power is known.
std::vector<double> UsualCurrents(double fill) {
  const auto fill_of = [](double resistance) {
    const auto power = [&](double current) { return current * UsualVoltage(current, resistance); };
    return power(MaximumBetween(power, 0.2, 0.999));
  };
  const double resistance = RootBetween([&](double at) { return fill_of(at) - fill; }, -0.3, 0.8);
  std::vector<double> currents;
  for (int k = 0; k < kSparklinePoints; ++k) {
    const double v = static_cast<double>(k) / (kSparklinePoints - 1);
    currents.push_back(SignChange(
        [&](double current) { return UsualVoltage(current, resistance) - v; }, 0, 1 - 1e-9));
  }
  return currents;
}

// What a conducting bypass diode takes from the voltage of its cells, in parts of their Voc.
double BypassPart(const StringFacts& facts) {
  constexpr double kUsualSubstring_V = 13;  // Voc of 20 cells
  const double voltage_V = facts.substrings > 0 && facts.open_circuit_voltage_V > 0
                               ? facts.open_circuit_voltage_V / facts.substrings
                               : kUsualSubstring_V;
  return kBypass_V / voltage_V;
}

// Adds the voltages of `cells` at falling currents, times `part`; where they cannot carry a current,
// their bypass diodes conduct.
void AddVoltages(const SweepPoints& cells, double part, double bypass,
                 const std::vector<double>& currents, std::vector<double>* sums) {
  std::size_t below = 0;  // the first point of no more current
  for (std::size_t k = 0; k < currents.size(); ++k) {
    while (below < cells.i.size() && cells.i[below] > currents[k]) ++below;
    double v = -bypass;
    if (below == cells.i.size()) {
      v = cells.v.back();
    } else if (below > 0) {
      const double width = cells.i[below] - cells.i[below - 1];
      v = cells.v[below - 1] +
          (cells.v[below] - cells.v[below - 1]) * (currents[k] - cells.i[below - 1]) / width;
    }
    (*sums)[k] += part * std::max(v, -bypass);
  }
}

// A part of the cells changes to `other`, at equal currents.
SweepPoints WithPart(SweepPoints points, double part, double bypass, const SweepPoints& other) {
  for (double& v : points.v) v *= 1 - part;
  AddVoltages(other, part, bypass, points.i, &points.v);
  points.Order();
  return points;
}

SweepPoints WithLessLight(SweepPoints points, double less) {
  for (std::size_t k = 0; k < points.v.size(); ++k) {
    points.i[k] -= less;
    points.v[k] += kUsualResistance * less;
  }
  return points;
}

SweepPoints WithLeak(SweepPoints points, double conductance) {
  for (std::size_t k = 0; k < points.v.size(); ++k) points.i[k] -= conductance * points.v[k];
  points.Order();
  return points;
}

// The mean of equal parts of the cells at equal currents, one for each of the sizes.
template <class Change>
SweepPoints Spread(const SweepPoints& points, const std::vector<double>& sizes, double bypass,
                   const Change& change) {
  if (sizes.size() == 1) return change(points, sizes.front());
  SweepPoints mean = points;
  std::fill(mean.v.begin(), mean.v.end(), 0.0);
  for (const double size : sizes) {
    AddVoltages(change(points, size), 1.0 / static_cast<double>(sizes.size()), bypass, points.i,
                &mean.v);
  }
  mean.Order();
  return mean;
}

// Sizes of equal parts: `mean` with a relative standard deviation of a normal distribution, or evenly
// from nothing to twice the mean.
std::vector<double> NormalSizes(double mean, double deviation) {
  constexpr double kQuantiles[] = {-1.40, -0.53, 0, 0.53, 1.40};
  std::vector<double> sizes;
  for (const double z : kQuantiles) sizes.push_back(mean * (1 + deviation * z));
  return sizes;
}
std::vector<double> EvenSizes(double mean, int parts) {
  std::vector<double> sizes;
  for (int k = 0; k < parts; ++k) sizes.push_back(mean * (2 * k + 1) / parts);
  return sizes;
}
// The cells of a substring carry the current of its least: no more sizes than substrings.
int LevelsOf(double part, const StringFacts& facts) {
  constexpr int kMost = 6;
  if (facts.substrings < 1) return kMost;
  return static_cast<int>(std::clamp(std::round(part * facts.substrings), 1.0, double{kMost}));
}

}  // namespace

SweepPoints PointsOf(const SweepFigures& sweep) {
  const double fill = sweep.imp_per_isc * sweep.vmp_per_voc;
  const std::vector<double> currents =
      sweep.currents.empty() ? UsualCurrents(fill) : sweep.currents;
  std::vector<double> knots, values;
  const double step = 1.0 / (kSparklinePoints - 1);
  const double near = 0.3 * step;
  const auto add = [&](double v, double i) {
    knots.push_back(v);
    values.push_back(values.empty() ? i : std::min(i, values.back()));
  };
  bool placed = sweep.currents.empty();
  for (int k = 0; k < kSparklinePoints; ++k) {
    const double v = k * step;
    if (!placed && v > sweep.vmp_per_voc - near) {
      add(sweep.vmp_per_voc, sweep.imp_per_isc);
      placed = true;
    }
    if (!sweep.currents.empty() && std::fabs(v - sweep.vmp_per_voc) < near) continue;
    add(v, k == kSparklinePoints - 1 ? 0 : currents[k]);
  }
  const double first = knots.front(), last = knots.back();
  const double at_first = values.front();
  const double slope_first = std::min((values[2] - values[0]) / (knots[2] - knots[0]), -0.005);
  const auto count = values.size();
  const double slope_last = std::min(
      (values[count - 1] - values[count - 2]) / (knots[count - 1] - knots[count - 2]), -1.0);
  const auto curve =
      boost::math::interpolators::pchip<std::vector<double>>(std::move(knots), std::move(values));
  SweepPoints points;
  for (double v = kFirstV; v < kLastV; v += kStepV) {
    points.v.push_back(v);
    points.i.push_back(v < first  ? at_first + slope_first * (v - first)
                       : v < last ? curve(v)
                                  : slope_last * (v - last));
  }
  points.Order();
  return points;
}

SweepPoints Changed(const SweepPoints& sound, Mechanism mechanism, double size, double part,
                    bool spread, const StringFacts& facts) {
  const double bypass = BypassPart(facts);
  const std::vector<double> sizes = EvenSizes(size, spread ? LevelsOf(part, facts) : 1);
  SweepPoints points = sound;
  switch (mechanism) {
    case Mechanism::kLight:
      return part > 0 ? Spread(sound, NormalSizes(size, part), bypass, WithLessLight)
                      : WithLessLight(std::move(points), size);
    case Mechanism::kSubstrings:
      for (double& v : points.v) v *= 1 - size;
      break;
    case Mechanism::kTemperature:
      for (double& v : points.v) v -= size;
      break;
    case Mechanism::kSeriesResistance:
    case Mechanism::kOtherModules:
      for (std::size_t k = 0; k < points.v.size(); ++k) points.v[k] -= size * points.i[k];
      break;
    case Mechanism::kShunt:
      return WithPart(sound, part, bypass, Spread(sound, sizes, bypass, WithLeak));
    case Mechanism::kMismatch:
      return WithPart(sound, part, bypass, Spread(sound, sizes, bypass, WithLessLight));
  }
  points.Order();
  return points;
}

}  // namespace lyrefit
