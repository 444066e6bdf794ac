// Experimental: may change in a minor version (data/stable).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/batch/result_row.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/devices/cell_options.h"
#include "lyrefit/diagnose/diagnose_options.h"
#include "lyrefit/estimate/fit/fit_options.h"
#include "lyrefit/report/page.h"
#include "lyrefit/stream/batch_source.h"
#include "lyrefit/translate/translate_options.h"
#include "lyrefit/trend/read_trend.h"
#include "lyrefit/trend/trend_options.h"

namespace LYREFIT_PUBLIC lyrefit {

// When a pixel of a sample counts as working, for its yield. The direction of more power decides.
struct PixelOptions {
  double least_voc_V = 0.05;            // of each cell in series; below it the pixel is shorted
  double resistor_ff_percent = 2;       // a straight line with an FF so near to 25 % is a resistor
  double least_jsc_mA_cm2 = 0.1;        // at 1000 W/m2; below it the pixel is dead. Without an area
                                        // that of 0.1 cm2 counts
  double least_efficiency_percent = 0;  // below it the pixel is weak
};

inline constexpr OptionRow<PixelOptions> kPixelOptionTable[] = {
    OptionRow<PixelOptions>("Working pixels"),
    {"least-voc-V", "V", "a pixel with less Voc for each cell in series is shorted",
     &PixelOptions::least_voc_V, 0.0, 10.0},
    {"resistor-ff", "PERCENT",
     "a pixel is shorted too where its curve is straight and its FF so near to the 25 % of a "
     "resistor",
     &PixelOptions::resistor_ff_percent, 0.0, 25.0},
    {"least-jsc", "MA/CM2", "a pixel with less Jsc at 1000 W/m2 is dead",
     &PixelOptions::least_jsc_mA_cm2, 0.0, 100.0},
    {"least-efficiency", "PERCENT", "a pixel with less efficiency is weak, and does not count",
     &PixelOptions::least_efficiency_percent, 0.0, 100.0},
};

// Usability of the row of a curve.
enum class RowStatus {
  kFine,
  kDoubtful,   // there is an answer, but the readings are implausible: see PlausibilityProblem
  kNotUsable,  // there is an answer, but it should not be used
  kBroken,     // there is no answer: the curve could not be read or processed
};

template <>
struct EnumTable<RowStatus> {
  static constexpr EnumText<RowStatus> kRows[] = {{RowStatus::kFine, "fine"},
                                                  {RowStatus::kDoubtful, "doubtful"},
                                                  {RowStatus::kNotUsable, "not usable"},
                                                  {RowStatus::kBroken, "broken"}};
};

// Result of a task for one curve.
struct TaskResult {
  RowStatus status = RowStatus::kFine;
  std::string reason;             // reason in one sentence if it is not fine
  std::vector<ResultCell> cells;  // one for each of the task's columns; empty if broken
  bool interrupted = false;       // the observer stopped the task: to be discarded
  bool failed = false;            // the curve needs inspection
  // Creates the curve's page, with the same bytes for the same curve and seed. Empty: no page.
  std::function<std::string(const PageOptions& options)> page = {};
  // Key points of the row; empty: those of the readings of `curve`.
  std::optional<KeyPoints> key_points = {};
};

// A task, as data: what is run on each of many curves.
struct BatchTaskType {
  std::string name;  // "fit"
  // The task's columns, after those of every row (CommonColumns).
  std::vector<ResultColumn> columns;
  std::vector<OptionEcho> options;  // all options that affect its cells; not the number of threads
  // Runs the task on one curve with the curve's seed. It must be thread-safe and use one thread.
  // `curve.curve` has a value. The same curve and seed must give the same cells, so times are not
  // allowed in them.
  std::function<TaskResult(const BatchCurve& curve, std::uint64_t seed, const Observer& observer)>
      run;
};

// The task `fit`. `auto_model`: one to three diodes, selected by the data (FitAuto).
// BatchFitOptions has the usual options: small searches and symmetric intervals.
BatchTaskType FitTask(const FitOptions& asked, bool auto_model = false);

// The task `diagnose`. The gain on held-out readings is not computed, since no column has it.
BatchTaskType DiagnoseTask(const DiagnoseOptions& asked);

// The task `translate` to standard conditions: power with its uncertainty, zone, checklist. A
// rating beside a curve (rated_power_W, of the whole string) is used if the options state none.
BatchTaskType FieldTestTask(const TranslateOptions& asked);

// The task `cell`: the description of a laboratory cell, of the source's option whole_cells, and
// whether it counts as a working pixel of its sample. Its summary has statistics of each sample.
BatchTaskType CellTask(const CellOptions& asked, const PixelOptions& pixels = {});

// The task `trend`: an item is a file with the measurements of one device over time, of the source's
// option whole_files: sweeps in a shape of ReadTrend, or the state of a trend; a table of operating
// points if the law of `reading` is for them. Its row has rates, losses by part and the onset that costs
// most.
BatchTaskType TrendTask(const TrendReadOptions& reading, const TrendOptions& asked = {});

// Usual options for fits of many curves: symmetric intervals, and no random baseline, since its
// RMSE has no column.
FitOptions BatchFitOptions();

// Usual options for field tests of many curves: 1,000 draws. They determine the probability of a
// wrong decision to 1.6 % or better, and the ends of an interval to a twelfth of its half-width.
TranslateOptions BatchTranslateOptions();

// The rated power beside a curve (rated_power_W, of the whole string) in W. Empty: missing or not a
// number.
std::optional<double> RatedPowerBeside(const BatchCurve& curve);

// A cell; unknown if the number is not finite or the text is empty.
ResultCell NumberCell(double value);
ResultCell TextCell(const std::string& text);
// Texts joined with `separator`.
ResultCell ListCell(const std::vector<std::string>& texts, const char* separator = " ");

}  // namespace lyrefit
