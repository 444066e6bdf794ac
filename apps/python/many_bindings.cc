#include <pybind11/stl.h>

#include <memory>
#include <utility>

#include "bindings.h"
#include "curves.h"
#include "docs.h"
#include "fit.h"
#include "fit_row.h"
#include "lyrefit/base/file.h"
#include "lyrefit/certify/floor.h"
#include "lyrefit/estimate/fit/fit_files.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/page.h"
#include "many_curves.h"
#include "work.h"

namespace lyrefit::python {
namespace {

constexpr char kFitManyDoc[] =
    "Fit many curves, each as fit() would, on all cores.\n\n"
    "A curve that cannot be read or fitted has a row that says why and keeps no other from its\n"
    "fit. Each fit is the same to the last bit as fit() gives with the same options, whatever the\n"
    "number of threads.\n\n"
    "Parameters\n----------\n"
    "curves : list, mapping, array_like, DataFrame or path\n"
    "    A list, or a mapping by id, of what fit() takes for one curve: pairs of arrays, Curves,\n"
    "    paths, frames. Or voltages in V of shape (m, n), a curve a row (or (n,) for all), with\n"
    "    `current`. Or a long DataFrame, a row a reading, see `group`. Or the path of a folder\n"
    "    tree or of a file with many curves.\n"
    "current : array_like of shape (m, n), optional\n"
    "    In A; NaN in either array pads shorter curves.\n"
    "group : str or list of str, optional\n"
    "    The column or columns of a long frame that name the curve of a row; 'curve', 'curve_id'\n"
    "    or 'id' where one of them is there. The columns v and i, or voltage and current, hold\n"
    "    the readings; cells_in_series, temperature_C and irradiance_Wm2 what they say, the mean\n"
    "    of a curve's rows.\n"
    "ids : sequence of str, optional\n"
    "    What to call the curves; else their names, paths or places from 0.\n"
    "cells_in_series, temperature_C, irradiance_Wm2 : scalar or array_like of shape (m,), "
    "optional\n"
    "    Of all curves, or of each; NaN where it is not known.\n"
    "model, bounds\n"
    "    As for fit().\n"
    "progress : callable, optional\n"
    "    Called at most ten times a second with a :class:`Progress` whose `iteration` counts\n"
    "    curves; returning False ends the work with the fits so far.\n";

constexpr char kFitManyEnd[] =
    "Returns\n-------\n"
    "FitResults\n"
    "    `frame()` has a row a curve; `results[i]` or `results['id']` is the FitResult of one.\n\n"
    "Raises\n------\n"
    "lyrefit.Error\n"
    "    Options outside their ranges, arrays whose shapes do not go together, a folder that is\n"
    "    not there. What is wrong with a single curve is in its row.\n\n"
    "Examples\n--------\n"
    ">>> results = lyrefit.fit_many(frame, group='string', cells_in_series=72)\n"
    ">>> table = results.frame()\n"
    ">>> table.loc[table.status != 'fine', ['id', 'reason']]\n";

constexpr char kFitResultsDoc[] =
    "The fits of many curves, in their order: a sequence of FitResult, also by id.\n\n"
    "Experimental: may change in a minor version.\n\n"
    "Asking for a curve that was not fitted raises the lyrefit.Error that its row tells.\n";

class FitResults {
 public:
  explicit FitResults(std::vector<FittedFile> fits)
      : fits_(std::make_shared<const std::vector<FittedFile>>(std::move(fits))) {}

  std::size_t size() const { return fits_->size(); }
  const std::vector<FittedFile>& fits() const { return *fits_; }

  FitResult At(std::size_t i) const {
    const Expected<FitReport>& report = (*fits_)[i].report;
    if (!report) Raise(report.error());
    return FitResult(std::shared_ptr<const FitReport>(fits_, &*report));
  }

  FitResult AtPlace(py::ssize_t place) const {
    const auto count = static_cast<py::ssize_t>(size());
    if (place < -count || place >= count) {
      throw py::index_error("there are " + std::to_string(count) + " curves");
    }
    return At(static_cast<std::size_t>(place < 0 ? place + count : place));
  }

  FitResult Named(const std::string& id) const {
    for (std::size_t i = 0; i < size(); ++i) {
      if ((*fits_)[i].file == id) return At(i);
    }
    throw py::key_error(id);
  }

  std::vector<FitRow> Rows() const {
    std::vector<FitRow> rows;
    for (const FittedFile& fit : *fits_) {
      rows.push_back(fit.report ? RowOf(fit.file, *fit.report)
                                : BrokenRow(fit.file, fit.report.error()));
    }
    return rows;
  }

