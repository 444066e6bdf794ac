// Optimized fully: it runs once for each candidate.
#include "lyrefit/diagnose/fit_effect.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/dense.h"

namespace lyrefit {
namespace {

// An effect whose signature stays below this many noise deviations, even at its bound, is not
// testable.
constexpr double kDetectable = 4.7;

bool IsTwoSided(const Effect& effect) {
  if (effect.parameters.empty()) return true;
  const EffectParameter& strength = effect.parameters.front();
  return strength.lower < strength.neutral && strength.neutral < strength.upper &&
         strength.neutral == 0;
}

// Cosine waves along every monotone stretch.
std::vector<Eigen::VectorXd> Waves(const WeightedData& weighted) {
  const std::vector<Reading>& points = weighted.readings->points;
  const int last_segment = points.back().segment;
  const int most = weighted.readings->traits.single ? 7 : 3;
  std::vector<Eigen::VectorXd> waves;
  for (int segment = 0; segment <= last_segment; ++segment) {
    std::vector<int> at;
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (points[k].segment == segment && weighted.used[k] != 0) at.push_back(static_cast<int>(k));
    }
    const int count = static_cast<int>(at.size());
    for (int w = 0; w < std::min(most, count / 4); ++w) {
      Eigen::VectorXd wave = Eigen::VectorXd::Zero(static_cast<int>(points.size()));
      for (int i = 0; i < count; ++i) wave[at[i]] = std::cos(M_PI * w * (i + 0.5) / count);
      waves.push_back(wave);
    }
  }
  return waves;
}

struct Raw {
  Eigen::VectorXd signature;
  int probe;
};

std::vector<Raw> RawSignatures(const WeightedData& weighted, const Effect& effect,
                               const FitSignatures& known) {
  std::vector<Raw> raw;
  if (effect.found_by == FoundBy::kWaves) {
    for (Eigen::VectorXd& wave : Waves(weighted)) raw.push_back({std::move(wave), -1});
    return raw;
  }
  const auto moved = known.moved.find(&effect);
  if (moved == known.moved.end()) return raw;
  const Eigen::MatrixXd whitened = WhitenColumns(weighted, moved->second);
  for (int k = 0; k < whitened.cols(); ++k) {
    const auto signature = whitened.col(k);
    if (signature.allFinite() && signature.norm() > 0) raw.push_back({signature, k});
  }
  return raw;
}

// Changes of the currents by each probe. Each evaluation starts from the junction voltages of the
// previous one.
Eigen::MatrixXd Move(const Readings& readings, const LawFit& fit, const Effect& effect) {
  Law law = fit.law;
  law.effects.push_back(&effect);
  const std::vector<Probe> probes = effect.probes(readings.traits);
  const int count = static_cast<int>(readings.points.size());
  const Eigen::Map<const Eigen::VectorXd> before(fit.current.data(), count);
  Eigen::MatrixXd moved(count, static_cast<int>(probes.size()));
  LawWorkspace workspace;
  for (int k = 0; k < moved.cols(); ++k) {
    CHECK_EQ(static_cast<int>(probes[k].size()), effect.size()) << effect.id;
    std::vector<double> p = fit.p;
    p.insert(p.end(), probes[k].begin(), probes[k].end());
    auto column = moved.col(k);
    if (EvaluateLaw(law, readings, p.data(), &workspace, column.data(), nullptr)) {
      column -= before;
    } else {
      column.setZero();
    }
  }
  return moved;
}

bool Serves(const WeightedData& weighted, const LawFit& fit,
            const std::vector<const Effect*>& effects, const FitSignatures& known) {
  if (known.fit.law.effects != fit.law.effects) return false;
  for (const Effect* effect : effects) {
    if (effect->probes != nullptr && known.moved.count(effect) == 0) return false;
  }
  const int count = static_cast<int>(fit.current.size());
  const Eigen::Map<const Eigen::VectorXd> here(fit.current.data(), count),
      there(known.fit.current.data(), count);
  return Whiten(weighted, here - there).squaredNorm() < weighted.count();
}

// Largest factor by which a probe's strength may grow within its bounds.
double Headroom(const Effect& effect, const Probe& probe) {
  const EffectParameter& strength = effect.parameters.front();
  const double used = std::fabs(probe[0] - strength.neutral);
  const double upper = std::fabs(strength.upper - strength.neutral);
  const double lower = std::fabs(strength.lower - strength.neutral);
  return used > 0 ? std::max(upper, lower) / used : 1;
}

Score ScoreProbes(const WeightedData& weighted, const Linearized& linear, const Effect& effect,
                  const FitSignatures& known) {
  Score score;
  const bool two_sided = IsTwoSided(effect);
  const std::vector<Probe> probes =
      effect.probes != nullptr ? effect.probes(weighted.readings->traits) : std::vector<Probe>();
  for (const Raw& raw : RawSignatures(weighted, effect, known)) {
    Eigen::VectorXd rest = raw.signature;
    TakeOut(linear.basis, &rest);
    Direction direction;
    direction.probe = raw.probe;
    direction.norm = rest.norm();
    direction.kept = direction.norm / raw.signature.norm();
    score.kept = std::max(score.kept, direction.kept);
    const bool wave = raw.probe < 0;
    if (!(direction.kept > (wave ? 1e-2 : 1e-7))) continue;
    if (!wave && direction.norm * Headroom(effect, probes[raw.probe]) < kDetectable) continue;
    direction.score = -rest.dot(linear.residual) / direction.norm;
    score.directions.push_back(direction);
  }
  score.testable = !score.directions.empty();
  if (!score.testable) {
    score.why_not =
        "the base model absorbs it: no strength within its bounds would show in these data";
    return score;
  }
  const auto size = [&](const Direction& d) { return two_sided ? std::fabs(d.score) : d.score; };
  std::stable_sort(score.directions.begin(), score.directions.end(),
                   [&](const Direction& a, const Direction& b) { return size(a) > size(b); });
  return score;
}

Score ScoreSingleReadings(const WeightedData& weighted, const Linearized& linear) {
  Score score;
  score.testable = true;
  score.kept = 1;
  Direction best;
  for (int k = 0; k < linear.residual.size(); ++k) {
    if (weighted.used[k] == 0) continue;
    const double room = 1 - linear.basis.row(k).squaredNorm();
    if (room < 1e-6) continue;
    const double size = std::fabs(linear.residual[k]) / std::sqrt(room);
    if (size > best.score) {
      best = {-1, 1, 1, size};
      score.outlier = k;
    }
  }
  score.directions = {best};
  return score;
}

// F(1, degrees - 1) statistic of a score, whose square is the reduction of the sum of squares
// `sum`. `least_variance`: lower limit of the noise variance.
double Statistic(double score, double sum, int degrees, double least_variance) {
  const double rest = std::max(sum - score * score, 1e-12 * sum);
  return score * score / std::max(rest / (degrees - 1), least_variance);
}

}  // namespace

