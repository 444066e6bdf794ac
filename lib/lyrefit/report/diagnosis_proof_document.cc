#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "lyrefit/report/record_parts.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

// Percentage of an upper bound, rounded up: "37 %".
std::string AtMostText(double part) {
  return std::isfinite(part) ? fmt::format("{:.0f} %", std::ceil(100 * part - 1e-9)) : "-";
}

}  // namespace

Section ProofSection(const Diagnosis& diagnosis) {
  Section section = {"What a cause can explain at most"};
  if (!diagnosis.proofs) return section;
  const Proofs& proofs = *diagnosis.proofs;
  if (!proofs.sentence.empty()) AddSentence(FullSentence(proofs.sentence), &section);
  if (proofs.causes.empty()) return section;
  block::Table table = {
      "llrrrr",
      {{"RMSE in A", "objective", "base model", "proved floor", "attained", "explains at most"}}};
  std::vector<std::string> scopes;
  for (const CauseProof& proof : proofs.causes) {
    table.rows.push_back({proof.effect + (proof.named ? " (named)" : ""), ToText(proof.objective),
                          Scientific(proof.base_A, 4), Scientific(proof.lower_bound_A, 4),
                          Scientific(proof.upper_bound_A, 4), AtMostText(proof.explains_at_most)});
    scopes.push_back(fmt::format("{}: {}.", proof.effect, proof.holds_for));
  }
  AddTable(std::move(table), &section);
  AddList(std::move(scopes), &section);
  AddSentence(
      "No model of its kind with that cause alone beside it lies below the floor; at most so much "
      "of the base model's sum of squares it explains. Figures of the two objectives cannot be "
      "compared.",
      &section);
  return section;
}

}  // namespace lyrefit
