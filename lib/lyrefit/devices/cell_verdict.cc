#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/numbers.h"
#include "lyrefit/devices/cell_parts.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

std::string SweepPower(const CellReport& report, const CellSweep& sweep) {
  if (std::isfinite(report.area_cm2) && sweep.doubt.empty()) {
    const std::string efficiency = sweep.no_efficiency_because.empty()
                                       ? "efficiency " + PercentText(sweep.efficiency)
                                       : "no efficiency, since the light is not known";
    const bool begins_above = !std::isfinite(sweep.jsc_mA_cm2);
    if (begins_above) {
      return fmt::format("{} (Voc {} V; the sweep does not reach 0 V: no Jsc, no FF)", efficiency,
                         Significant(sweep.key.open_circuit_voltage_V, 4));
    }
    return fmt::format(
        "{} (Jsc {} mA/cm2, Voc {} V, FF {})", efficiency, Significant(sweep.jsc_mA_cm2, 4),
        Significant(sweep.key.open_circuit_voltage_V, 4), PercentText(sweep.key.fill_factor));
  }
  return fmt::format("Pmp {} W (Isc {} A, Voc {} V, FF {})", Significant(sweep.key.max_power_W, 4),
                     Significant(sweep.key.short_circuit_current_A, 4),
                     Significant(sweep.key.open_circuit_voltage_V, 4),
                     PercentText(sweep.key.fill_factor));
}

// "0.02, 0.2, 2" of the pairs of several rates.
std::string OverRates(const CellReport& report, double (*value)(const CellReport&, int pair)) {
  std::string text;
  for (const int i : report.over_rate->pairs) {
    text += (text.empty() ? "" : ", ") + Significant(value(report, i), 2);
  }
  return text;
}

std::string HysteresisVerdict(const CellReport& report) {
  if (report.pairs.empty()) return "";
  if (report.over_rate) {
    const auto gap = [](const CellReport& r, int pair) { return r.pairs[pair].gap_percent; };
    const auto rate = [](const CellReport& r, int pair) {
      return r.sweeps[r.pairs[pair].forward].scan_rate_V_s;
    };
    const std::string& finding = report.over_rate->finding;
    return fmt::format(" Hysteresis over rate: a gap of {} % of Jsc at {} V/s; {}.",
                       OverRates(report, gap), OverRates(report, rate),
                       finding.empty() ? "none to speak of" : finding);
  }
  const DirectionPair& pair = report.pairs.front();
  if (pair.sense == HysteresisSense::kNeither) {
    return fmt::format(
        " Hysteresis: a gap of {} % of Jsc; the index by power, {}, is below its noise.",
        Significant(pair.gap_percent, 2), PercentText(pair.index_power, 2));
  }
  if (!std::isfinite(pair.gap_percent)) {
    return " Hysteresis is not decided: one direction does not reach 0 V.";
  }
  if (pair.sense == HysteresisSense::kNone) {
    return fmt::format(" No hysteresis: a gap of {} % of Jsc between the directions.",
                       Significant(pair.gap_percent, 2));
  }
  return fmt::format(" Hysteresis, {}: index by power {}, gap {} % of Jsc{}.", ToText(pair.sense),
                     PercentText(pair.index_power, 2), Significant(pair.gap_percent, 2),
                     pair.cross ? " (the curves cross, which the index hides)" : "");
}

// The fill factor without series resistance that is measured, and what is lost beside it.
std::string PseudoVerdict(const CellReport& report) {
  const PseudoFillFactor& pseudo = report.pseudo;
  if (pseudo.source != PseudoSource::kSunsVoc || !std::isfinite(pseudo.value)) return "";
  return fmt::format(
      " Pseudo-FF {} (measured, Suns-Voc): series resistance costs {}, recombination and shunt {}.",
      PercentText(pseudo.value),
      PercentText(pseudo.value - report.sweeps[report.main].key.fill_factor, 2),
      PercentText(pseudo.ideal - pseudo.value, 2));
}

std::string LossVerdict(const CellReport& report) {
  for (const FillFactorLosses& losses : report.losses) {
    if (losses.sweep != report.main) continue;
    if (!losses.missing.empty()) return " No split of the fill factor: " + losses.missing + ".";
    const auto largest =
        std::max_element(losses.parts.begin(), losses.parts.end(),
                         [](const auto& a, const auto& b) { return a.loss.value < b.loss.value; });
    return fmt::format(" The fill factor loses most by {}: {} of {}.",
                       largest->name.substr(0, largest->name.find(':')),
                       PercentText(largest->loss.value, 2), PercentText(losses.ideal));
  }
  return "";
}

