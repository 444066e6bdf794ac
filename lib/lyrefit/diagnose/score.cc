#include "lyrefit/diagnose/score.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/random.h"
#include "lyrefit/diagnose/candidate.h"
#include "lyrefit/diagnose/null_law.h"
#include "lyrefit/diagnose/nulls.h"

namespace lyrefit {

NullDraws MakeNullDraws(std::size_t readings, int draws, std::uint64_t seed, std::uint64_t run) {
  NullDraws normal(static_cast<int>(readings), draws);
  RandomStream random(seed, run);
  for (float& number : normal.reshaped()) number = static_cast<float>(random.Normal());
  return normal;
}

struct ScoreSheet::Parts {
  Prepared prepared;
  Eigen::MatrixXf nulls;
  ListLaw list;
};

ScoreSheet::ScoreSheet(const Workbench& bench, const LawFit& fit,
                       const std::vector<const Effect*>& candidates,
                       const Eigen::Ref<const NullDraws>& draws)
    : parts_(new Parts) {
  Prepared& prepared = parts_->prepared;
  prepared = PrepareAll(bench, fit, candidates);
  if (prepared.degrees < 3) return;
  parts_->nulls = SimulateNulls(bench, prepared, draws);
  parts_->list = ListLaw(parts_->nulls, prepared.degrees);
}

ScoreSheet::ScoreSheet(ScoreSheet&&) noexcept = default;
ScoreSheet& ScoreSheet::operator=(ScoreSheet&&) noexcept = default;
ScoreSheet::~ScoreSheet() = default;

std::vector<Score> ScoreSheet::Scores(const Calibration& calibration) const {
  std::vector<Score> scores;
  std::size_t at = 0;
  for (const Candidate& candidate : parts_->prepared.candidates) {
    Score score = candidate.score;
    if (score.testable) {
      const NullLaw& law = parts_->list.laws[at++];
      score.p_value = law.Of(score.statistic);
      score.charge = 2 * std::log(law.Directions());
      score.catalogue = parts_->list.Catalogue();
      score.corrected_p = calibration.Corrected(parts_->list.Corrected(score.p_value));
    }
    scores.push_back(std::move(score));
  }
  return scores;
}

Calibration ScoreSheet::Calibrate(const Workbench& bench, const NoiseEstimator& noise, int draws,
                                  std::uint64_t seed) const {
  Calibration calibration;
  if (parts_->list.laws.empty()) return calibration;
  // A list that counts few nulls is calibrated for being one.
  const int counted = std::min(2 * draws, static_cast<int>(parts_->nulls.rows()));
  const ListLaw list(parts_->nulls.topRows(counted), parts_->prepared.degrees);
  Begin(bench.watch, "nulls", draws);
  const Eigen::MatrixXf nulls = SimulateRefits(
      bench, parts_->prepared, noise, MakeNullDraws(bench.readings->points.size(), draws, seed, 1));
  for (int d = 0; d < nulls.rows(); ++d) {
    double smallest = 1;
    for (int c = 0; c < nulls.cols(); ++c) {
      smallest = std::min(smallest, list.laws[c].Of(nulls(d, c)));
    }
    calibration.nulls.push_back(-std::log(std::max(list.Corrected(smallest), 1e-300)));
  }
  std::sort(calibration.nulls.begin(), calibration.nulls.end());
  return calibration;
}

std::vector<Score> ScoreEffects(const Workbench& bench, const LawFit& fit,
                                const std::vector<const Effect*>& candidates,
                                const Eigen::Ref<const NullDraws>& draws,
                                const Calibration& calibration) {
  return ScoreSheet(bench, fit, candidates, draws).Scores(calibration);
}

std::vector<Score> Rescore(const Workbench& bench, const LawFit& fit,
                           const std::vector<const Effect*>& candidates,
                           const std::vector<Score>& known) {
  std::vector<Score> scores;
  for (Candidate& candidate : PrepareAll(bench, fit, candidates).candidates) {
    Score& score = candidate.score;
    const auto same = std::find_if(known.begin(), known.end(), [&](const Score& other) {
      return other.effect == score.effect && other.testable;
    });
    if (same != known.end()) {
      score.charge = same->charge;
      score.catalogue = same->catalogue;
    } else if (score.testable) {  // at most what all its directions would
      score.charge = 2 * std::log(std::max<double>(candidate.directions.cols(), 1));
    }
    scores.push_back(std::move(score));
  }
  return scores;
}

}  // namespace lyrefit
