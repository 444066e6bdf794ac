#include "lyrefit/curve/plausibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/median.h"
#include "lyrefit/curve/technology.h"

namespace lyrefit {
namespace {

constexpr double kStandard_W_m2 = 1000;
// Lower irradiances may be a sensor's offset; currents are scaled by this value at least.
constexpr double kLeastLight_W_m2 = 10;
// The largest cells deliver about 20 A, and the strings of a combiner box are rarely all stated.
constexpr double kMostOfString_A = 100;
// Current densities of all photons of AM1.5G above a gap (Ruehle 2016,
// doi:10.1016/j.solener.2016.02.015). Areas and spectra are rarely known to better than a fifth.
constexpr struct {
  double gap_eV;
  double density_mA_cm2;
} kPhotons[] = {{0.3, 70}, {0.66, 60}, {1.0, 48}, {1.12, 44}, {1.42, 32}, {1.75, 21}, {2.3, 9}};
constexpr double kDensityTolerance = 1.2;
// Limits of one junction and of three under one sun, and of both under concentration (de Vos 1980,
// doi:10.1088/0022-3727/13/5/018; Ruehle).
constexpr double kMostOfJunction = 0.337, kMostOfStack = 0.5;
constexpr double kMostOfJunctionConcentrated = 0.41, kMostOfStackConcentrated = 0.64;
constexpr double kLeastOfModule_A = 0.02;
constexpr int kCellsOfModule = 30;
constexpr double kLeastLightOfModule_W_m2 = 100;  // excludes dusk
// A diode of n = 1 at 1.5 V has 0.92, and irradiance that rises during the sweep increases it.
constexpr double kMostFillFactor = 0.95;
constexpr double kLeastFillFactor = 0.1;
// Strong irradiance, cold cells and a bright rear side give less than twice the rating.
constexpr double kMostOfRating = 3;
// A wrong unit of the current (mA for A) is a factor of 1000.
constexpr double kLeastOfRating = 1.0 / 300;
constexpr double kLeastLightOfRating_W_m2 = 200;

// Isc, or the largest current at forward voltage if the readings do not reach 0 V; 0 if none is
// delivered.
double DeliveredCurrent_A(const IvCurve& curve, const KeyPoints& key) {
  constexpr double kLit = 0.1;  // of the largest current
  double delivered_A = 0;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    if (curve.voltage_V[k] >= 0) delivered_A = std::max(delivered_A, curve.current_A[k]);
  }
  if (std::isfinite(key.short_circuit_current_A)) delivered_A = key.short_circuit_current_A;
  return delivered_A > kLit * LargestMagnitude(curve.current_A) ? delivered_A : 0;
}

// Irradiance as a fraction of 1000 W/m2; 1 if not stated.
double LightOf(const IvCurve& curve) {
  if (!curve.irradiance_known) return 1;
  return std::max(curve.conditions.irradiance_W_m2, kLeastLight_W_m2) / kStandard_W_m2;
}

std::string AtLight(const IvCurve& curve) {
  if (!curve.irradiance_known) return "";
  return fmt::format(" at the stated {:.4g} W/m2", curve.conditions.irradiance_W_m2);
}

std::string TooMuchOfString(const IvCurve& curve, double isc_A) {
  const int strings = curve.conditions.strings_in_parallel;
  if (!(isc_A > kMostOfString_A * strings * LightOf(curve))) return "";
  const char* light = isc_A <= kMostOfString_A * strings ? "or less light than there was" : "";
  return fmt::format(
      "Isc of {:.4g} A{} is more than any cell gives, with {} string{} in parallel: other units "
      "than were read (mA?), {}",
      isc_A, AtLight(curve), strings, strings == 1 ? "" : "s",
      *light != '\0' ? light : "or strings in parallel that nobody stated");
}

// All photons for no known technology; those of several junctions in series share them.
double MostDensity_mA_cm2(const std::string& technology) {
  const Technology* const known = FindTechnology(technology);
  if (known == nullptr) return kPhotons[0].density_mA_cm2;
  if (known->junctions > 1) return kPhotons[0].density_mA_cm2 / known->junctions;
  for (std::size_t k = 1; k < std::size(kPhotons); ++k) {
    const auto &from = kPhotons[k - 1], &to = kPhotons[k];
    if (known->bandgap_eV > to.gap_eV) continue;
    const double part = (known->bandgap_eV - from.gap_eV) / (to.gap_eV - from.gap_eV);
    return kDensityTolerance *
           (from.density_mA_cm2 + part * (to.density_mA_cm2 - from.density_mA_cm2));
  }
  return kPhotons[0].density_mA_cm2;
}

std::string TooMuchOfArea(const IvCurve& curve, double isc_A) {
  if (!curve.notes.area_cm2 || !(*curve.notes.area_cm2 > 0)) return "";
  const double density_mA_cm2 =
      1e3 * isc_A / curve.conditions.strings_in_parallel / *curve.notes.area_cm2;
  const double most_mA_cm2 = MostDensity_mA_cm2(curve.notes.technology);
  if (!(density_mA_cm2 > most_mA_cm2 * LightOf(curve))) return "";
  return fmt::format(
      "Isc of {:.4g} A from cells of {:.4g} cm2 is {:.4g} mA/cm2{}, more than sunlight gives "
      "({:.3g} mA/cm2 at 1000 W/m2): other units than were read, or the area of another device",
      isc_A, *curve.notes.area_cm2, density_mA_cm2, AtLight(curve), most_mA_cm2);
}

std::string TooLittleOfModule(const IvCurve& curve, double isc_A) {
  const Conditions& at = curve.conditions;
  const bool bright = curve.irradiance_known && at.irradiance_W_m2 >= kLeastLightOfModule_W_m2;
  if (!bright || !curve.cells_known || at.cells_in_series < kCellsOfModule || !(isc_A > 0))
    return "";
  if (!(isc_A < kLeastOfModule_A * at.strings_in_parallel * LightOf(curve))) return "";
  return fmt::format(
      "Isc of {:.4g} A{} is less than a module of {} cells gives: other units than were read "
      "(ampere written as milliampere?), or a module in the shade",
      isc_A, AtLight(curve), at.cells_in_series);
}

// The power of a cell over the light on it. The limit of a junction holds where one is stated.
std::string TooEfficient(const IvCurve& curve, const KeyPoints& key) {
  constexpr double kConcentrated = 2;
  if (!curve.notes.area_cm2 || !(*curve.notes.area_cm2 > 0)) return "";
  const Conditions& at = curve.conditions;
  const double light_W = kStandard_W_m2 * LightOf(curve) * 1e-4 * *curve.notes.area_cm2;
  const double part = key.max_power_W / (light_W * at.cells_in_series * at.strings_in_parallel);
  const Technology* const known = FindTechnology(curve.notes.technology);
  const bool one = known != nullptr && known->junctions == 1;
  const double most = LightOf(curve) > kConcentrated
                          ? (one ? kMostOfJunctionConcentrated : kMostOfStackConcentrated)
                          : (one ? kMostOfJunction : kMostOfStack);
  if (!(part > most)) return "";
  return fmt::format(
      "{:.4g} W from {:.4g} cm2 a cell are {:.3g} % of the light{}, more than {} can give ({:.3g} "
      "%): other units than were read, other light, or the area of another device",
      key.max_power_W, *curve.notes.area_cm2, 100 * part,
      curve.irradiance_known ? AtLight(curve) : " at the assumed 1000 W/m2",
      one ? "one junction" : "cells of three junctions", 100 * most);
}

// Checks the fill factor of the readings themselves: a parabola through few readings may exceed
// them.
std::string OddShape(const IvCurve& curve, const KeyPoints& key) {
  double power_W = 0;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    power_W = std::max(power_W, curve.voltage_V[k] * curve.current_A[k]);
  }
  const double fill_factor = power_W / (key.short_circuit_current_A * key.open_circuit_voltage_V);
  if (!(power_W > 0) || !std::isfinite(fill_factor)) return "";
  if (fill_factor >= kLeastFillFactor && fill_factor <= kMostFillFactor) return "";
  return fmt::format(
      "the fill factor is {:.3g}, {}: are all readings of one curve, and which column is which?",
      fill_factor,
      fill_factor > kMostFillFactor ? "more than a diode allows"
                                    : "of a curve with no power in it");
}

