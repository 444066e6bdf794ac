#include "lyrefit/diagnose/follow_up.h"

#include <algorithm>
#include <cmath>

namespace lyrefit {
namespace {

constexpr double kLightUnknown = 0.03, kKelvinUnknown = 1, kDropUnknown_V = 0.1;
constexpr double kSlower = 5, kDimmer = 0.5;

// The points of the brightest curve. A dark measurement gives its first curve.
std::vector<Reading> Brightest(const Readings& measured) {
  double light = 0;
  int curve = 0;
  for (const Reading& r : measured.points) {
    if (r.dark || r.irradiance <= light) continue;
    light = r.irradiance;
    curve = r.curve;
  }
  std::vector<Reading> points;
  for (const Reading& r : measured.points) {
    if (r.curve == curve) points.push_back(r);
  }
  return points;
}

PlannedCurve CurveOf(const Readings& measured, const std::vector<Reading>& points) {
  PlannedCurve curve;
  curve.readings = measured;
  curve.readings.points = points;
  for (Reading& r : curve.readings.points) {
    r.weight = 1;
    r.scatter = 0;
  }
  return curve;
}

void AddUnknownConditions(PlannedCurve* curve, FollowUp* follow_up) {
  curve->light = static_cast<int>(follow_up->unknown.size());
  follow_up->unknown.push_back(kLightUnknown);
  curve->temperature = static_cast<int>(follow_up->unknown.size());
  follow_up->unknown.push_back(kKelvinUnknown);
}

constexpr char kSameNoise[] = "noise as measured here, a rough path of its own";
constexpr char kOtherConditions[] =
    "noise as measured here, a rough path of its own, light known to 3 %, temperature to 1 K";

FollowUp ReverseSweep(const Readings& measured) {
  FollowUp follow_up = {
      "reverse_sweep", "the same sweep in the opposite order, at once", kSameNoise, {}, {}};
  PlannedCurve curve = CurveOf(measured, Brightest(measured));
  curve.at_once = true;
  std::vector<Reading>& points = curve.readings.points;
  std::reverse(points.begin(), points.end());
  for (Reading& r : points) {
    r.x = 1 - r.x;
    r.rate = -r.rate;
  }
  follow_up.curves = {curve};
  return follow_up;
}

FollowUp SlowerSweep(const Readings& measured) {
  FollowUp follow_up = {
      "slower_sweep", "the same sweep later, five times slower", kOtherConditions, {}, {}};
  PlannedCurve curve = CurveOf(measured, Brightest(measured));
  for (Reading& r : curve.readings.points) r.rate /= kSlower;
  AddUnknownConditions(&curve, &follow_up);
  follow_up.curves = {curve};
  return follow_up;
}

FollowUp SecondLight(const Readings& measured) {
  FollowUp follow_up = {
      "second_light", "the same sweep under half the light", kOtherConditions, {}, {}};
  PlannedCurve curve = CurveOf(measured, Brightest(measured));
  for (Reading& r : curve.readings.points) r.irradiance *= kDimmer;
  AddUnknownConditions(&curve, &follow_up);
  follow_up.curves = {curve};
  return follow_up;
}

FollowUp DarkCurve(const Readings& measured) {
  FollowUp follow_up = {"dark_curve",
                        "a dark curve up to Voc",
                        "noise as measured here, temperature known to 1 K",
                        {},
                        {}};
  PlannedCurve curve = CurveOf(measured, Brightest(measured));
  std::vector<Reading>& points = curve.readings.points;
  const int last = static_cast<int>(points.size()) - 1;
  for (int k = 0; k <= last; ++k) {
    points[k].voltage = measured.pivot_voltage * (k + 1) / (last + 1);
    points[k].irradiance = 0;
    points[k].dark = true;
  }
  curve.temperature = 0;
  follow_up.unknown = {kKelvinUnknown};
  follow_up.curves = {curve};
  return follow_up;
}

// Curves with each bypass group covered in turn. The covered cells are not counted; the voltages
// per working cell are unchanged.
FollowUp CoveredParts(const Readings& measured, int groups) {
  FollowUp follow_up = {"cover_part",
                        "a curve with each bypass group covered in turn (1/" +
                            std::to_string(groups) + " of the cells)",
                        std::string(kOtherConditions) + ", the bypass diode's drop to 0.1 V",
                        {},
                        {}};
  const int cells = measured.traits.cells / groups * (groups - 1);
  for (int which = 0; which < groups; ++which) {
    PlannedCurve curve = CurveOf(measured, Brightest(measured));
    curve.covered = which;
    curve.groups = groups;
    curve.readings.scale.cells = curve.readings.traits.cells = cells;
    curve.readings.traits.substrings = groups - 1;
    curve.readings.traits.bypass_known = true;
    AddUnknownConditions(&curve, &follow_up);
    curve.drop = static_cast<int>(follow_up.unknown.size());
    follow_up.unknown.push_back(kDropUnknown_V / cells);
    follow_up.curves.push_back(curve);
  }
  return follow_up;
}

FollowUp IscVoc(const Readings& measured) {
  constexpr int kLevels = 12;
  constexpr double kDimmest = 0.03;
  FollowUp follow_up = {"isc_voc",
                        "Isc and Voc under 12 lights from full to 3 %",
                        "noise as measured here, each light known to 3 %, temperature to 1 K",
                        {},
                        {kKelvinUnknown}};
  const Reading first = Brightest(measured).front();
  for (int k = 0; k < kLevels; ++k) {
    std::vector<Reading> pair(2, first);
    for (Reading& r : pair) r.irradiance *= std::pow(kDimmest, k / (kLevels - 1.0));
    pair[0].voltage = 0;
    pair[1].voltage = measured.pivot_voltage;
    pair[0].rate = pair[1].rate = 0;
    PlannedCurve curve = CurveOf(measured, pair);
    curve.open_circuit = true;
    curve.temperature = 0;
    curve.light = static_cast<int>(follow_up.unknown.size());
    follow_up.unknown.push_back(kLightUnknown);
    follow_up.curves.push_back(curve);
  }
  return follow_up;
}

}  // namespace

std::vector<FollowUp> FollowUpMeasurements(const Readings& measured) {
  const DataTraits& traits = measured.traits;
  std::vector<FollowUp> all;
  if (traits.only_dark) return all;
  if (traits.single) all.push_back(ReverseSweep(measured));
  all.push_back(SlowerSweep(measured));
  all.push_back(SecondLight(measured));
  if (!traits.dark) all.push_back(DarkCurve(measured));
  const int groups = SubstringsOf(traits);
  const bool in_groups = traits.single && groups > 1 && traits.cells % groups == 0;
  if (in_groups) all.push_back(CoveredParts(measured, groups));
  all.push_back(IscVoc(measured));
  return all;
}

CurveLaw LawOn(const PlannedCurve& curve, const Law& law, const std::vector<double>& theta) {
  CurveLaw own;
  own.law = law;
  own.law.effects.clear();
  for (int k = 0; k < law.base_size(); ++k) own.from.push_back(k);
  own.theta.assign(theta.begin(), theta.begin() + law.base_size());
  for (std::size_t e = 0; e < law.effects.size(); ++e) {
    const Effect& effect = *law.effects[e];
    if (!curve.at_once && effect.where == Where::kSweep) continue;
    const int first = law.Offset(static_cast<int>(e));
    std::vector<double> values(theta.begin() + first, theta.begin() + first + effect.size());
    const bool moves = curve.covered >= 0 && effect.covered != nullptr;
    if (moves && !effect.covered(values.data(), curve.covered, curve.groups)) continue;
    own.law.effects.push_back(&effect);
    for (int k = 0; k < effect.size(); ++k) own.from.push_back(first + k);
    own.theta.insert(own.theta.end(), values.begin(), values.end());
  }
  return own;
}

Readings Under(const PlannedCurve& curve, const std::vector<double>& unknown) {
  Readings readings = curve.readings;
  for (Reading& r : readings.points) {
    if (curve.light >= 0) r.irradiance *= 1 + unknown[curve.light];
    if (curve.temperature >= 0) r.temperature_K += unknown[curve.temperature];
    if (curve.drop >= 0) r.voltage += unknown[curve.drop];
  }
  return readings;
}

}  // namespace lyrefit
