#include <algorithm>
#include <memory>

#include "bindings.h"
#include "curves.h"
#include "docs.h"
#include "frames.h"
#include "lyrefit/base/setting_text.h"
#include "lyrefit/certify/certificate_documents.h"
#include "lyrefit/certify/certify.h"
#include "lyrefit/certify/floor.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/plots.h"
#include "lyrefit/settings/bounds_file.h"
#include "result.h"
#include "work.h"

namespace lyrefit::python {
namespace {

using Proof = std::shared_ptr<const Certificate>;

Record RecordOf(const Proof& proof) {
  Record record;
  record.json = [proof](JsonPoints) { return CertificateJson(*proof); };
  record.text = [proof](Length) { return CertificateText(*proof); };
  record.brief = [proof] { return BriefCertificate(*proof); };
  record.document = [proof] { return CertificateDocument(*proof); };
  record.csv = [proof] { return CertificateCsv(*proof); };
  record.plot = [proof](const std::string& file) { return PlotCertificate(*proof, file); };
  return record;
}

class CertifyResult : public Result {
 public:
  explicit CertifyResult(Proof proof) : Result(RecordOf(proof)), proof_(std::move(proof)) {}
  const Certificate& proof() const { return *proof_; }

 private:
  Proof proof_;
};

bool AllCertified(const CertifyResult& result) {
  const Certificate& proof = result.proof();
  return proof.floor.certified && !proof.interrupted &&
         std::all_of(proof.models.begin(), proof.models.end(),
                     [](const ModelCertificate& model) { return model.certified; });
}

// Converts a name, a file, or {"Iph": (0, 2), ...} to bounds.
BoundsSpec BoxAsked(py::handle asked, const std::string& curve_file) {
  if (!py::isinstance<py::dict>(asked)) {
    return Must(NamedBounds(TextOf("bounds", asked), curve_file));
  }
  BoundsSpec spec;
  spec.name = "given";
  for (const std::string& text : TextsOf("bounds", asked)) {
    const auto range = ReadRange(text);
    if (!range) Raise({"bounds: " + range.error().ToString(), {}});
    spec.table[range->first] = range->second;
  }
  return spec;
}

CertifyResult CertifyOne(py::handle curve, py::handle current, const py::kwargs& given) {
  Keywords keywords("certify", given);
  const py::object progress = keywords.Take("progress").value_or(py::none());
  const CurveKeywords said = ReadCurveKeywords(&keywords);
  CertifyOptions options;
  const std::optional<py::object> bounds = keywords.Take("bounds");
  keywords.Read(kCertifyOptionTable, &options);
  keywords.Finish();
  const IvCurve taken = CurveOf(curve, current, said);
  if (bounds && !bounds->is_none()) {
    options = Must(CertifyWithin(BoxAsked(*bounds, taken.source), taken, options));
  }
  Certificate proof = Must(
      Work(progress, [&](const Observer& observer) { return Certify(taken, options, observer); }));
  return CertifyResult(std::make_shared<const Certificate>(std::move(proof)));
}

constexpr char kCertifyDoc[] =
    "Prove how low the RMSE of a curve can go, of either objective.\n\n"
    "The floor is that of any number of diodes in parallel with n and Rs in these ranges; beside\n"
    "it stands the best each model can do.\n\n"
    "Parameters\n----------\n"
    "curve, current\n"
    "    As fit() takes them: arrays of shape (n,) in V and A, a Curve, a path, a frame.\n"
    "bounds : str, path or mapping, optional\n"
    "    A box for every parameter, as fit() takes it, in the place of the single ranges.\n"
    "progress : callable, optional\n"
    "    Called at most ten times a second with a :class:`Progress`; False ends the work.\n";

constexpr char kCertifyEnd[] =
    "Returns\n-------\n"
    "CertifyResult\n"
    "    ``result['floor']['rmse_A']`` and, model by model, ``result['models']``, in A.\n\n"
    "Raises\n------\n"
    "lyrefit.Error\n"
    "    An unusable curve, no delivered current at a forward voltage, options outside their\n"
    "    ranges.\n";

std::vector<KeywordNote> CertifyNotes() {
  std::vector<KeywordNote> notes;
  notes.push_back({"bounds", "str | PathLike[str] | Mapping[str, tuple[float, float]] | None",
                   "None", "Proof", ""});
  notes.push_back({"progress", "Callable[[Progress], object]", "None", "", ""});
  AppendNotes(kCertifyOptionTable, CertifyOptions(), &notes);
  AppendCurveNotes(&notes);
  return EachOnce(notes);
}

}  // namespace

void BindCertify(py::module_* module) {
  py::class_<CertifyResult, Result>(*module, "CertifyResult", "What certify() proved.")
      .def_property_readonly("certified", &AllCertified,
                             "bool: the floor and every model are proved.")
      .def(
          "frame", [](const CertifyResult& r) { return FrameOfCsv(r.record().csv()); },
          "frame($self)\n--\n\nA pandas.DataFrame: a row for the floor and for each model "
          "(--csv).");
  DefineVerb(module,
             {"certify", "curve, current=None", kCertifyDoc, kCertifyEnd, CertifyNotes(), true},
             &CertifyOne, py::arg("curve"), py::arg("current") = py::none());
}

}  // namespace lyrefit::python
