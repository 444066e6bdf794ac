#include "lyrefit/model/make_readings.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/check_readings.h"
#include "lyrefit/curve/dark.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/curve/sweep_order.h"
#include "lyrefit/curve/technology.h"
#include "lyrefit/model/default_values.h"
#include "lyrefit/model/law.h"

namespace lyrefit {

std::vector<int> UsualSubstrings(int cells) {
  constexpr int kMostOfAModule = 150, kOfAModule = 3, kOfAGroup = 20;
  std::vector<int> usual;
  if (cells <= kMostOfAModule) return usual;
  for (const int module : {60, 72, 54, 66}) {
    if (cells % module == 0) usual.push_back(kOfAModule * cells / module);
  }
  if (usual.empty()) usual.push_back((cells + kOfAGroup / 2) / kOfAGroup);
  return usual;
}

int SubstringsOf(const DataTraits& traits) {
  constexpr int kUsual = 24, kMost = 3;  // cells per bypass group, groups per module
  if (traits.substrings > 0) return traits.substrings;
  if (traits.bypass_known) return 1;
  return std::min(std::max((traits.cells + kUsual - 1) / kUsual, 1), kMost);
}

Readings InBrightestLight(const Readings& measured) {
  Reading at = measured.points.front();
  for (const Reading& r : measured.points) {
    if (r.irradiance > at.irradiance) at = r;
  }
  at.x = at.rate = 0;
  at.current = at.irradiance > 0 ? 1 : 0;
  Readings bare = measured;
  bare.points = {at};
  return bare;
}

namespace {

bool TimesIncrease(const std::vector<double>& time) {
  for (std::size_t k = 1; k < time.size(); ++k) {
    if (!(time[k] > time[k - 1])) return false;
  }
  return !time.empty();
}

bool Varies(const std::vector<double>& values, double part) {
  if (values.empty()) return false;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low > part * std::max(std::fabs(*high), std::fabs(*low));
}

// Decides from its readings whether a curve is dark. Warns if the metadata disagree.
bool DecideDark(const IvCurve& curve, std::vector<std::string>* warnings) {
  constexpr double kOffset_W_m2 = 20;  // possible offset of an irradiance sensor in the dark
  const bool dark = IsDark(curve);
  if (!dark && IsStatedDark(curve)) {
    warnings->push_back(curve.name +
                        ": stated as dark, but it delivers current at 0 V; taken as lit at 1000 "
                        "W/m2");
  }
  const bool said_lit = !curve.irradiance_known || curve.conditions.irradiance_W_m2 > kOffset_W_m2;
  if (dark && said_lit) {
    warnings->push_back(curve.name + ": stated as lit, but no current flows at 0 V; taken as dark");
  }
  return dark;
}

struct CurveLayout {
  std::vector<double> clock;  // time in s, or reading number
  bool times = false;
  std::vector<int> turns;
};

CurveLayout LayOut(const IvCurve& curve, std::vector<std::string>* warnings) {
  CurveLayout layout;
  layout.turns = FindTurns(curve.voltage_V);
  layout.times = TimesIncrease(curve.time_s);
  if (!curve.time_s.empty() && !layout.times) {
    warnings->push_back(curve.name +
                        ": the times do not increase from reading to reading; the order of the "
                        "file is taken instead");
  }
  if (!curve.sweep.empty()) {
    const std::set<int> sweeps(curve.sweep.begin(), curve.sweep.end());
    if (sweeps.size() > 1 && layout.turns.size() == 1) {
      warnings->push_back(curve.name +
                          ": several sweeps are stated, but the voltage runs in one direction "
                          "only; taken as one sweep");
    }
  }
  for (std::size_t k = 0; k < curve.size(); ++k) {
    layout.clock.push_back(layout.times ? curve.time_s[k] : static_cast<double>(k));
  }
  return layout;
}

// dV/dt per cell, a central difference within a monotone stretch of voltage.
double Rate(const IvCurve& curve, const CurveLayout& layout, int cells, int k, int first,
            int last) {
  const int before = std::max(k - 1, first), after = std::min(k + 1, last);
  const double span = layout.clock[after] - layout.clock[before];
  if (!(span > 0)) return 0;
  return (curve.voltage_V[after] - curve.voltage_V[before]) / cells / span;
}

void AppendCurve(const IvCurve& curve, int index, bool dark, int cells, const CurveLayout& layout,
                 Readings* readings) {
  const bool monitored = !dark && curve.irradiance_known && Varies(curve.irradiance_W_m2, 0.005);
  const double first = layout.clock.front();
  const double span = std::max(layout.clock.back() - first, 1e-300);
  int segment = readings->points.empty() ? 0 : readings->points.back().segment + 1;
  std::size_t turn = 0;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    if (turn + 1 < layout.turns.size() && layout.turns[turn + 1] == static_cast<int>(k)) {
      ++turn;
      ++segment;
    }
    const int begin = layout.turns[turn];
    const int end = turn + 1 < layout.turns.size() ? layout.turns[turn + 1] - 1
                                                   : static_cast<int>(curve.size()) - 1;
    Reading reading;
    reading.voltage = curve.voltage_V[k] / cells;
    reading.current = curve.current_A[k];
    reading.irradiance = (monitored                ? curve.irradiance_W_m2[k]
                          : curve.irradiance_known ? curve.conditions.irradiance_W_m2
                                                   : 1000.0) /
                         1000;
    if (dark) reading.irradiance = 0;
    if (!dark && reading.irradiance <= 0) reading.irradiance = 1;
    reading.temperature_K = curve.conditions.cell_temperature_K;
    reading.x = (layout.clock[k] - first) / span - 0.5;
    reading.rate = Rate(curve, layout, cells, static_cast<int>(k), begin, end);
    reading.curve = index;
    reading.index = static_cast<int>(k);
    reading.dark = dark;
    reading.suns_voc = curve.suns_voc_A.has_value();
    if (reading.suns_voc) reading.x = reading.rate = 0;
    reading.segment = segment;
    readings->points.push_back(reading);
  }
  readings->scale.times = readings->scale.times || layout.times;
  if (layout.times) readings->scale.span_s = std::max(readings->scale.span_s, span);
}

// Number of levels `apart` from each other; also defined for values without gaps.
int Levels(std::vector<double> values, double apart) {
  std::sort(values.begin(), values.end());
  int levels = 0;
  double level = 0;
  for (const double value : values) {
    if (levels > 0 && value - level <= apart) continue;
    level = value;
    ++levels;
  }
  return levels;
}

// Open-circuit voltage of a lit curve, per cell, by linear interpolation; 0 if there is no zero
// crossing or the curve is dark.
double OpenCircuit(const std::vector<Reading>& points, int curve) {
  std::vector<std::pair<double, double>> sorted;
  for (const Reading& r : points) {
    if (r.curve == curve && !r.dark) sorted.emplace_back(r.voltage, r.current);
  }
  std::sort(sorted.begin(), sorted.end());
  double found = 0;
  for (std::size_t k = 1; k < sorted.size(); ++k) {
    const auto& [v0, i0] = sorted[k - 1];
    const auto& [v1, i1] = sorted[k];
    if (i0 > 0 && i1 <= 0) found = v0 + (v1 - v0) * i0 / (i0 - i1);
  }
  return found;
}

// Turns between two long stretches of one curve; short stretches are noise of the voltage.
void SetTurns(Readings* readings) {
  constexpr int kLong = 7;
  const std::vector<Reading>& points = readings->points;
  std::vector<double>& turns = readings->traits.turns;
  turns.clear();
  std::size_t before = 0;  // length of the stretch before
  for (std::size_t first = 0, last = 0; first < points.size(); first = last) {
    while (last < points.size() && points[last].segment == points[first].segment) ++last;
    const bool same = first > 0 && points[first].curve == points[first - 1].curve;
    if (same && !points[first].suns_voc && before >= kLong && last - first >= kLong) {
      turns.push_back(0.5 * (points[first - 1].x + points[first].x));
    }
    before = last - first;
  }
}

void SetScales(Readings* readings) {
  double scale = 0, largest = 0, rates = 0;
  for (const Reading& r : readings->points) {
    largest = std::max(largest, std::fabs(r.current));
    if (!r.dark && r.voltage > -0.05) scale = std::max(scale, r.current);
    rates += r.rate * r.rate;
  }
  if (!(scale > 0)) scale = largest;
  if (!(scale > 0)) scale = 1;
  readings->scale.current_A = scale;
  const double rate = std::sqrt(rates / static_cast<double>(readings->points.size()));
  readings->scale.rate_V_per_s = rate > 0 ? rate : 1;
  for (Reading& r : readings->points) {
    r.current /= scale;
    r.rate /= readings->scale.rate_V_per_s;
  }
}

void FindTraits(const CurveSet& set, Readings* readings) {
  DataTraits& traits = readings->traits;
  std::vector<double> lit_irradiance, temperature;
  traits.readings = static_cast<int>(readings->points.size());
  traits.lowest_voltage = traits.highest_voltage = readings->points.front().voltage;
  bool any_dark = false;
  for (const Reading& r : readings->points) {
    any_dark = any_dark || r.dark;
    traits.lowest_voltage = std::min(traits.lowest_voltage, r.voltage);
    traits.highest_voltage = std::max(traits.highest_voltage, r.voltage);
    temperature.push_back(r.temperature_K);
    if (!r.dark) lit_irradiance.push_back(r.irradiance);
    if (!r.dark && !r.suns_voc && r.current < -0.01) traits.beyond_voc = true;
    if (!r.dark) traits.largest_current = std::max(traits.largest_current, r.current);
  }
  traits.curves = static_cast<int>(set.curves.size());
  traits.only_dark = lit_irradiance.empty();
  traits.dark = any_dark && !traits.only_dark;
  const auto traces = std::count_if(set.curves.begin(), set.curves.end(), [](const IvCurve& curve) {
    return curve.suns_voc_A.has_value();
  });
  traits.suns_voc = traces > 0 && traces < static_cast<std::ptrdiff_t>(set.curves.size());
  const bool one_curve = set.curves.size() - (traits.suns_voc ? traces : 0) == 1;
  traits.irradiance_levels = one_curve ? 1 : std::max(1, Levels(lit_irradiance, 0.02));
  traits.temperature_levels = Levels(temperature, 2);
  traits.single = one_curve;
  traits.reverse = traits.lowest_voltage < -0.1;
  traits.cells = readings->scale.cells;
  traits.module = traits.cells > 1;
  const std::optional<int>& diodes = set.curves.front().notes.bypass_diodes;
  const std::vector<int> usual = UsualSubstrings(traits.cells);
  traits.substrings = diodes.value_or(usual.empty() ? 0 : usual.front());
  traits.bypass_known = diodes.has_value();
  for (int c = 0; c < traits.curves; ++c) {
    traits.open_circuit = std::max(traits.open_circuit, OpenCircuit(readings->points, c));
    std::set<int> segments;
    for (const Reading& r : readings->points) {
      if (r.curve == c && !r.suns_voc) segments.insert(r.segment);
    }
    traits.up_down = traits.up_down || segments.size() > 1;
  }
  SetTurns(readings);
  SetStepTimes(readings);
  SetRangeCurrents(readings);
}

// Number of cells used in the computation. A junction gives at most some 1.6 V. If the stated or
// assumed number contradicts this, the number follows from the open-circuit voltage.
int CountCells(const CurveSet& set, DataTraits* traits, std::vector<std::string>* warnings) {
  constexpr double kMost_V = 1.6;
  const IvCurve& first = set.curves.front();
  traits->stated_cells = first.conditions.cells_in_series;
  traits->cells_known = first.cells_known;
  double voc = 0;
  for (const IvCurve& curve : set.curves) {
    const KeyPoints points = FindKeyPoints(curve.voltage_V, curve.current_A);
    // For a sweep that ends before open circuit the largest voltage is a lower bound of Voc.
    voc = std::max(voc, points.open_circuit_voltage_V > 0
                            ? points.open_circuit_voltage_V
                            : *std::max_element(curve.voltage_V.begin(), curve.voltage_V.end()));
  }
  if (!(voc / traits->stated_cells > kMost_V)) return traits->stated_cells;
  const int cells = LikelyCells(voc);
  warnings->push_back(NumberText(voc) + " V over " + std::to_string(traits->stated_cells) +
                      (traits->cells_known ? " stated" : " assumed") +
                      " cells is more than a junction gives; reckoned with " +
                      std::to_string(cells) + " cells, which n absorbs");
  return cells;
}

// Stated properties of the device, else the defaults of a joint fit.
void TakeNotes(const CurveSet& set, Readings* readings) {
  readings->bandgap_eV = kDefaultBandgap_eV;
  readings->isc_tempco_per_K = kDefaultTempco_per_K;
  readings->traits.bandgap_known = readings->traits.tempco_known = false;
  for (const IvCurve& curve : set.curves) {
    const DeviceNotes& notes = curve.notes;
    if (notes.bandgap_eV && !readings->traits.bandgap_known) {
      readings->bandgap_eV = *notes.bandgap_eV;
      readings->traits.bandgap_known = true;
    }
    if (notes.bandgap_slope_per_K && !readings->bandgap_slope_per_K) {
      readings->bandgap_slope_per_K = notes.bandgap_slope_per_K;
    }
    if (readings->traits.tempco_known) continue;
    if (notes.isc_tempco_per_K) {
      readings->isc_tempco_per_K = *notes.isc_tempco_per_K;
      readings->traits.tempco_known = true;
    } else if (notes.isc_tempco_A_per_K) {
      readings->isc_tempco_per_K = 0;
      readings->isc_tempco_scales_per_K = *notes.isc_tempco_A_per_K / readings->scale.current_A;
      readings->traits.tempco_known = true;
    }
  }
}

// The highest open-circuit voltage of a cell of the stated technology; of silicon in modules of which
// none is stated. What the readings exceed is no limit.
double MostOpenCircuit(const Readings& readings, const std::string& stated) {
  const DataTraits& traits = readings.traits;
  const Technology* const named = FindTechnology(stated);
  const bool unknown = named == nullptr && !(stated.empty() && traits.module);
  if (traits.only_dark || unknown) return 0;
  const Reading& brightest = *std::max_element(
      readings.points.begin(), readings.points.end(),
      [](const Reading& a, const Reading& b) { return a.irradiance < b.irradiance; });
  const double most = HighestVoc_V(named != nullptr ? *named : Silicon(), brightest.temperature_K,
                                   brightest.irradiance);
  const double measured = traits.open_circuit > 0 ? traits.open_circuit : traits.highest_voltage;
  return measured < most ? most : 0;
}

// Larger values than any device or meter gives are error codes, and their squares may overflow.
Expected<void> CheckSizes(const IvCurve& curve) {
  constexpr double kLargest = 1e6;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const bool voltage = std::fabs(curve.voltage_V[k]) > kLargest;
    if (!voltage && !(std::fabs(curve.current_A[k]) > kLargest)) continue;
    return Fail(curve.name + ": reading " + std::to_string(k + 1) + " is " +
                NumberText(voltage ? curve.voltage_V[k] : curve.current_A[k]) +
                (voltage ? " V" : " A") + ", which no device gives: leave it out");
  }
  return {};
}

}  // namespace

