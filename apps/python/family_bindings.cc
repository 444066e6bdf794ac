#include <algorithm>
#include <iterator>
#include <memory>

#include "bindings.h"
#include "docs.h"
#include "effects.h"
#include "errors.h"
#include "frames.h"
#include "lyrefit/family/family_documents.h"
#include "lyrefit/family/fit_family.h"
#include "lyrefit/family/fit_individually.h"
#include "lyrefit/model/pvlib_parameters.h"
#include "lyrefit/read/read_module.h"
#include "lyrefit/read/write_pan.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/plots.h"
#include "pvlib_dict.h"
#include "result.h"
#include "sets.h"
#include "work.h"

namespace lyrefit::python {
namespace {

struct FittedFamily {
  FamilyReport report;
  CurveSet set;
};
using Family = std::shared_ptr<const FittedFamily>;

Record RecordOf(const Family& family) {
  Record record;
  record.json = [family](JsonPoints) { return FamilyJson(family->report); };
  record.text = [family](Length length) { return FamilyText(family->report, length); };
  record.brief = [family] { return BriefFamily(family->report); };
  record.document = [family] { return FamilyDocument(family->report, family->set); };
  record.csv = [family] { return IndividualFitsCsv(family->report); };
  record.plot = [family](const std::string& file) {
    return PlotFamily(family->report, family->set, file);
  };
  return record;
}

class FamilyResult : public Result {
 public:
  explicit FamilyResult(Family family) : Result(RecordOf(family)), family_(std::move(family)) {}
  const FamilyReport& report() const { return family_->report; }
  const CurveSet& set() const { return family_->set; }