std::string HourVerdict(const CellReport& report) {
  const HourRow* last = nullptr;
  const std::vector<HourRow> rows = RowsOfHours(report);
  for (const HourRow& row : rows) {
    const bool like_main =
        report.sweeps[row.sweep].direction == report.sweeps[report.main].direction;
    if (like_main && (last == nullptr || row.hours > last->hours)) last = &row;
  }
  if (last == nullptr) return "";
  return fmt::format(" After {} h: Pmp {} of the first, Voc {}, Jsc {}, FF {}.",
                     Significant(last->since_h, 3), PercentText(last->power),
                     PercentText(last->voc), PercentText(last->isc), PercentText(last->ff));
}

}  // namespace

std::vector<HourRow> RowsOfHours(const CellReport& report) {
  std::vector<HourRow> rows;
  double least = kInfinity, most = -kInfinity;
  for (const CellSweep& sweep : report.sweeps) {
    least = std::fmin(least, sweep.elapsed_h);
    most = std::fmax(most, sweep.elapsed_h);
  }
  if (!(most > least)) return rows;
  constexpr double kSameLight = 0.02;
  for (std::size_t i = 0; i < report.sweeps.size(); ++i) {
    const CellSweep& sweep = report.sweeps[i];
    if (sweep.kind != SweepKind::kLit || std::isnan(sweep.elapsed_h)) continue;
    const CellSweep* first = nullptr;
    for (const CellSweep& other : report.sweeps) {
      const double light = other.irradiance_W_m2;
      const bool alike = other.kind == SweepKind::kLit && other.direction == sweep.direction &&
                         std::fabs(light - sweep.irradiance_W_m2) <= kSameLight * light;
      if (alike && (first == nullptr || other.elapsed_h < first->elapsed_h)) first = &other;
    }
    const KeyPoints &own = sweep.key, &at = first->key;
    rows.push_back({static_cast<int>(i), sweep.elapsed_h, sweep.elapsed_h - first->elapsed_h,
                    own.open_circuit_voltage_V / at.open_circuit_voltage_V,
                    own.short_circuit_current_A / at.short_circuit_current_A,
                    own.fill_factor / at.fill_factor, own.max_power_W / at.max_power_W});
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const HourRow& a, const HourRow& b) { return a.hours < b.hours; });
  return rows;
}

std::string CellVerdict(const CellReport& report) {
  std::string text;
  if (report.main == -1) text = "No lit curve that delivers power.";
  if (report.main == -1 && report.dark && std::isfinite(report.dark->least_n)) {
    const DarkIdeality& dark = *report.dark;
    text +=
        std::isfinite(dark.fitted.value)
            ? fmt::format(
                  " n of the dark curve: {} by the fit; smallest local n {}, with what "
                  "shunt and Rs add.",
                  RangedText(dark.fitted), Significant(dark.least_n, 3))
            : fmt::format(" Smallest local n of the dark curve: {}, with what shunt and Rs add.",
                          Significant(dark.least_n, 3));
  }
  for (const FillFactorLosses& losses : report.losses) {
    const CellSweep& sweep = report.sweeps[losses.sweep];
    const CellSweep& main = report.sweeps[report.main];
    // Of a series the first speaks.
    if (std::fabs(sweep.elapsed_h - main.elapsed_h) > 0.05 * main.elapsed_h + 0.02 ||
        std::fabs(sweep.scan_rate_V_s / main.scan_rate_V_s - 1) > 0.05) {
      continue;
    }
    text += (text.empty() ? "" : " ") +
            FullSentence(fmt::format("{}: {}", sweep.name, SweepPower(report, sweep)));
  }
  text += HysteresisVerdict(report);
  if (report.main != -1) text += HourVerdict(report);
  for (const IdealityOverLight& over : report.over_light) {
    const char* source = over.source == SweepKind::kLit ? "over light" : "from Suns-Voc";
    text += over.rises_to_low_light
                ? fmt::format(" n {} {} around Isc; the local n rises to {} at low light.", source,
                              RangedText(over.junction, 3), Significant(over.local.front().n, 3))
                : fmt::format(" n {} {}.", source, RangedText(over.n, 3));
  }
  if (report.superposition && std::isfinite(report.superposition->rms_percent)) {
    text += report.superposition->departs
                ? fmt::format(" Lit and dark curve do not superpose: {} % of Jsc{}.",
                              Significant(report.superposition->rms_percent, 2), WarmthText(report))
                : std::string(" Lit and dark curve superpose.");
  }
  return text + PseudoVerdict(report) + LossVerdict(report);
}

}  // namespace lyrefit
