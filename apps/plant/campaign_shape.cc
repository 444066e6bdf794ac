#include "plant/campaign_shape.h"

#include <boost/math/special_functions/fpclassify.hpp>  // pchip.hpp of Boost 1.74 lacks it

#include <algorithm>
#include <boost/math/interpolators/pchip.hpp>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>

#include "lyrefit/base/distributions.h"
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
// The largest errors of a temperature sensor on a string that is aired like its neighbours, as part
// of Voc: 2.5 K as standard deviation, 6 K at most.
constexpr double kTemperatureSigma = 0.0075, kTemperatureMost = 0.018;
// Errors of the mechanisms themselves, as part of the change that they make.
constexpr double kMechanismError = 0.06;
// Errors of neighbouring currents of a sweep are alike: as many count as one.
constexpr double kAlikeCurrents = 3;
// The shape of a sweep departs from every mechanism by more than noise: chi-squared over its mean.
constexpr double kOverdispersion = 2;
// -2 ln of the probability of a parameter, as of Schwarz's criterion for two dozen currents.
constexpr double kPerParameter = 3.2;
constexpr double kOtherModulesRare = 3;  // -2 ln of how much rarer than a fault
constexpr double kChangeRare = 10;       // -2 ln of how much rarer than no change
// The least part of the voltage that a substring gives, where their number is unknown.
constexpr double kLeastVoltage = 0.01;
// The least changes of Isc and Voc of other modules, in standard deviations, beyond what less light
// does to Voc.
constexpr double kOtherFigure = 2.5, kVocPerLight = 0.045;
// Cells without light are a bypassed substring, and less light on more of them than this is less light.
constexpr double kDarkest = 0.9, kMostShaded = 0.7;
// Leaks at Voc in parts of Isc: median, and the standard deviation of the logarithm.
constexpr double kUsualLeak = 0.1, kLeakSpread = 1.2;
// -2 ln of how much rarer sizes are spread than alike.
constexpr double kSpreadRare = 1.4;

// A falling curve of points, in parts of Isc and Voc.
struct Points {
  std::vector<double> v, i;

  // The current at a voltage, the voltage at a current; beyond the ends, the end.
  double CurrentAt(double at) const {
    const auto above = std::lower_bound(v.begin(), v.end(), at);
    if (above == v.begin()) return i.front();
    if (above == v.end()) return i.back();
    const auto k = static_cast<std::size_t>(above - v.begin());
    return i[k - 1] + (i[k] - i[k - 1]) * (at - v[k - 1]) / (v[k] - v[k - 1]);
  }
  double VoltageAt(double at) const {
    const auto below = std::lower_bound(i.begin(), i.end(), at, std::greater<>());
    if (below == i.begin()) return v.front();
    if (below == i.end()) return v.back();
    const auto k = static_cast<std::size_t>(below - i.begin());
    return v[k - 1] + (v[k] - v[k - 1]) * (at - i[k - 1]) / (i[k] - i[k - 1]);
  }
  double Power() const {
    double most = 0;
    for (std::size_t k = 0; k < v.size(); ++k) most = std::max(most, v[k] * i[k]);
    return most;
  }
  // Strictly falling, with rising voltages.
  void Order() {
    constexpr double kLeast = 1e-7;
    for (std::size_t k = 1; k < v.size(); ++k) {
      v[k] = std::max(v[k], v[k - 1] + kLeast);
      i[k] = std::min(i[k], i[k - 1] - kLeast);
    }
  }
};

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

