#include "lyrefit/devices/describe_cell.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/append.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/devices/cell_figures.h"
#include "lyrefit/devices/cell_parts.h"
#include "lyrefit/devices/describe_sweep.h"
#include "lyrefit/devices/joint_estimate.h"
#include "lyrefit/devices/joint_problem.h"
#include "lyrefit/read/cells.h"
#include "lyrefit/report/text_layout.h"

namespace lyrefit {
namespace {

std::vector<IdealityOverLight> FindIdealities(const CellReport& report, double thermal_V) {
  std::vector<IdealityOverLight> idealities;
  const std::vector<CellSweep>& sweeps = report.sweeps;
  const double isc = report.main == -1 ? kUnknown : sweeps[report.main].key.short_circuit_current_A;
  const auto take = [&](SweepKind source, const std::vector<VocPoint>& points) {
    auto found = FindIdealityOverLight(points, thermal_V, isc);
    if (!found) return;
    found->source = source;
    idealities.push_back(std::move(*found));
  };
  take(SweepKind::kLit, PointsOfLights(sweeps));
  for (const CellSweep& sweep : sweeps) {
    if (sweep.kind == SweepKind::kSunsVoc) take(SweepKind::kSunsVoc, PointsOfTrace(sweep));
  }
  return idealities;
}

std::optional<DarkIdeality> FindDark(const CellReport& report, double thermal_V) {
  const int at = FindSweep(report, SweepKind::kDark, report.sweeps[std::max(report.main, 0)]);
  if (at == -1) return std::nullopt;
  const CellSweep& sweep = report.sweeps[at];
  DarkIdeality dark = FindDarkIdeality(sweep, thermal_V, report.cells_in_series);
  dark.sweep = at;
  if (sweep.diode()) dark.fitted = FittedValue(sweep, "n1");
  return dark;
}

// Whether a sweep is one direction of a pair with hysteresis.
bool IsHysteretic(const CellReport& report, int sweep) {
  return std::any_of(report.pairs.begin(), report.pairs.end(), [&](const DirectionPair& pair) {
    return pair.sense != HysteresisSense::kNone && (pair.forward == sweep || pair.reverse == sweep);
  });
}

// n of the junction over light, the last one that begins below the light of `main`.
Ranged IdealityAtMain(const CellReport& report) {
  Ranged n;
  for (const IdealityOverLight& over : report.over_light) {
    const double isc = report.sweeps[report.main].key.short_circuit_current_A;
    if (over.points.front().light_A < isc) n = over.junction;
  }
  return n;
}

// Whether n of a fit is above that over light by more than the least that counts and than the 95 %
// errors of both.
bool IsAbove(const Ranged& fitted, const Ranged& over_light) {
  constexpr double kMost = 1.07;
  const double error =
      std::hypot(fitted.high_95 - fitted.low_95, kMost * (over_light.high_95 - over_light.low_95)) /
      2;
  const double above = fitted.value - kMost * over_light.value;
  return above > 0 && !(above <= error);
}

// Why n of the fits is none of the junction, beside what each sweep alone shows: a pair with
// hysteresis where n is above `ideal_n` already, and an n above that over light, as collection makes
// it, which is then in Rs and Rsh as well.
std::vector<CellSweep> VoidByOtherSweeps(const CellReport& report) {
  std::vector<CellSweep> sweeps = report.sweeps;
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    std::vector<std::string>& reasons = sweeps[i].void_because;
    if (sweeps[i].fit && !reasons.empty() && IsHysteretic(report, static_cast<int>(i))) {
      reasons.emplace_back(
          "one direction of a pair with hysteresis: its n is none of the junction");
    }
  }
  for (const int i : BrightestSweeps(report)) {
    const Ranged fitted = FittedValue(sweeps[i], "n1"), n = IdealityAtMain(report);
    if (!IsAbove(fitted, n)) continue;
    sweeps[i].void_because.push_back(fmt::format(
        "n = {:.3g} of the fit is above the {:.3g} ({}) of Voc over light: collection that depends "
        "on voltage, or an n that changes along the curve, is in the fit's n, Rs and Rsh",
        fitted.value, n.value, Range(n.low_95, n.high_95)));
  }
  return sweeps;
}

// Rs of the fit of the dark curve, where the fit may be used; else NaN.
Ranged DarkRs(const CellReport& report) {
  const CellSweep& dark = report.sweeps[report.dark->sweep];
  return dark.diode() ? FittedValue(dark, "Rs") : Ranged{};
}

std::vector<SeriesResistance> RsOfLights(const CellReport& report) {
  std::vector<SeriesResistance> list;
  const std::vector<int> lights = LightsOf(report, ReachedIsc);
  for (std::size_t k = 1; k < lights.size(); ++k) {
    list.push_back(RsFromTwoLights(report.sweeps[lights[k - 1]], report.sweeps[lights[k]]));
  }
  return list;
}

// From lit and dark curve; it means nothing where they do not superpose.
std::vector<SeriesResistance> RsOfDark(const CellReport& report) {
  if (!report.dark) return {};
  const CellSweep &main = report.sweeps[report.main], &dark = report.sweeps[report.dark->sweep];
  std::vector<SeriesResistance> list;
  const Ranged own = DarkRs(report);
  if (std::isfinite(own.value)) list.push_back(RsFromDark(main, dark, own));
  list.push_back(RsFromDark(main, dark, {}));
  for (SeriesResistance& one : list) {
    if (!report.superposition->departs) continue;
    one.ohm = {};
    one.missing = "the curves do not superpose";
  }
  return list;
}

std::vector<SeriesResistance> RsOfVoc(const CellReport& report) {
  std::vector<SeriesResistance> list;
  for (const IdealityOverLight& over : report.over_light) {
    list.push_back(RsFromVoc(report.sweeps[report.main], over));
  }
  return list;
}

std::vector<SeriesResistance> FindSeriesResistances(const CellReport& report) {
  std::vector<SeriesResistance> list;
  for (const int i : BrightestSweeps(report)) list.push_back(RsOfFit(report.sweeps[i]));
  Append(RsOfLights(report), &list);
  Append(RsOfDark(report), &list);
  Append(RsOfVoc(report), &list);
  list.push_back(RsFromSlope(report.sweeps[report.main]));
  return list;
}

// Series resistances for the test of superposition and their source. An estimate that needs no model
// of the diode comes before the fits and counts in the dark as well.
struct TakenOff {
  SeriesOhms ohms;
  std::string from;
};

std::vector<TakenOff> SeriesToTakeOff(const CellReport& report) {
  std::vector<TakenOff> all;
  for (const auto& list : {RsOfVoc(report), RsOfLights(report)}) {
    for (const SeriesResistance& one : list) {
      if (one.method == SeriesMethod::kVocOfLights || !(one.ohm.value >= 0)) continue;
      if (all.empty()) all.push_back({{one.ohm.value, one.ohm.value}, one.Name()});
    }
  }
  const CellSweep& main = report.sweeps[report.main];
  if (main.diode()) {
    const double lit = FittedValue(main, "Rs").value, dark = DarkRs(report).value;
    all.push_back({{lit, std::isfinite(dark) ? dark : lit}, "single-diode fit"});
  }
  if (all.empty()) all.push_back({{}, "none: the fit is void"});
  return all;
}

// The curves superpose where one of the estimates of Rs makes them: another then has what changed
// between its measurements in it.
std::optional<Superposition> Superpose(const CellReport& report, double least_percent) {
  if (!report.dark) return std::nullopt;
  std::optional<Superposition> first, found;
  for (const TakenOff& one : SeriesToTakeOff(report)) {
    found = TestSuperposition(report.sweeps[report.main], report.sweeps[report.dark->sweep],
                              one.ohms, least_percent);
    found->rs_from = one.from;
    if (first) found->not_with = first->rs_from;
    if (!first) first = found;
    if (!found->departs) break;
  }
  if (found->departs) found = first;
  found->lit = report.main;
  found->dark = report.dark->sweep;
  return found;
}

// Where no factor of the dark current makes the curves superpose, a barrier or collection is in the
// lit curve, and in the n and Rs of its fit.
std::vector<CellSweep> VoidBySuperposition(const CellReport& report) {
  constexpr double kExplained = 0.1;
  std::vector<CellSweep> sweeps = report.sweeps;
  const std::optional<Superposition>& found = report.superposition;
  if (!found || !found->departs || found->scaled_rms_percent < kExplained * found->rms_percent) {
    return sweeps;
  }
  for (const int i : BrightestSweeps(report)) {
    if (!sweeps[i].diode()) continue;
    sweeps[i].void_because.emplace_back(
        "lit and dark curve do not superpose, whatever the factor of the dark current: a lamp that "
        "drifted, a barrier or collection that depends on voltage may be in n and Rs");
  }
  return sweeps;
}

std::vector<FillFactorLosses> FindLosses(const CellReport& report) {
  std::vector<FillFactorLosses> losses;
  for (const int i : BrightestSweeps(report)) {
    losses.push_back(FindFillFactorLosses(report.sweeps[i]));
    losses.back().sweep = i;
  }
  return losses;
}

PseudoFillFactor FindPseudo(const CellReport& report, ConstantSet constants) {
  const KeyPoints& key = report.sweeps[report.main].key;
  const double thermal_V = ThermalVoltage(report.temperature_C + kZeroCelsius_K, constants);
  PseudoFillFactor pseudo;
  pseudo.ideal = FillFactorOf({key.short_circuit_current_A, key.open_circuit_voltage_V,
                               report.cells_in_series * thermal_V});
  for (const SweepKind source : {SweepKind::kSunsVoc, SweepKind::kLit}) {
    for (const IdealityOverLight& over : report.over_light) {
      if (over.source != source) continue;
      pseudo.value = PseudoFillFactorOf(key.short_circuit_current_A, over.points);
      pseudo.source =
          source == SweepKind::kSunsVoc ? PseudoSource::kSunsVoc : PseudoSource::kLights;
      // Without Rs the curve gives no less: where it seems to, a shunt that does not follow the light,
      // or an n that does, is in Voc over light.
      if (pseudo.value >= key.fill_factor) return pseudo;
    }
  }
  pseudo.value = kUnknown;
  pseudo.source = PseudoSource::kFit;
  for (const FillFactorLosses& losses : report.losses) {
    if (losses.sweep == report.main) pseudo.value = losses.without_series;
  }
  return pseudo;
}

// Rs from two lights is one number if it is a resistance; what collection loses grows as the light
// falls.
bool GrowsAsTheLightFalls(const std::vector<SeriesResistance>& list) {
  constexpr double kGrown = 1.3;
  const SeriesResistance* brighter = nullptr;
  for (const SeriesResistance& one : list) {
    if (one.method != SeriesMethod::kTwoLights || !one.missing.empty()) continue;
    if (brighter != nullptr && one.ohm.low_95 > brighter->ohm.high_95 &&
        one.ohm.value > kGrown * brighter->ohm.value) {
      return true;
    }
    brighter = &one;
  }
  return false;
}

std::vector<std::string> WarningsOf(const CellSweep& sweep) {
  std::vector<std::string> warnings;
  const auto warn = [&](const std::string& text) { warnings.push_back(sweep.name + ": " + text); };
  if (!sweep.doubt.empty()) warn(sweep.doubt);
  if (!sweep.no_efficiency_because.empty()) warn(sweep.no_efficiency_because);
  if (sweep.limited > 0) {
    warn(fmt::format(
        "{} readings beyond Voc have one current: a limit of the source; they are left out",
        sweep.limited));
  }
  if (!sweep.no_fit_because.empty()) warn("no fit: " + sweep.no_fit_because);
  if (!sweep.void_because.empty()) warn("n and Rs of the fit are void: " + VoidReasons(sweep));
  return warnings;
}

std::vector<std::string> FindWarnings(const CurveSet& cell, const CellReport& report) {
  std::vector<std::string> warnings;
  for (const RejectedCurve& rejected : cell.rejected) {
    warnings.push_back(fmt::format("{} left out: {}", rejected.id, rejected.error.ToString()));
  }
  if (GrowsAsTheLightFalls(report.series_resistance)) {
    warnings.emplace_back(
        "Rs from two lights grows as the light falls, which no resistance does: collection that "
        "depends on voltage is in it, and in Rs from Voc over light");
  }
  if (!std::isfinite(report.area_cm2)) {
    warnings.emplace_back(
        "the area is not known: no current density, efficiency or resistance per area; give "
        "--area-cm2");
  }
  for (const CellSweep& sweep : report.sweeps) Append(WarningsOf(sweep), &warnings);
  return warnings;
}

// Those of the set and of its curves, each sentence once.
std::vector<Assumption> AssumptionsOf(const CurveSet& cell) {
  std::vector<Assumption> all = cell.assumptions;
  for (const IvCurve& curve : cell.curves) {
    for (const Assumption& assumption : curve.assumptions) {
      const bool known = std::any_of(all.begin(), all.end(), [&](const Assumption& other) {
        return other.sentence == assumption.sentence;
      });
      if (!known) all.push_back(assumption);
    }
  }
  return all;
}

// The report with its sweeps, each described and fitted alone.
Expected<CellReport> DescribeSweeps(const CurveSet& cell, const CellOptions& options,
                                    const Observer& observer) {
  CellReport report;
  const Conditions& conditions = cell.curves.front().conditions;
  report.version = Version();
  report.name = cell.name;
  report.source = cell.source;
  report.cells_in_series = conditions.cells_in_series;
  report.temperature_C = conditions.cell_temperature_K - kZeroCelsius_K;
  report.bandgap_eV = cell.curves.front().notes.bandgap_eV.value_or(kUnknown);
  report.assumptions = AssumptionsOf(cell);
  report.non_default_options = NonDefaults(options, kCellOptionTable);
  for (const IvCurve& curve : cell.curves) {
    if (curve.notes.area_cm2) report.area_cm2 = *curve.notes.area_cm2;
    report.per_area = report.per_area || curve.per_area;
  }
  if (report.per_area) report.area_cm2 = 1;
  std::vector<MeasuredSweep> measured;
  for (const IvCurve& curve : cell.curves) Append(FindSweeps(curve, report.area_cm2), &measured);
  if (measured.empty()) return Fail("no sweep has five readings", cell.source);
  TRY(AcceptedSweeps accepted, LeaveOutRefused(std::move(measured)));
  report.warnings = std::move(accepted.warnings);
  for (MeasuredSweep& one : accepted.sweeps) {
    report.sweeps.push_back(options.fit ? FitCellSweep(std::move(one), options, observer)
                                        : std::move(one.sweep));
    const CellSweep& sweep = report.sweeps.back();
    report.interrupted = report.interrupted || (sweep.fit && sweep.fit->interrupted);
  }
  NameApart(cell, &report.sweeps);
  return report;
}

}  // namespace

