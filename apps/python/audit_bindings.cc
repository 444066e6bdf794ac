#include <memory>

#include "bindings.h"
#include "docs.h"
#include "errors.h"
#include "frames.h"
#include "lyrefit/study/audit.h"
#include "lyrefit/study/report/documents.h"
#include "result.h"
#include "work.h"

namespace lyrefit::python {
namespace {

using Audited = std::shared_ptr<const AuditReport>;

Record RecordOf(const Audited& audited) {
  Record record;
  record.json = [audited](JsonPoints) { return AuditJson(*audited); };
  record.text = [audited](Length) { return AuditText(*audited); };
  record.brief = [audited] { return BriefAudit(*audited); };
  record.document = [audited] { return AuditDocument(*audited); };
  record.csv = [audited] { return AuditCsv(*audited); };
  return record;
}

class AuditResult : public Result {
 public:
  using Result::Result;
};

AuditResult AuditRowsOf(py::handle rows, const py::kwargs& given) {
  Keywords keywords("audit", given);
  AuditOptions options;
  keywords.Read(kAuditOptionTable, &options);
  keywords.Finish();
  const std::string path = TextOf("rows", rows);
  AuditReport report = Must(Unlocked([&] { return Audit(path, options); }));
  if (!report.remark.empty()) Warn(report.path + ": " + report.remark);
  return AuditResult(RecordOf(std::make_shared<const AuditReport>(std::move(report))));
}

constexpr char kAuditDoc[] =
    "Check published parameter rows: does the claimed RMSE come out?\n\n"
    "Parameters\n----------\n"
    "rows : str or os.PathLike\n"
    "    A CSV file of rows as they are printed, whose last digits say how nearly a claim must\n"
    "    come out; its columns are those of ``lyrefit audit --help``. Devices are folders or "
    "files\n"
    "    of curves beside it, in the folder above, or in `curves`.\n";

constexpr char kAuditEnd[] =
    "Returns\n-------\n"
    "AuditResult\n"
    "    ``result['findings']``: each row with its verdict and what explains it, RMSEs in A.\n\n"
    "Raises\n------\n"
    "lyrefit.Error\n"
    "    An unreadable table, a missing folder.\n";

std::vector<KeywordNote> AuditNotes() {
  std::vector<KeywordNote> notes;
  AppendNotes(kAuditOptionTable, AuditOptions(), &notes);
  return notes;
}

}  // namespace

void BindAudit(py::module_* module) {
  py::class_<AuditResult, Result>(
      *module, "AuditResult", "What audit() found. Experimental: may change in a minor version.")
      .def(
          "frame", [](const AuditResult& r) { return FrameOfCsv(r.record().csv()); },
          "frame($self)\n--\n\nA pandas.DataFrame: a row for each row of the audit (--csv).");
  DefineVerb(module, {"audit", "rows", kAuditDoc, kAuditEnd, AuditNotes()}, &AuditRowsOf,
             py::arg("rows"));
}

}  // namespace lyrefit::python
