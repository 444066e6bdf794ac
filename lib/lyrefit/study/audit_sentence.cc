#include "lyrefit/study/audit_evidence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/study/audit_lowest.h"

namespace lyrefit {
namespace {

constexpr double kOptimumWithin = 1e-4;  // relative to the optimum
constexpr double kLargestIdeality = 5;   // a larger n cannot be that of a single cell

std::string Ampere(double value) { return fmt::format("{:.6e} A", value); }

// The sets of constants that reproduce the claim. Empty if all do or one was stated.
std::string ConstantsText(const AuditReading& reading) {
  constexpr std::size_t kSets = std::size(EnumTable<ConstantSet>::kRows);
  if (!reading.any_constants || reading.constants.size() == kSets) return "";
  std::string text;
  for (const ConstantSet set : reading.constants) {
    text += (text.empty() ? " with the constants " : " or ") + ToText(set);
  }
  return text;
}

std::string AsStated(const AuditFinding& finding) {
  const AuditReading& stated = finding.stated;
  return "As stated the row gives " + Ampere(stated.figure_A);
}

std::string ExplanationText(const AuditExplanation& explanation) {
  const AuditReading& reading = explanation.reading;
  std::string text = fmt::format("{}{}: {}", JoinedChanges(reading), ConstantsText(reading),
                                 Ampere(reading.figure_A));
  if (!std::isnan(explanation.low_temperature_C)) {
    const double reach = std::max(reading.temperature_C - explanation.low_temperature_C,
                                  explanation.high_temperature_C - reading.temperature_C);
    text += fmt::format(" (the temperature must be right to {:.1g} C)", reach);
  }
  return text;
}

std::string Explained(const AuditFinding& finding) {
  std::string text = AsStated(finding) + "; the claim reproduces ";
  for (std::size_t i = 0; i < finding.explanations.size(); ++i) {
    if (i > 0) text += "; as plainly ";
    text += ExplanationText(finding.explanations[i]);
  }
  return text + ".";
}

// The effect of the temperature alone on the RMSE.
std::string TemperatureText(const AuditFinding& finding) {
  if (!finding.temperatures) return "";
  const AuditTemperatures& t = *finding.temperatures;
  if (t.at_claim_C.empty()) {
    if (!(t.best_A > finding.row.rmse.value)) return "";
    return fmt::format(" No temperature alone brings it below {} ({:.1f} C).", Ampere(t.best_A),
                       t.best_C);
  }
  std::string list;
  for (const double celsius : t.at_claim_C) {
    list += fmt::format("{}{:.2f}", list.empty() ? "" : " and ", celsius);
  }
  return fmt::format(" By temperature alone the claim would need {} C.", list);
}

std::string NearestText(const AuditFinding& finding) {
  if (!finding.nearest) return " No change tried reproduces the claim.";
  const AuditExplanation& nearest = *finding.nearest;
  const std::string text = ExplanationText(nearest);
  if (nearest.reading.constants.empty()) return fmt::format(" Nearest comes, {}.", text);
  return fmt::format(
      " It would reproduce {}; but of the {} readings tried {:.2g} may be expected to match by "
      "accident.",
      text, nearest.readings_tried, nearest.chance);
}

bool IsOptimum(const AuditFinding& finding) {
  const double rmse = finding.stated.figure_A;
  return std::fabs(rmse - finding.optimum_A) <= kOptimumWithin * finding.optimum_A;
}

std::string Better(const AuditFinding& finding) {
  std::string text = AsStated(finding) + ", less than claimed";
  if (IsOptimum(finding)) {
    return text + fmt::format("; that is the optimum, {}.", Ampere(finding.optimum_A));
  }
  return text + "." + TemperatureText(finding) + NearestText(finding);
}

std::string OtherDevice(const AuditFinding& finding) {
  const AuditRow& row = finding.row;
  const double photocurrent_A = row.parameters[kIph].value;
  std::string text =
      fmt::format("{}. Its Iph of {:.4g} A is far from the Isc of {}, {:.4g} A", AsStated(finding),
                  photocurrent_A, finding.stated.curve, finding.short_circuit_A);
  if (finding.other_device) {
    const AuditReading& other = *finding.other_device;
    text += fmt::format("; it looks like a row of {}: {} the RMSE is {:.3g} A", other.curve,
                        JoinedChanges(other), other.figure_A);
  } else {
    text += fmt::format("; it belongs to another device, Isc about {:.3g} A, none of those at hand",
                        photocurrent_A);
  }
  for (int d = 0; d < static_cast<int>(row.model); ++d) {
    const double n = row.parameters[IdealityIndex(d)].value;
    if (n > kLargestIdeality) {
      text += fmt::format("; n of {:.4g} looks like n times the cells in series", n);
    }
  }
  return text + ".";
}

// An RMSE of which the claim is the print: "9.860219e-04 A, cut off to the claim's digits". A claim
// that is cut off lies below it, and of few digits it may be far from it.
std::string PrintedAs(const PrintedNumber& claim, double rmse_A) {
  const bool rounded = rmse_A - claim.value <= claim.half_unit;
  return fmt::format("{}, {} to the claim's digits", Ampere(rmse_A),
                     rounded ? "rounded" : "cut off");
}

// The claim as the least RMSE of a Newton step or of the other objective; empty if it is neither.
std::string LeastOfText(const AuditFinding& finding) {
  const AuditLowest& lowest = *finding.lowest;
  const PrintedNumber& claim = finding.row.rmse;
  if (IsPrintOf(claim, lowest.newton_step_A)) {
    return fmt::format(
        " The claim is compatible with the least that one Newton step from the measured currents "
        "comes to, {}; that is not the root of the equation.",
        PrintedAs(claim, lowest.newton_step_A));
  }
  if (!IsPrintOf(claim, lowest.other_objective_A)) return "";
  const bool measured = lowest.objective == Objective::kMeasuredCurrent;
  return fmt::format(" The claim is compatible with the least {} RMSE, {}.",
                     ToText(measured ? Objective::kSolvedCurrent : Objective::kMeasuredCurrent),
                     PrintedAs(claim, lowest.other_objective_A));
}

// The verdict for a claim below every fit, with or without parameters.
std::string Below(const AuditFinding& finding) {
  const AuditLowest& lowest = *finding.lowest;
  const std::string start =
      finding.stated.parameters.empty() ? "The row has no parameters" : AsStated(finding);
  const std::string range = fmt::format("n from {:g} to {:g}", lowest.n_lower, lowest.n_upper);
  const std::string least =
      finding.verdict == AuditVerdict::kBelowProved
          ? fmt::format(
                "and none give the claim: it is proved that with {} no {} RMSE lies below {}",
                range, ToText(lowest.objective), Ampere(lowest.lower_bound_A))
          : fmt::format("and none known give the claim: the least {} RMSE found with {} is {}",
                        ToText(lowest.objective), range, Ampere(LowestFound(lowest)));
  return start + ", " + least + "." + LeastOfText(finding);
}

// The verdict for a claim below the best fit that is possible with n outside the fit's range.
std::string WiderText(const AuditFinding& finding) {
  if (!finding.lowest || !IsBelow(finding.row.rmse, finding.lowest->rmse_A)) return "";
  return fmt::format(" With n from {:g} to {:g} the claim can be met, down to {}.",
                     finding.lowest->n_lower, finding.lowest->n_upper,
                     Ampere(finding.lowest->reached_A));
}

std::string Fails(const AuditFinding& finding) {
  return AsStated(finding) + "." + TemperatureText(finding) + NearestText(finding) +
         WiderText(finding);
}

std::string NoParameters(const AuditFinding& finding) {
  const std::string text = "The row has no parameters";
  if (!finding.lowest) return text + ".";
  const double least = finding.lowest->rmse_A;
  if (IsPrintOf(finding.row.rmse, least)) {
    return fmt::format("{}; the claim is compatible with the least there is, {}.", text,
                       PrintedAs(finding.row.rmse, least));
  }
  if (finding.row.rmse.value < least) {
    return fmt::format("{}; the best fit with n from {:g} to {:g} has {}.{}{}", text, kLowestFitted,
                       kHighestFitted, Ampere(least), LeastOfText(finding), WiderText(finding));
  }
  return fmt::format("{}; the claim can be met, for the best fit has {}.{}", text, Ampere(least),
                     LeastOfText(finding));
}

}  // namespace

std::string JoinedChanges(const AuditReading& reading) {
  std::string text;
  for (std::size_t i = 0; i < reading.changes.size(); ++i) {
    if (i > 0) text += i + 1 == reading.changes.size() ? " and " : ", ";
    text += reading.changes[i];
  }
  return text;
}

std::string LeftBoundsText(const std::vector<LeftBound>& left) {
  std::string text;
  for (const LeftBound& bound : left) {
    const bool below = bound.value < bound.lower;
    text += fmt::format("{}{} {:.4g} {} {:g}", text.empty() ? "" : ", ", bound.info.symbol,
                        bound.value, below ? "below" : "above", below ? bound.lower : bound.upper);
  }
  return text;
}

std::string AuditSentence(const AuditFinding& finding) {
  switch (finding.verdict) {
    case AuditVerdict::kReproduces:
      return fmt::format("The claim comes out of the row{}: {}.", ConstantsText(finding.stated),
                         Ampere(finding.stated.figure_A));
    case AuditVerdict::kReproducesChanged:
      return Explained(finding);
    case AuditVerdict::kBetter:
      return Better(finding);
    case AuditVerdict::kOtherDevice:
      return OtherDevice(finding);
    case AuditVerdict::kTooCoarse:
      return fmt::format("{}, and its printed digits leave room for {} more or less.",
                         AsStated(finding), Ampere(finding.stated.tolerance_A));
    case AuditVerdict::kBelowProved:
    case AuditVerdict::kBelowKnown:
      return Below(finding);
    case AuditVerdict::kFails:
      return Fails(finding);
    case AuditVerdict::kNoParameters:
      return NoParameters(finding);
  }
  return "";
}

}  // namespace lyrefit