// Sun heats the cells of a module to some 90 C where air stands still behind it.
std::string TooHotForModule(const IvCurve& curve) {
  constexpr double kHottest_C = 95;
  const double stated_C = curve.conditions.cell_temperature_K - kZeroCelsius_K;
  if (curve.conditions.cells_in_series < kCellsOfModule || !(stated_C > kHottest_C)) return "";
  return fmt::format(
      "a cell temperature of {:.4g} C is more than sun gives a module: {:.3g} C in degrees "
      "Fahrenheit?",
      stated_C, (stated_C - 32) / 1.8);
}

std::optional<std::string> ImplausiblePower(const IvCurve& curve, double rated_W) {
  const KeyPoints key = FindKeyPoints(curve.voltage_V, curve.current_A);
  if (!(rated_W > 0) || !(key.max_power_W > 0)) return std::nullopt;
  const double ratio = key.max_power_W / rated_W;
  if (ratio > kMostOfRating) {
    return fmt::format(
        "Pmax of {:.4g} W is {:.4g} times the rated power of {:.4g} W: other units than were read "
        "(mA?), or the rating of another device",
        key.max_power_W, ratio, rated_W);
  }
  const double light = curve.conditions.irradiance_W_m2 / kStandard_W_m2;
  const bool bright =
      curve.irradiance_known && curve.conditions.irradiance_W_m2 >= kLeastLightOfRating_W_m2;
  if (bright && ratio < kLeastOfRating * light) {
    return fmt::format(
        "Pmax of {:.4g} W{} is {:.2g} times the rated power of {:.4g} W: other units than were "
        "read, the rating of another device, or no light on it",
        key.max_power_W, AtLight(curve), ratio, rated_W);
  }
  return std::nullopt;
}

}  // namespace

