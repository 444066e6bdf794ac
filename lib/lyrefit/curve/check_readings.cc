#include "lyrefit/curve/check_readings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "lyrefit/base/median.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/dark.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/curve/plausibility.h"
#include "lyrefit/curve/sweep_order.h"

namespace lyrefit {
namespace {

constexpr double kSmallest_A = 1e-18;    // below the resolution of any instrument
constexpr double kLargestString_A = 30;  // of one string, if no unit is named
constexpr double kLargestVoltage_V = 2000;
constexpr double kLargestStated_A = 2e4;  // of one string, for any unit
constexpr double kLargestStated_V = 2e4;
constexpr double kDark_W_m2 = 20;  // a sensor may show an offset below this

Examined Examine(const IvCurve& curve) {
  constexpr double kNoise = 0.02;  // of the largest current
  Examined look{curve, FindKeyPoints(curve.voltage_V, curve.current_A),
                LargestMagnitude(curve.current_A), LargestMagnitude(curve.voltage_V)};
  for (std::size_t k = 0; k < curve.size(); ++k) {
    if (curve.voltage_V[k] >= 0) look.delivered_A = std::max(look.delivered_A, curve.current_A[k]);
  }
  look.lit = !IsDark(curve) && look.delivered_A > kNoise * look.largest_A;
  return look;
}

void LookForOverflow(const IvCurve& curve, Findings* out) {
  const struct {
    const char* name;
    const char* unit;
    const std::vector<double>& values;
  } columns[] = {{"voltage", "V", curve.voltage_V}, {"current", "A", curve.current_A}};
  for (const auto& column : columns) {
    std::vector<int> points;
    for (std::size_t k = 0; k < curve.size(); ++k) {
      if (std::fabs(column.values[k]) >= kOverflowCode) points.push_back(static_cast<int>(k));
    }
    if (points.empty()) continue;
    const std::string more =
        points.size() > 1 ? fmt::format(" and of {} more", points.size() - 1) : "";
    out->push_back(
        {"overflow",
         fmt::format("the {} of reading {}{} is {:.6g} {}, which instruments write for "
                     "an overflow or for no value: leave such rows out with --skip-missing",
                     column.name, points.front() + 1, more, column.values[points.front()],
                     column.unit),
         true, points, true});
  }
}

void LookForNothing(const IvCurve& curve, Findings* out) {
  const double largest = LargestMagnitude(curve.current_A);
  const bool equal = std::all_of(curve.current_A.begin(), curve.current_A.end(),
                                 [&](double value) { return value == curve.current_A.front(); });
  std::string sentence;
  if (largest == 0) {
    sentence = fmt::format(
        "all {} currents are 0: is this the column of the current, and was the "
        "device connected?",
        curve.size());
  } else if (equal) {
    sentence = fmt::format(
        "all {} currents are {:.6g} A: is this the column of the current, and "
        "did the instrument reach its limit?",
        curve.size(), curve.current_A.front());
  } else if (largest < kSmallest_A) {
    sentence = fmt::format(
        "the largest current is {:.3g} A, less than any instrument measures: is "
        "its unit right?",
        largest);
  }
  if (!sentence.empty()) out->push_back({"nothing", sentence, true, {}, true});
}

void LookAtSigns(const Examined& look, Findings* out) {
  constexpr double kOffset = 0.05;  // of the largest current
  const IvCurve& curve = look.curve;
  if (DetectCurrentSign(curve.voltage_V, curve.current_A) == CurrentSign::kUnclear) {
    const auto [low, high] = std::minmax_element(curve.voltage_V.begin(), curve.voltage_V.end());
    out->push_back(
        {"sign",
         fmt::format(
             "the current goes from {:.4g} A at {:.4g} V to {:.4g} A at {:.4g} V: no device "
             "delivers more at the higher voltage; does the voltage have the wrong sign? "
             "turn it in the file",
             curve.current_A[low - curve.voltage_V.begin()], *low,
             curve.current_A[high - curve.voltage_V.begin()], *high),
         true,
         {}});
  } else if (look.key.short_circuit_current_A < -kOffset * look.largest_A) {
    out->push_back({"sign",
                    fmt::format("at 0 V the current is {:.4g} A, where a device at light delivers "
                                "current and one in the dark has none: does the voltage have the "
                                "wrong sign, or an offset?",
                                look.key.short_circuit_current_A),
                    false,
                    {}});
  }
}

// Without light a device delivers no current, and at a few W/m2 less than the largest string would.
// A sensor's offset or an instrument's leakage stays below 5 % of the largest current.
void LookAtLight(const Examined& look, Findings* out) {
  constexpr double kOffset = 0.05;  // of the largest current
  const IvCurve& curve = look.curve;
  const double stated = curve.conditions.irradiance_W_m2;
  if (!curve.irradiance_known || !(stated < kDark_W_m2)) return;
  const double largest_A = kLargestString_A * curve.conditions.strings_in_parallel * stated / 1000;
  const double isc = look.key.short_circuit_current_A;
  if (!(isc > kOffset * look.largest_A && isc > largest_A)) return;
  constexpr double kSun = 1.6;  // in kW/m2
  out->push_back(
      {"light",
       fmt::format("{:g} W/m2 are stated, but the device delivers {:.4g} A at 0 V, which "
                   "it cannot without light: which of the two is right{}? state the light "
                   "with --irradiance-Wm2",
                   stated, isc, stated > 0 && stated < kSun ? ", or is it kW/m2" : ""),
       false,
       {}});
}

bool ImplausibleCell(double voltage_V) {
  return voltage_V < kLowestCell_V || voltage_V > kHighestCell_V;
}

// Voltage at which the current has fallen to `part` of `whole`, searched from open circuit.
double VoltageAt(double part, double whole, const std::vector<std::pair<double, double>>& points) {
  for (std::size_t k = points.size() - 1; k > 0; --k) {
    const auto& [v0, i0] = points[k - 1];
    const auto& [v1, i1] = points[k];
    if (!(i0 >= part * whole && i1 < part * whole)) continue;
    return v0 + (i0 - part * whole) / (i0 - i1) * (v1 - v0);
  }
  return std::nan("");
}

std::vector<std::pair<double, double>> ByFirst(const std::vector<double>& x,
                                               const std::vector<double>& y) {
  std::vector<std::pair<double, double>> points;
  for (std::size_t k = 0; k < x.size(); ++k) points.emplace_back(x[k], y[k]);
  std::sort(points.begin(), points.end());
  return points;
}

// Detects exchanged columns of voltage and current. Between open circuit and half the current, a
// diode at n = 1 loses ln 2 of its thermal voltage, 1.2 % of Voc or more. Series resistance adds to
// it. A shunt that takes an equal fraction of the current up to half the voltage is a poor one. In
// an exchanged curve the two fractions change places.
void LookForExchange(const Examined& look, Findings* out) {
  constexpr double kLeastDiode = 0.012, kPoorShunt = 0.02;
  const double voc = look.key.open_circuit_voltage_V;
  // An exchanged curve without open circuit looks like one without short circuit.
  const double known_isc = look.key.short_circuit_current_A;
  const double isc = known_isc > 0 ? known_isc : look.delivered_A;
  if (!look.lit || !(voc > 0)) return;
  const IvCurve& curve = look.curve;
  const double knee = 1 - VoltageAt(0.5, isc, ByFirst(curve.voltage_V, curve.current_A)) / voc;
  const double slope = 1 - VoltageAt(0.5, voc, ByFirst(curve.current_A, curve.voltage_V)) / isc;
  const bool mirrored = knee < kLeastDiode && slope > std::max(kPoorShunt, 2 * knee);
  const int cells = curve.conditions.cells_in_series;
  const bool fits_exchanged = curve.cells_known && ImplausibleCell(voc / cells) &&
                              !ImplausibleCell(isc / cells) && slope > knee;
  if (!mirrored && !fits_exchanged) return;
  const bool units = curve.current_unit_known && curve.voltage_unit_known;
  out->push_back({"exchanged",
                  fmt::format("Voc would be {:.4g} V and Isc {:.4g} A, with the knee of a curve "
                              "whose columns are exchanged: say which is which with "
                              "--voltage-column and --current-column",
                              voc, isc),
                  fits_exchanged || !units,
                  {}});
}

// What registers of an inverter may be, added to a doubt about their unit.
std::string AsRegisters(const std::vector<double>& readings, const std::string& question) {
  return AreWholeNumbers(readings) ? "an inverter's registers, in " + question + "? or " : "";
}

void LookAtUnits(const Examined& look, Findings* out) {
  const IvCurve& curve = look.curve;
  const int strings = curve.conditions.strings_in_parallel;
  const double current_A = look.lit ? look.delivered_A : look.largest_A;
  if (!curve.current_unit_known && current_A > kLargestString_A * strings) {
    out->push_back(
        {"unit",
         fmt::format("the largest current is {:.4g} A and the file names no unit: {}"
                     "milliampere{}? say so with --current-unit mA, {}A if it is "
                     "ampere",
                     current_A,
                     AsRegisters(curve.current_A,
                                 "hundredths or tenths of an ampere (--current-unit 0.01A, 0.1A)"),
                     look.largest_V < kLargestString_A ? ", or columns exchanged" : "",
                     look.largest_V < kHighestStack_V
                         ? "mA/cm2 or A/m2 with --area-cm2 if it is a density, or "
                         : "or "),
         true,
         {}});
  } else if (current_A > kLargestStated_A * strings) {
    out->push_back({"unit",
                    fmt::format("the largest current is {:.4g} A: is the unit of its column right?",
                                current_A),
                    true,
                    {}});
  }
  if (!curve.voltage_unit_known && look.largest_V > kLargestVoltage_V) {
    out->push_back(
        {"unit",
         fmt::format("the largest voltage is {:.4g} V and the file names no unit: {}"
                     "millivolt? say so with --voltage-unit mV, or V if it is volt",
                     look.largest_V,
                     AsRegisters(curve.voltage_V, "tenths of a volt (--voltage-unit 0.1V)")),
         true,
         {}});
  } else if (look.largest_V > kLargestStated_V) {
    out->push_back({"unit",
                    fmt::format("the largest voltage is {:.4g} V: is the unit of its column right?",
                                look.largest_V),
                    true,
                    {}});
  }
}

// The temperature of the cells enters n, whose error is not seen in the fit.
void LookAtHead(const IvCurve& curve, Findings* out) {
  if (curve.temperature_known) return;
  for (const Assumption& assumption : curve.assumptions) {
    if (!IsLeftTemperature(assumption)) continue;
    out->push_back(
        {"head", assumption.sentence + ", and 25 C enters n: give --temperature-C", false, {}});
    return;
  }
}

// Stated key points that no device has.
void LookAtKeyPoints(const IvCurve& curve, Findings* out) {
  if (!curve.key_points) return;
  const KeyPoints& key = *curve.key_points;
  const auto compare = [&](const char* inner, double a, const char* outer, double b, char unit) {
    if (!(a > b)) return;
    out->push_back({"key-points",
                    fmt::format("{} {:.4g} {} is above {} {:.4g} {}, which no device gives: one of "
                                "them is wrong",
                                inner, a, unit, outer, b, unit),
                    false,
                    {}});
  };
  compare("Imp", key.max_power_current_A, "Isc", key.short_circuit_current_A, 'A');
  compare("Vmp", key.max_power_voltage_V, "Voc", key.open_circuit_voltage_V, 'V');
}

}  // namespace

std::vector<ReadingFinding> CheckReadings(const IvCurve& curve) {
  Findings findings;
  LookForOverflow(curve, &findings);
  LookForNothing(curve, &findings);
  // Such values allow no other check.
  if (!findings.empty() || IsNight(curve)) return findings;
  const Examined look = Examine(curve);
  LookAtSigns(look, &findings);
  if (findings.empty()) LookForExchange(look, &findings);
  LookAtUnits(look, &findings);
  if (findings.empty()) {
    LookAtLight(look, &findings);
    const bool lit_as_stated = findings.empty();
    LookAtCells(look, &findings);
    if (lit_as_stated) {
      for (ReadingFinding& size : CheckPlausibility(curve)) findings.push_back(std::move(size));
    }
  }
  for (ReadingFinding& limit : FindEqualReadings(curve)) findings.push_back(std::move(limit));
  LookAtKeyPoints(curve, &findings);
  LookAtHead(curve, &findings);
  std::stable_sort(
      findings.begin(), findings.end(),
      [](const ReadingFinding& a, const ReadingFinding& b) { return a.refuse > b.refuse; });
  return findings;
}

Expected<std::vector<std::string>> JudgeReadings(const IvCurve& curve) {
  TRY(Validate(curve));
  std::vector<std::string> doubts;
  for (const ReadingFinding& finding : CheckReadings(curve)) {
    if (finding.always) return Fail(finding.sentence, curve.source);
    if (finding.refuse && !curve.as_is) {
      return Fail(finding.sentence + " (--as-is takes the readings as they are)", curve.source);
    }
    doubts.push_back(finding.sentence);
  }
  return doubts;
}

Expected<std::vector<std::string>> JudgeReadings(const std::vector<IvCurve>& curves) {
  if (curves.size() == 1) return JudgeReadings(curves.front());
  struct Doubt {
    std::string sentence;
    int curves = 0;
  };
  std::map<std::string, Doubt> doubts;
  for (const IvCurve& curve : curves) {
    if (auto judged = JudgeReadings(curve); !judged) {
      judged.error().message = fmt::format("curve {}: {}", curve.name, judged.error().message);
      return judged;
    }
    std::map<std::string, std::string> own;
    for (const ReadingFinding& finding : CheckReadings(curve)) {
      own.try_emplace(finding.id, finding.sentence);
    }
    for (const auto& [id, sentence] : own) {
      Doubt& doubt = doubts[id];
      if (doubt.curves++ == 0) doubt.sentence = fmt::format("curve {}: {}", curve.name, sentence);
    }
  }
  std::vector<std::string> sentences;
  for (const auto& [id, doubt] : doubts) {
    const std::string more =
        doubt.curves > 1 ? fmt::format(" (and the like for {} more)", doubt.curves - 1) : "";
    sentences.push_back(doubt.sentence + more);
  }
  return sentences;
}

}  // namespace lyrefit
