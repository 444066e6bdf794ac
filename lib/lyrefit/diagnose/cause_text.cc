#include "lyrefit/diagnose/cause_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "lyrefit/diagnose/effect_size.h"

namespace lyrefit {
namespace {

double Percent(double part) { return 100 * part; }

// "1 of 3 substrings", or "33 % of the cells" if the share is no whole number of substrings.
std::string Part(const Readings& readings, double share) {
  const int known = readings.traits.substrings;
  const int substrings = known > 0 ? known : 3;
  const double count = share * substrings;
  const double whole = std::round(count);
  if (whole < 1 || std::fabs(count - whole) > 0.03 * substrings) {
    return fmt::format("{:.0f} % of the cells", Percent(share));
  }
  return fmt::format("{:.0f} of {} substrings", whole, substrings);
}

std::string Covered(double part) {
  return part < 1 ? fmt::format(", on {:.0f} % of its cells", Percent(part)) : "";
}

std::vector<std::string> OfShading(const Readings& readings, const double* p) {
  return {fmt::format("{} under {:.0f} % of the others' light{}", Part(readings, p[1]),
                      Percent(1 - p[0]), Covered(p[3]))};
}

std::vector<std::string> OfSubstrings(const Readings& readings, const double* p) {
  std::vector<std::string> words;
  for (int k = 0; k < 4; ++k) {
    if (!(p[2 * k + 1] > 0)) continue;
    words.push_back(fmt::format("{} under {:.0f} % of the brightest's light{}",
                                Part(readings, p[2 * k + 1]), Percent(1 - p[2 * k]),
                                Covered(p[9])));
  }
  return words;
}

// Light of a weak cell, relative to the others, from its parameters. In a module of parallel chains
// it is that of the cell in its own chain.
double LightOfWeakCell(const double* p) { return 1 - p[0] * p[8]; }

std::vector<std::string> OfWeakCell(const WeightedData& weighted, const LawFit& fit, int index,
                                    const double* p) {
  const std::string cells =
      p[1] > 1.5 ? fmt::format("{:.0f} cells have", p[1]) : std::string("one cell has");
  std::vector<std::string> words = {
      fmt::format("{} {:.0f} % of the others' light", cells, Percent(LightOfWeakCell(p)))};
  if (p[8] > 1) words.push_back("the module's halves stand side by side: the other half goes on");
  const HotCell hot = FindHotCell(weighted, fit, index);
  if (hot.heat_W > 0) {
    words.push_back(fmt::format("at short circuit it stands at {:.1f} V and turns {:.3g} W to heat",
                                hot.voltage_V, hot.heat_W));
  }
  return words;
}

// Voltage of a cell without a fault as a function of current, from a table. The voltage falls with
// the current.
class HealthyCell {
 public:
  HealthyCell(const WeightedData& weighted, const LawFit& fit) : grid_(*weighted.readings) {
    Reading at = grid_.points.front();
    for (const Reading& r : grid_.points) {
      if (r.irradiance > at.irradiance) at = r;
    }
    at.x = at.rate = 0;
    grid_.points.assign(kSteps + 1, at);
    law_ = fit.law;
    law_.effects.clear();
    for (int k = 0; k <= kSteps; ++k) grid_.points[k].voltage = VoltageAt(k);
    LawWorkspace workspace;
    current_.resize(grid_.points.size());
    usable_ = EvaluateLaw(law_, grid_, fit.p.data(), &workspace, current_.data(), nullptr);
  }
  double Voltage(double current) const {
    if (!usable_) return 0;
    const auto below =
        std::find_if(current_.begin(), current_.end(), [&](double at) { return at < current; });
    return VoltageAt(static_cast<int>(below - current_.begin()));
  }
  double ShortCircuit() const { return usable_ ? current_.front() : 0; }

 private:
  static constexpr int kSteps = 400;
  double VoltageAt(int step) const {
    return 1.1 * grid_.pivot_voltage * std::min(step, kSteps) / kSteps;
  }

  Readings grid_;
  Law law_;
  std::vector<double> current_;
  bool usable_ = false;
};

// Reverse voltage (below 0) of the weak cell at a current above its photocurrent, by bisection.
double ReverseVoltage(const double* p, double photocurrent, double conductance, double current) {
  const double beyond = current - LightOfWeakCell(p) * photocurrent;
  if (beyond <= 0) return 0;
  const double leak = conductance + p[2];
  const auto carried = [&](double v) {  // current at -v
    if (p[7] > 0) return leak * v + photocurrent * std::pow(v / p[7], p[6]);
    const double gap = std::max(1 - v / p[5], 1e-3);
    return leak * v + conductance * p[4] * v * std::pow(gap, -p[6]);
  };
  double low = 0, high = p[7] > 0 ? 200 : p[5];
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (carried(middle) < beyond ? low : high) = middle;
  }
  return -low;
}

}  // namespace

HotCell FindHotCell(const WeightedData& weighted, const LawFit& fit, int index) {
  const Readings& readings = *weighted.readings;
  const double* p = fit.p.data() + fit.law.Offset(index);
  const HealthyCell reference(weighted, fit);
  double brightest = 0;
  for (const Reading& r : readings.points) brightest = std::max(brightest, r.irradiance);
  const double photocurrent = fit.p[kIph] * brightest / readings.scale.current_A;
  const double conductance = readings.scale.resistance_ohm() / fit.p[kRsh];
  const double cells = readings.traits.cells;
  const double mates = cells / SubstringsOf(readings.traits) - 1;
  const bool bypassed = SubstringsOf(readings.traits) > 1;
  // Voltage balance at the current of the weak cell. Its root is the current of the shorted module,
  // or of a substring whose bypass diode conducts.
  const auto excess = [&](double current) {
    const double own = ReverseVoltage(p, photocurrent, conductance, current);
    return bypassed ? own + mates * reference.Voltage(current) + p[3]
                    : own + (cells - 1) * reference.Voltage(current);
  };
  double low = LightOfWeakCell(p) * photocurrent, high = reference.ShortCircuit();
  if (!(high > low)) return {};
  for (int k = 0; k < 50; ++k) {
    const double middle = 0.5 * (low + high);
    (excess(middle) > 0 ? low : high) = middle;
  }
  HotCell hot;
  hot.voltage_V = ReverseVoltage(p, photocurrent, conductance, low);
  hot.heat_W = -hot.voltage_V * low * readings.scale.current_A / p[8];
  return hot;
}

std::vector<std::string> InWords(const WeightedData& weighted, const LawFit& fit, int index) {
  const std::string_view id = fit.law.effects[index]->id;
  const double* p = fit.p.data() + fit.law.Offset(index);
  const Readings& readings = *weighted.readings;
  if (id == "shading") return OfShading(readings, p);
  if (id == "substrings") return OfSubstrings(readings, p);
  if (id == "weak_cell") return OfWeakCell(weighted, fit, index, p);
  if (id == "mismatch") {
    return {fmt::format("{:.3g} cells deliver {:.1f} % less than the others",
                        p[1] * readings.traits.cells, Percent(p[0]))};
  }
  if (id == "scatter") {
    return {fmt::format("the light of the cells differs by {:.1f} % (one standard deviation)",
                        Percent(p[0]))};
  }
  if (id == "leaky_cell") {
    return {fmt::format("at 0.5 V the leak takes {:.2g} A of the cell",
                        0.5 * p[0] * readings.scale.current_A)};
  }
  return {};
}

}  // namespace lyrefit
