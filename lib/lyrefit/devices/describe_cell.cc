#include "lyrefit/devices/describe_cell.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "lyrefit/base/option.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/devices/compare_directions.h"
#include "lyrefit/devices/describe_sweep.h"
#include "lyrefit/devices/fill_factor_losses.h"
#include "lyrefit/devices/ideality_over_light.h"
#include "lyrefit/devices/joint_estimate.h"
#include "lyrefit/devices/series_resistance.h"
#include "lyrefit/devices/superposition.h"
#include "lyrefit/read/cells.h"

namespace lyrefit {
namespace {

constexpr double kSameLight = 0.02;

bool IsSameLight(const CellSweep& a, const CellSweep& b) {
  return std::fabs(a.irradiance_W_m2 - b.irradiance_W_m2) <=
         kSameLight * std::max(a.irradiance_W_m2, b.irradiance_W_m2);
}

// Numbers sweeps of one name: "forward, dark (2)".
void NumberRepeats(std::vector<CellSweep>* sweeps) {
  std::map<std::string, int> seen;
  for (CellSweep& sweep : *sweeps) {
    const int count = ++seen[sweep.name];
    if (count > 1) sweep.name += fmt::format(" ({})", count);
  }
}

// Brightest lit sweep, of equals the first; -1: none is lit.
int BrightestOf(const std::vector<CellSweep>& sweeps) {
  int main = -1;
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    if (sweeps[i].kind != SweepKind::kLit || !(sweeps[i].key.max_power_W > 0)) continue;
    const bool brighter = main == -1 || (sweeps[i].irradiance_W_m2 > sweeps[main].irradiance_W_m2 &&
                                         !IsSameLight(sweeps[i], sweeps[main]));
    if (brighter) main = static_cast<int>(i);
  }
  return main;
}

// First sweep of this kind, one of the direction of `like` before others; -1: none.
int FindSweep(const CellReport& report, SweepKind kind, const CellSweep& like) {
  int found = -1;
  for (std::size_t i = 0; i < report.sweeps.size(); ++i) {
    if (report.sweeps[i].kind != kind) continue;
    if (report.sweeps[i].direction == like.direction) return static_cast<int>(i);
    if (found == -1) found = static_cast<int>(i);
  }
  return found;
}

// Lit sweeps of the direction of `main`, one a light, the brightest first.
std::vector<const CellSweep*> LightsOf(const CellReport& report) {
  std::vector<const CellSweep*> lights;
  for (const CellSweep& sweep : report.sweeps) {
    if (sweep.kind != SweepKind::kLit || sweep.direction != report.sweeps[report.main].direction) {
      continue;
    }
    const bool known = std::any_of(lights.begin(), lights.end(), [&](const CellSweep* other) {
      return IsSameLight(*other, sweep);
    });
    if (!known && sweep.key.short_circuit_current_A > 0) lights.push_back(&sweep);
  }
  std::stable_sort(lights.begin(), lights.end(), [](const CellSweep* a, const CellSweep* b) {
    return a->irradiance_W_m2 > b->irradiance_W_m2;
  });
  return lights;
}

// n of one direction of a hysteretic pair is no ideality where it is above `ideal_n`; the sentence
// says why.
void VoidHystereticFits(CellReport* report) {
  for (const DirectionPair& pair : report->pairs) {
    if (pair.sense == HysteresisSense::kNone) continue;
    for (const int i : {pair.forward, pair.reverse}) {
      CellSweep& sweep = report->sweeps[i];
      if (!sweep.fit || sweep.void_because.empty()) continue;
      sweep.void_because.push_back(
          "one direction of a pair with hysteresis: its n is none of the junction");
    }
  }
}

void FindIdealities(double thermal_V, CellReport* report) {
  const std::vector<VocPoint> lights = PointsOfLights(report->sweeps);
  if (auto found = FindIdealityOverLight(lights, thermal_V)) {
    report->over_light.push_back(std::move(*found));
  }
  for (const CellSweep& sweep : report->sweeps) {
    if (sweep.kind != SweepKind::kSunsVoc) continue;
    auto found = FindIdealityOverLight(PointsOfTrace(sweep), thermal_V);
    if (!found) continue;
    found->source = SweepKind::kSunsVoc;
    report->over_light.push_back(std::move(*found));
  }
}

void FindDark(double thermal_V, CellReport* report) {
  const CellSweep& like = report->sweeps[std::max(report->main, 0)];
  const int dark = FindSweep(*report, SweepKind::kDark, like);
  if (dark == -1) return;
  report->dark = FindDarkIdeality(report->sweeps[dark], thermal_V, report->cells_in_series);
  report->dark->sweep = dark;
  if (report->sweeps[dark].diode()) report->dark->fitted = FittedValue(report->sweeps[dark], "n1");
}

// Rs of the fit of the dark curve, where the fit may be used; else NaN.
double DarkRs(const CellReport& report) {
  const CellSweep& dark = report.sweeps[report.dark->sweep];
  return dark.diode() ? FittedValue(dark, "Rs").value : kUnknown;
}

void FindSeriesResistances(CellReport* report) {
  const CellSweep& main = report->sweeps[report->main];
  std::vector<SeriesResistance>& list = report->series_resistance;
  for (const CellSweep& sweep : report->sweeps) {
    if (sweep.kind == SweepKind::kLit && IsSameLight(sweep, main)) list.push_back(RsOfFit(sweep));
  }
  const std::vector<const CellSweep*> lights = LightsOf(*report);
  for (std::size_t k = 1; k < lights.size(); ++k) {
    list.push_back(RsFromTwoLights(*lights[k - 1], *lights[k]));
  }
  if (report->dark) {
    const CellSweep& dark = report->sweeps[report->dark->sweep];
    if (std::isfinite(DarkRs(*report))) list.push_back(RsFromDark(main, dark, DarkRs(*report)));
    list.push_back(RsFromDark(main, dark, kUnknown));
  }
  for (const IdealityOverLight& over : report->over_light) {
    list.push_back(RsFromVoc(main, over.points, over.source));
  }
  list.push_back(RsFromSlope(main));
}

// The n of a fit that is above the n over light is none of the junction: collection is in it, and in
// Rs and Rsh.
void VoidFitsAboveLight(CellReport* report) {
  constexpr double kMost = 1.15;
  if (report->main == -1 || report->over_light.empty()) return;
  const CellSweep& main = report->sweeps[report->main];
  double n = kUnknown;
  for (const IdealityOverLight& over : report->over_light) {
    for (const LocalIdeality& local : over.local) {
      // The last one that begins below this light.
      if (local.low_A < main.key.short_circuit_current_A) n = local.n;
    }
  }
  for (CellSweep& sweep : report->sweeps) {
    const double fitted = FittedValue(sweep, "n1").value;
    if (sweep.kind != SweepKind::kLit || !IsSameLight(sweep, main) || !(fitted > kMost * n)) {
      continue;
    }
    sweep.void_because.push_back(fmt::format(
        "n = {:.3g} of the fit is above the {:.3g} of Voc over light: collection that depends on "
        "voltage, or an n that changes along the curve, is in the fit's n, Rs and Rsh",
        fitted, n));
  }
}

// Rs from lit against dark means nothing where the curves do not superpose.
void VoidDarkResistances(CellReport* report) {
  if (!report->superposition || !report->superposition->departs) return;
  for (SeriesResistance& one : report->series_resistance) {
    if (one.method.rfind("lit against dark", 0) != 0) continue;
    one.ohm = {};
    one.missing = "the curves do not superpose";
  }
}

// Where no factor of the dark current makes the curves superpose, a barrier or collection is in the
// lit curve, and in the n and Rs of its fit.
void VoidFitsThatDoNotSuperpose(CellReport* report) {
  constexpr double kExplained = 0.1;
  const std::optional<Superposition>& found = report->superposition;
  if (!found || !found->departs || found->scaled_rms_percent < kExplained * found->rms_percent) {
    return;
  }
  for (FillFactorLosses& losses : report->losses) {
    CellSweep& sweep = report->sweeps[losses.sweep];
    if (!sweep.diode()) continue;
    sweep.void_because.emplace_back(
        "lit and dark curve do not superpose, whatever the factor of the dark current: a barrier "
        "or collection that depends on voltage may be in n and Rs");
    const int at = losses.sweep;
    losses = FindFillFactorLosses(sweep);
    losses.sweep = at;
    if (at == report->main && report->pseudo.source == "the fit with Rs = 0") {
      report->pseudo.value = kUnknown;
    }
    for (SeriesResistance& one : report->series_resistance) {
      if (one.method == RsOfFit(sweep).method) one = RsOfFit(sweep);
    }
  }
}

void FindPseudo(const CellOptions& options, CellReport* report) {
  const CellSweep& main = report->sweeps[report->main];
  PseudoFillFactor& pseudo = report->pseudo;
  pseudo.ideal =
      FillFactorOf({main.key.short_circuit_current_A, main.key.open_circuit_voltage_V,
                    report->cells_in_series *
                        ThermalVoltage(report->temperature_C + kZeroCelsius_K, options.constants)});
  for (const SweepKind source : {SweepKind::kSunsVoc, SweepKind::kLit}) {
    for (const IdealityOverLight& over : report->over_light) {
      if (over.source != source || std::isfinite(pseudo.value)) continue;
      const double found = PseudoFillFactorOf(main.key.short_circuit_current_A, over.points);
      // Without Rs the curve gives no less: where it seems to, a shunt that does not follow the light,
      // or an n that does, is in Voc over light.
      if (!(found >= main.key.fill_factor)) continue;
      pseudo.value = found;
      pseudo.source = source == SweepKind::kSunsVoc ? "Suns-Voc" : "Voc of the light series";
    }
  }
  if (std::isfinite(pseudo.value)) return;
  pseudo.source = "the fit with Rs = 0";
  for (const FillFactorLosses& losses : report->losses) {
    if (losses.sweep == report->main) pseudo.value = losses.without_series;
  }
}

// Series resistances for the test of superposition and their source. An estimate that needs no model
// of the diode comes before the fit and counts in the dark as well.
std::pair<SeriesOhms, std::string> SeriesToTakeOff(const CellReport& report) {
  for (const char* method : {"Suns-Voc against lit", "two lights"}) {
    for (const SeriesResistance& one : report.series_resistance) {
      if (one.method.rfind(method, 0) != 0 || !(one.ohm.value >= 0)) continue;
      return {{one.ohm.value, one.ohm.value}, one.method};
    }
  }
  const CellSweep& main = report.sweeps[report.main];
  if (!main.diode()) return {{}, "none: the fit is void"};
  const double lit = FittedValue(main, "Rs").value, dark = DarkRs(report);
  return {{lit, std::isfinite(dark) ? dark : lit}, "single-diode fit"};
}

// Indices of LightsOf and the dark curve in one estimate with the Suns-Voc traces.
void EstimateJointly(const CellOptions& options, const Observer& observer, CellReport* report) {
  std::vector<int> lights;
  if (report->main != -1) {
    for (const CellSweep* sweep : LightsOf(*report)) {
      lights.push_back(static_cast<int>(sweep - report->sweeps.data()));
    }
  }
  report->joint = FindJointEstimate(*report, lights, report->dark ? report->dark->sweep : -1,
                                    options, observer);
}

void Superpose(const CellOptions& options, CellReport* report) {
  const CellSweep& main = report->sweeps[report->main];
  if (!report->dark) return;
  const auto [series, from] = SeriesToTakeOff(*report);
  report->superposition =
      TestSuperposition(main, report->sweeps[report->dark->sweep], series, options.superposition);
  report->superposition->lit = report->main;
  report->superposition->dark = report->dark->sweep;
  report->superposition->rs_from = from;
}

// Rs from two lights is one number if it is a resistance; what collection loses grows as the light
// falls.
void WarnOfGrowingRs(CellReport* report) {
  constexpr double kGrown = 1.3;
  const SeriesResistance* brighter = nullptr;
  for (const SeriesResistance& one : report->series_resistance) {
    if (one.method.rfind("two lights", 0) != 0 || !one.missing.empty()) continue;
    if (brighter != nullptr && one.ohm.low_95 > brighter->ohm.high_95 &&
        one.ohm.value > kGrown * brighter->ohm.value) {
      report->warnings.push_back(
          "Rs from two lights grows as the light falls, which no resistance does: collection that "
          "depends on voltage is in it, and in Rs from Voc over light");
      return;
    }
    brighter = &one;
  }
}

void Warn(CellReport* report) {
  std::vector<std::string>& warnings = report->warnings;
  WarnOfGrowingRs(report);
  if (!std::isfinite(report->area_cm2)) {
    warnings.push_back(
        "the area is not known: no current density, efficiency or resistance per area; give "
        "--area-cm2");
  }
  for (const CellSweep& sweep : report->sweeps) {
    if (!sweep.doubt.empty()) warnings.push_back(sweep.name + ": " + sweep.doubt);
    if (!sweep.no_efficiency_because.empty()) {
      warnings.push_back(sweep.name + ": " + sweep.no_efficiency_because);
    }
    if (sweep.limited > 0) {
      warnings.push_back(fmt::format(
          "{}: {} readings beyond Voc have one current: a limit of the source; they are left out",
          sweep.name, sweep.limited));
    }
    if (!sweep.no_fit_because.empty()) {
      warnings.push_back(sweep.name + ": no fit: " + sweep.no_fit_because);
    }
    std::string reasons;
    for (const std::string& reason : sweep.void_because) {
      reasons += (reasons.empty() ? "" : "; ") + reason;
    }
    if (!reasons.empty()) {
      warnings.push_back(sweep.name + ": n and Rs of the fit are void: " + reasons);
    }
  }
}

}  // namespace