void SetStepTimes(Readings* readings) {
  constexpr double kNear = 0.05;
  readings->traits.step_times.clear();
  if (!readings->traits.single) return;
  const std::vector<Reading>& points = readings->points;
  const std::vector<double>& turns = readings->traits.turns;
  for (std::size_t k = 1; k + 2 < points.size(); ++k) {
    if (points[k].suns_voc || points[k + 1].suns_voc) continue;
    const double x = 0.5 * (points[k].x + points[k + 1].x);
    // A step at the turn is the difference of the directions.
    const bool at_turn =
        std::any_of(turns.begin(), turns.end(), [x](double t) { return std::fabs(x - t) < kNear; });
    if (!at_turn) readings->traits.step_times.push_back(x);
  }
}

void SetRangeCurrents(Readings* readings) {
  constexpr double kLeast = 0.03, kMost = 0.97, kApart = 0.01;
  std::vector<double>& places = readings->traits.range_currents;
  places.clear();
  if (!readings->traits.single) return;
  const std::vector<Reading>& points = readings->points;
  for (std::size_t k = 1; k < points.size(); ++k) {
    if (points[k].segment != points[k - 1].segment || points[k].dark) continue;
    if (points[k].suns_voc) continue;
    for (const double part : {0.25, 0.5, 0.75}) {  // a jump moves one of the two
      places.push_back(points[k].current + part * (points[k - 1].current - points[k].current));
    }
  }
  std::sort(places.begin(), places.end());
  std::size_t kept = 0;
  for (const double place : places) {
    if (place < kLeast || place > kMost) continue;
    if (kept > 0 && place < places[kept - 1] + kApart) continue;
    places[kept++] = place;
  }
  places.resize(kept);
}

