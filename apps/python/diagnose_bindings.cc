#include <memory>

#include "bindings.h"
#include "docs.h"
#include "effects.h"
#include "fit.h"
#include "frames.h"
#include "lyrefit/diagnose/diagnose.h"
#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/diagnose/reference.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/plots.h"
#include "lyrefit/simulate/text_readers.h"
#include "sets.h"
#include "work.h"

namespace lyrefit::python {
namespace {

// A diagnosis and, if reference sweeps were given, the comparison with them.
struct Diagnosed {
  Diagnosis diagnosis;
  std::optional<ReferenceComparison> reference;
};
using Found = std::shared_ptr<const Diagnosed>;

Record RecordOf(const Found& found) {
  Record record;
  record.json = [found](JsonPoints) {
    return found->reference ? ReferenceJson(*found->reference, found->diagnosis)
                            : DiagnosisJson(found->diagnosis);
  };
  record.text = [found](Length length) {
    const std::string own = DiagnosisText(found->diagnosis, length);
    return found->reference ? ReferenceText(*found->reference) + "\n" + own : own;
  };
  record.brief = [found] {
    const std::string own = BriefDiagnosis(found->diagnosis);
    return found->reference ? BriefReference(*found->reference) + own : own;
  };
  record.document = [found] {
    return found->reference ? ReferenceDocument(*found->reference, found->diagnosis)
                            : DiagnosisDocument(found->diagnosis);
  };
  record.csv = [found] {
    const std::string& name = found->reference ? found->reference->name : found->diagnosis.name;
    return CausesCsv({name}, {found->diagnosis});
  };
  record.plot = [found](const std::string& file) { return PlotDiagnosis(found->diagnosis, file); };
  return record;
}

struct DiagnoseAsked {
  DiagnoseOptions options;
  ReferenceOptions reference;
  OwnEffects own;
  py::object progress = py::none();
};

class DiagnoseResult : public Result {
 public:
  DiagnoseResult(Found found, const DiagnoseAsked& asked)
      : Result(RecordOf(found)),
        found_(std::move(found)),
        own_(asked.own),
        extended_(asked.options.extend) {}
  const Diagnosis& diagnosis() const { return found_->diagnosis; }
  py::dict Said() const {
    const py::dict& all = Dictionary();
    return found_->reference ? py::dict(all["diagnosis"]) : all;
  }
  std::optional<FitResult> Extended() const {
    if (!extended_) return std::nullopt;
    return FitResult(HoldWith(FitReport(diagnosis().extended), own_));
  }

 private:
  Found found_;
  OwnEffects own_;
  bool extended_;  // whether the extended fit was requested
};

class OutlierSweepsResult : public Result {
 public:
  explicit OutlierSweepsResult(const std::shared_ptr<const OutlierSweeps>& outliers)
      : Result(RecordOf(outliers)) {}