Expected<CellReport> DescribeCell(const CurveSet& cell, const CellOptions& options,
                                  const Observer& observer) {
  TRY(ValidateOptions(options, kCellOptionTable));
  if (cell.curves.empty()) return Fail("no curve to describe", cell.source);
  TRY(CheckIsOneCell(cell, "batch --task cell"));
  CellReport report;
  const IvCurve& first = cell.curves.front();
  report.version = Version();
  report.name = cell.name;
  report.source = cell.source;
  report.cells_in_series = first.conditions.cells_in_series;
  report.temperature_C = first.conditions.cell_temperature_K - kZeroCelsius_K;
  for (const IvCurve& curve : cell.curves) {
    if (curve.notes.area_cm2) report.area_cm2 = *curve.notes.area_cm2;
  }
  std::vector<MeasuredSweep> measured;
  for (const IvCurve& curve : cell.curves) {
    for (MeasuredSweep& sweep : FindSweeps(curve, report.area_cm2)) {
      measured.push_back(std::move(sweep));
    }
  }
  if (measured.empty()) return Fail("no sweep has five readings", cell.source);
  TRY(LeaveOutRefused(&measured, &report.warnings));
  for (MeasuredSweep& one : measured) {
    if (options.fit) FitCellSweep(options, observer, &one);
    report.interrupted = report.interrupted || (one.sweep.fit && one.sweep.fit->interrupted);
    report.sweeps.push_back(std::move(one.sweep));
  }
  NumberRepeats(&report.sweeps);
  report.main = BrightestOf(report.sweeps);
  report.pairs = FindPairs(report.sweeps, options.hysteresis);
  VoidHystereticFits(&report);
  const double thermal_V = first.conditions.ModuleThermalVoltage(options.constants);
  FindIdealities(thermal_V, &report);
  VoidFitsAboveLight(&report);
  FindDark(thermal_V, &report);
  if (report.main != -1) {
    for (std::size_t i = 0; i < report.sweeps.size(); ++i) {
      const CellSweep& sweep = report.sweeps[i];
      if (sweep.kind != SweepKind::kLit || !IsSameLight(sweep, report.sweeps[report.main]))
        continue;
      report.losses.push_back(FindFillFactorLosses(sweep));
      report.losses.back().sweep = static_cast<int>(i);
    }
    FindSeriesResistances(&report);
    FindPseudo(options, &report);
    Superpose(options, &report);
    VoidDarkResistances(&report);
    VoidFitsThatDoNotSuperpose(&report);
  }
  if (options.fit) EstimateJointly(options, observer, &report);
  if (report.joint) NameShuntLosses(*report.joint, &report.losses);
  report.assumptions = cell.assumptions;
  for (const IvCurve& curve : cell.curves) {
    for (const Assumption& assumption : curve.assumptions) {
      const bool known = std::any_of(
          report.assumptions.begin(), report.assumptions.end(),
          [&](const Assumption& other) { return other.sentence == assumption.sentence; });
      if (!known) report.assumptions.push_back(assumption);
    }
  }
  for (const RejectedCurve& rejected : cell.rejected) {
    report.warnings.push_back(
        fmt::format("{} left out: {}", rejected.id, rejected.error.ToString()));
  }
  report.non_default_options = NonDefaults(options, kCellOptionTable);
  Warn(&report);
  return report;
}

}  // namespace lyrefit
