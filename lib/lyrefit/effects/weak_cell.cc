#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/base/roots.h"
#include "lyrefit/effects/odd_cells.h"
#include "lyrefit/effects/parts.h"
#include "lyrefit/model/cell.h"

namespace lyrefit {
namespace {

enum { kDeficit, kCells, kLeak, kBypass, kFactor, kBreakdown, kExponent, kSoft, kSideBySide };

std::vector<EffectParameter> WeakCellParameters() {
  return {
      Parameter("d", "light_deficit",
                "part of the substring's light that is missing because of them: in half-cut "
                "modules half of what the cells themselves miss, at most 0.5")
          .Between(0, 0.999)
          .Scatter(kCellScatter),
      Parameter("cells", "weak_cells", "how many they are, all in one substring")
          .Between(1, 24)
          .From(1)
          .FixedByDefault()
          .Only(Whole::kCount),
      Parameter("g", "leak", "conductance of each beside that of the others")
          .Unit("S")
          .Between(0, 5)
          .CurrentPower(1)
          .FixedByDefault(),
      Parameter("Vb", "bypass_voltage", "drop of a bypass diode at Isc")
          .Unit("V")
          .Between(0.1, 1.2)
          .From(0.5)
          .FixedByDefault(),
      Parameter("a", "breakdown_factor", "of reverse breakdown")
          .Between(0, 10)
          .From(0.1)
          .FixedByDefault(),
      // At its upper bound (no breakdown), or with an exponent near 1, the law describes a leak.
      Parameter("Vbr", "breakdown_voltage", "of a cell, its size")
          .Unit("V")
          .Between(3, 60)
          .From(15)
          .FixedByDefault()
          .BelowUpper(),
      Parameter("m", "breakdown_exponent", "of reverse breakdown")
          .Between(1.5, 8)
          .From(3.4)
          .FixedByDefault()
          .AboveLower(),
      Parameter("A", "soft_voltage", "at which a cell in reverse carries Iph; 0: Bishop's law")
          .Unit("V")
          .Between(0, 30)
          .FixedByDefault()
          .AbsentAt(0),
      kChains,
  };
}

// `asked`: the fit was requested by name, which adds starts.
std::vector<ShapeStart> WeakCellStarts(const CurveShape& shape, bool asked) {
  std::vector<ShapeStart> starts;
  // Cells that hardly conduct in reverse form a separate local optimum.
  std::vector<double> soft = {3.2};
  if (asked) soft.push_back(10);
  const double full = shape.At(0.05);
  if (!(full > 0)) return starts;
  std::vector<double> deficits = {0.06, 0.2, 0.45, 0.75};
  // Light from a plateau before the knee, or from a tail towards Voc if the cell conducts in
  // reverse.
  for (const double place : {0.75, 0.95}) {
    deficits.push_back(std::clamp(1 - shape.At(place) / full, 0.01, 0.97));
  }
  for (const double deficit : deficits) {
    for (const double chains : {1.0, 2.0}) {
      if (deficit * chains > 0.97) continue;
      for (const double voltage : soft) {
        starts.push_back(
            {{deficit, 1, 0, 0.5, 0.1, 15, 3.4, voltage, chains}, {kBypass, kExponent, kSoft}});
      }
      starts.push_back(
          {{deficit, 1, 0, 0.5, 0.1, 15, 3.4, 0, chains}, {kBypass, kFactor, kBreakdown}});
      starts.push_back({{deficit, 1, 0, 0.5, 0, 15, 3.4, 0, chains}, {kBypass}});
    }
  }
  return starts;
}

// Light of a weak cell, relative to the others, from its parameters. In a module of parallel chains
// it is that of the cell in its own chain.
double LightOfWeakCell(const double* p) { return 1 - p[kDeficit] * p[kSideBySide]; }

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
    return (conductance + p[kLeak]) * v + ReverseCurrent(cell, Tangent<Pack>(-v)).a[0] - beyond;
  };
  return -RootBetween(missing, 0, p[kSoft] > 0 ? 200 : p[kBreakdown]);
}

