#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/append.h"
#include "lyrefit/batch/batch_task.h"
#include "lyrefit/batch/pixel_state.h"
#include "lyrefit/curve/dark.h"
#include "lyrefit/devices/cell_parts.h"
#include "lyrefit/devices/describe_cell.h"
#include "lyrefit/devices/device_documents.h"
#include "lyrefit/read/cells.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json.h"

namespace lyrefit {
namespace {

std::vector<ResultColumn> CellColumns() {
  constexpr CellType kText = CellType::kText;
  constexpr CellType kNumber = CellType::kNumber;
  std::vector<ResultColumn> columns = {
      {"sample", "", kText, "the sample of the pixel, by its id"},
      {"state", "", kText, "working, shorted, dead, weak, or unlit: measured in the dark only"},
      {"sweeps", "", CellType::kWhole, "sweeps of the pixel, of all lights and directions"},
      {"area_cm2", "cm2", kNumber, "area of the pixel"},
      {"direction", "", kText, "the direction of more power, which the key points are of"},
      {"jsc_mA_cm2", "mA/cm2", kNumber, "short-circuit current of that sweep over the area"},
      {"efficiency", "", kNumber, "of that sweep, a fraction"},
  };
  for (const char* direction : {"forward", "reverse"}) {
    for (const CellField& field : CellFields()) {
      columns.push_back({std::string(direction) + "_" + field.name, field.unit, kNumber,
                         std::string(field.doc) + ", " + direction + " sweep"});
    }
    columns.push_back({std::string(direction) + "_void", "", kText,
                       std::string("why n and Rs of the fit are void, ") + direction + " sweep"});
  }
  for (ResultColumn column : std::vector<ResultColumn>{
           {"hysteresis", "", kText, "none, normal (reverse gives more power) or inverted"},
           {"hysteresis_index_power", "", kNumber, "(Pmp reverse - Pmp forward) / Pmp reverse"},
           {"hysteresis_gap_percent", "%", kNumber,
            "rms of the difference of the directions, of Jsc"},
           {"n_over_light", "", kNumber, "ideality from Voc over light"},
           {"n_dark", "", kNumber, "least local ideality of the dark curve"},
           {"pseudo_fill_factor", "", kNumber, "fill factor without series resistance"},
           {"superposition", "", kText, "of the lit and dark curve: holds or departs"},
           {"warnings", "", kText, "in plain words, with '; ' between them"}}) {
    columns.push_back(std::move(column));
  }
  return columns;
}

std::vector<ResultCell> CellsOfSweep(const CellSweep* sweep) {
  std::vector<ResultCell> cells;
  for (const CellField& field : CellFields()) {
    cells.push_back(sweep == nullptr ? ResultCell() : NumberCell(field.value(*sweep)));
  }
  cells.push_back(sweep == nullptr ? ResultCell() : TextCell(VoidReasons(*sweep)));
  return cells;
}

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

std::vector<ResultCell> CellsOf(const std::string& sample, const CellReport& report,
                                const JudgedPixel& judged) {
  const BrightestSweeps sweeps = BrightestSweepsOf(report);
  const CellSweep* const best = sweeps.better();
  std::vector<ResultCell> cells = {
      TextCell(sample),
      TextCell(ToText(judged.state)),
      static_cast<std::int64_t>(report.sweeps.size()),
      NumberCell(report.area_cm2),
      best == nullptr ? ResultCell() : TextCell(ToText(best->direction)),
      best == nullptr ? ResultCell() : NumberCell(best->jsc_mA_cm2),
      best == nullptr ? ResultCell() : NumberCell(best->efficiency)};
  Append(CellsOfSweep(sweeps.forward), &cells);
  Append(CellsOfSweep(sweeps.reverse), &cells);
  const DirectionPair* const pair = PairOf(report, sweeps);
  cells.push_back(pair == nullptr ? ResultCell() : TextCell(ToText(pair->sense)));
  cells.push_back(pair == nullptr ? ResultCell() : NumberCell(pair->index_power));
  cells.push_back(pair == nullptr ? ResultCell() : NumberCell(pair->gap_percent));
  const bool over_light = !report.over_light.empty();
  cells.push_back(over_light ? NumberCell(report.over_light.front().junction_n()) : ResultCell());
  cells.push_back(report.dark ? NumberCell(report.dark->least_n) : ResultCell());
  cells.push_back(NumberCell(report.pseudo.value));
  cells.push_back(!report.superposition
                      ? ResultCell()
                      : TextCell(report.superposition->departs ? "departs" : "holds"));
  cells.push_back(ListCell(report.warnings, "; "));
  return cells;
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
  BatchTaskType task;
  task.name = "cell";
  task.columns = CellColumns();
  task.options = NonDefaults(options, kCellOptionTable);
  AppendNonDefaults(pixels, kPixelOptionTable, &task.options);
  task.options.push_back({kPixelCriterion, PixelCriterion(pixels), ""});
  task.run = [options, pixels](const BatchCurve& curve, std::uint64_t /*seed*/,
                               const Observer& observer) {
    const CurveSet set = SetOfCell(curve);
    Expected<CellReport> report = DescribeCell(set, options, observer);
    if (!report) return TaskResult{RowStatus::kBroken, report.error().message, {}, false};
    const bool all_dark = std::all_of(set.curves.begin(), set.curves.end(), IsStatedDark);
    const JudgedPixel judged = JudgePixel(*report, all_dark, pixels);
    const bool fails = judged.state != PixelState::kWorking && judged.state != PixelState::kUnlit;
    TaskResult result{fails ? RowStatus::kNotUsable : RowStatus::kFine, judged.reason,
                      CellsOf(SampleOfCell(curve.id, curve.curve->source), *report, judged),
                      report->interrupted};
    result.failed = fails;
    if (const CellSweep* best = BrightestSweepsOf(*report).better()) result.key_points = best->key;
    result.page =
        [report = std::make_shared<const CellReport>(std::move(*report))](const PageOptions& page) {
          return DrawPage(CellDocument(*report), CellJson(*report), page);
        };
    return result;
  };
  return task;
}

}  // namespace lyrefit
