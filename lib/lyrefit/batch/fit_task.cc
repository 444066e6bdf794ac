#include "lyrefit/certify/floor.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "lyrefit/base/append.h"
#include "lyrefit/batch/column.h"
#include "lyrefit/model/device.h"
#include "lyrefit/model/device_effects.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json.h"

namespace lyrefit {
namespace {

// Parameters of the largest model that a row can have.
std::vector<ParameterInfo> FitParameters(const FitOptions& options, bool auto_model) {
  const Model largest = auto_model ? Model::kTripleDiode : options.model;
  std::vector<ParameterInfo> infos = MakeDevice(largest, {}).parameters;
  AddInfos(options.with, &infos);
  return infos;
}

// Standard error under the recommended error model.
double StandardError(const FitReport& report, const Estimate& of) {
  const auto k = static_cast<std::size_t>(&of - report.estimates.data());
  return k < report.under_errors.size() ? report.under_errors[k].standard_error : of.standard_error;
}

std::string ErrorsOf(const FitReport& report) {
  const bool told = std::any_of(report.estimates.begin(), report.estimates.end(),
                                [](const Estimate& e) { return std::isfinite(e.standard_error); });
  if (!told) return "";
  if (!report.errors || !report.errors->believed) return "independent";
  if (report.errors->stated) return "stated";
  return report.errors->Taken() == ErrorsTaken::kPath ? "correlated" : "unequal";
}

// The estimate of a parameter; empty: the model of the answer lacks it.
Estimate EstimateOf(const FitReport& report, const std::string& symbol) {
  for (const Estimate& one : report.estimates) {
    if (one.info.symbol != symbol) continue;
    Estimate found = one;
    found.standard_error = StandardError(report, one);
    return found;
  }
  return {};
}

ColumnList<FitReport> FitColumns(const std::vector<ParameterInfo>& parameters) {
  using Of = const FitReport&;
  ColumnList<FitReport> columns = {
      {"model", "", "number of diodes: sd, dd or td", [](Of of) { return ToText(of.model); }}};
  for (const ParameterInfo& info : parameters) {
    const std::string name = info.symbol + (info.unit.empty() ? "" : "_" + info.unit);
    columns.emplace_back(name, info.unit, info.doc, [symbol = info.symbol](Of of) {
      const Estimate estimate = EstimateOf(of, symbol);
      return of.polished ? estimate.refined : estimate.searched;
    });
    columns.emplace_back(
        name + "_se", info.unit,
        "standard error of " + info.symbol +
            " under what `errors` says; none where it is fixed or at a bound",
        [symbol = info.symbol](Of of) { return EstimateOf(of, symbol).standard_error; });
  }
  Append(
      {{"errors", "",
        "what the standard errors take the errors of the readings for. independent: of one size "
        "and knowing nothing of each other. unequal: knowing nothing of each other, noise of "
        "current and voltage. correlated: these and wandering light, as the residuals clearly say. "
        "stated: of the sizes that were stated",
        ErrorsOf},
       {"rmse_searched_solved_current_A", "A",
        "root mean square error of the search's best, by the solved current",
        [](Of of) { return of.rmse.searched.solved_current_A; }},
       {"rmse_refined_solved_current_A", "A",
        "root mean square error of the answer, by the solved current",
        [](Of of) { return of.polished ? of.rmse.refined.solved_current_A : kUnknown; }},
       {"rmse_refined_measured_current_A", "A", "the same by the measured current put into the law",
        [](Of of) { return of.polished ? of.rmse.refined.measured_current_A : kUnknown; }},
       {"warnings", "", "in plain words, with '; ' between them",
        [](Of of) { return ListCell(of.warnings, "; "); }}},
      &columns);
  return columns;
}

std::vector<OptionEcho> FitEcho(const FitOptions& options, bool auto_model) {
  std::vector<OptionEcho> echoes = {{"model", auto_model ? "auto" : ToText(options.model), ""}};
  AppendNonDefaults(options, kFitOptionTable, &echoes);
  return echoes;
}

}  // namespace

FitOptions BatchFitOptions() {
  FitOptions options;
  options.intervals = Intervals::kSymmetric;
  options.random_baseline = false;
  return options;
}

BatchTaskType FitTask(const FitOptions& asked, bool auto_model) {
  FitOptions options = asked;
  options.threads = 1;
  const ColumnList<FitReport> columns = FitColumns(FitParameters(options, auto_model));
  BatchTaskType task;
  task.name = "fit";
  task.columns = HeadsOf(columns);
  task.options = FitEcho(options, auto_model);
  task.run = [options, auto_model, columns](const BatchCurve& curve, std::uint64_t seed,
                                            const Observer& observer) {
    FitOptions own = options;
    own.search.seed = seed;
    Expected<FitReport> report = FitWithFloor(*curve.curve, own, auto_model, observer);
    if (!report) return TaskResult{RowStatus::kBroken, report.error().message, {}, false};
    // A page must not depend on the time used.
    report->search.seconds = report->refine.seconds = kUnknown;
    report->interval_seconds = report->plain_seconds = kUnknown;
    report->refine.best_candidate_seconds = kUnknown;
    TaskResult result{report->usable ? RowStatus::kFine : RowStatus::kNotUsable,
                      report->not_usable_because, CellsOf(columns, *report), report->interrupted};
    result.failed = !report->usable;
    result.page =
        [report = std::make_shared<const FitReport>(std::move(*report))](const PageOptions& page) {
          return DrawPage(FitDocument(*report), JsonReport(*report), page);
        };
    return result;
  };
  return task;
}

}  // namespace lyrefit
