#include "lyrefit/diagnose/candidate.h"

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
// Directions of one effect with a larger cosine count as one.
constexpr double kAlike = 0.97;

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
                               const Signature& signature) {
  std::vector<Raw> raw;
  if (effect.found_by == FoundBy::kWaves) {
    for (Eigen::VectorXd& wave : Waves(weighted)) raw.push_back({std::move(wave), -1});
    return raw;
  }
  const auto moved = signature.moved.find(&effect);
  if (moved == signature.moved.end()) return raw;
  const Eigen::MatrixXd signatures = WhitenColumns(weighted, moved->second);
  for (int k = 0; k < signatures.cols(); ++k) {
    const auto signature = signatures.col(k);
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
            const std::vector<const Effect*>& effects, const Signature& signature) {
  if (signature.fit.law.effects != fit.law.effects) return false;
  for (const Effect* effect : effects) {
    if (effect->probes != nullptr && signature.moved.count(effect) == 0) return false;
  }
  const int count = static_cast<int>(fit.current.size());
  const Eigen::Map<const Eigen::VectorXd> here(fit.current.data(), count),
      there(signature.fit.current.data(), count);
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

CandidateEffect Prepare(const WeightedData& weighted, const Linearized& linear,
                        const Effect& effect, const Signature& signature) {
  CandidateEffect candidate;
  candidate.score.effect = &effect;
  candidate.two_sided = IsTwoSided(effect);
  const std::vector<Probe> probes =
      effect.probes != nullptr ? effect.probes(weighted.readings->traits) : std::vector<Probe>();
  std::vector<Eigen::VectorXd> kept;
  for (const Raw& raw : RawSignatures(weighted, effect, signature)) {
    Eigen::VectorXd rest = raw.signature;
    TakeOut(linear.basis, &rest);
    Direction direction;
    direction.probe = raw.probe;
    direction.norm = rest.norm();
    direction.kept = direction.norm / raw.signature.norm();
    candidate.score.kept = std::max(candidate.score.kept, direction.kept);
    const bool wave = raw.probe < 0;
    if (!(direction.kept > (wave ? 1e-2 : 1e-7))) continue;
    if (!wave && direction.norm * Headroom(effect, probes[raw.probe]) < kDetectable) continue;
    const Eigen::VectorXd unit = rest / direction.norm;
    direction.score = -unit.dot(linear.residual);
    candidate.score.directions.push_back(direction);
    kept.push_back(unit);
  }
  candidate.score.testable = !kept.empty();
  if (kept.empty()) {
    candidate.score.why_not =
        "the base model absorbs it: no strength within its bounds would show in these data";
    return candidate;
  }
  // The null statistics use one direction of each set of nearly equal ones. The score uses them
  // all, sorted.
  std::vector<int> order(kept.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<int>(k);
  const auto size = [&](int k) {
    const double s = candidate.score.directions[k].score;
    return candidate.two_sided ? std::fabs(s) : s;
  };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return size(a) > size(b); });
  std::vector<int> distinct;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    bool alike = false;
    for (const int other : distinct) {
      const double cosine = kept[k].dot(kept[other]);
      alike = alike || (candidate.two_sided ? std::fabs(cosine) : cosine) > kAlike;
    }
    if (!alike) distinct.push_back(static_cast<int>(k));
  }
  candidate.directions.resize(linear.residual.size(), static_cast<int>(distinct.size()));
  for (std::size_t k = 0; k < distinct.size(); ++k) {
    candidate.directions.col(static_cast<int>(k)) = kept[distinct[k]].cast<float>();
  }
  std::vector<Direction> sorted;
  sorted.reserve(order.size());
  for (const int k : order) sorted.push_back(candidate.score.directions[k]);
  candidate.score.directions = sorted;
  return candidate;
}

CandidateEffect PrepareOutliers(const WeightedData& weighted, const Linearized& linear,
                                const Effect& effect) {
  CandidateEffect candidate;
  candidate.score.effect = &effect;
  candidate.two_sided = true;
  candidate.score.testable = true;
  candidate.score.kept = 1;
  Direction best;
  for (int k = 0; k < linear.residual.size(); ++k) {
    if (weighted.used[k] == 0) continue;
    const double room = 1 - linear.basis.row(k).squaredNorm();
    if (room < 1e-6) continue;
    const double score = std::fabs(linear.residual[k]) / std::sqrt(room);
    if (score > best.score) {
      best = {-1, 1, 1, score};
      candidate.score.outlier = k;
    }
  }
  candidate.score.directions = {best};
  return candidate;
}

}  // namespace

std::shared_ptr<const Signature> FindSignature(const WeightedData& weighted, const LawFit& fit,
                                               const std::vector<const Effect*>& effects,
                                               Signatures* known) {
  for (const auto& signature : *known) {
    if (Serves(weighted, fit, effects, *signature)) return signature;
  }
  auto signature = std::make_shared<Signature>();
  signature->fit = fit;
  for (const Effect* effect : effects) {
    if (weighted.progress.Stopped()) break;
    if (effect->probes == nullptr) continue;
    signature->moved.emplace(effect, Move(*weighted.readings, fit, *effect));
  }
  known->push_back(signature);
  return signature;
}

Prepared PrepareAll(const WeightedData& weighted, const LawFit& fit,
                    const std::vector<const Effect*>& effects, Signatures* known) {
  const std::shared_ptr<const Signature> signature = FindSignature(weighted, fit, effects, known);
  Prepared prepared;
  prepared.linear = Linearize(weighted, fit);
  prepared.degrees = weighted.count() - static_cast<int>(prepared.linear.basis.cols());
  const double sum = prepared.linear.residual.squaredNorm();
  for (const Effect* effect : effects) {
    if (weighted.progress.Stopped()) break;
    const bool single = effect->found_by == FoundBy::kSingleReading;
    CandidateEffect candidate = single ? PrepareOutliers(weighted, prepared.linear, *effect)
                                       : Prepare(weighted, prepared.linear, *effect, *signature);
    if (prepared.degrees < 3) candidate.score.testable = false;
    if (candidate.score.testable) {
      const double best = candidate.score.directions.front().score;
      const double size = candidate.two_sided ? std::fabs(best) : std::max(best, 0.0);
      candidate.score.statistic = Statistic(size, sum, prepared.degrees, weighted.least_variance);
    }
    prepared.candidates.push_back(std::move(candidate));
  }
  return prepared;
}

double Statistic(double score, double sum, int degrees, double least_variance) {
  const double rest = std::max(sum - score * score, 1e-12 * sum);
  return score * score / std::max(rest / (degrees - 1), least_variance);
}

}  // namespace lyrefit