Phrases WeakCellInWords(const FittedEffect& of) {
  const double* p = of.p;
  const std::string cells =
      p[kCells] > 1.5 ? fmt::format("{:.0f} cells have", p[kCells]) : std::string("one cell has");
  Phrases words = {fmt::format("{} {} of the others' {}", cells,
                               LightLeft(p[kDeficit], of.Of("d"), p[kSideBySide]), of.light())};
  if (p[kSideBySide] > 1) {
    words.push_back("the module's halves stand side by side: the other half goes on");
  }
  const HotCell hot = FindHotCell(of);
  if (hot.heat_W > 0) {
    words.push_back(fmt::format("at short circuit it stands at {:.1f} V and turns {:.3g} W to heat",
                                hot.voltage_V, hot.heat_W));
  }
  return words;
}

}  // namespace

HotCell FindHotCell(const FittedEffect& of) {
  const Readings& readings = of.readings;
  const double* p = of.p;
  Readings at = InBrightestLight(readings);
  Law rest = of.law;
  rest.effects.clear();
  const auto healthy = [&](double voltage) {  // current of a cell without a fault
    at.points.front().voltage = voltage;
    LawWorkspace workspace;
    double current = 0;
    EvaluateLaw(rest, at, of.parameters.data(), &workspace, &current, nullptr);
    return current;
  };
  const double photocurrent =
      of.parameters[kIph] * at.points.front().irradiance / readings.scale.current_A;
  const double conductance = readings.scale.resistance_ohm() / of.parameters[kRsh];
  const double cells = readings.traits.cells;
  const double mates = cells / SubstringsOf(readings.traits) - 1;
  const bool bypassed = SubstringsOf(readings.traits) > 1;
  // Voltage balance at the voltage of its mates. Its root is that of the shorted module, or of a
  // substring whose bypass diode conducts.
  const auto excess = [&](double voltage) {
    const double own = ReverseVoltage(of.effect(), p, photocurrent, conductance, healthy(voltage));
    return bypassed ? own + mates * voltage + p[kBypass] : own + (cells - 1) * voltage;
  };
  if (!(healthy(0) > LightOfWeakCell(p) * photocurrent)) return {};
  const double current = healthy(RootBetween(excess, 0, 1.1 * readings.pivot_voltage));
  HotCell hot;
  hot.voltage_V = ReverseVoltage(of.effect(), p, photocurrent, conductance, current);
  hot.heat_W = -hot.voltage_V * current * readings.scale.current_A / p[kSideBySide];
  return hot;
}

Effect WeakCell() {
  Effect e;
  e.id = "weak_cell";
  e.title = "weak cells";
  e.where = Where::kDevice;
  e.equation =
      "one or a few cells of a substring under light (1 - d), with a conductance g of their own; "
      "in reverse I = ... - Gsh a Vj (1 + Vj / Vbr)^-m, or ... + Iph (-Vj / A)^m";
  e.reference = "bishop1988";
  e.sentence = "a cell delivers less than its neighbours and is driven into reverse: a hot spot";
  e.needs = "a curve of a module whose weak cell conducts in reverse before its bypass diode does";
  e.acts = "between short circuit and the knee";
  e.confused_with = {"mismatch", "shading", "nonohmic_shunt"};
  e.separate_by = "cover one cell after the other, or a thermal image under load";
  e.action = "look at the module with a thermal camera: one cell is covered, dark or broken";
  e.fact_sheet = "PVFS 1-19";
  e.prior = {0.02, 0.02, kFaultPrior};
  e.in_words = WeakCellInWords;
  e.parameters = WeakCellParameters();
  e.cell = [](const auto* p, auto* cell) {
    SetOddCells(p[kCells], p[kDeficit], p[kLeak], p[kSideBySide], cell);
    cell->bypass = p[3];
    const bool soft = ValueOf(p[kSoft])[0] > 0;  // all lanes have the same parameters
    cell->reverse = soft ? ReverseLaw::kSoft : ReverseLaw::kBishop;
    cell->reverse_strength = p[kFactor];
    cell->reverse_voltage = soft ? p[kSoft] : p[kBreakdown];
    cell->reverse_exponent = p[kExponent];
  };
  e.groups = true;
  e.why_not = NeedsBypassedModule;
  e.probes = [](const DataTraits&) {
    std::vector<Probe> probes;
    for (const double deficit : {0.05, 0.15, 0.4, 0.8}) {
      probes.push_back({deficit, 1, 0, 0.5, 0.1, 15, 3.4, 3.2, 1});
    }
    return probes;
  };
  e.starts = [](const CurveShape& shape, const DataTraits&, const auto& asked) {
    return WeakCellStarts(shape, !asked.empty());
  };
  return e;
}

}  // namespace lyrefit
