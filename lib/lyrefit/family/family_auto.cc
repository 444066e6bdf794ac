#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "lyrefit/family/fit_family.h"

namespace lyrefit {
namespace {

constexpr double kSame = 1e-6;  // relative difference of mean squares that counts as 0

FamilyCandidate Describe(const FamilyReport& report) {
  FamilyCandidate candidate;
  candidate.law = report.translation.spec.law;
  candidate.model = report.translation.spec.model;
  candidate.rmse = report.rmse.refined;
  for (const Estimate& e : report.estimates) candidate.free_parameters += !e.fixed;
  if (report.held_out) {
    candidate.held_out_median_A = report.held_out->median_rmse_A;
    candidate.held_out_rmse_A = report.held_out->rmse.solved_current_A;
  }
  return candidate;
}

// Excess of the mean square of `one` over that of `best` on the same curves, in standard errors.
double Behind(const HeldOut& one, const HeldOut& best) {
  const std::size_t count = one.curve_rmse_A.size();
  if (count != best.curve_rmse_A.size() || count < 2) return kUnknown;
  std::vector<double> difference;
  double mean = 0, level = 0;
  for (std::size_t c = 0; c < count; ++c) {
    const double a = one.curve_rmse_A[c], b = best.curve_rmse_A[c];
    difference.push_back(a * a - b * b);
    mean += difference.back() / static_cast<double>(count);
    level += b * b / static_cast<double>(count);
  }
  if (std::fabs(mean) <= kSame * level) return 0;
  double squares = 0;
  for (const double d : difference) squares += (d - mean) * (d - mean);
  const double error = std::sqrt(squares / static_cast<double>(count * (count - 1)));
  return error > 0 ? mean / error : 0;
}

// Returns the position of the law to report; fills `behind_best` and `chosen`.
std::size_t Choose(const std::vector<FamilyReport>& reports,
                   std::vector<FamilyCandidate>* candidates) {
  const auto lower = [](const FamilyCandidate& a, const FamilyCandidate& b) {
    return a.held_out_rmse_A < b.held_out_rmse_A;
  };
  const bool tested = std::all_of(reports.begin(), reports.end(),
                                  [](const FamilyReport& r) { return r.held_out.has_value(); });
  std::size_t chosen = 0;
  if (tested) {
    const auto best = static_cast<std::size_t>(
        std::min_element(candidates->begin(), candidates->end(), lower) - candidates->begin());
    chosen = best;
    for (std::size_t i = 0; i < reports.size(); ++i) {
      FamilyCandidate& one = (*candidates)[i];
      one.behind_best = i == best ? 0 : Behind(*reports[i].held_out, *reports[best].held_out);
      const bool simpler = one.free_parameters < (*candidates)[chosen].free_parameters;
      if (simpler && one.behind_best < 1) chosen = i;
    }
  }
  (*candidates)[chosen].chosen = true;
  return chosen;
}

}  // namespace

Expected<FamilyReport> FitFamilyAuto(const CurveSet& set, const FamilyOptions& options,
                                     const Observer& observer) {
  std::vector<FamilyReport> reports;
  std::vector<FamilyCandidate> candidates;
  std::vector<std::string> refusals;
  std::optional<Error> first_error;
  double seconds = 0;
  bool interrupted = false;
  for (const TranslationLaw law : {TranslationLaw::kDeSoto, TranslationLaw::kPvsyst}) {
    for (const Model model : {Model::kSingleDiode, Model::kDoubleDiode}) {
      if (interrupted) continue;
      FamilyOptions trial = options;
      trial.law = law;
      trial.model = model;
      Expected<FamilyReport> report = FitFamily(set, trial, observer);
      if (!report) {  // the law does not support some option
        if (!first_error) first_error = report.error();
        refusals.push_back(fmt::format("{} {} was not tried: {}", ToText(law), ToText(model),
                                       report.error().message));
        continue;
      }
      candidates.push_back(Describe(*report));
      seconds += report->seconds;
      interrupted = report->interrupted;
      reports.push_back(std::move(*report));
    }
  }
  if (reports.empty()) return tl::unexpected(*first_error);
  const std::size_t chosen = Choose(reports, &candidates);
  FamilyReport report = std::move(reports[chosen]);
  report.candidates = std::move(candidates);
  report.seconds = seconds;
  report.interrupted = interrupted;
  report.assumptions.insert(report.assumptions.end(), refusals.begin(), refusals.end());
  return report;
}

}  // namespace lyrefit