 private:
  Family family_;
};

struct FamilyAsked {
  std::string family = "desoto";  // or pvsyst, cec, free, auto
  FamilyOptions options;
  OwnEffects own;
};

// Keywords about shared parameters, which individual fits do not have, and those that auto selects.
constexpr const char* kShared[] = {"residuals",
                                   "key_point_errors",
                                   "shunt",
                                   "recombination",
                                   "weights",
                                   "search_curves",
                                   "fit_curves",
                                   "irradiance_offset",
                                   "folds",
                                   "temperature_offset",
                                   "irradiance_accuracy",
                                   "free",
                                   "temperature_accuracy",
                                   "individual_fits",
                                   "against"};
constexpr const char* kChosenByAuto[] = {"model", "shunt", "recombination"};

template <class Names>
void Refuse(const Keywords& keywords, const Names& names, const char* why) {
  for (const char* const name : names) {
    if (keywords.Given(name)) Raise({std::string(name) + " " + why, {}});
  }
}

void SettleFamily(Keywords* keywords, FamilyAsked* asked) {
  if (const auto family = keywords->Take("family")) asked->family = TextOf("family", *family);
  const std::string& name = asked->family;
  if (name == "pvsyst") {
    asked->options.law = TranslationLaw::kPvsyst;
  } else if (name == "cec") {
    asked->options.law = TranslationLaw::kCec;
  } else if (name == "free") {
    asked->options.search = SearchOptions();
    Refuse(*keywords, kShared,
           "is about what curves share: family 'free' fits every curve on its own");
  } else if (name == "auto") {
    Refuse(*keywords, kChosenByAuto,
           "is what family 'auto' chooses: it is for 'desoto', 'pvsyst' and 'cec'");
  } else if (name != "desoto") {
    Raise({"family: expected one of desoto, pvsyst, cec, free, auto, found '" + name + "'", {}});
  }
}

// Reads those options of a fit of one curve that a set has too.
void ReadNoise(Keywords* keywords, FamilyAsked* asked) {
  static const auto* const table = [] {
    auto* rows = new std::vector<OptionRow<FitOptions>>();
    std::copy_if(std::begin(kFitOptionTable), std::end(kFitOptionTable), std::back_inserter(*rows),
                 [](const OptionRow<FitOptions>& row) { return row.name == std::string("noise"); });
    return rows;
  }();
  FitOptions fit;
  keywords->Read(*table, &fit);
  if (asked->family != "free" && fit.errors.kind != ErrorKind::kWhite) {
    Raise(
        {"noise: a joint fit weighs by weights alone; its intervals take the errors of the "
         "readings and of whole curves into account by themselves",
         {}});
  }
  asked->options.errors = fit.errors;
}

FamilyAsked ReadFamilyKeywords(Keywords* keywords) {
  FamilyAsked asked;
  FamilyOptions& options = asked.options;
  SettleFamily(keywords, &asked);
  if (const auto with = keywords->Take("with_")) {
    EffectsAsked effects = EffectsOf(*with);
    options.with = std::move(effects.uses);
    asked.own = std::move(effects.own);
    if (asked.family == "free") {
      options.search.population = FitOptions::SearchBesideShapes().population;
      options.search.iterations = FitOptions::SearchBesideShapes().iterations;
    }
  }
  if (const auto files = keywords->Take("against")) {
    for (const std::string& file : TextsOf("against", *files)) {
      options.against.push_back(Must(ReadModuleParameters(file)));
    }
  }
  keywords->Read(kFamilyOptionTable, &options);
  keywords->Read(kSearchOptionTable, &options.search);
  ReadNoise(keywords, &asked);
  if (!asked.own.empty()) options.threads = 1;
  return asked;
}

Expected<FamilyReport> FitAsked(const CurveSet& set, const FamilyAsked& asked,
                                const Observer& observer) {
  if (asked.family == "free") return FitIndividually(set, asked.options, observer);
  if (asked.family == "auto") return FitFamilyAuto(set, asked.options, observer);
  return FitFamily(set, asked.options, observer);
}

FamilyResult FitOneFamily(py::handle curves, const py::kwargs& given) {
  Keywords keywords("fit_family", given);
  const py::object progress = keywords.Take("progress").value_or(py::none());
  const FamilyAsked asked = ReadFamilyKeywords(&keywords);
  const CurveKeywords said = ReadCurveKeywords(&keywords);
  keywords.Finish();
  CurveSet set = SetOf(curves, py::none(), said);
  FamilyReport report = Must(WorkWith(FaultsOf(asked.own), progress, [&](const Observer& observer) {
    return FitAsked(set, asked, observer);
  }));
  WarnUnlessUsable(report.usable, {});
  WarnOfDoubts(report.doubts);
  return FamilyResult(HoldWith(FittedFamily{std::move(report), std::move(set)}, asked.own));
}

// Rows of "photocurrent": {...} and so on, one for each parameter.
py::object ParameterFrame(const FamilyResult& result) {
  py::list rows;
  for (const auto& [name, estimate] :
       py::reinterpret_borrow<py::dict>(result.Dictionary()["parameters"])) {
    py::dict row;
    row["parameter"] = name;
    row.attr("update")(estimate);
    rows.append(row);
  }
  return FrameOfRows(rows);
}

py::dict SharedOf(const FamilyResult& result) {
  py::dict parameters;
  for (const auto& [name, estimate] :
       py::reinterpret_borrow<py::dict>(result.Dictionary()["parameters"])) {
    const py::object refined = estimate["refined"];
    parameters[name] = refined.is_none() ? py::object(estimate["searched"]) : refined;
  }
  return parameters;
}

py::object PvlibOf(const FamilyResult& result) {
  const FamilyReport& report = result.report();
  return PvlibDict(report.name, report.translation, report.refined,
                   result.set().curves.front().notes.technology);
}

std::string PanOf(const FamilyResult& result) {
  const FamilyReport& report = result.report();
  return Must(PanText(report.translation, report.refined,
                      NotesOf(report.name, result.set().curves.front().notes)));
}

constexpr char kFitFamilyDoc[] =
    "Fit one device to curves under different irradiance and temperature.\n\n"
    "Parameters\n----------\n"
    "curves : path, DataFrame, list or dict\n"
    "    A folder or table as the command reads it; a long frame with a row a reading and the\n"
    "    columns curve, voltage (V), current (A), irradiance (W/m2) and temperature (C); a list "
    "of\n"
    "    Curve, frames or (voltage, current) pairs; or a dict from ids to such.\n"
    "family : {'desoto', 'pvsyst', 'auto', 'free'}\n"
    "    The law that all curves share; 'auto' the one that errs least on curves it did not see;\n"
    "    'free' fits every curve on its own.\n"
    "progress : callable, optional\n"
    "    Called with a :class:`Progress` ten times a second; False ends the work.\n";

constexpr char kFitFamilyEnd[] =
    "Returns\n-------\n"
    "FamilyResult\n\n"
    "Raises\n------\n"
    "lyrefit.Error\n"
    "    Fewer than two light curves, a broken file, options outside their ranges.\n\n"
    "Warns\n------\n"
    "UserWarning\n"
    "    The fit is not usable; why is in result['warnings'].\n";

std::vector<KeywordNote> FamilyNotes() {
  std::vector<KeywordNote> notes;
  notes.push_back({"progress", "Callable[[Progress], object]", "None", "", ""});
  AppendNotes(kFamilyOptionTable, FamilyOptions(), &notes);
  AppendNotes(kSearchOptionTable, FamilyOptions::FamilySearch(), &notes);
  notes.push_back({"against", "PathLike[str] | str | Sequence[str]", "None", "Family",
                   "parameters from elsewhere, tested on the same curves"});
  AppendCurveNotes(&notes);
  return EachOnce(notes);
}

}  // namespace

void BindFamily(py::module_* module) {
  py::class_<FamilyResult, Result>(*module, "FamilyResult", "What fit_family() found.")
      .def_property_readonly(
          "parameters", &SharedOf,
          "dict of str to float: the shared parameters at 1000 W/m2 and 25 C, pvlib's names.")
      .def_property_readonly(
          "pvlib", &PvlibOf,
          "dict: which function of pvlib takes the device, its keywords under 'parameters', and\n"
          "its row of SAM's library (--pvlib). lyrefit.Error where pvlib cannot take it.")
      .def_property_readonly(
          "pan", &PanOf,
          "str: the electrical model as a PVsyst .PAN file (--pan). lyrefit.Error for another law\n"
          "than 'pvsyst', and where EgRef is not fixed to the band gap of the technology.")
      .def_property_readonly(
          "usable", [](const FamilyResult& result) { return result.report().usable; }, "bool")
      .def(
          "frame",
          [](const FamilyResult& result) { return FrameOfRows(result.Dictionary()["curves"]); },
          "frame($self)\n--\n\nA pandas.DataFrame with a row a curve: id, conditions, RMSEs (A).")
      .def("parameter_frame", &ParameterFrame,
           "parameter_frame($self)\n--\n\n"
           "A pandas.DataFrame with a row a shared parameter: value, standard error, interval.")
      .def(
          "fit_frame", [](const FamilyResult& result) { return FrameOfCsv(result.record().csv()); },
          "fit_frame($self)\n--\n\n"
          "A pandas.DataFrame with the parameters of each curve's own fit, a row a curve (--csv).");
  DefineVerb(module, {"fit_family", "curves", kFitFamilyDoc, kFitFamilyEnd, FamilyNotes(), true},
             &FitOneFamily, py::arg("curves"));
}

}  // namespace lyrefit::python