std::shared_ptr<const FitSignatures> FindSignatures(const WeightedData& weighted, const LawFit& fit,
                                                    const std::vector<const Effect*>& effects,
                                                    Signatures* known) {
  for (const auto& one : *known) {
    if (Serves(weighted, fit, effects, *one)) return one;
  }
  auto own = std::make_shared<FitSignatures>();
  own->fit = fit;
  for (const Effect* effect : effects) {
    if (weighted.progress.Stopped()) break;
    if (effect->probes == nullptr) continue;
    own->moved.emplace(effect, Move(*weighted.readings, fit, *effect));
  }
  known->push_back(own);
  return own;
}

std::vector<Score> ScoreEffects(const WeightedData& weighted, const LawFit& fit,
                                const std::vector<const Effect*>& effects, Signatures* known) {
  const auto signatures = FindSignatures(weighted, fit, effects, known);
  const Linearized linear = Linearize(weighted, fit);
  const int degrees = weighted.count() - static_cast<int>(linear.basis.cols());
  const double sum = linear.residual.squaredNorm();
  std::vector<Score> scores;
  for (const Effect* effect : effects) {
    if (weighted.progress.Stopped()) break;
    const bool single = effect->found_by == FoundBy::kSingleReading;
    Score score = single ? ScoreSingleReadings(weighted, linear)
                         : ScoreProbes(weighted, linear, *effect, *signatures);
    score.effect = effect;
    if (degrees < 3) score.testable = false;
    if (score.testable) {
      const double best = score.directions.front().score;
      const double size = single || IsTwoSided(*effect) ? std::fabs(best) : std::max(best, 0.0);
      score.statistic = Statistic(size, sum, degrees, weighted.least_variance);
    }
    scores.push_back(std::move(score));
  }
  return scores;
}

const Score* FindScore(const std::vector<Score>& scores, FoundBy found_by) {
  const auto at = std::find_if(scores.begin(), scores.end(), [&](const Score& score) {
    return score.effect->found_by == found_by;
  });
  return at == scores.end() ? nullptr : &*at;
}

}  // namespace lyrefit