// The sweep as a dense curve through its currents and its maximum power.
Points PointsOf(const SweepFigures& sweep) {
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
  Points points;
  for (double v = kFirstV; v < kLastV; v += kStepV) {
    points.v.push_back(v);
    points.i.push_back(v < first  ? at_first + slope_first * (v - first)
                       : v < last ? curve(v)
                                  : slope_last * (v - last));
  }
  points.Order();
  return points;
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
void AddVoltages(const Points& cells, double part, double bypass,
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
Points WithPart(Points points, double part, double bypass, const Points& other) {
  for (double& v : points.v) v *= 1 - part;
  AddVoltages(other, part, bypass, points.i, &points.v);
  points.Order();
  return points;
}

Points WithLessLight(Points points, double less) {
  for (std::size_t k = 0; k < points.v.size(); ++k) {
    points.i[k] -= less;
    points.v[k] += kUsualResistance * less;
  }
  return points;
}

Points WithLeak(Points points, double conductance) {
  for (std::size_t k = 0; k < points.v.size(); ++k) points.i[k] -= conductance * points.v[k];
  points.Order();
  return points;
}

// The mean of equal parts of the cells at equal currents, one for each of the sizes.
template <class Change>
Points Spread(const Points& points, const std::vector<double>& sizes, double bypass,
              const Change& change) {
  if (sizes.size() == 1) return change(points, sizes.front());
  Points mean = points;
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

Points Changed(const Points& sound, Mechanism mechanism, double size, double part, bool spread,
               const StringFacts& facts) {
  const double bypass = BypassPart(facts);
  const std::vector<double> sizes = EvenSizes(size, spread ? LevelsOf(part, facts) : 1);
  Points points = sound;
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

class MechanismSearch {
 public:
  MechanismSearch(const SweepFigures& sound, const SweepFigures& ill, const SweepScatter& scatter,
                  const StringFacts& facts)
      : points_(PointsOf(sound)), sound_(sound), ill_(ill), scatter_(scatter), facts_(facts) {
    power_ = points_.Power();
    isc_ = ill.log_isc - sound.log_isc;
    voc_ = ill.log_voc - sound.log_voc;
    fill_ = std::log(ill.imp_per_isc * ill.vmp_per_voc / (sound.imp_per_isc * sound.vmp_per_voc));
    largest_ = std::max({std::fabs(isc_), std::fabs(voc_), std::fabs(fill_)});
  }

  std::vector<MechanismFit> All() const {
    // Light is lost as evenly as dirt lies.
    std::vector<MechanismFit> fits = {OfOneSize(Mechanism::kLight, 0, 0.95, {0, 0.08, 0.15, 0.25}),
                                      OfOneSize(Mechanism::kSeriesResistance, 0, 0.7),
                                      OfOneSize(Mechanism::kTemperature, 0, kTemperatureMost),
                                      OfTwoSizes(Mechanism::kShunt, 1.5),
                                      OfTwoSizes(Mechanism::kMismatch, kDarkest)};
    // Modules of another type have another current and another voltage: else it is one fault, the
    // light or a temperature.
    if (std::fabs(isc_) > kOtherFigure * scatter_.log_isc &&
        std::fabs(voc_ - kVocPerLight * isc_) > kOtherFigure * scatter_.log_voc) {
      fits.push_back(OfOneSize(Mechanism::kOtherModules, -0.1, 0.1));
    }
    fits.push_back(facts_.substrings > 1 ? OfSubstrings()
                                         : OfOneSize(Mechanism::kSubstrings, kLeastVoltage, 0.5));
    std::sort(fits.begin(), fits.end(), [](const MechanismFit& one, const MechanismFit& other) {
      return one.misfit < other.misfit;
    });
    const MechanismFit none = Judge(Mechanism::kSeriesResistance, 0, 1, false);
    if (none.misfit - kPerParameter < fits.front().misfit + kChangeRare) return {};
    double sum = 0;
    for (MechanismFit& fit : fits) {
      fit.probability = std::exp(0.5 * (fits.front().misfit - fit.misfit));
      sum += fit.probability;
    }
    for (MechanismFit& fit : fits) fit.probability /= sum;
    return fits;
  }

 private:
  // -2 ln of the likelihood and the prior of a size. `fit`: gets both, and the change of power.
  MechanismFit Judge(Mechanism mechanism, double size, double part, bool spread) const {
    Points points = Changed(points_, mechanism, size, part, spread, facts_);
    MechanismFit fit = {mechanism, size, part, spread};
    const bool free = mechanism == Mechanism::kOtherModules;
    const double lost = std::log(points.Power() / power_);
    const double expected_voc = points.VoltageAt(0);
    // What is left of Voc is an error of temperature, which acts on the rest of the sweep too.
    if (!free && mechanism != Mechanism::kTemperature) {
      const double left = std::exp(voc_) - expected_voc;
      for (double& v : points.v) v += std::clamp(left, -kTemperatureMost, kTemperatureMost);
    }
    const double isc = points.CurrentAt(0), voc = points.VoltageAt(0), power = points.Power();
    if (!(isc > 0.01) || !(voc > 0.01) || !(power > 0)) return fit;
    const auto square = [&](double found, double expected, double sigma, double error) {
      return std::pow(found - expected, 2) / (sigma * sigma + error * error);
    };
    const double log_fill = std::log(power / (isc * voc) / power_);
    double sum = square(fill_, log_fill, scatter_.log_fill, kMechanismError * largest_);
    if (!free) {
      sum += square(isc_, std::log(isc), scatter_.log_isc, 0.5 * kMechanismError * largest_);
      sum +=
          square(voc_, std::log(expected_voc), scatter_.log_voc, 0.5 * kMechanismError * largest_);
    }
    if (ill_.currents.empty()) {
      double at = 0, most = 0;
      for (std::size_t k = 0; k < points.v.size(); ++k) {
        if (points.v[k] * points.i[k] > most) most = points.v[k] * points.i[k], at = points.v[k];
      }
      const double vmp = std::log(at / voc / sound_.vmp_per_voc);
      sum += square(std::log(ill_.vmp_per_voc / sound_.vmp_per_voc), vmp,
                    std::hypot(scatter_.log_vmp_per_voc, 0.007), kMechanismError * largest_);
    } else {
      for (int k = 1; k + 1 < kSparklinePoints; ++k) {
        const double v = static_cast<double>(k) / (kSparklinePoints - 1);
        const double expected = points.CurrentAt(v * voc) / isc;
        const double change = ill_.currents[k] - points_.CurrentAt(v);
        sum += square(ill_.currents[k], expected, scatter_.currents[k],
                      kMechanismError * std::fabs(change)) /
               kAlikeCurrents;
      }
    }
    fit.goodness =
        ill_.currents.empty()
            ? ChiSquaredTail(sum, 4)
            : ChiSquaredTail(sum / kOverdispersion, 3 + (kSparklinePoints - 2) / kAlikeCurrents);
    double prior = kPerParameter;
    if (mechanism == Mechanism::kTemperature) prior += std::pow(size / kTemperatureSigma, 2);
    if (mechanism == Mechanism::kShunt || mechanism == Mechanism::kMismatch) prior += kPerParameter;
    if (mechanism == Mechanism::kShunt) {
      prior += std::pow(std::log(size / kUsualLeak) / kLeakSpread, 2);
    }
    if (spread) prior += kSpreadRare;
    if (free) prior += 2 * kPerParameter + kOtherModulesRare;
    fit.misfit = sum + prior;
    fit.log_power = free ? isc_ + voc_ + log_fill : lost;
    return fit;
  }

  // A grid that is drawn together about the best point, for each of the parts.
  MechanismFit OfOneSize(Mechanism mechanism, double from, double to,
                         const std::vector<double>& parts = {1}) const {
    constexpr int kSteps = 12, kRounds = 5;
    MechanismFit best;
    for (const double part : parts) {
      double low = from, high = to;
      MechanismFit here;
      for (int round = 0; round < kRounds; ++round) {
        const double step = (high - low) / kSteps;
        for (int k = 0; k <= kSteps; ++k) {
          Take(Judge(mechanism, low + k * step, part, false), &here);
        }
        low = std::max(low, here.size - 1.5 * step);
        high = std::min(high, here.size + 1.5 * step);
      }
      Take(here, &best);
    }
    return best;
  }
  // Likewise in the logarithms of size and part.
  MechanismFit OfTwoSizes(Mechanism mechanism, double most) const {
    constexpr int kSteps = 9, kRounds = 4;
    double low[] = {std::log(0.003), std::log(0.01)};
    double high[] = {std::log(most), mechanism == Mechanism::kMismatch ? std::log(kMostShaded) : 0};
    MechanismFit best;
    for (int round = 0; round < kRounds; ++round) {
      const double size = (high[0] - low[0]) / kSteps, part = (high[1] - low[1]) / kSteps;
      for (int k = 0; k <= kSteps; ++k) {
        for (int l = 0; l <= kSteps; ++l) {
          for (const bool spread : {false, true}) {
            if (spread && 2 * std::exp(low[0] + k * size) > most) continue;
            Take(Judge(mechanism, std::exp(low[0] + k * size), std::exp(low[1] + l * part), spread),
                 &best);
          }
        }
      }
      const double middle[] = {std::log(best.size), std::log(best.part)};
      for (const int q : {0, 1}) {
        const double step = 1.5 * (q == 0 ? size : part);
        low[q] = std::max(low[q], middle[q] - step);
        high[q] = std::min(high[q], middle[q] + step);
      }
    }
    return best;
  }
  MechanismFit OfSubstrings() const {
    MechanismFit best;
    for (int k = 1; k <= std::max(facts_.substrings / 2, 1); ++k) {
      MechanismFit fit =
          Judge(Mechanism::kSubstrings, static_cast<double>(k) / facts_.substrings, 1, false);
      fit.count = k;
      Take(fit, &best);
    }
    return best;
  }
  static void Take(const MechanismFit& fit, MechanismFit* best) {
    if (std::isfinite(fit.misfit) && !(best->misfit <= fit.misfit)) *best = fit;
  }

  Points points_;
  const SweepFigures& sound_;
  const SweepFigures& ill_;
  const SweepScatter& scatter_;
  const StringFacts& facts_;
  double power_ = 0, isc_ = 0, voc_ = 0, fill_ = 0, largest_ = 0;
};

}  // namespace

std::vector<MechanismFit> FitMechanisms(const SweepFigures& sound, const SweepFigures& ill,
                                        const SweepScatter& scatter, const StringFacts& facts) {
  return MechanismSearch(sound, ill, scatter, facts).All();
}

}  // namespace lyrefit