Expected<Readings> MakeReadings(const CurveSet& set, std::vector<std::string>* warnings) {
  if (set.curves.empty()) return Fail("there is no curve");
  Readings readings;
  for (const IvCurve& curve : set.curves) {
    TRY(Validate(curve));
    TRY(CheckSizes(curve));
  }
  readings.scale.cells = CountCells(set, &readings.traits, warnings);
  for (std::size_t c = 0; c < set.curves.size(); ++c) {
    const IvCurve& curve = set.curves[c];
    if (curve.conditions.cells_in_series != set.curves.front().conditions.cells_in_series) {
      return Fail(curve.name +
                  ": its number of cells differs from the others'; a measurement is of "
                  "one device");
    }
    const bool dark = DecideDark(curve, warnings);
    AppendCurve(curve, static_cast<int>(c), dark, readings.scale.cells, LayOut(curve, warnings),
                &readings);
  }
  SetScales(&readings);
  FindTraits(set, &readings);
  readings.scale.strings = set.curves.front().conditions.strings_in_parallel;
  TakeNotes(set, &readings);
  DataTraits& traits = readings.traits;
  traits.setup = set.curves.front().notes.setup;
  traits.most_open_circuit = MostOpenCircuit(readings, set.curves.front().notes.technology);
  readings.reference_temperature_K =
      traits.temperature_levels > 1 ? 298.15 : set.curves.front().conditions.cell_temperature_K;
  traits.thermal_voltage = ThermalVoltage(readings.reference_temperature_K);
  readings.pivot_voltage =
      traits.open_circuit > 0 ? traits.open_circuit : std::max(0.9 * traits.highest_voltage, 0.05);
  readings.scale.reach_V =
      std::max({std::fabs(traits.lowest_voltage), std::fabs(traits.highest_voltage), 1e-3});
  readings.scale.saturation_2_unit = Saturation2Unit(readings);
  return readings;
}

}  // namespace lyrefit
