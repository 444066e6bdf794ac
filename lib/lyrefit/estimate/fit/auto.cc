#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/estimate/fit/held_out.h"
#include "lyrefit/estimate/fit/statistics.h"
#include "lyrefit/model/current.h"

namespace lyrefit {
namespace {

constexpr double kLevel = 0.05;

std::string Capital(Model model) {
  return model == Model::kSingleDiode ? "SD" : model == Model::kDoubleDiode ? "DD" : "TD";
}

// Reasons why the data do not support `rich` over `simple`; empty if they do.
std::string Objection(const CandidateReport& simple, const CandidateReport& rich) {
  std::vector<std::string> reasons;
  if (!(rich.aicc < simple.aicc)) {
    reasons.push_back(std::isnan(rich.aicc) || std::isnan(simple.aicc)
                          ? "too few points for AICc"
                          : fmt::format("AICc rises by {:.1f}", rich.aicc - simple.aicc));
  }
  if (!(rich.f_p_value < kLevel)) {
    reasons.push_back(std::isnan(rich.f_p_value)
                          ? "no degrees of freedom for the F-test"
                          : fmt::format("F-test p = {:.2g}", rich.f_p_value));
  }
  if (!rich.identifiable) reasons.push_back("the added diode may be absent");
  if (!(rich.held_out_rmse_A < simple.held_out_rmse_A)) {
    reasons.push_back(fmt::format("held-out RMSE does not fall ({:.3g} to {:.3g} A)",
                                  simple.held_out_rmse_A, rich.held_out_rmse_A));
  }
  std::string text;
  for (const std::string& reason : reasons) text += (text.empty() ? "" : ", ") + reason;
  return text;
}

// Whether every diode is needed. The best fit with one diode less must be outside the 95 % limit
// that also bounds the profile of a saturation current.
bool DiodesIdentifiable(double simple_rmse, double rich_rmse, int degrees_of_freedom) {
  if (degrees_of_freedom < 1) return false;
  const double t = StudentT95(degrees_of_freedom);
  const double ratio = simple_rmse / rich_rmse;
  return (ratio * ratio - 1) * degrees_of_freedom > t * t;
}

CandidateReport Judge(const FitReport& report, const FitOptions& options, const FitReport* simpler,
                      const ProgressReporter& progress) {
  CandidateReport candidate;
  candidate.model = report.model;
  candidate.rmse_A = report.rmse.refined.Of(report.objective);
  candidate.aicc = report.criteria.aicc;
  candidate.held_out_rmse_A = HeldOutRmse(report, options, progress);
  if (simpler != nullptr) {
    const double simple = simpler->rmse.refined.Of(report.objective);
    const int extra = report.criteria.parameters - simpler->criteria.parameters;
    const int degrees = report.criteria.points - report.criteria.parameters;
    candidate.f_p_value = FTestPValue(simple * simple, candidate.rmse_A * candidate.rmse_A,
                                      std::max(extra, 1), degrees);
    candidate.identifiable = DiodesIdentifiable(simple, candidate.rmse_A, degrees);
  }
  return candidate;
}

// The options without those for diodes that the model lacks.
FitOptions ForModel(FitOptions options, Model model, const IvCurve& curve) {
  options.model = model;
  const Device device = MakeDevice(model, curve.conditions);
  const Device largest = MakeDevice(Model::kTripleDiode, curve.conditions);
  const auto lacks = [&](const std::string& key) {
    return largest.Find(key).has_value() && !device.Find(key).has_value();
  };
  for (auto it = options.fixed.begin(); it != options.fixed.end();) {
    it = lacks(it->first) ? options.fixed.erase(it) : std::next(it);
  }
  auto& overrides = options.bounds.overrides;
  for (auto it = overrides.begin(); it != overrides.end();) {
    it = lacks(it->first) ? overrides.erase(it) : std::next(it);
  }
  return options;
}

}  // namespace

Expected<FitReport> FitAuto(const IvCurve& curve, const FitOptions& options,
                            const Observer& observer) {
  std::vector<FitReport> fits;
  ModelChoice choice;
  std::string sentence;
  const ProgressReporter progress(observer, 0);
  for (const Model model : {Model::kSingleDiode, Model::kDoubleDiode, Model::kTripleDiode}) {
    FitOptions own = ForModel(options, model, curve);
    own.polish = true;
    own.intervals = Intervals::kNone;  // only the chosen model needs them
    own.errors = {};
    auto fit = Fit(curve, own, observer);
    if (!fit && fits.empty()) return fit;
    if (!fit) {
      sentence += fmt::format(" {} was not tried: {}.", Capital(model), fit.error().message);
      break;
    }
    fits.push_back(std::move(*fit));
    const bool first = fits.size() == 1;
    choice.candidates.push_back(
        Judge(fits.back(), own, first ? nullptr : &fits[fits.size() - 2], progress));
    if (fits.back().interrupted || progress.stop().requested()) {
      sentence += " The comparison was interrupted.";
      break;
    }
  }
  std::size_t chosen = 0;
  for (std::size_t k = 1; k < choice.candidates.size(); ++k) {
    const CandidateReport& rich = choice.candidates[k];
    const std::string objection = Objection(choice.candidates[chosen], rich);
    if (objection.empty() && chosen + 1 == k) {
      chosen = k;
      sentence += fmt::format(
          " {} earns its extra diode: AICc falls by {:.1f}, F-test p = {:.2g}, held-out RMSE falls "
          "from {:.3g} to {:.3g} A.",
          Capital(rich.model), choice.candidates[k - 1].aicc - rich.aicc, rich.f_p_value,
          choice.candidates[k - 1].held_out_rmse_A, rich.held_out_rmse_A);
    } else {
      sentence += fmt::format(" {} is not supported: {}.", Capital(rich.model),
                              objection.empty() ? "the model before it is not" : objection);
    }
  }
  choice.chosen = choice.candidates[chosen].model;
  choice.sentence = fmt::format("The data support {}.", Capital(choice.chosen)) + sentence;
  const bool interrupted = fits.back().interrupted || progress.stop().requested();
  FitOptions final_options = ForModel(options, choice.chosen, curve);
  final_options.polish = true;
  auto final_fit = interrupted ? Expected<FitReport>(std::move(fits[chosen]))
                               : Fit(curve, final_options, observer);
  if (!final_fit) return final_fit;
  FitReport report = std::move(*final_fit);
  report.interrupted = report.interrupted || interrupted;
  report.choice = std::move(choice);
  return report;
}

}  // namespace lyrefit
