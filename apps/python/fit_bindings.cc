#include <pybind11/stl.h>

#include "bindings.h"
#include "curves.h"
#include "docs.h"
#include "effects.h"
#include "errors.h"
#include "fit.h"
#include "fit_row.h"
#include "lyrefit/certify/floor.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/plots.h"
#include "lyrefit/settings/bounds_file.h"
#include "searcher.h"
#include "two_junctions.h"
#include "work.h"

namespace lyrefit::python {
namespace {

Record RecordOf(const std::shared_ptr<const FitReport>& report) {
  Record record;
  record.json = [report](JsonPoints points) { return JsonReport(*report, points); };
  record.text = [report](Length length) {
    return length == Length::kWhole ? FullReport(*report) : ShortReport(*report);
  };
  record.brief = [report] { return BriefReport(*report); };
  record.document = [report] { return FitDocument(*report); };
  record.csv = [report] { return FitsCsv({{report->curve.source, *report}}); };
  record.plot = [report](const std::string& file) { return PlotFit(*report, file); };
  return record;
}

void ReadModel(py::handle value, FitKeywords* asked) {
  const std::string text = TextOf("model", value);
  const std::optional<Model> model = FromText<Model>(text);
  asked->auto_model = text == "auto";
  if (!model && !asked->auto_model) {
    Raise({"model: expected one of " + AllTexts<Model>() + ", auto, found '" + text + "'", {}});
  }
  asked->options.model = model.value_or(Model::kSingleDiode);
}

// Reads {"Iph": (0, 2), ...}: a range for each parameter, as in a bounds file.
void ReadBox(py::handle value, FitKeywords* asked) {
  for (const std::string& text : TextsOf("bounds", value)) {
    const auto range = ReadRange(text);
    if (!range) Raise({"bounds: " + range.error().ToString(), {}});
    asked->options.bounds.table[range->first] = range->second;
  }
  asked->options.bounds.name = "given";
  asked->box = true;
}

void ReadSearcher(const py::object& searcher, FitKeywords* asked) {
  if (PyCallable_Check(searcher.ptr()) == 0) {
    Raise({"searcher: expected a function search(objective, lower, upper, options)", {}});
  }
  auto fault = std::make_shared<Fault>();
  asked->options.searcher = SearcherOf(searcher, fault);
  asked->faults.Add(std::move(fault));
}

py::object FitOne(py::handle curve, py::handle current, const py::kwargs& given) {
  Keywords keywords("fit", given);
  const py::object progress = keywords.Take("progress").value_or(py::none());
  const CurveKeywords said = ReadCurveKeywords(&keywords);
  const JunctionKeywords junctions = ReadJunctionKeywords(&keywords);
  const FitKeywords asked = ReadFitKeywords(&keywords);
  keywords.Finish();
  if (junctions.junctions == 2) {
    return FitTandem(curve, current, said, asked, junctions, progress);
  }
  const IvCurve taken = CurveOf(curve, current, said);
  const std::string file =
      IsPath(curve) && current.is_none() ? TextOf("curve", curve) : taken.source;
  const FitOptions options = Must(OptionsFor(asked, file));
  const bool auto_model = asked.auto_model;
  FitReport report = Must(WorkWith(
      asked.faults, progress,
      [&](const Observer& observer) { return FitWithFloor(taken, options, auto_model, observer); },
      options.threads));
  WarnUnlessUsable(report.usable, report.not_usable_because);
  WarnOfDoubts(report.doubts);
  return py::cast(FitResult(HoldWith(std::move(report), asked.own)));
}

py::dict ParametersOf(const FitResult& result) {
  py::dict parameters;
  const FitReport& report = result.report();
  for (const Estimate& estimate : report.estimates) {
    const std::string& name =
        estimate.info.name.empty() ? estimate.info.symbol : estimate.info.name;
    parameters[py::str(name)] = report.polished ? estimate.refined : estimate.searched;
  }
  return parameters;
}

constexpr char kFitDoc[] =
    "Fit diode-model parameters to a measured I-V curve.\n\n"
    "A global search within bounds, then bounded least squares from its best candidates and from "
    "a\n"
    "grid, then what is known and how well: intervals, identifiability, residuals. The same seed\n"
    "gives the same bits on any number of threads.\n\n"
    "Parameters\n----------\n"
    "curve : array_like of shape (n,), Curve, path, mapping or DataFrame\n"
    "    Voltages in V; or, without `current`, a Curve, the path or text of a file, a table with\n"
    "    the columns v and i, or an array of shape (2, n) or (n, 2). With junctions=2 also a list\n"
    "    of these, or a mapping by id: one device under several lights of its junctions.\n"
    "current : array_like of shape (n,), optional\n"
    "    In A, positive where the device delivers.\n"
    "model : {'sd', 'dd', 'td', 'auto'}, default 'sd'\n"
    "    One, two or three diodes; 'auto' lets the data decide.\n"
    "bounds : str, path or mapping, default 'physical'\n"
    "    The box that is searched: 'physical' (derived from the curve), 'wide', 'paper' or\n"
    "    'literature' (published beside the curve's file), a JSON file, or a range for every\n"
    "    parameter, {'Iph': (0, 2), ...}. Single ranges are replaced by `bound`.\n"
    "searcher : callable, optional\n"
    "    A search of your own, called as compare() calls one; the polish goes on from its "
    "candidates.\n"
    "progress : callable, optional\n"
    "    Called at most ten times a second with a :class:`Progress`; returning False ends the fit\n"
    "    with what was found so far.\n";

constexpr char kFitEnd[] =
    "Returns\n-------\n"
    "FitResult\n"
    "    A mapping with the keys of the command's JSON; `parameters` has the answer under pvlib's\n"
    "    names, `frame()` a row, `text` the report.\n"
    "TwoJunctionResult\n"
    "    The same of a tandem (junctions=2), without `frame()`; experimental.\n\n"
    "Raises\n------\n"
    "lyrefit.Error\n"
    "    An unusable curve, options outside their ranges, impossible bounds, fewer points than\n"
    "    free parameters; a file that cannot be read, with line and column.\n"
    "KeyboardInterrupt\n"
    "    Within a second of Ctrl-C.\n\n"
    "Warns\n------\n"
    "UserWarning\n"
    "    The fit is not usable, and why; all that is to be known is in result['warnings'].\n\n"
    "Examples\n--------\n"
    ">>> result = lyrefit.fit(voltage, current, cells_in_series=60, temperature_C=45)\n"
    ">>> result.parameters['resistance_series']\n"
    ">>> result['rmse']['refined']['solved_current_A']\n"
    ">>> lyrefit.fit('module.csv', model='dd', fix={'n2': 2}, bound={'Rs': (0, 0.5)})\n"
    ">>> lyrefit.fit(['white.csv', 'red.csv'], junctions=2, light={'red': '1:0.8'})\n";

// Keywords of fit in the order of its documentation.
std::vector<KeywordNote> FitNotes() {
  std::vector<KeywordNote> notes;
  AppendNotes(kConditionOptionTable, ConditionOptions(), &notes);
  AppendFitNotes({}, &notes);
  AppendJunctionNotes(&notes);
  AppendNotes(kReadOptionTable, ReadOptions(), &notes);
  notes.push_back({"name", "str", "None", "Reading", "of the curve, in reports"});
  return notes;
}

}  // namespace

FitResult::FitResult(std::shared_ptr<const FitReport> report)
    : Result(RecordOf(report)), report_(std::move(report)) {}

FitKeywords ReadFitKeywords(Keywords* keywords, const FitOptions& usual) {
  FitKeywords asked;
  asked.options = usual;
  if (const auto model = keywords->Take("model")) ReadModel(*model, &asked);
  if (const auto with = keywords->Take("with_")) {
    EffectsAsked effects = EffectsOf(*with);
    asked.options.with = std::move(effects.uses);
    asked.own = std::move(effects.own);
  }
  if (const auto bounds = keywords->Take("bounds")) {
    if (py::isinstance<py::dict>(*bounds)) {
      ReadBox(*bounds, &asked);
    } else {
      asked.bounds = TextOf("bounds", *bounds);
    }
  }
  asked.faults = FaultsOf(asked.own);
  if (const auto searcher = keywords->Take("searcher")) ReadSearcher(*searcher, &asked);
  keywords->Read(kFitOptionTable, &asked.options);
  keywords->Read(kSearchOptionTable, &asked.options.search);
  if (!asked.faults.empty()) asked.options.threads = 1;
  if (asked.options.with.empty()) return asked;
  const SearchOptions beside = FitOptions::SearchBesideShapes();
  if (!keywords->Given("population")) asked.options.search.population = beside.population;
  if (!keywords->Given("iterations")) asked.options.search.iterations = beside.iterations;
  if (asked.auto_model) {
    Raise({"model 'auto' chooses among diodes alone: say which model stands beside with_", {}});
  }
  return asked;
}

Expected<FitOptions> OptionsFor(const FitKeywords& asked, const std::string& file) {
  FitOptions options = asked.options;
  if (asked.box || asked.bounds == "physical") return options;
  Expected<BoundsSpec> named = NamedBounds(asked.bounds, file);
  if (!named) return tl::unexpected(named.error());
  named->overrides = options.bounds.overrides;
  options.bounds = *std::move(named);
  return options;
}

void AppendFitNotes(const FitOptions& usual, std::vector<KeywordNote>* notes) {
  notes->push_back({"model", "str", "'sd'", "Model", ""});
  notes->push_back({"bounds", "str | PathLike[str] | Mapping[str, tuple[float, float]]",
                    "'physical'", "Model", ""});
  notes->push_back({"searcher", "SearchLike", "None", "Search", ""});
  notes->push_back({"progress", "Callable[[Progress], object]", "None", "", ""});
  AppendNotes(kFitOptionTable, usual, notes);
  AppendNotes(kSearchOptionTable, usual.search, notes);
}

void BindFit(py::module_* module) {
  BindTwoJunctions(module);
  py::class_<FitResult, Result>(*module, "FitResult", "What fit() found.")
      .def_property_readonly("parameters", &ParametersOf,
                             "dict of str to float: the answer under pvlib's names.")
      .def(
          "frame",
          [](const FitResult& r) { return FrameOf({RowOf(r.report().curve.name, r.report())}); },
          "frame($self)\n--\n\nThe fit as a pandas.DataFrame of one row, as fit_many has them.")
      .def_property_readonly(
          "model_current", [](const FitResult& r) { return ArrayOf(r.report().model_current_A); },
          "numpy.ndarray of shape (n,): current of the model at the measured voltages, A.")
      .def_property_readonly(
          "residual", [](const FitResult& r) { return ArrayOf(r.report().residual_A); },
          "numpy.ndarray of shape (n,): model less measured current, A.")
      .def_property_readonly(
          "curve", [](const FitResult& r) { return std::make_shared<IvCurve>(r.report().curve); },
          "Curve: what was fitted.")
      .def_property_readonly(
          "usable", [](const FitResult& result) { return result.report().usable; }, "bool");
  DefineVerb(module, {"fit", "curve, current=None", kFitDoc, kFitEnd, FitNotes(), true}, &FitOne,
             py::arg("curve"), py::arg("current") = py::none());
}

}  // namespace lyrefit::python