 private:
  static Record RecordOf(const std::shared_ptr<const OutlierSweeps>& outliers) {
    Record record;
    record.json = [outliers](JsonPoints) { return OutlierSweepsJson(*outliers); };
    record.text = [outliers](Length) { return OutlierSweepsText(*outliers); };
    record.brief = [outliers] { return BriefOutlierSweeps(*outliers); };
    record.document = [outliers] { return OutlierSweepsDocument(*outliers); };
    record.csv = [outliers] { return OutlierSweepsCsv(*outliers); };
    return record;
  }
};

// Custom effects in "effects" are tried in addition to the other effects of the list.
void ReadEffects(py::handle value, DiagnoseAsked* asked) {
  const bool list = py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value);
  py::list members;
  if (list) {
    members = py::list(py::reinterpret_borrow<py::object>(value));
  } else {
    members.append(value);
  }
  for (const py::handle member : members) {
    if (py::isinstance<OwnEffect>(member)) {
      for (auto& own : OwnEffectsOf("effects", member)) {
        asked->options.effects.push_back(own->effect().id);
        asked->own.push_back(std::move(own));
      }
      continue;
    }
    DiagnoseOptions named;
    const Expected<void> read = ReadEffectIds(TextOf("effects", member), &named, AllTextReaders());
    if (!read) Raise({"effects: " + read.error().ToString(), {}});
    for (const std::string& id : named.effects) asked->options.effects.push_back(id);
  }
}

DiagnoseAsked ReadDiagnoseKeywords(Keywords* keywords) {
  DiagnoseAsked asked;
  asked.progress = keywords->Take("progress").value_or(py::none());
  if (const auto own = keywords->Take("own_effects")) asked.own = OwnEffectsOf("own_effects", *own);
  if (const auto effects = keywords->Take("effects")) ReadEffects(*effects, &asked);
  keywords->Read(kDiagnoseOptionTable, &asked.options);
  keywords->Read(kReferenceOptionTable, &asked.reference);
  for (const auto& own : asked.own) asked.options.own_effects.push_back(&own->effect());
  if (!asked.own.empty()) asked.options.threads = 1;
  asked.reference.threads = asked.options.threads;
  return asked;
}

Diagnosis DiagnoseSet(const CurveSet& set, const DiagnoseAsked& asked, const std::string& file) {
  Expected<Diagnosis> diagnosis =
      WorkWith(FaultsOf(asked.own), asked.progress,
               [&](const Observer& observer) { return Diagnose(set, asked.options, observer); });
  if (!diagnosis && diagnosis.error().file.empty()) diagnosis.error().file = file;
  return Must(std::move(diagnosis));
}

py::object Give(Diagnosed diagnosed, const DiagnoseAsked& asked) {
  WarnOfDoubts(diagnosed.diagnosis.doubts);
  return py::cast(DiagnoseResult(HoldWith(std::move(diagnosed), asked.own), asked));
}

py::object DiagnoseAgainst(py::handle curves, py::handle current, py::handle reference,
                           const CurveKeywords& said, const DiagnoseAsked& asked) {
  const CurveSet sweep = SetOf(curves, current, said);
  if (sweep.curves.size() != 1) {
    Raise({"healthy compares one sweep, this measurement has " +
               std::to_string(sweep.curves.size()) + " curves",
           sweep.source});
  }
  CurveKeywords module = said;  // without the conditions and the name of this sweep
  module.told.irradiance_W_m2.reset();
  module.told.temperature_C.reset();
  module.name.clear();
  const std::vector<IvCurve> others = SweepsOf(reference, module);
  ReferenceComparison comparison = Must(Work(asked.progress, [&](const Observer&) {
    return CompareWithReferences(sweep.curves.front(), others, asked.reference);
  }));
  Diagnosis diagnosis = DiagnoseSet(SetOfOne(comparison.without_common), asked, "");
  return Give({std::move(diagnosis), std::move(comparison)}, asked);
}

py::object DiagnoseModule(py::handle curves, const CurveKeywords& said,
                          const DiagnoseAsked& asked) {
  const std::vector<IvCurve> sweeps = SweepsOf(curves, said);
  OutlierSweeps outliers = Must(Work(
      asked.progress, [&](const Observer&) { return FindOutlierSweeps(sweeps, asked.reference); }));
  return py::cast(OutlierSweepsResult(std::make_shared<const OutlierSweeps>(std::move(outliers))));
}

py::object DiagnoseOne(py::handle curves, py::handle current, const py::kwargs& given) {
  Keywords keywords("diagnose", given);
  const py::object reference = keywords.Take("reference").value_or(py::none());
  const auto module = keywords.Take("module");
  const DiagnoseAsked asked = ReadDiagnoseKeywords(&keywords);
  CurveKeywords said = ReadCurveKeywords(&keywords);
  said.reading.keep_limited = true;  // a limit of the instrument is a finding
  keywords.Finish();
  const bool of_module = module && TruthOf("module", *module);
  if (of_module && !reference.is_none()) Raise({"only one of healthy and module", {}});
  if (of_module) return DiagnoseModule(curves, said, asked);
  if (!reference.is_none()) return DiagnoseAgainst(curves, current, reference, said, asked);
  const bool file = IsPath(curves) && current.is_none();
  const CurveSet set = SetOf(curves, current, said);
  return Give({DiagnoseSet(set, asked, file ? TextOf("curve", curves) : ""), std::nullopt}, asked);
}

py::object CandidateFrame(const DiagnoseResult& result) {
  return FrameOfRows(result.Said()["trials"]).attr("drop")(py::arg("columns") = "parameters");
}

py::list CausesOf(const DiagnoseResult& result) {
  py::list ids;
  for (const py::handle cause : result.Said()["verdict"]["causes"]) ids.append(cause["id"]);
  return ids;
}

constexpr char kDiagnoseDoc[] =
    "Say what a diode model gets wrong in a measurement, and why.\n\n"
    "Parameters\n----------\n"
    "curve : array_like of shape (n,), path, Curve, DataFrame, list or dict\n"
    "    Voltage in V, or the measurement: one sweep, up and down sweeps, a lit and a dark curve,\n"
    "    curves over irradiance and temperature. Several curves as fit_family() takes them.\n"
    "current : array_like of shape (n,), optional\n"
    "    In A, with voltages.\n"
    "healthy : list, optional\n"
    "    Reference sweeps of the same module or its neighbours: the curve is compared with them, "
    "and\n"
    "    diagnosed without what they all have.\n"
    "module : bool, default False\n"
    "    All curves are sweeps of one module: find the outliers.\n"
    "effects : list of str or Effect, optional\n"
    "    Those to try; all that the data can show unless said.\n"
    "own_effects : list of Effect, optional\n"
    "    Tried beside the catalogue's; experimental: may change in a minor version.\n"
    "progress : callable, optional\n"
    "    Called with a :class:`Progress` ten times a second; False ends the work.\n";

constexpr char kDiagnoseEnd[] =
    "Returns\n-------\n"
    "DiagnoseResult, or OutlierSweepsResult with module=True\n\n"
    "Raises\n------\n"
    "lyrefit.Error\n"
    "    No usable curve, unknown effects, fewer readings than parameters.\n";

std::vector<KeywordNote> DiagnoseNotes() {
  std::vector<KeywordNote> notes;
  notes.push_back({"reference", "Any", "None", "", ""});
  notes.push_back({"module", "Literal[False]", "False", "", ""});  // True has another result type
  notes.push_back({"own_effects", "Effect | Sequence[Effect]", "None", "", ""});
  notes.push_back({"progress", "Callable[[Progress], object]", "None", "", ""});
  AppendNotes(kDiagnoseOptionTable, DiagnoseOptions(), &notes);
  AppendNotes(kReferenceOptionTable, ReferenceOptions(), &notes);
  AppendCurveNotes(&notes);
  return EachOnce(notes);
}

}  // namespace

