#include "lyrefit/study/audit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "lyrefit/base/version.h"
#include "lyrefit/curve/number_text.h"
#include "lyrefit/fit/bounds.h"
#include "lyrefit/study/audit_curves.h"
#include "lyrefit/study/audit_evidence.h"
#include "lyrefit/study/audit_explain.h"
#include "lyrefit/study/audit_reading.h"
#include "lyrefit/study/audit_sentence.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

constexpr double kCoarse = 0.1;        // of the claim: a tolerance that lets almost anything pass
constexpr double kMatchesWell = 0.01;  // of the claim: a match even of coarse digits
constexpr char kDefaultBounds[] = "paper";

// The published bounds of a curve; nothing if no name is given and there are none.
Expected<std::optional<BoundsSpec>> PublishedBounds(const std::string& name,
                                                    const AuditCurve& curve) {
  const fs::path file =
      fs::path(curve.folder) / fmt::format("bounds-{}.json", name.empty() ? kDefaultBounds : name);
  std::error_code error;
  if (!fs::exists(file, error)) {
    if (name.empty()) return std::nullopt;
    return Fail(fmt::format("there are no bounds {}: no {}", Quoted(name), file.string()));
  }
  Expected<BoundsSpec> spec = ReadBoundsFile(file.string());
  if (!spec) return tl::unexpected(spec.error());
  spec->name = name.empty() ? kDefaultBounds : name;
  return *spec;
}

class Auditor {
 public:
  Auditor(const AuditOptions& options, AuditShelf shelf)
      : options_(options), shelf_(std::move(shelf)) {}

  Expected<AuditFinding> AuditOne(const AuditRow& row, const std::string& path) {
    const auto refuse = [&](int column, const Error& error) {
      return Fail(error.ToString(), path, row.line, column);
    };
    const Expected<int> curve = FindCurve(row.device, &shelf_);
    if (!curve) return refuse(row.device_column, curve.error());
    const auto bounds = PublishedBounds(row.bounds, shelf_.curves[*curve]);
    if (!bounds) return refuse(row.bounds_column, bounds.error());

    const AuditSubject subject = MakeSubject(row, *curve, shelf_, options_);
    AuditFinding finding;
    finding.row = row;
    finding.stated = ReadingEvaluator(subject).Read(subject.stated);
    finding.verdict = VerdictAsStated(finding);
    if (finding.verdict == AuditVerdict::kBetter || finding.verdict == AuditVerdict::kFails) {
      LookFurther(subject, &finding);
    }
    if (*bounds) {
      finding.bounds_name = (*bounds)->name;
      if (auto checked = CheckBounds(**bounds, subject, &finding); !checked) {
        return refuse(row.bounds_column, checked.error());
      }
    }
    finding.sentence = AuditSentence(finding);
    return finding;
  }

 private:
  static AuditVerdict VerdictAsStated(const AuditFinding& finding) {
    const double claim = finding.row.rmse.value;
    const double rmse = finding.stated.rmse.Of(finding.stated.objective);
    if (finding.stated.constants.empty()) {
      return rmse < claim ? AuditVerdict::kBetter : AuditVerdict::kFails;
    }
    const bool coarse = finding.stated.tolerance_A > kCoarse * claim &&
                        std::fabs(rmse - claim) > kMatchesWell * claim;
    return coarse ? AuditVerdict::kTooCoarse : AuditVerdict::kReproduces;
  }

  void LookFurther(const AuditSubject& subject, AuditFinding* finding) {
    AuditSearch search = Explain(subject);
    finding->explanations = std::move(search.explanations);
    if (!finding->explanations.empty()) {
      finding->verdict = AuditVerdict::kReproducesChanged;
      return;
    }
    finding->short_circuit_A = shelf_.curves[subject.stated.curve].short_circuit_A;
    if (HasOtherPhotocurrent(subject)) {
      finding->verdict = AuditVerdict::kOtherDevice;
      finding->other_device = FindOtherDevice(subject);
      return;
    }
    finding->nearest = std::move(search.nearest);
    finding->optimum_A = optima_.Find(subject, subject.stated, finding->stated.shown);
    finding->temperatures = ScanTemperatures(subject);
  }

  // Of the row as stated, and of explanations on the same curve.
  Expected<void> CheckBounds(const BoundsSpec& spec, const AuditSubject& subject,
                             AuditFinding* finding) const {
    const Device device = MakeDevice(subject.row->model, subject.stated.conditions);
    const auto bounds = MakeBounds(spec, device, shelf_.curves[subject.stated.curve].curve);
    if (!bounds) return tl::unexpected(bounds.error());
    finding->stated.left_bounds = FindLeftBounds(device, *bounds, finding->stated);
    for (AuditExplanation& explanation : finding->explanations) {
      AuditReading& reading = explanation.reading;
      if (reading.curve == finding->stated.curve) {
        reading.left_bounds = FindLeftBounds(device, *bounds, reading);
      }
    }
    return {};
  }

  const AuditOptions& options_;
  AuditShelf shelf_;
  OptimumFinder optima_;
};

}  // namespace

Expected<AuditReport> Audit(const std::string& path, const AuditOptions& options) {
  Expected<AuditRows> rows = ReadAuditRows(path);
  if (!rows) return tl::unexpected(rows.error());
  Expected<AuditShelf> shelf = OpenShelf(path, options.curve_folders);
  if (!shelf) return tl::unexpected(shelf.error());
  AuditReport report;
  report.version = Version();
  report.path = path;
  report.options = options;
  report.bad_rows = std::move(rows->bad_rows);
  Auditor auditor(report.options, std::move(*shelf));
  for (const AuditRow& row : rows->rows) {
    Expected<AuditFinding> finding = auditor.AuditOne(row, path);
    if (finding) {
      report.findings.push_back(std::move(*finding));
    } else {
      report.bad_rows.push_back(finding.error());
    }
  }
  std::stable_sort(report.bad_rows.begin(), report.bad_rows.end(),
                   [](const Error& a, const Error& b) { return a.line < b.line; });
  return report;
}

int CountFindings(const AuditReport& report, AuditVerdict verdict) {
  return static_cast<int>(
      std::count_if(report.findings.begin(), report.findings.end(),
                    [&](const AuditFinding& finding) { return finding.verdict == verdict; }));
}

}  // namespace lyrefit
