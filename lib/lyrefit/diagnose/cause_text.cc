#include "lyrefit/diagnose/cause_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "lyrefit/base/roots.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/diagnose/effect_size.h"
#include "lyrefit/model/cell.h"
#include "lyrefit/model/law.h"

namespace lyrefit {
namespace {

double Percent(double part) { return 100 * part; }

// An effect of a fit, with its parameters in the units of Reading and as reported.
struct Described {
  const WeightedData& weighted;
  const LawFit& fit;
  int index;
  const double* p;
  const std::vector<CauseParameter>& strength;

  const Readings& readings() const { return *weighted.readings; }
  // What differs between cells: in a flasher what they make of the light.
  const char* light() const {
    return readings().traits.setup == Setup::kFlash ? "current" : "light";
  }
  // The upper bound of parameter number `k`.
  double Most(int k) const { return fit.law.effects[index]->parameters[k].upper; }
  // The reported parameter; unknown values if it is not among them.
  Sized Of(std::string_view symbol) const {
    for (const CauseParameter& one : strength) {
      if (one.symbol == symbol) return {one.value, one.low_95, one.high_95};
    }
    return {};
  }
};

// "71 % (69 to 73)", without an interval that rounding hides.
std::string PercentWithRange(const Sized& part, int digits) {
  const auto text = [digits](double value) { return fmt::format("{:.{}f}", 100 * value, digits); };
  const std::string value = text(part.value), low = text(part.low_95), high = text(part.high_95);
  if (!std::isfinite(part.low_95) || low == high) return value + " %";
  return fmt::format("{} % ({} to {})", value, low, high);
}

// Light that is left where `factor` times the deficit is missing.
std::string LightLeft(double deficit, const Sized& reported, double factor = 1) {
  const double low = 1 - factor * reported.high_95, high = 1 - factor * reported.low_95;
  return PercentWithRange({1 - factor * deficit, std::max(low, 0.0), std::min(high, 1.0)}, 0);
}

// "1 of 3 substrings", or "33 % of the cells" if the share is no whole number of substrings.
std::string Part(const Readings& readings, double share) {
  const int known = readings.traits.substrings;
  const int substrings = known > 0 ? known : 3;
  const double count = share * substrings;
  const double whole = std::round(count);
  constexpr double kNear = 0.12;  // of a substring
  if (whole < 1 || std::fabs(count - whole) > std::min(0.03 * substrings, kNear)) {
    return fmt::format("{:.0f} % of the cells", Percent(share));
  }
  return fmt::format("{:.0f} of {} substrings", whole, substrings);
}

std::string Covered(double part) {
  return part < 1 ? fmt::format(", on {:.0f} % of its cells", Percent(part)) : "";
}

std::vector<std::string> OfShading(const Described& of) {
  return {fmt::format("{} under {} of the others' {}{}", Part(of.readings(), of.p[1]),
                      LightLeft(of.p[0], of.Of("d")), of.light(), Covered(of.p[3]))};
}

std::vector<std::string> OfSubstrings(const Described& of) {
  std::vector<std::string> words;
  const double* p = of.p;
  for (int k = 0; k < 4; ++k) {
    if (!(p[2 * k + 1] > 0)) continue;
    words.push_back(fmt::format(
        "{} under {} of the brightest's {}{}", Part(of.readings(), p[2 * k + 1]),
        LightLeft(p[2 * k], of.Of(fmt::format("d{}", k + 1))), of.light(), Covered(p[9])));
  }
  return words;
}

// Light of a weak cell, relative to the others, from its parameters. In a module of parallel chains
// it is that of the cell in its own chain.
double LightOfWeakCell(const double* p) { return 1 - p[0] * p[8]; }

std::vector<std::string> OfWeakCell(const Described& of) {
  const double* p = of.p;
  const std::string cells =
      p[1] > 1.5 ? fmt::format("{:.0f} cells have", p[1]) : std::string("one cell has");
  std::vector<std::string> words = {
      fmt::format("{} {} of the others' {}", cells, LightLeft(p[0], of.Of("d"), p[8]), of.light())};
  if (p[8] > 1) words.push_back("the module's halves stand side by side: the other half goes on");
  const HotCell hot = FindHotCell(of.weighted, of.fit, of.index);
  if (hot.heat_W > 0) {
    words.push_back(fmt::format("at short circuit it stands at {:.1f} V and turns {:.3g} W to heat",
                                hot.voltage_V, hot.heat_W));
  }
  return words;
}

// Three digits without an exponent.
std::string Plain(double value) {
  return fmt::format(std::fabs(value) < 999.5 ? "{:.3g}" : "{:.0f}", value);
}

// "3.2 K (2.9 to 3.5)"
std::string WithRange(const Sized& size, const char* unit) {
  const std::string range =
      std::isfinite(size.low_95)
          ? fmt::format(" ({} to {})", Plain(std::min(size.low_95, size.high_95)),
                        Plain(std::max(size.low_95, size.high_95)))
          : "";
  return fmt::format("{} {}{}", Plain(size.value), unit, range);
}

std::vector<std::string> OfCoveredEdge(const Described& of) {
  std::vector<std::string> words;
  const int substrings = std::clamp(SubstringsOf(of.readings().traits), 2, 4);
  words.reserve(substrings);
  for (int k = 0; k < substrings; ++k) {
    words.push_back(fmt::format(
        "{:.0f} % of a substring's cells have {} of the others' {}", Percent(of.p[2 * k + 1]),
        LightLeft(of.p[2 * k], of.Of(fmt::format("d{}", k + 1))), of.light()));
  }
  return words;
}

std::vector<std::string> OfDimCells(const Described& of) {
  const double chains = of.p[of.fit.law.effects[of.index]->size() - 1];
  std::vector<std::string> lights;
  for (int k = 0; k < 6; ++k) {
    const Sized deficit = of.Of(fmt::format("d{}", k + 1));
    if (std::isfinite(deficit.value)) lights.push_back(LightLeft(deficit.value, deficit, chains));
  }
  return {fmt::format("{} cells have {} of the others' {}", lights.size(), fmt::join(lights, ", "),
                      of.light())};
}

std::vector<std::string> OfOpenSubstring(const Described& of) {
  return {fmt::format("{} without current; the bypass diode drops {}", Part(of.readings(), of.p[0]),
                      WithRange(of.Of("Vb"), "V"))};
}

std::vector<std::string> OfGradedShunt(const Described& of) {
  return {
      fmt::format("at 0.5 V the cells lose {:.2g} % of Isc on average, most at one end of the "
                  "string",
                  Percent(0.5 * of.p[0]))};
}

// Key points of the readings of one direction: 1 up, -1 down.
KeyPoints InDirection(const Readings& readings, double sign) {
  std::vector<double> voltage, current;
  for (const Reading& reading : readings.points) {
    if (reading.dark || !(sign * reading.rate > 0)) continue;
    voltage.push_back(reading.voltage);
    current.push_back(reading.current);
  }
  return FindKeyPoints(voltage, current);
}

std::vector<std::string> OfHysteresis(const Described& of) {
  const double index =
      HysteresisIndex(InDirection(of.readings(), 1), InDirection(of.readings(), -1));
  if (!std::isfinite(index)) return {};
  return {fmt::format(
      "index (Pmp_rev - Pmp_fwd) / Pmp_rev = {:.1f} %: {}", Percent(index),
      index < 0 ? "inverted, the sweep up gives more" : "normal, the sweep down gives more")};
}

std::vector<std::string> OfBypassOpen(const Described& of) {
  return {fmt::format("{} under {} of the others' light, and no bypass diode leads around it",
                      Part(of.readings(), of.p[1]), LightLeft(of.p[0], of.Of("d")))};
}

double VoltageOf(const Described& of, const Reading& reading) {
  return reading.voltage * of.readings().scale.cells;
}

// "was 14.0 % (13.8 to 14.2) weaker than before". `limit`: the largest change that a fit can have,
// which an interval reaches where the readings do not determine it.
std::string LightChange(const Sized& part, double limit, const char* than) {
  if (part.low_95 <= 0 && part.high_95 >= 0) {
    return fmt::format("was stronger or weaker{}: these readings determine neither size nor sign",
                       than);
  }
  const bool weaker = part.value < 0;
  const Sized size = weaker ? Sized{-part.value, -part.high_95, -part.low_95} : part;
  const std::string text = size.high_95 >= limit
                               ? fmt::format("at least {:.1f} %", Percent(size.low_95))
                               : PercentWithRange(size, 1);
  return fmt::format("was {} {}{}", text, weaker ? "weaker" : "stronger", than);
}

std::vector<std::string> OfStep(const Described& of) {
  for (const Reading& reading : of.readings().points) {
    if (reading.x <= of.p[1]) continue;
    return {fmt::format("from {:.4g} V on the light {}", VoltageOf(of, reading),
                        LightChange(of.Of("s"), of.Most(0), " than before"))};
  }
  return {};
}

// Voltage of the reading nearest to the moment that is the second parameter.
double VoltageAtMoment(const Described& of) {
  const std::vector<Reading>& points = of.readings().points;
  const auto nearest =
      std::min_element(points.begin(), points.end(), [&of](const Reading& a, const Reading& b) {
        return std::fabs(a.x - of.p[1]) < std::fabs(b.x - of.p[1]);
      });
  return VoltageOf(of, *nearest);
}

std::vector<std::string> OfEdge(const Described& of) {
  return {fmt::format("near {:.4g} V the light went over to another level: it {}",
                      VoltageAtMoment(of), LightChange(of.Of("s"), of.Most(0), " than before"))};
}

std::vector<std::string> OfTransient(const Described& of) {
  // The depth is a loss.
  const Sized depth = of.Of("a");
  return {fmt::format(
      "near {:.4g} V the light {}", VoltageAtMoment(of),
      LightChange({-depth.value, -depth.high_95, -depth.low_95}, of.Most(0), " for a moment"))};
}

std::vector<std::string> OfDrift(const Described& of) {
  return {"at the end of the sweep the light " +
          LightChange(of.Of("d"), of.Most(0), " than at its begin")};
}

// "5.02 A", "1.3 mA", "8.2 uA"
std::string Ampere(double value) {
  const double size = std::fabs(value);
  if (size < 1e-3) return Plain(1e6 * value) + " uA";
  return size < 0.1 ? Plain(1e3 * value) + " mA" : fmt::format("{:.4g} A", value);
}

// Times a factor.
Sized Scaled(const Sized& size, double factor) {
  return {factor * size.value, factor * size.low_95, factor * size.high_95};
}

// A difference as a positive size and one of two words for its sign.
std::string SignedSize(const Sized& size, const char* unit, const char* above, const char* below) {
  const bool negative = size.value < 0;
  return WithRange(Scaled(size, negative ? -1 : 1), unit) + " " + (negative ? below : above);
}

std::vector<std::string> OfClip(const Described& of) {
  std::vector<std::string> words;
  const Sized most = of.Of("Ic"), least = of.Of("Il");
  const double scale = of.readings().scale.current_A;
  if (most.value < 1.4 * scale) words.push_back("no current above " + Ampere(most.value));
  if (least.value > -10 * scale) {
    words.push_back("no current below " + Ampere(least.value));
  }
  return words;
}

// Without times the shift is known in readings and in volts only.
std::vector<std::string> OfTimingSkew(const Described& of) {
  const ReadingScale& scale = of.readings().scale;
  const Sized skew = of.Of("ts");
  if (scale.times) {
    return {"the voltage was read " + SignedSize(Scaled(skew, 1e3), "ms", "after", "before") +
            " the current"};
  }
  return {
      fmt::format("the voltage was read {} the current, {} mV along the sweep; the file has no "
                  "times",
                  SignedSize(skew, "readings", "after", "before"),
                  Plain(1e3 * std::fabs(of.p[0]) * scale.cells))};
}

// The largest change of the current by the effect.
std::vector<std::string> OfCurrent(const Described& of) {
  const LawFit rest = TakenOut(of.fit, of.index);
  const std::vector<Reading>& points = of.readings().points;
  std::vector<double> without(points.size());
  LawWorkspace workspace;
  if (!EvaluateLaw(rest.law, of.readings(), rest.p.data(), &workspace, without.data(), nullptr)) {
    return {};
  }
  // Where the device delivers power, if any reading is there: beyond, currents grow without limit.
  const auto change = [&](std::size_t k) { return of.fit.current[k] - without[k]; };
  const auto delivers = [&](std::size_t k) {
    return points[k].current > 0 && points[k].voltage > 0;
  };
  std::size_t most = points.size();
  for (const bool anywhere : {false, true}) {
    if (most < points.size()) break;
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (!anywhere && !delivers(k)) continue;
      if (most == points.size() || std::fabs(change(k)) > std::fabs(change(most))) most = k;
    }
  }
  if (most == points.size() || !(std::fabs(change(most)) > 0)) return {};
  const double percent = Percent(std::fabs(change(most)));
  return {fmt::format("it {} up to {:.{}f} % of Isc, most at {:.4g} V",
                      change(most) < 0 ? "takes" : "adds", percent, percent < 10 ? 1 : 0,
                      VoltageOf(of, points[most]))};
}

// Reverse voltage (below 0) of the weak cell at a current above its photocurrent.
double ReverseVoltage(const Effect& weak_cell, const double* p, double photocurrent,
                      double conductance, double current) {
  const double beyond = current - LightOfWeakCell(p) * photocurrent;
  if (beyond <= 0) return 0;
  const std::vector<Pack> own(p, p + weak_cell.size());
  CellGroup<Pack> groups[kMostGroups];
  Cell<Pack> cell{};
  cell.group = groups;
  cell.photocurrent = photocurrent;
  cell.conductance = conductance;
  weak_cell.cell.value(own.data(), &cell);
  const auto missing = [&](double v) {  // at -v
    return (conductance + p[2]) * v + ReverseCurrent(cell, Tangent<Pack>(-v)).a[0] - beyond;
  };
  return -RootBetween(missing, 0, p[7] > 0 ? 200 : p[5]);
}

}  // namespace

