#include <algorithm>
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
             return lights.empty() ? kUnknown : lights.front().junction_n();
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

}  // namespace lyrefit
