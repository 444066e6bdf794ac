#include <memory>

#include "bindings.h"
#include "docs.h"
#include "effects.h"
#include "frames.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/plots.h"
#include "lyrefit/translate/translate.h"
#include "lyrefit/translate/translation_documents.h"
#include "result.h"
#include "sets.h"
#include "work.h"

namespace lyrefit::python {
namespace {

using Translated = std::shared_ptr<const TranslationReport>;

Record RecordOf(const Translated& report) {
  Record record;
  record.json = [report](JsonPoints) { return TranslationJson(*report); };
  record.text = [report](Length length) { return TranslationText(*report, length); };
  record.brief = [report] { return BriefTranslation(*report); };
  record.document = [report] { return TranslationDocument(*report); };
  record.csv = [report] { return TranslationCsv(*report); };
  record.plot = [report](const std::string& file) { return PlotTranslation(*report, file); };
  return record;
}

class TranslateResult : public Result {
 public:
  explicit TranslateResult(const Translated& report) : Result(RecordOf(report)) {}
};

struct TranslateAsked {
  TranslateOptions options;
  OwnEffects own;
};

TranslateAsked ReadTranslateKeywords(Keywords* keywords) {
  TranslateAsked asked;
  TranslateOptions& options = asked.options;
  const auto coefficients = keywords->Take("coefficients");
  const auto module = keywords->Take("module");
  if (const auto own = keywords->Take("own_effects")) {
    asked.own = OwnEffectsOf("own_effects", *own);
    for (const auto& effect : asked.own) options.diagnosis.own_effects.push_back(&effect->effect());
  }
  keywords->Read(kTranslateOptionTable, &options);
  keywords->Read(TranslateDiagnosisRows(), &options.diagnosis);
  ForNestedTables(&options,
                  [keywords](const auto& table, auto* nested) { keywords->Read(table, nested); });
  if (!asked.own.empty()) options.diagnosis.threads = 1;
  ShareSeedAndThreads(&options);
  if (coefficients) {
    Must(ReadCoefficients(TextOf("coefficients", *coefficients), &options.coefficients));
  }
  if (module) Must(ReadModule(TextOf("module", *module), &options));
  return asked;
}

// Reads the further curves with the options of the first one; given conditions apply only to the
// first.
std::vector<IvCurve> FurtherCurves(py::handle value, const CurveKeywords& first) {
  CurveKeywords said = first;
  said.told = {};
  said.told.cells = first.told.cells;
  said.name.clear();
  std::vector<IvCurve> further;
  if (IsSeveral(value)) {
    for (const py::handle curve : value) further.push_back(CurveOf(curve, py::none(), said));
  } else {
    further.push_back(CurveOf(value, py::none(), said));
  }
  constexpr std::size_t kMost = 2;
  if (further.size() > kMost) {
    Raise({"with_curve: procedure 3 takes at most two further curves", {}});
  }
  return further;
}

TranslateResult TranslateOne(py::handle curve, py::handle current, const py::kwargs& given) {
  Keywords keywords("translate", given);
  const py::object progress = keywords.Take("progress").value_or(py::none());
  const auto further = keywords.Take("with_curve");
  TranslateAsked asked = ReadTranslateKeywords(&keywords);
  const CurveKeywords said = ReadCurveKeywords(&keywords);
  keywords.Finish();
  const IvCurve taken = CurveOf(curve, current, said);
  if (further) asked.options.further = FurtherCurves(*further, said);
  Expected<TranslationReport> report = WorkWith(
      FaultsOf(asked.own), progress,
      [&](const Observer& observer) { return TranslateCurve(taken, asked.options, observer); });
  TranslationReport translated = Must(std::move(report));
  WarnOfDoubts(translated.doubts);
  return TranslateResult(HoldWith(std::move(translated), asked.own));
}

py::object RecommendedOf(const TranslateResult& result) {
  const py::dict& all = result.Dictionary();
  for (const py::handle one : all["results"]) {
    if (one["procedure"].equal(all["recommended"])) {
      return py::reinterpret_borrow<py::object>(one);
    }
  }
  return py::none();
}

constexpr char kTranslateDoc[] =
    "Carry a measured curve to standard or any conditions, with its uncertainty.\n\n"
    "Parameters\n----------\n"
    "curve, current\n"
    "    As fit() takes them: arrays of shape (n,) in V and A, a Curve, a path, a frame.\n"
    "to : (float, float) or str\n"
    "    Irradiance in W/m2 and cell temperature in degrees Celsius, or 'STC'.\n"
    "with_curve : curve or list of curves, optional\n"
    "    At most two of the same device under other conditions, for procedure 3.\n"
    "coefficients, module : path, optional\n"
    "    JSON with what a laboratory or a data sheet says; keywords go before it.\n"
    "progress : callable, optional\n"
    "    Called with a :class:`Progress` ten times a second; False ends the work.\n";

constexpr char kTranslateEnd[] =
    "Returns\n-------\n"
    "TranslateResult\n\n"
    "Raises\n------\n"
    "lyrefit.Error\n"
    "    A dark curve, irradiance or temperature that nobody stated, one that ends before Pmax.\n";

std::vector<KeywordNote> TranslateNotes() {
  std::vector<KeywordNote> notes;
  notes.push_back({"with_curve", "Any", "None", "", ""});
  notes.push_back({"coefficients", "str | PathLike[str]", "None", "", ""});
  notes.push_back({"module", "str | PathLike[str]", "None", "", ""});
  notes.push_back({"own_effects", "Effect | Sequence[Effect]", "None", "", ""});
  notes.push_back({"progress", "Callable[[Progress], object]", "None", "", ""});
  AppendNotes(kTranslateOptionTable, TranslateOptions(), &notes);
  AppendNotes(TranslateDiagnosisRows(), DiagnoseOptions(), &notes);
  TranslateOptions usual;
  ForNestedTables(&usual, [&notes](const auto& table, const auto* nested) {
    AppendNotes(table, *nested, &notes);
  });
  AppendCurveNotes(&notes);
  return EachOnce(notes);
}

}  // namespace

void BindTranslate(py::module_* module) {
  py::class_<TranslateResult, Result>(
      *module, "TranslateResult",
      "What translate() found. Experimental: may change in a minor version.")
      .def_property_readonly(
          "recommended", &RecommendedOf,
          "dict or None: the result of the procedure to go by, of those under 'results'.")
      .def(
          "frame", [](const TranslateResult& r) { return FrameOfCsv(r.record().csv()); },
          "frame($self)\n--\n\nA pandas.DataFrame with a row a procedure: the six key points, "
          "each\n"
          "with its expanded uncertainty (..._U), and why it has none (--csv).");
  DefineVerb(module,
             {"translate", "curve, current=None", kTranslateDoc, kTranslateEnd, TranslateNotes()},
             &TranslateOne, py::arg("curve"), py::arg("current") = py::none());
}

}  // namespace lyrefit::python