HotCell FindHotCell(const WeightedData& weighted, const LawFit& fit, int index) {
  const Readings& readings = *weighted.readings;
  const Effect& weak_cell = *fit.law.effects[index];
  const double* p = fit.p.data() + fit.law.Offset(index);
  Readings at = InBrightestLight(readings);
  const LawFit rest = WithoutEffects(fit);
  const auto healthy = [&](double voltage) {  // current of a cell without a fault
    at.points.front().voltage = voltage;
    LawWorkspace workspace;
    double current = 0;
    EvaluateLaw(rest.law, at, rest.p.data(), &workspace, &current, nullptr);
    return current;
  };
  const double photocurrent = fit.p[kIph] * at.points.front().irradiance / readings.scale.current_A;
  const double conductance = readings.scale.resistance_ohm() / fit.p[kRsh];
  const double cells = readings.traits.cells;
  const double mates = cells / SubstringsOf(readings.traits) - 1;
  const bool bypassed = SubstringsOf(readings.traits) > 1;
  // Voltage balance at the voltage of its mates. Its root is that of the shorted module, or of a
  // substring whose bypass diode conducts.
  const auto excess = [&](double voltage) {
    const double own = ReverseVoltage(weak_cell, p, photocurrent, conductance, healthy(voltage));
    return bypassed ? own + mates * voltage + p[3] : own + (cells - 1) * voltage;
  };
  if (!(healthy(0) > LightOfWeakCell(p) * photocurrent)) return {};
  const double current = healthy(RootBetween(excess, 0, 1.1 * readings.pivot_voltage));
  HotCell hot;
  hot.voltage_V = ReverseVoltage(weak_cell, p, photocurrent, conductance, current);
  hot.heat_W = -hot.voltage_V * current * readings.scale.current_A / p[8];
  return hot;
}

