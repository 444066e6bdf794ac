#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "lyrefit/base/append.h"
#include "lyrefit/batch/column.h"
#include "lyrefit/batch/pixel_state.h"
#include "lyrefit/curve/dark.h"
#include "lyrefit/devices/cell_parts.h"
#include "lyrefit/devices/describe_cell.h"
#include "lyrefit/devices/device_documents.h"
#include "lyrefit/read/cells.h"

namespace lyrefit {
namespace {

// The pair of the two sweeps; null if there is none.
const DirectionPair* PairOf(const CellReport& report, const BrightestSweeps& sweeps) {
  for (const DirectionPair& pair : report.pairs) {
    if (&report.sweeps[pair.forward] == sweeps.forward &&
        &report.sweeps[pair.reverse] == sweeps.reverse) {
      return &pair;
    }
  }
  return nullptr;
}

struct CellRow {
  CellRow(std::string name, const CellReport& of, const JudgedPixel& pixel)
      : sample(std::move(name)),
        report(of),
        judged(pixel),
        sweeps(BrightestSweepsOf(of)),
        best(sweeps.better()),
        pair(PairOf(of, sweeps)) {}

  std::string sample;
  const CellReport& report;
  const JudgedPixel& judged;
  BrightestSweeps sweeps;
  const CellSweep* best;      // null: none
  const DirectionPair* pair;  // likewise
};

void AddSweepColumns(const std::string& direction, const CellSweep* BrightestSweeps::*which,
                     ColumnList<CellRow>* columns) {
  for (const CellField& field : CellFields()) {
    columns->emplace_back(direction + "_" + field.name, field.unit,
                          std::string(field.doc) + ", " + direction + " sweep",
                          [which, value = field.value](const CellRow& of) {
                            const CellSweep* const sweep = of.sweeps.*which;
                            return sweep == nullptr ? kUnknown : value(*sweep);
                          });
  }
  columns->emplace_back(direction + "_void", "",
                        "why n and Rs of the fit are void, " + direction + " sweep",
                        [which](const CellRow& of) {
                          const CellSweep* const sweep = of.sweeps.*which;
                          return sweep == nullptr ? "" : VoidReasons(*sweep);
                        });
}

ColumnList<CellRow> CellColumns() {
  using Of = const CellRow&;
  ColumnList<CellRow> columns = {
      {"sample", "", "the sample of the pixel, by its id", &CellRow::sample},
      {"state", "", "working, shorted, dead, weak, or unlit: measured in the dark only",
       [](Of of) { return ToText(of.judged.state); }},
      {"sweeps", "", "sweeps of the pixel, of all lights and directions",
       [](Of of) { return of.report.sweeps.size(); }},
      {"area_cm2", "cm2", "area of the pixel", [](Of of) { return of.report.area_cm2; }},
      {"direction", "", "the direction of more power, which the key points are of",
       [](Of of) { return of.best ? ToText(of.best->direction) : ""; }},
      {"jsc_mA_cm2", "mA/cm2", "short-circuit current of that sweep over the area",
       [](Of of) { return of.best ? of.best->jsc_mA_cm2 : kUnknown; }},
      {"efficiency", "", "of that sweep, a fraction",
       [](Of of) { return of.best ? of.best->efficiency : kUnknown; }},
  };
  AddSweepColumns("forward", &BrightestSweeps::forward, &columns);
  AddSweepColumns("reverse", &BrightestSweeps::reverse, &columns);
  Append({{"hysteresis", "", "none, normal (reverse gives more power) or inverted",
           [](Of of) { return of.pair ? ToText(of.pair->sense) : ""; }},
          {"hysteresis_index_power", "", "(Pmp reverse - Pmp forward) / Pmp reverse",
           [](Of of) { return of.pair ? of.pair->index_power : kUnknown; }},
          {"hysteresis_gap_percent", "%", "rms of the difference of the directions, of Jsc",
           [](Of of) { return of.pair ? of.pair->gap_percent : kUnknown; }},
          {"n_over_light", "", "ideality from Voc over light",
           [](Of of) {
             const auto& lights = of.report.over_light;
             return lights.empty() ? kUnknown : lights.front().junction.value;
           }},
          {"n_dark", "", "least local ideality of the dark curve",
           [](Of of) { return of.report.dark ? of.report.dark->least_n : kUnknown; }},
          {"pseudo_fill_factor", "", "fill factor without series resistance",
           [](Of of) { return of.report.pseudo.value; }},
          {"superposition", "", "of the lit and dark curve: holds or departs",
           [](Of of) {
             if (!of.report.superposition) return "";
             return of.report.superposition->departs ? "departs" : "holds";
           }},
          {"warnings", "", "in plain words, with '; ' between them",
           [](Of of) { return ListCell(of.report.warnings, "; "); }}},
         &columns);
  return columns;
}

// All curves of the cell.
CurveSet SetOfCell(const BatchCurve& cell) {
  CurveSet set = SetOfOne(*cell.curve);
  set.curves.insert(set.curves.end(), cell.more.begin(), cell.more.end());
  return set;
}

}  // namespace

BatchTaskType CellTask(const CellOptions& asked, const PixelOptions& pixels) {
  CellOptions options = asked;
  options.threads = 1;
  const ColumnList<CellRow> columns = CellColumns();
  BatchTaskType task;
  task.name = "cell";
  task.columns = HeadsOf(columns);
  task.options = NonDefaults(options, kCellOptionTable);
  AppendNonDefaults(pixels, kPixelOptionTable, &task.options);
  task.options.push_back({kPixelCriterion, PixelCriterion(pixels), ""});
  task.run = [options, pixels, columns](const BatchCurve& curve, std::uint64_t /*seed*/,
                                        const Observer& observer) {
    if (const auto valid = ValidateOptions(pixels, kPixelOptionTable); !valid) {
      return TaskResult{RowStatus::kBroken, valid.error().message, {}, false};
    }
    const CurveSet set = SetOfCell(curve);
    Expected<CellReport> report = DescribeCell(set, options, observer);
    if (!report) return TaskResult{RowStatus::kBroken, report.error().message, {}, false};
    const bool all_dark = std::all_of(set.curves.begin(), set.curves.end(), IsStatedDark);
    const JudgedPixel judged = JudgePixel(*report, all_dark, pixels);
    const bool fails = judged.state != PixelState::kWorking && judged.state != PixelState::kUnlit;
    const CellRow row(SampleOfCell(curve.id, curve.curve->source), *report, judged);
    TaskResult result{fails ? RowStatus::kNotUsable : RowStatus::kFine, judged.reason,
                      CellsOf(columns, row), report->interrupted};
    result.failed = fails;
    if (row.best != nullptr) result.key_points = row.best->key;
    result.page =
        [report = std::make_shared<const CellReport>(std::move(*report))](const PageOptions& page) {
          return DrawPage(CellDocument(*report), CellJson(*report), page);
        };
    return result;
  };
  return task;
}

namespace {

constexpr double kSun_W_m2 = 1000;
constexpr double kResistorFf = 0.25;
constexpr double kUsualArea_cm2 = 0.1;
// Slopes at 0 V and at Voc that differ by less are those of a straight line.
constexpr double kStraight = 1.5;

// The area, or that of a usual pixel, so that pixels without an area can be judged.
double AreaToJudge(const CellReport& report) {
  return std::isfinite(report.area_cm2) ? report.area_cm2 : kUsualArea_cm2;
}

// Largest density of current within 0.1 V of 0 V, in mA/cm2.
double LargestNearZero(const CellReport& report) {
  constexpr double kNear_V = 0.1;
  double largest_A = 0;
  for (const CellSweep& sweep : report.sweeps) {
    for (std::size_t k = 0; k < sweep.voltage_V.size(); ++k) {
      if (std::fabs(sweep.voltage_V[k]) > kNear_V) continue;
      largest_A = std::max(largest_A, std::fabs(sweep.current_A[k]));
    }
  }
  return 1e3 * largest_A / AreaToJudge(report);
}

// A pixel without photocurrent: a resistor, or nothing.
JudgedPixel WithoutPhotocurrent(const CellReport& report, const PixelOptions& options) {
  const double near_zero = LargestNearZero(report);
  if (near_zero > options.least_jsc_mA_cm2) {
    return {PixelState::kShorted,
            fmt::format("shorted: no power, but {:.3g} mA/cm2 within 0.1 V of 0 V", near_zero)};
  }
  return {PixelState::kDead, "dead: no photocurrent (or a dark curve that is not said to be one)"};
}

bool IsStraight(const CellSweep& sweep) {
  const double ratio = sweep.resistance_at_isc_ohm / sweep.resistance_at_voc_ohm;
  return ratio < kStraight && ratio > 1 / kStraight;
}

}  // namespace

const CellSweep* BrightestSweeps::better() const {
  if (forward == nullptr || reverse == nullptr) return forward == nullptr ? reverse : forward;
  return reverse->key.max_power_W > forward->key.max_power_W ? reverse : forward;
}

BrightestSweeps BrightestSweepsOf(const CellReport& report) {
  constexpr double kSameLight = 0.02;
  double brightest = 0;
  for (const CellSweep& sweep : report.sweeps) {
    if (sweep.kind == SweepKind::kLit) brightest = std::max(brightest, sweep.irradiance_W_m2);
  }
  BrightestSweeps found;
  for (const CellSweep& sweep : report.sweeps) {
    if (sweep.kind != SweepKind::kLit || sweep.irradiance_W_m2 < (1 - kSameLight) * brightest) {
      continue;
    }
    const bool forward = sweep.direction == ScanDirection::kForward;
    const CellSweep*& place = forward ? found.forward : found.reverse;
    if (place == nullptr) place = &sweep;
  }
  return found;
}

JudgedPixel JudgePixel(const CellReport& report, bool all_dark, const PixelOptions& options) {
  if (all_dark) return {PixelState::kUnlit, ""};
  const CellSweep* const best = BrightestSweepsOf(report).better();
  if (best == nullptr || !(best->key.max_power_W > 0)) return WithoutPhotocurrent(report, options);
  const KeyPoints& key = best->key;
  const double least_jsc = options.least_jsc_mA_cm2 * best->irradiance_W_m2 / kSun_W_m2;
  const double jsc = 1e3 * key.short_circuit_current_A / AreaToJudge(report);
  if (jsc < least_jsc) {
    return {PixelState::kDead,
            fmt::format("dead: Jsc of {:.3g} mA/cm2 is below {:.3g} mA/cm2", jsc, least_jsc)};
  }
  const double least_voc_V = options.least_voc_V * report.cells_in_series;
  if (key.open_circuit_voltage_V < least_voc_V) {
    return {PixelState::kShorted, fmt::format("shorted: Voc of {:.3g} V is below {:.3g} V",
                                              key.open_circuit_voltage_V, least_voc_V)};
  }
  const double from_resistor = 100 * std::fabs(key.fill_factor - kResistorFf);
  if (from_resistor <= options.resistor_ff_percent && IsStraight(*best)) {
    return {PixelState::kShorted,
            fmt::format("shorted: a straight line, FF of {:.1f} %", 100 * key.fill_factor)};
  }
  if (100 * best->efficiency < options.least_efficiency_percent) {
    return {PixelState::kWeak,
            fmt::format("weak: efficiency of {:.3g} % is below {:.3g} %", 100 * best->efficiency,
                        options.least_efficiency_percent)};
  }
  return {};
}

std::string PixelCriterion(const PixelOptions& options) {
  std::string text = fmt::format(
      "A pixel works if its direction of more power passes these limits. Dead: Jsc below {:g} "
      "mA/cm2 at 1000 W/m2 (where no area is known, {:g} cm2 are assumed). Shorted: Voc below {:g} "
      "V a cell, or a straight line with an FF within {:g} of 25 %.",
      options.least_jsc_mA_cm2, kUsualArea_cm2, options.least_voc_V, options.resistor_ff_percent);
  if (options.least_efficiency_percent > 0) {
    text += fmt::format(" Weak: efficiency below {:g} %.", options.least_efficiency_percent);
  }
  return text;
}

}  // namespace lyrefit
