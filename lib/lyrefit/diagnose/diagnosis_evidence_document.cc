#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "lyrefit/diagnose/diagnosis_parts.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

std::string NoiseText(const Evidence& evidence) {
  std::string text = fmt::format("{} A and {} % of the current (one standard deviation)",
                                 Significant(evidence.noise_constant_A, 3),
                                 Significant(100 * evidence.noise_relative, 3));
  if (evidence.noise_voltage_V > 0) {
    text += fmt::format("; of the voltage {} V", Significant(evidence.noise_voltage_V, 3));
  }
  if (evidence.noise_dark_A > 0) {
    text += fmt::format("; in the dark {} A", Significant(evidence.noise_dark_A, 3));
  }
  if (evidence.noise_stated_A > 0) {
    text += fmt::format("; stated, and believed instead: {} A (median)",
                        Significant(evidence.noise_stated_A, 3));
  }
  if (evidence.noise_path_A > 0) {
    text += fmt::format(
        "; a rough path of {} A that neighbours share, light that wanders or a module that departs "
        "from the model",
        Significant(evidence.noise_path_A, 3));
  }
  return text + fmt::format("; autocorrelation {}", Significant(evidence.autocorrelation, 2));
}

std::string ResidualText(const ResidualStatistics& r) {
  return fmt::format("largest {} A at {} V; {} of one sign, {} expected (p = {}); Durbin-Watson {}",
                     Significant(r.largest_A, 3), Significant(r.largest_at_V, 4),
                     Plural(r.runs, "run"), Significant(r.expected_runs, 3),
                     Significant(r.runs_p_value, 2), Significant(r.durbin_watson, 3));
}

std::string WhitenessText(const Diagnosis& diagnosis) {
  const Evidence& evidence = diagnosis.evidence;
  std::string text = fmt::format("p = {} of pure noise with the base model",
                                 Significant(evidence.whiteness_p_value, 2));
  if (diagnosis.verdict.found) {
    text += fmt::format(", {} with the causes", Significant(evidence.whiteness_after_p_value, 2));
  }
  return text;
}

// "current 0.00100 A, voltage 0.0100 V"
std::string GridText(const Evidence& evidence) {
  std::string text;
  if (evidence.grid_step_A > 0) {
    text += fmt::format("current {} A", Significant(evidence.grid_step_A, 3));
  }
  if (evidence.grid_step_V > 0) {
    text += fmt::format("{}voltage {} V", text.empty() ? "" : ", ",
                        Significant(evidence.grid_step_V, 3));
  }
  return text;
}

bool IsCause(const Diagnosis& diagnosis, const std::string& id) {
  const std::vector<Cause>& causes = diagnosis.verdict.causes;
  return std::any_of(causes.begin(), causes.end(),
                     [&id](const Cause& cause) { return cause.effect == id; });
}

std::vector<std::string> TrialRow(const Diagnosis& diagnosis, const Trial& trial) {
  return {trial.effect + (IsCause(diagnosis, trial.effect) ? " <-" : ""),
          Scientific(trial.rmse_A, 3),
          Significant(trial.misfit, 3),
          Significant(trial.log_evidence, 3),
          Significant(trial.probability, 2),
          Significant(trial.delta_aicc, 3),
          Scientific(trial.held_out_rmse_A, 3),
          Significant(trial.kept, 2)};
}

Section EvidenceSection(const Diagnosis& diagnosis) {
  const Evidence& evidence = diagnosis.evidence;
  Section section = {"What the readings show"};
  AddField("noise", NoiseText(evidence), &section);
  AddField("misfit",
           fmt::format("the base model's residuals are {} times the noise",
                       Significant(evidence.misfit_ratio, 3)),
           &section);
  AddField("residuals", ResidualText(evidence.residuals), &section);
  AddField("whiteness", WhitenessText(diagnosis), &section);
  const std::string grid = GridText(evidence);
  if (!grid.empty()) AddField("grid", grid, &section);
  if (evidence.clipped_points > 0) {
    AddField("clipped",
             fmt::format("{} at {} A", Plural(evidence.clipped_points, "point"),
                         Significant(evidence.clip_level_A, 5)),
             &section);
  }
  std::vector<std::string> findings;
  for (const Finding& finding : evidence.findings) findings.push_back(finding.sentence);
  AddList(std::move(findings), &section);
  return section;
}

Section TrialSection(const Diagnosis& diagnosis) {
  Section section = {"Effects tried, one at a time (RMSE solved-current)"};
  block::Table table = {"lrrrrrrr",
                        {{"effect", "RMSE (A)", "misfit", "ln evidence", "probability", "dAICc",
                          "held out (A)", "kept"}}};
  for (const Trial& trial : diagnosis.trials) {
    if (trial.tried) table.rows.push_back(TrialRow(diagnosis, trial));
  }
  if (table.rows.empty()) return section;
  AddTable(std::move(table), &section);
  AddSentence(
      "<-: named as a cause. Misfit: what the effect takes away, in units of the noise. ln "
      "evidence: of the marginal likelihood with the effect over that without. Probability: of it "
      "as the only cause; -: not fitted, its score excludes it. dAICc: with the effect minus "
      "without. Kept: the part of its signature that the base model cannot absorb.",
      &section);
  return section;
}

Section UntriedSection(const Diagnosis& diagnosis) {
  std::vector<std::pair<std::string, std::string>> reasons;  // each with its effects
  for (const Trial& trial : diagnosis.trials) {
    if (trial.tried) continue;
    const auto same = std::find_if(reasons.begin(), reasons.end(), [&trial](const auto& one) {
      return one.first == trial.why_not;
    });
    if (same == reasons.end()) {
      reasons.emplace_back(trial.why_not, trial.effect);
    } else {
      same->second += ", " + trial.effect;
    }
  }
  std::vector<std::string> sentences;
  sentences.reserve(reasons.size());
  for (const auto& [reason, effects] : reasons) {
    sentences.push_back(reason.empty() ? effects : fmt::format("{}: {}", effects, reason));
  }
  return ListSection("Effects not tried", std::move(sentences));
}

Section LimitSection(const Diagnosis& diagnosis) {
  std::vector<std::string> sentences;
  for (const CannotBeExcluded& cause : diagnosis.verdict.cannot_be_excluded) {
    std::string text =
        fmt::format("{} (biases {}): {}", cause.id, cause.biases, FullSentence(cause.sentence));
    if (!cause.separate_by.empty()) text += " To tell: " + FullSentence(cause.separate_by);
    sentences.push_back(std::move(text));
  }
  return ListSection("What these data cannot exclude", std::move(sentences));
}

}  // namespace

std::vector<Section> DiagnosisEvidenceSections(const Diagnosis& diagnosis) {
  return {EvidenceSection(diagnosis), TrialSection(diagnosis), UntriedSection(diagnosis),
          LimitSection(diagnosis)};
}

}  // namespace lyrefit
