#include "lyrefit/devices/describe_cell.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

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

namespace lyrefit {
namespace {

// Numbers sweeps of one name: "forward, dark (2)".
void NumberRepeats(std::vector<CellSweep>* sweeps) {
  std::map<std::string, int> seen;
  for (CellSweep& sweep : *sweeps) {
    const int count = ++seen[sweep.name];
    if (count > 1) sweep.name += fmt::format(" ({})", count);
  }
}

std::vector<IdealityOverLight> FindIdealities(const std::vector<CellSweep>& sweeps,
                                              double thermal_V) {
  std::vector<IdealityOverLight> idealities;
  const auto take = [&](SweepKind source, const std::vector<VocPoint>& points) {
    auto found = FindIdealityOverLight(points, thermal_V);
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

// n over light, the last one that begins below the light of `main`.
double IdealityAtMain(const CellReport& report) {
  double n = kUnknown;
  for (const IdealityOverLight& over : report.over_light) {
    for (const LocalIdeality& local : over.local) {
      if (local.low_A < report.sweeps[report.main].key.short_circuit_current_A) n = local.n;
    }
  }
  return n;
}

// Why n of the fits is none of the junction, beside what each sweep alone shows: a pair with
// hysteresis where n is above `ideal_n` already, and an n above that over light, as collection makes
// it, which is then in Rs and Rsh as well.
std::vector<CellSweep> VoidByOtherSweeps(const CellReport& report) {
  constexpr double kMost = 1.15;
  std::vector<CellSweep> sweeps = report.sweeps;
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    std::vector<std::string>& reasons = sweeps[i].void_because;
    if (sweeps[i].fit && !reasons.empty() && IsHysteretic(report, static_cast<int>(i))) {
      reasons.emplace_back(
          "one direction of a pair with hysteresis: its n is none of the junction");
    }
  }
  for (const int i : BrightestSweeps(report)) {
    const double fitted = FittedValue(sweeps[i], "n1").value, n = IdealityAtMain(report);
    if (!(fitted > kMost * n)) continue;
    sweeps[i].void_because.push_back(fmt::format(
        "n = {:.3g} of the fit is above the {:.3g} of Voc over light: collection that depends on "
        "voltage, or an n that changes along the curve, is in the fit's n, Rs and Rsh",
        fitted, n));
  }
  return sweeps;
}

// Rs of the fit of the dark curve, where the fit may be used; else NaN.
double DarkRs(const CellReport& report) {
  const CellSweep& dark = report.sweeps[report.dark->sweep];
  return dark.diode() ? FittedValue(dark, "Rs").value : kUnknown;
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
  if (std::isfinite(DarkRs(report))) list.push_back(RsFromDark(main, dark, DarkRs(report)));
  list.push_back(RsFromDark(main, dark, kUnknown));
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
    list.push_back(RsFromVoc(report.sweeps[report.main], over.points, over.source));
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
// of the diode comes before the fit and counts in the dark as well.
std::pair<SeriesOhms, std::string> SeriesToTakeOff(const CellReport& report) {
  for (const auto& list : {RsOfVoc(report), RsOfLights(report)}) {
    for (const SeriesResistance& one : list) {
      if (one.method == SeriesMethod::kVocOfLights || !(one.ohm.value >= 0)) continue;
      return {{one.ohm.value, one.ohm.value}, one.Name()};
    }
  }
  const CellSweep& main = report.sweeps[report.main];
  if (!main.diode()) return {{}, "none: the fit is void"};
  const double lit = FittedValue(main, "Rs").value, dark = DarkRs(report);
  return {{lit, std::isfinite(dark) ? dark : lit}, "single-diode fit"};
}

std::optional<Superposition> Superpose(const CellReport& report, double least_percent) {
  if (!report.dark) return std::nullopt;
  const auto [series, from] = SeriesToTakeOff(report);
  Superposition found = TestSuperposition(report.sweeps[report.main],
                                          report.sweeps[report.dark->sweep], series, least_percent);
  found.lit = report.main;
  found.dark = report.dark->sweep;
  found.rs_from = from;
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
        "lit and dark curve do not superpose, whatever the factor of the dark current: a barrier "
        "or collection that depends on voltage may be in n and Rs");
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
  report.assumptions = AssumptionsOf(cell);
  report.non_default_options = NonDefaults(options, kCellOptionTable);
  for (const IvCurve& curve : cell.curves) {
    if (curve.notes.area_cm2) report.area_cm2 = *curve.notes.area_cm2;
  }
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
  NumberRepeats(&report.sweeps);
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
  report.over_light = FindIdealities(report.sweeps, thermal_V);
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
