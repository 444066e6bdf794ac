#include "lyrefit/study/audit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/estimate/fit/bounds.h"
#include "lyrefit/settings/bounds_file.h"
#include "lyrefit/study/audit_evidence.h"
#include "lyrefit/study/audit_lowest.h"
#include "lyrefit/study/audit_reading.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

// Relative to the claim: a larger tolerance accepts almost any value.
constexpr double kCoarse = 0.1;
// Relative to the claim: a smaller distance is a match despite a large tolerance.
constexpr double kMatchesWell = 0.01;
constexpr char kDefaultBounds[] = "paper";

// The published bounds of a curve. Empty: no name is given and no default bounds exist.
Expected<std::optional<BoundsSpec>> PublishedBounds(const std::string& name,
                                                    const AuditCurve& curve) {
  const fs::path file =
      fs::path(curve.folder) / fmt::format("bounds-{}.json", name.empty() ? kDefaultBounds : name);
  std::error_code error;
  if (!fs::exists(file, error)) {
    if (name.empty()) return std::nullopt;
    return Fail(fmt::format("there are no bounds {}: no {}", Quoted(name), file.string()));
  }
  TRY(BoundsSpec spec, ReadBoundsFile(file.string()));
  spec.name = name.empty() ? kDefaultBounds : name;
  return spec;
}

// State shared by the rows of an audit. The shelf and the cached optima grow as rows use them.
struct AuditDesk {
  const std::string& path;
  const AuditOptions& options;
  AuditShelf shelf;
  LowestFinder lowest;
};

AuditVerdict VerdictAsStated(const AuditFinding& finding) {
  const double claim = finding.row.rmse.value;
  const double rmse = finding.stated.figure_A;
  if (finding.stated.parameters.empty()) return AuditVerdict::kNoParameters;
  if (finding.stated.constants.empty()) {
    return rmse < claim ? AuditVerdict::kBetter : AuditVerdict::kFails;
  }
  const bool coarse = finding.stated.tolerance_A > kCoarse * claim &&
                      std::fabs(rmse - claim) > kMatchesWell * claim;
  return coarse ? AuditVerdict::kTooCoarse : AuditVerdict::kReproduces;
}

// The finding with the claim compared with the lowest RMSE of any fit, and with its proved lower bound.
AuditFinding LookBelow(AuditFinding finding, const AuditSubject& subject, LowestFinder* finder) {
  finding.lowest = finder->Find(subject, finding.stated.shown);
  if (!finding.lowest) return finding;
  const PrintedNumber& claim = finding.row.rmse;
  if (IsBelow(claim, finding.lowest->lower_bound_A)) {
    finding.verdict = AuditVerdict::kBelowProved;
  } else if (IsBelow(claim, LowestFound(*finding.lowest))) {
    finding.verdict = AuditVerdict::kBelowKnown;
  }
  return finding;
}

// The finding with what may explain a claim that is not reproduced as stated.
AuditFinding LookFurther(AuditFinding finding, const AuditSubject& subject, LowestFinder* finder) {
  AuditSearch search = Explain(subject);
  finding.explanations = std::move(search.explanations);
  if (!finding.explanations.empty()) {
    finding.verdict = AuditVerdict::kReproducesChanged;
    return finding;
  }
  finding.short_circuit_A = subject.shelf->curves[subject.stated.curve].short_circuit_A;
  if (HasOtherPhotocurrent(subject)) {
    finding.verdict = AuditVerdict::kOtherDevice;
    finding.other_device = FindOtherDevice(subject);
    return finding;
  }
  finding.nearest = std::move(search.nearest);
  finding.optimum_A = finder->Optimum(subject, subject.stated, finding.stated.shown);
  finding.temperatures = ScanTemperatures(subject);
  if (finding.verdict != AuditVerdict::kFails) return finding;
  return LookBelow(std::move(finding), subject, finder);
}

// The finding with violated bounds of the row as stated, and of explanations on the same curve.
Expected<AuditFinding> CheckBounds(AuditFinding finding, const BoundsSpec& spec,
                                   const AuditSubject& subject) {
  const Device device = MakeDevice(subject.row->model, subject.stated.conditions);
  TRY(const auto bounds,
      MakeBounds(spec, device, subject.shelf->curves[subject.stated.curve].curve));
  finding.stated.left_bounds = FindLeftBounds(device, bounds, finding.stated);
  finding.bounds_name = spec.name;
  for (AuditExplanation& explanation : finding.explanations) {
    AuditReading& reading = explanation.reading;
    if (reading.curve == finding.stated.curve) {
      reading.left_bounds = FindLeftBounds(device, bounds, reading);
    }
  }
  return finding;
}

// The claimed RMSE, or that which is equivalent to a claimed sum of squares.
PrintedNumber ClaimedRmse(const AuditRow& row, std::size_t points) {
  PrintedNumber claim = row.rmse;
  if (!row.sum_of_squares) return claim;
  const double rmse = std::sqrt(claim.value / static_cast<double>(points));
  claim.half_unit *= 0.5 * rmse / claim.value;
  claim.value = rmse;
  return claim;
}

Expected<AuditFinding> AuditOne(AuditRow row, AuditDesk* desk) {
  const auto refuse = [&](int column, const Error& error) {
    return Fail(error.ToString(), desk->path, row.line, column);
  };
  const Expected<int> curve = FindCurve(row.device, &desk->shelf);
  if (!curve) return refuse(row.device_column, curve.error());
  const auto bounds = PublishedBounds(row.bounds, desk->shelf.curves[*curve]);
  if (!bounds) return refuse(row.bounds_column, bounds.error());

  row.rmse = ClaimedRmse(row, desk->shelf.curves[*curve].curve.voltage_V.size());
  const AuditSubject subject = MakeSubject(row, *curve, desk->shelf, desk->options);
  AuditFinding finding;
  finding.row = row;
  finding.stated = ReadingEvaluator(subject).Read(subject.stated);
  finding.verdict = VerdictAsStated(finding);
  if (finding.verdict == AuditVerdict::kBetter || finding.verdict == AuditVerdict::kFails) {
    finding = LookFurther(std::move(finding), subject, &desk->lowest);
  }
  if (finding.verdict == AuditVerdict::kNoParameters) {
    finding = LookBelow(std::move(finding), subject, &desk->lowest);
  }
  if (*bounds && !finding.stated.parameters.empty()) {
    auto checked = CheckBounds(std::move(finding), **bounds, subject);
    if (!checked) return refuse(row.bounds_column, checked.error());
    finding = std::move(*checked);
  }
  finding.sentence = AuditSentence(finding);
  return finding;
}

}  // namespace

Expected<AuditReport> Audit(const std::string& path, const AuditOptions& options) {
  TRY(AuditRows rows, ReadAuditRows(path));
  TRY(AuditShelf shelf, OpenShelf(path, options.curve_folders));
  AuditReport report;
  report.version = Version();
  report.path = path;
  report.options = options;
  report.bad_rows = std::move(rows.bad_rows);
  report.remark = std::move(rows.remark);
  AuditDesk desk{path, report.options, std::move(shelf), {}};
  for (const AuditRow& row : rows.rows) {
    Expected<AuditFinding> finding = AuditOne(row, &desk);
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