Expected<CellReport> DescribeCell(const CurveSet& cell, const CellOptions& options,
                                  const Observer& observer) {
  TRY(ValidateOptions(options, kCellOptionTable));
  if (cell.curves.empty()) return Fail("no curve to describe", cell.source);
  TRY(CheckIsOneCell(cell, "batch --task cell"));
  TRY(CellReport report, DescribeSweeps(cell, options, observer));
  const double thermal_V = cell.curves.front().conditions.ModuleThermalVoltage(options.constants);
  report.main = BrightestOf(report.sweeps);
  report.pairs = FindPairs(report.sweeps, options.hysteresis);
  report.over_rate = CompareRates(report.sweeps, &report.pairs);
  report.over_light = FindIdealities(report, thermal_V);
  report.sweeps = VoidByOtherSweeps(report);
  report.dark = FindDark(report, thermal_V);
  if (report.main != -1) {
    report.superposition = Superpose(report, options.superposition);
    report.sweeps = VoidBySuperposition(report);
    report.losses = FindLosses(report);
    report.series_resistance = FindSeriesResistances(report);
    report.pseudo = FindPseudo(report, options.constants);
  }
  if (options.fit) {
    report.joint = FindJointEstimate(report, LightsOf(report, IscOfSweep),
                                     report.dark ? report.dark->sweep : -1, options, observer);
  }
  if (report.joint) NameShuntLosses(*report.joint, &report.losses);
  Append(FindWarnings(cell, report), &report.warnings);
  return report;
}

}  // namespace lyrefit
