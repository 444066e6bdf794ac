
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "lyrefit/base/median.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/curve/technology.h"
#include "lyrefit/diagnose/describe.h"
#include "lyrefit/diagnose/device_findings.h"
#include "lyrefit/diagnose/effect_size.h"
#include "lyrefit/effects/catalogue.h"

namespace lyrefit {
namespace {

// Voltage between trace and sweep by other things than resistance, V a cell: that of 1 K.
constexpr double kApart_V = 2e-3;
// Of a maximum power or an Isc that readings show.
constexpr double kReadingError = 0.004;
// A rise of so much of Isc is none of the noise.
constexpr double kLeastRise = 0.01;

struct Point {
  double voltage, current;  // V per cell, current scales
};

// The readings of the sweep or of the first trace, by voltage.
std::vector<Point> PointsOf(const WeightedData& weighted, bool suns_voc) {
  const std::vector<Reading>& readings = weighted.readings->points;
  std::vector<Point> points;
  int curve = -1;
  for (std::size_t k = 0; k < readings.size(); ++k) {
    const Reading& r = readings[k];
    if (weighted.used[k] == 0 || r.dark || r.suns_voc != suns_voc) continue;
    if (curve < 0) curve = r.curve;
    if (r.curve == curve) points.push_back({r.voltage, r.current});
  }
  std::stable_sort(points.begin(), points.end(),
                   [](const Point& a, const Point& b) { return a.voltage < b.voltage; });
  return points;
}

KeyPoints KeyPointsOf(const std::vector<Point>& points) {
  std::vector<double> voltage, current;
  for (const Point& point : points) {
    voltage.push_back(point.voltage);
    current.push_back(point.current);
  }
  return FindKeyPoints(voltage, current);
}

// Voltage of a curve at a current, linear between readings; NaN beyond them.
double VoltageAt(const std::vector<Point>& points, double current) {
  for (std::size_t k = 1; k < points.size(); ++k) {
    const Point &a = points[k - 1], &b = points[k];
    if (!(a.current >= current && current > b.current)) continue;
    return a.voltage + (b.voltage - a.voltage) * (a.current - current) / (a.current - b.current);
  }
  return kUnknown;
}

// Largest height of a chord over a reading, in Isc: that of the concave hull. A reading at open circuit
// was often taken apart.
double RiseOf(const std::vector<Point>& points, double isc) {
  constexpr double kApart = 0.03;  // of Isc
  std::vector<Point> taken, hull;
  std::copy_if(points.begin(), points.end(), std::back_inserter(taken),
               [&](const Point& point) { return point.current >= kApart * isc; });
  const auto lies_below = [](const Point& b, const Point& a, const Point& c) {
    return (b.current - a.current) * (c.voltage - a.voltage) <=
           (c.current - a.current) * (b.voltage - a.voltage);
  };
  for (const Point& point : taken) {
    while (hull.size() > 1 && lies_below(hull.back(), hull[hull.size() - 2], point)) {
      hull.pop_back();
    }
    hull.push_back(point);
  }
  double rise = 0;
  std::size_t k = 1;
  for (const Point& point : taken) {
    while (k + 1 < hull.size() && hull[k].voltage < point.voltage) ++k;
    if (k >= hull.size()) break;
    const Point &a = hull[k - 1], &c = hull[k];
    const double span = c.voltage - a.voltage;
    if (!(span > 0)) continue;
    const double chord = a.current + (c.current - a.current) * (point.voltage - a.voltage) / span;
    rise = std::max(rise, (chord - point.current) / isc);
  }
  return rise;
}

// Loss of the fill factor by the voltages between trace and sweep at small currents, which every cell
// gives: of modules without a rise it is Rs Isc/Voc there, 0.9 to 1.15 times.
Sized DropAtSmallCurrents(const std::vector<Point>& sweep, const std::vector<Point>& trace,
                          double isc, double voc) {
  constexpr double kLeast = 0.15, kMost = 0.5, kStep = 0.05;  // of Isc
  std::vector<double> drops;
  for (double part = kLeast; part < kMost; part += kStep) {
    const double apart = VoltageAt(trace, part * isc) - VoltageAt(sweep, part * isc);
    if (std::isfinite(apart)) drops.push_back(apart / part / voc);
  }
  if (drops.empty()) return {};
  constexpr double kFactorScatter = 0.07;
  const double value = Median(std::move(drops));
  const double half =
      kNormal95 * std::hypot(kApart_V / voc / (0.5 * (kLeast + kMost)), kFactorScatter * value);
  return {value, value - half, value + half};
}

// The loss that the trace shows; void without enough of both curves.
Sized Measured(const std::vector<Point>& sweep, const std::vector<Point>& trace, double photo,
               double isc, double voc, double rise) {
  const KeyPoints pseudo = KeyPointsOf(trace), loaded = KeyPointsOf(sweep);
  const double shown = pseudo.short_circuit_current_A;
  const double most = std::isfinite(shown) ? shown : photo;
  if (!(most > 0) || !(pseudo.max_power_W > 0) || !(loaded.max_power_W > 0)) return {};
  const double own = pseudo.open_circuit_voltage_V;
  const double without = pseudo.max_power_W / (most * (std::isfinite(own) ? own : voc));
  const double with = loaded.max_power_W / (isc * voc);
  const double half = kNormal95 * std::hypot(kReadingError * with, without * kApart_V / voc);
  const Sized whole = {without - with, without - with - half, without - with + half};
  if (rise < kLeastRise) return whole;
  const Sized drop = DropAtSmallCurrents(sweep, trace, isc, voc);
  const double share = std::min(drop.value, whole.value), reach = drop.high_95 - drop.value;
  return {share, share - reach, share + reach};
}

std::string LossWords(const ResistanceLoss& loss) {
  return fmt::format(
      "by the Suns-Voc trace, resistance takes {:.3f} ({:.3f} to {:.3f}) of the fill factor; in "
      "new "
      "modules it takes {:.3f}, {:.3f} at most",
      loss.part.value, loss.part.low_95, loss.part.high_95, loss.usual, loss.most);
}

}  // namespace

bool IsResistance(const Cause& cause) {
  const Effect* effect = FindEffect(cause.effect);
  return effect != nullptr && effect->resistance;
}

std::optional<ResistanceLoss> FindResistanceLoss(const Selection& selection,
                                                 const std::string& technology) {
  const WeightedData& weighted = selection.weighted;
  const Readings& readings = *weighted.readings;
  const DataTraits& traits = readings.traits;
  const bool same = traits.irradiance_levels < 2 && traits.temperature_levels < 2;
  if (!traits.suns_voc || !traits.module || !same || IsThinFilm(technology) ||
      !ReachesPastKnee(readings)) {
    return {};
  }
  const KeyPoints device = DeviceKeyPoints(weighted, selection.extended);
  const double product = device.short_circuit_current_A * device.open_circuit_voltage_V;
  if (!(product > 0)) return {};
  const std::vector<Point> sweep = PointsOf(weighted, false);
  const double light = InBrightestLight(readings).points.front().irradiance;
  const double isc = device.short_circuit_current_A / readings.scale.current_A;
  const double photo = selection.extended.p[kIph] * light / readings.scale.current_A;
  const double shown = KeyPointsOf(sweep).open_circuit_voltage_V;
  const double voc =
      std::isfinite(shown) ? shown : device.open_circuit_voltage_V / readings.scale.cells;
  ResistanceLoss loss;
  loss.usual = kUsualResistanceLoss * light;
  loss.most = kMostResistanceLoss * light;
  loss.rise = RiseOf(sweep, isc);
  loss.part = Measured(sweep, PointsOf(weighted, true), photo, isc, voc, loss.rise);
  if (!std::isfinite(loss.part.low_95)) return {};
  const double watts = isc * readings.scale.current_A * voc * readings.scale.cells;
  const double half =
      std::hypot(loss.part.high_95 - loss.part.value, kNormal95 * kUsualResistanceScatter * light);
  const double beyond = loss.part.value - loss.usual;
  loss.beyond_W = {watts * beyond, watts * (beyond - half), watts * (beyond + half)};
  return loss;
}

bool IsNoted(const ResistanceLoss& loss) {
  const double least = loss.usual * (1 + kNotedResistanceLoss / kUsualResistanceLoss);
  return loss.part.value > least && loss.part.low_95 > loss.most;
}

void JudgeResistance(const ResistanceLoss& loss, const Selection& selection, bool wanted,
                     Verdict* verdict) {
  std::vector<Cause>& causes = verdict->causes;
  const bool noted = IsNoted(loss);
  bool named = false;
  for (std::size_t c = 0; c < causes.size();) {
    Cause& cause = causes[c];
    if (!IsResistance(cause)) {
      ++c;
      continue;
    }
    if (!noted) {
      cause.recoverable_power_W = {};
      verdict->below_floor.insert(verdict->below_floor.begin(), std::move(cause));
      causes.erase(causes.begin() + static_cast<std::ptrdiff_t>(c));
      continue;
    }
    if (!named) {
      cause.recoverable_power_W = NotBelowZero(loss.beyond_W);
      cause.in_words.push_back(LossWords(loss));
      cause.sentence += "; " + cause.in_words.back();
    }
    named = true;
    ++c;
  }
  verdict->found = !causes.empty();
  // What a trace cannot exclude beside unlike currents.
  const bool possible =
      loss.part.high_95 > loss.usual * (1 + kNotedResistanceLoss / kUsualResistanceLoss);
  if (!named && !noted && possible && loss.rise >= kLeastRise && !causes.empty()) {
    causes.front().equivalents.emplace_back("series_resistance");
  }
  if (named || !noted || !wanted) return;
  const Effect& effect = *FindEffect("series_resistance");
  Cause cause = MakeCause(effect, "values", 1);
  cause.separate_by = {effect.separate_by};
  cause.in_words = {LossWords(loss)};
  cause.sentence += "; " + cause.in_words.front();
  cause.recoverable_power_W = NotBelowZero(loss.beyond_W);
  const double gain = loss.beyond_W.value / DevicePower(selection.weighted, selection.extended);
  cause.power_effect.value = gain;
  // What no known cause explains is this resistance, or beside it.
  const auto nameless = std::find_if(causes.begin(), causes.end(), [](const Cause& other) {
    return other.id == "unknown_structure";
  });
  if (nameless != causes.end()) causes.erase(nameless);
  causes.insert(loss.rise < kLeastRise || causes.empty() ? causes.begin() : causes.begin() + 1,
                std::move(cause));
  verdict->found = true;
}

}  // namespace lyrefit