  std::string Json() const { return FitsJson(*fits_, JsonPoints::kThinned); }
  std::string Csv() const { return FitsCsv(*fits_); }
  Document Page() const { return FitsDocument(*fits_); }

 private:
  std::shared_ptr<const std::vector<FittedFile>> fits_;  // the ids are the file names
};

Expected<FitReport> FitOneOf(const CurveToFit& curve, const FitKeywords& asked,
                             const Observer& observer) {
  const Expected<IvCurve> taken = curve.read();
  if (!taken) return tl::unexpected(taken.error());
  Expected<FitOptions> options = OptionsFor(asked, curve.file);
  if (!options) return tl::unexpected(options.error());
  options->threads = 1;
  return FitWithFloor(*taken, *options, asked.auto_model, observer);
}

FitResults FitMany(py::handle curves, py::handle current, const py::kwargs& given) {
  Keywords keywords("fit_many", given);
  const py::object progress = keywords.Take("progress").value_or(py::none());
  const FitKeywords asked = ReadFitKeywords(&keywords);
  if (!asked.faults.empty()) {
    Raise({"fit_many calls no functions of one's own: effects and searchers are for fit()", {}});
  }
  const std::vector<CurveToFit> taken = TakeManyCurves(curves, current, &keywords);
  keywords.Finish();
  std::vector<std::string> ids;
  for (const CurveToFit& curve : taken) ids.push_back(curve.id);
  return FitResults(Work(
      progress,
      [&](const Observer& observer) {
        return FitFiles(ids, asked.options.threads, observer, [&](int i, const Observer& watch) {
          return FitOneOf(taken[static_cast<std::size_t>(i)], asked, watch);
        });
      },
      asked.options.threads));
}

void SaveManyPage(const FitResults& results, py::handle file, bool interactive) {
  const std::string path = TextOf("file", file);
  Must(Unlocked([&] {
    PageOptions options;
    options.interactive = interactive;
    const std::string json = FitsJson(results.fits(), JsonPoints::kAll);
    return WriteTextFile(path, DrawPage(results.Page(), json, options));
  }));
}

std::string DescribeMany(const FitResults& results) {
  std::size_t fine = 0;
  for (const FittedFile& fit : results.fits()) fine += fit.report && fit.report->usable ? 1 : 0;
  return "<lyrefit.FitResults: " + std::to_string(results.size()) + " curves, " +
         std::to_string(fine) + " fine>";
}

std::vector<KeywordNote> FitManyNotes() {
  std::vector<KeywordNote> notes;
  AppendManyNotes(&notes);
  AppendFitNotes({}, &notes);
  AppendCurveNotes(&notes);
  return notes;
}

}  // namespace

void BindFitMany(py::module_* module) {
  py::class_<FitResults> type(*module, "FitResults", kFitResultsDoc);
  NeverChanges(&type, "frame() or json");
  type.def("__len__", &FitResults::size)
      .def("__getitem__", &FitResults::AtPlace)
      .def("__getitem__", &FitResults::Named)
      .def("__repr__", &DescribeMany)
      .def(
          "frame", [](const FitResults& r) { return FrameOf(r.Rows()); },
          "frame($self)\n--\n\n"
          "A pandas.DataFrame with a row a curve: id, status ('fine', 'not usable', 'broken'),\n"
          "reason, model, conditions, parameters under pvlib's names in SI units, each followed\n"
          "by its standard error (_se), nNsVth in V, i_sc, v_oc, i_mp, v_mp, p_mp and ff of the\n"
          "model, rmse_solved_current and rmse_measured_current in A, warnings.")
      .def_property_readonly("json", &FitResults::Json,
                             "str: what the command writes of several files under --json.")
      .def_property_readonly("csv", &FitResults::Csv, "str: the same under --csv.")
      .def_property_readonly(
          "text", [](const FitResults& r) { return DrawText(r.Page()); }, "str: the table.")
      .def("save_page", &SaveManyPage, py::arg("file"), py::arg("interactive") = true,
           "save_page($self, file, interactive=True)\n--\n\n"
           "Write all of it as a page to send (--html).")
      .def("_repr_html_", [](const FitResults& r) { return DrawHtml(r.Page()); });
  DefineVerb(module, {"fit_many", "curves, current=None", kFitManyDoc, kFitManyEnd, FitManyNotes()},
             &FitMany, py::arg("curves"), py::arg("current") = py::none());
}

}  // namespace lyrefit::python