std::vector<std::string> InWords(const WeightedData& weighted, const LawFit& fit, int index,
                                 const std::vector<CauseParameter>& strength) {
  const std::string_view id = fit.law.effects[index]->id;
  const Described of = {weighted, fit, index, fit.p.data() + fit.law.Offset(index), strength};
  const double* p = of.p;
  const Readings& readings = *weighted.readings;
  if (id == "shading") return OfShading(of);
  if (id == "substrings") return OfSubstrings(of);
  if (id == "weak_cell") return OfWeakCell(of);
  if (id == "covered_edge") return OfCoveredEdge(of);
  if (id == "dim_cells") return OfDimCells(of);
  if (id == "open_substring") return OfOpenSubstring(of);
  if (id == "graded_shunt") return OfGradedShunt(of);
  if (id == "hysteresis") return OfHysteresis(of);
  if (id == "bypass_open") return OfBypassOpen(of);
  if (id == "irr_step") return OfStep(of);
  if (id == "cloud_edge") return OfEdge(of);
  if (id == "transient") return OfTransient(of);
  if (id == "drift") return OfDrift(of);
  if (id == "clip") return OfClip(of);
  if (id == "mismatch") {
    return {fmt::format("{:.3g} cells deliver {} less than the others",
                        p[1] * readings.traits.cells, PercentWithRange(of.Of("d"), 1))};
  }
  if (id == "scatter") {
    return {fmt::format("the light of the cells differs by {}, one standard deviation",
                        PercentWithRange(of.Of("s"), 1))};
  }
  if (id == "leaky_cell") {
    const std::string each = p[1] > 1.5 ? fmt::format("each of {:.0f} cells", p[1]) : "the cell";
    return {fmt::format("at 0.5 V {} loses {:.2g} % of Isc", each, Percent(0.5 * p[0]))};
  }
  if (id == "temp_drift") {
    return {SignedSize(of.Of("r"), "K", "warmer", "colder") + " at the end than at the begin"};
  }
  if (id == "timing_skew") return OfTimingSkew(of);
  if (id == "range_switch") {
    const Sized end = of.Of("Ir");
    return {fmt::format("below {} the currents are {} than above", Ampere(end.value),
                        SignedSize(Scaled(of.Of("g"), 100), "%", "larger", "smaller"))};
  }
  if (id == "current_offset") {
    return {"the instrument reads " + SignedSize(Scaled(of.Of("c"), 100 / readings.scale.current_A),
                                                 "% of Isc", "too much", "too little")};
  }
  if (id == "voltage_offset") {
    return {"the instrument reads " +
            SignedSize(Scaled(of.Of("c"), 1e3), "mV", "too much", "too little")};
  }
  if (id == "sensor_offset") {
    return {"the light is " + SignedSize(of.Of("c"), "W/m2", "more", "less") + " than shown"};
  }
  if (id == "sensor_nonlin") {
    return {"the light is " + SignedSize(Scaled(of.Of("c"), 100), "%", "more", "less") +
            " than shown for each 1000 W/m2"};
  }
  if (id == "temp_offset" || id == "temp_gradient") {
    return {"the cells are " + SignedSize(of.Of("c"), "K", "warmer", "colder") +
            (id == "temp_offset" ? " than shown" : " than shown at 1000 W/m2")};
  }
  if (id == "isc_tempco") {
    return {SignedSize(Scaled(of.Of("c"), 100), "%/K", "more", "less") + " than stated"};
  }
  if (id == "bandgap") {
    return {SignedSize(of.Of("c"), "eV", "more", "less") + " than stated"};
  }
  return OfCurrent(of);
}

}  // namespace lyrefit