std::vector<ReadingFinding> CheckPlausibility(const IvCurve& curve) {
  const KeyPoints key = FindKeyPoints(curve.voltage_V, curve.current_A);
  const double isc_A = DeliveredCurrent_A(curve, key);
  std::vector<ReadingFinding> findings;
  std::string current = TooMuchOfString(curve, isc_A);
  if (current.empty()) current = TooMuchOfArea(curve, isc_A);
  if (current.empty()) current = TooLittleOfModule(curve, isc_A);
  if (!current.empty()) findings.push_back({"current", current, false, {}});
  const std::string efficient = isc_A > 0 && current.empty() ? TooEfficient(curve, key) : "";
  if (!efficient.empty()) findings.push_back({"efficiency", efficient, false, {}});
  const std::string shape = isc_A > 0 ? OddShape(curve, key) : "";
  if (!shape.empty()) findings.push_back({"shape", shape, false, {}});
  const std::string hot = isc_A > 0 ? TooHotForModule(curve) : "";
  if (!hot.empty()) findings.push_back({"temperature", hot, false, {}});
  return findings;
}

std::optional<std::string> PlausibilityProblem(const IvCurve& curve,
                                               std::optional<double> rated_power_W) {
  if (rated_power_W) {
    if (auto why = ImplausiblePower(curve, *rated_power_W)) return why;
  }
  for (const ReadingFinding& finding : CheckReadings(curve)) {
    for (const char* const id : {"sign", "exchanged", "unit", "light", "technology", "current",
                                 "efficiency", "shape", "temperature"}) {
      if (finding.id == id) return finding.sentence;
    }
  }
  return std::nullopt;
}

namespace {

constexpr double kNarrowGap_eV = 0.9;  // cells below it may have less than kLowestCell_V
constexpr double kUsualCell_V = 0.62;
constexpr double kDim_W_m2 = 50;  // a cell may have a low voltage below this

// Whether a voltage may belong to one cell of several junctions as well as to a short string.
bool MayBeStack(double open_circuit_voltage_V, int cells) {
  return cells == 1 && open_circuit_voltage_V > kHighestCell_V &&
         open_circuit_voltage_V < kHighestStack_V;
}

constexpr int kCellsOfAModule = 150;  // most of one module; more are modules in series

constexpr char kStack[] =
    "or is this one cell of several junctions (a tandem: count them, --cells 2) or of a wide band "
    "gap";

// The highest voltage of a cell of the technology under the light and at the temperature of the
// curve. A temperature that nobody stated may be that of a cold morning.
double MostOfCell_V(const IvCurve& curve, const Technology& technology) {
  constexpr double kCold_K = kZeroCelsius_K - 25;
  const Conditions& at = curve.conditions;
  const double suns = curve.irradiance_known ? std::max(1.0, at.irradiance_W_m2 / 1000) : 1;
  return HighestVoc_V(technology, curve.temperature_known ? at.cell_temperature_K : kCold_K, suns);
}

// A voltage that fits a cell, but none of silicon, of which a module and a cell of some ampere are
// where nobody states another technology; or none of the stated technology.
void LookAtMaterial(const Examined& look, double cell_V, Findings* out) {
  constexpr double kLarge_A = 1, kConcentrated = 2;
  const IvCurve& curve = look.curve;
  const Technology* const known = FindTechnology(curve.notes.technology);
  const bool concentrated =
      curve.irradiance_known && curve.conditions.irradiance_W_m2 > 1000 * kConcentrated;
  const bool usually_silicon =
      (curve.conditions.cells_in_series > 1 || look.delivered_A > kLarge_A) && !concentrated &&
      curve.notes.technology.empty();
  if (known == nullptr && !usually_silicon) return;
  const Technology& of = known != nullptr ? *known : Silicon();
  const double most_V = MostOfCell_V(curve, of);
  if (!(cell_V > most_V)) return;
  const std::string cells =
      fmt::format("number of cells ({}; --cells)", curve.conditions.cells_in_series);
  out->push_back(
      {"technology",
       fmt::format("Voc is {:.3g} V a cell, and {} gives {:.2f} V at most{}", cell_V,
                   known != nullptr ? "a cell of " + std::string(of.name) : "one of silicon",
                   most_V,
                   known != nullptr
                       ? fmt::format(": is the {} or the technology (--technology) another?", cells)
                       : fmt::format(", which is taken where no technology is stated: give it "
                                     "(--technology CdTe, GaAs, perovskite, ...) or the right {}",
                                     cells)),
       false,
       {}});
}

}  // namespace

