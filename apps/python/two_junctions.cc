#include "two_junctions.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

#include "bindings.h"
#include "docs.h"
#include "errors.h"
#include "lyrefit/devices/device_documents.h"
#include "lyrefit/devices/fit_two_junctions.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json.h"
#include "lyrefit/report/plots.h"
#include "sets.h"
#include "work.h"

namespace lyrefit::python {
namespace {

using Tandem = std::shared_ptr<const TwoJunctionReport>;

// Keywords of a fit that two junctions do not have.
constexpr const char* kNotOfTwo[] = {"model",  "with_",      "objective", "bounds",
                                     "floor",  "noise",      "loss",      "starts",
                                     "polish", "loss_scale", "kernel",    "searcher"};

Record RecordOf(const Tandem& tandem) {
  Record record;
  record.json = [tandem](JsonPoints) { return TwoJunctionJson(*tandem); };
  record.text = [tandem](Length length) { return TwoJunctionText(*tandem, length); };
  record.brief = [tandem] { return BriefTwoJunctions(*tandem); };
  record.document = [tandem] { return TwoJunctionDocument(*tandem); };
  record.plot = [tandem](const std::string& file) { return PlotTwoJunctions(*tandem, file); };
  return record;
}

class TwoJunctionResult : public Result {
 public:
  explicit TwoJunctionResult(Tandem tandem)
      : Result(RecordOf(tandem)), tandem_(std::move(tandem)) {}
  const TwoJunctionReport& report() const { return *tandem_; }

 private:
  Tandem tandem_;
};

py::dict TandemParameters(const TwoJunctionResult& result) {
  py::dict parameters;
  for (const Estimate& estimate : result.report().estimates) {
    parameters[py::str(estimate.info.name)] = estimate.refined;
  }
  return parameters;
}

// The rows of the table that are keywords of two junctions alone; fit() has the others itself.
const std::vector<OptionRow<TwoJunctionOptions>>& OwnRows() {
  static const auto* const rows = [] {
    auto* own = new std::vector<OptionRow<TwoJunctionOptions>>();
    std::copy_if(std::begin(kTwoJunctionOptionTable), std::end(kTwoJunctionOptionTable),
                 std::back_inserter(*own), [](const OptionRow<TwoJunctionOptions>& row) {
                   return std::string(row.name).rfind("light", 0) == 0;
                 });
    return own;
  }();
  return *rows;
}

CurveSet TandemCurves(py::handle curves, py::handle current, const CurveKeywords& said) {
  std::vector<CurveSet> sets;
  const bool list = py::isinstance<py::list>(curves) || py::isinstance<py::tuple>(curves);
  if (current.is_none() && list && IsSeveral(curves)) {
    for (const py::handle member : curves) sets.push_back(SetOf(member, py::none(), said));
  } else {
    sets.push_back(SetOf(curves, current, said));
  }
  return Must(GatherCurves(std::move(sets)));
}

}  // namespace

JunctionKeywords ReadJunctionKeywords(Keywords* keywords) {
  JunctionKeywords asked;
  if (const auto count = keywords->Take("junctions")) {
    const std::int64_t junctions = WholeOf("junctions", *count);
    CheckRange("junctions", static_cast<double>(junctions), 1, 2);
    asked.junctions = static_cast<int>(junctions);
  }
  for (const char* const name : {"light", "light_accuracy"}) {
    if (asked.junctions != 1 || !keywords->Given(name)) continue;
    Raise({std::string(name) + " is about the junctions of a tandem: it needs junctions=2", {}});
  }
  for (const char* const name : kNotOfTwo) {
    if (asked.junctions == 2 && keywords->Given(name)) {
      Raise({std::string(name) + " is for one junction, not for junctions=2", {}});
    }
  }
  keywords->Read(OwnRows(), &asked.options);
  return asked;
}

void AppendJunctionNotes(std::vector<KeywordNote>* notes) {
  notes->push_back(
      {"junctions", "int", "1", "Two junctions",
       std::string("junctions in series; 2 is a tandem, fitted to all curves together; ") +
           kExperimentalNote});
  AppendNotes(OwnRows(), TwoJunctionOptions(), notes);
}

py::object FitTandem(py::handle curves, py::handle current, const CurveKeywords& said,
                     const FitKeywords& asked, const JunctionKeywords& junctions,
                     const py::object& progress) {
  const CurveSet set = TandemCurves(curves, current, said);
  const TwoJunctionOptions options = WithOptionsOf(asked.options, junctions.options);
  TwoJunctionReport report = Must(Work(
      progress, [&](const Observer& observer) { return FitTwoJunctions(set, options, observer); },
      options.threads));
  WarnUnlessUsable(report.usable, report.not_usable_because);
  return py::cast(TwoJunctionResult(std::make_shared<const TwoJunctionReport>(std::move(report))));
}

void BindTwoJunctions(py::module_* module) {
  py::class_<TwoJunctionResult, Result>(
      *module, "TwoJunctionResult",
      "What fit() with junctions=2 found. Experimental: may change in a minor version.")
      .def_property_readonly("parameters", &TandemParameters,
                             "dict of str to float: the answer, under the names of the JSON.")
      .def_property_readonly(
          "usable", [](const TwoJunctionResult& result) { return result.report().usable; }, "bool");
}

}  // namespace lyrefit::python