void BindDiagnose(py::module_* module) {
  py::class_<DiagnoseResult, Result>(*module, "DiagnoseResult", "What diagnose() found.")
      .def_property_readonly("causes", &CausesOf, "list of str: ids of the effects, largest first.")
      .def_property_readonly(
          "sentence",
          [](const DiagnoseResult& r) { return py::object(r.Said()["verdict"]["sentence"]); },
          "str: the verdict.")
      .def_property_readonly(
          "extended",
          [](const DiagnoseResult& r) -> py::object {
            auto extended = r.Extended();
            return extended ? py::cast(*std::move(extended)) : py::object(py::none());
          },
          "FitResult or None: the model with its causes, with extend=True.")
      .def("frame", &CandidateFrame,
           "frame($self)\n--\n\nA pandas.DataFrame with a row a candidate: effect, whether it was\n"
           "tried and why not, its probability, RMSE (A), held-out RMSE (A).")
      .def(
          "cause_frame",
          [](const DiagnoseResult& result) { return FrameOfCsv(result.record().csv()); },
          "cause_frame($self)\n--\n\nA pandas.DataFrame with a row a cause (--csv).");
  py::class_<OutlierSweepsResult, Result>(*module, "OutlierSweepsResult",
                                          "What diagnose(module=True) found.")
      .def(
          "frame", [](const OutlierSweepsResult& r) { return FrameOfCsv(r.record().csv()); },
          "frame($self)\n--\n\nA pandas.DataFrame with a row a sweep, the oddest first (--csv).");
  DefineVerb(module,
             {"diagnose", "curve, current=None", kDiagnoseDoc, kDiagnoseEnd, DiagnoseNotes(), true},
             &DiagnoseOne, py::arg("curve"), py::arg("current") = py::none());
}

}  // namespace lyrefit::python