void LookAtCells(const Examined& look, Findings* out) {
  const IvCurve& curve = look.curve;
  const bool reached = look.key.open_circuit_voltage_V > 0;
  // If the sweep ends before open circuit, Voc is above its highest voltage.
  const double voc = reached ? look.key.open_circuit_voltage_V
                             : *std::max_element(curve.voltage_V.begin(), curve.voltage_V.end());
  if (!look.lit || !(voc > 0)) return;
  const int cells = curve.conditions.cells_in_series;
  const double per_cell = voc / cells;
  const bool dim = curve.irradiance_known && curve.conditions.irradiance_W_m2 < kDim_W_m2;
  const int likely = LikelyCells(voc);
  const Technology* const known = FindTechnology(curve.notes.technology);
  const double highest_V =
      std::max(kHighestCell_V, known != nullptr ? MostOfCell_V(curve, *known) : 0);
  const bool narrow = known != nullptr && known->bandgap_eV < kNarrowGap_eV;
  constexpr int kMillivoltFirst = 100;  // cells: more than a module has in series
  if (per_cell > highest_V && !curve.cells_known && !curve.voltage_unit_known &&
      likely >= kMillivoltFirst) {
    out->push_back({"cells",
                    fmt::format("{} {:.4g} V and the file names no unit: millivolt "
                                "(--voltage-unit mV)? or some {} cells in series (--cells)?",
                                reached ? "Voc is" : "the curve goes to", voc, likely),
                    false,
                    {}});
  } else if (per_cell > highest_V && !curve.cells_known) {
    out->push_back(
        {"cells",
         fmt::format("{} {:.4g} V: some {} cells in series{}? give their number (--cells)",
                     reached ? "Voc is" : "the curve goes to", voc, likely,
                     MayBeStack(voc, cells) ? fmt::format(", {}", kStack) : ""),
         false,
         {}});
  } else if (per_cell > highest_V || (reached && per_cell < kLowestCell_V && !dim && !narrow)) {
    const std::string stated =
        curve.cells_known ? fmt::format("each of {} stated cells", cells) : "one cell";
    const std::string each =
        per_cell < 1 ? fmt::format("{:.3g} mV", 1e3 * per_cell) : fmt::format("{:.4g} V", per_cell);
    const std::string instead =
        MayBeStack(voc, cells)
            ? fmt::format(": were cells in series forgotten (--cells {}), {}?", likely, kStack)
        : likely > kCellsOfAModule && likely != cells
            ? fmt::format(": give the cells of all modules in series (--cells, near {})?", likely)
        : likely != cells ? fmt::format(": give --cells {}?", likely)
                          : ": is the unit right?";
    out->push_back({"cells",
                    fmt::format("{} {:.4g} V: {} for {}, and a cell at light has {:g} to {:g} V{}",
                                reached ? "Voc is" : "the curve goes to", voc, each, stated,
                                kLowestCell_V, highest_V, instead),
                    curve.cells_known,
                    {}});
  } else {
    LookAtMaterial(look, per_cell, out);
  }
}

int LikelyCells(double open_circuit_voltage_V) {
  const double cells = open_circuit_voltage_V / kUsualCell_V;
  constexpr double kTolerance = 0.1;
  int likely = std::max(1, static_cast<int>(std::lround(std::min(cells, 1e6))));
  double nearest = kTolerance;
  for (const int usual : {36, 54, 60, 72, 96}) {
    const double distance = std::fabs(usual / cells - 1);
    if (distance < nearest) likely = usual;
    nearest = std::min(nearest, distance);
  }
  return likely;
}

}  // namespace lyrefit
