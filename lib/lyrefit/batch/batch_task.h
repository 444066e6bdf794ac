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
#include "lyrefit/diagnose/diagnose_options.h"
#include "lyrefit/fit/fit_options.h"
#include "lyrefit/batch/batch_source.h"
#include "lyrefit/batch/result_row.h"
#include "lyrefit/report/page.h"
#include "lyrefit/translate/translate_options.h"

namespace LYREFIT_PUBLIC lyrefit {

// What a row says of its curve.
enum class RowStatus {
  kFine,
  kDoubtful,   // there is an answer, but of readings that no device has: see PlausibilityProblem
  kNotUsable,  // there is an answer, but nobody should work with it
  kBroken,     // there is none: the curve could not be read, or not be worked with
};

template <>
struct EnumTable<RowStatus> {
  static constexpr EnumText<RowStatus> kRows[] = {{RowStatus::kFine, "fine"},
                                                  {RowStatus::kDoubtful, "doubtful"},
                                                  {RowStatus::kNotUsable, "not usable"},
                                                  {RowStatus::kBroken, "broken"}};
};

// What a task found out about one curve.
struct TaskResult {
  RowStatus status = RowStatus::kFine;
  std::string reason;             // why it is not fine, in one sentence
  std::vector<ResultCell> cells;  // one for each of the task's columns; empty where it is broken
  bool interrupted = false;       // the observer stopped it: to be thrown away
  bool failed = false;            // somebody has to look at this curve
  // Its page, the same bytes for the same curve and seed; empty: there is none.
  std::function<std::string(const PageOptions& options)> page = {};
};

// What is done with each of many curves, as data: another task is another of these.
struct BatchTaskType {
  std::string name;                   // "fit"
  std::vector<ResultColumn> columns;  // its own, behind those that every row has (ResultColumns)
  std::vector<OptionEcho> options;    // whatever its cells depend on; threads do not count
  // From any thread, on one thread, with the seed of this curve. `curve.curve` holds one. The same
  // curve and seed give the same cells, so no times are measured.
  std::function<TaskResult(const BatchCurve& curve, std::uint64_t seed, const Observer& observer)>
      run;
};

// What `fit` says of a curve; `auto_model`: one to three diodes, as the data decide (FitAuto).
// Searches are small and intervals symmetric unless the options say otherwise: see BatchFitOptions.
BatchTaskType FitTask(const FitOptions& asked, bool auto_model = false);

// What `diagnose` says of a curve. The gain is not measured on held-out readings: no column has it.
BatchTaskType DiagnoseTask(const DiagnoseOptions& asked);

// What `translate` says of a curve at standard conditions: power with its uncertainty, zone,
// checklist. A rating that stands beside a curve (rated_power_W, of the whole string) counts where
// the options state none.
BatchTaskType FieldTestTask(const TranslateOptions& asked);

// The usual options of a fit among many: symmetric intervals, and no random points beside the
// search, whose figure has no column.
FitOptions BatchFitOptions();

// The usual options of a field test among many: 1,000 draws, which tell a wrong decision's
// probability to 1.6 % or better and the ends of an interval to a twelfth of its half width.
TranslateOptions BatchTranslateOptions();

// The rated power that stands beside a curve (rated_power_W, of the whole string), in W; none: there
// is none, or it is no number.
std::optional<double> RatedPowerBeside(const BatchCurve& curve);

// What the causes of a verdict are about, by the catalogue (Effect::where): "device", "sweep",
// "instrument", "conditions", "unknown". Empty: there is no such cause.
std::string AboutOf(const std::string& cause);

// For cells that may not be known: nothing where the number is not finite, or the text empty.
ResultCell NumberCell(double value);
ResultCell TextCell(const std::string& text);
// Texts as one, with `separator` between them.
ResultCell ListCell(const std::vector<std::string>& texts, const char* separator = " ");

}  // namespace lyrefit
