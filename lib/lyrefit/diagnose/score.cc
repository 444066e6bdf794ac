#include "lyrefit/diagnose/score.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "lyrefit/base/dense.h"
#include "lyrefit/base/random.h"
#include "lyrefit/diagnose/null_law.h"

namespace lyrefit {
namespace {

// An effect that would need more than its bound to come to this many noise units cannot be seen.
constexpr double kDetectable = 4.7;
// Directions of one effect that are more alike than this count as one.
constexpr double kAlike = 0.97;

struct Candidate {
  Score score;
  bool two_sided = false;
  Eigen::MatrixXd directions;  // unit columns; none for outliers
};

bool IsTwoSided(const Effect& effect) {
  if (effect.parameters.empty()) return true;
  const EffectParameter& strength = effect.parameters.front();
  return strength.lower < strength.neutral && strength.neutral < strength.upper &&
         strength.neutral == 0;
}

// Smooth waves along every monotone stretch.
std::vector<Eigen::VectorXd> Waves(const Workbench& bench) {
  const std::vector<Reading>& points = bench.readings->points;
  const int last_segment = points.back().segment;
  const int most = bench.readings->traits.single ? 7 : 3;
  std::vector<Eigen::VectorXd> waves;
  for (int segment = 0; segment <= last_segment; ++segment) {
    std::vector<int> at;
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (points[k].segment == segment && bench.used[k] != 0) at.push_back(static_cast<int>(k));
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

std::vector<Raw> Signatures(const Workbench& bench, const LawFit& fit, const Effect& effect) {
  std::vector<Raw> raw;
  if (std::strcmp(effect.id, "unknown_structure") == 0) {
    for (Eigen::VectorXd& wave : Waves(bench)) raw.push_back({std::move(wave), -1});
    return raw;
  }
  const std::vector<Probe> probes = effect.probes(bench.readings->traits);
  for (std::size_t k = 0; k < probes.size(); ++k) {
    Eigen::VectorXd signature = Signature(bench, fit, effect, probes[k]);
    if (signature.allFinite() && signature.norm() > 0) {
      raw.push_back({std::move(signature), static_cast<int>(k)});
    }
  }
  return raw;
}

// How far from its neutral value a probe's strength may still grow.
double Headroom(const Effect& effect, const Probe& probe) {
  const EffectParameter& strength = effect.parameters.front();
  const double used = std::fabs(probe[0] - strength.neutral);
  const double upper = std::fabs(strength.upper - strength.neutral);
  const double lower = std::fabs(strength.lower - strength.neutral);
  return used > 0 ? std::max(upper, lower) / used : 1;
}

Candidate Prepare(const Workbench& bench, const LawFit& fit, const Linearized& linear,
                  const Effect& effect) {
  Candidate candidate;
  candidate.score.effect = &effect;
  candidate.two_sided = IsTwoSided(effect);
  const std::vector<Probe> probes =
      effect.probes != nullptr ? effect.probes(bench.readings->traits) : std::vector<Probe>();
  std::vector<Eigen::VectorXd> kept;
  for (const Raw& raw : Signatures(bench, fit, effect)) {
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
  // The best direction of each lot of like ones stands for the lot in the null.
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
    candidate.directions.col(static_cast<int>(k)) = kept[distinct[k]];
  }
  std::vector<Direction> sorted;
  sorted.reserve(order.size());
  for (const int k : order) sorted.push_back(candidate.score.directions[k]);
  candidate.score.directions = sorted;
  return candidate;
}

double Statistic(double score, double sum, int degrees, double least_variance) {
  const double rest = std::max(sum - score * score, 1e-12 * sum);
  return score * score / std::max(rest / (degrees - 1), least_variance);
}

// The largest statistic of each candidate in each simulated null.
Eigen::MatrixXd SimulateNulls(const Workbench& bench, const Linearized& linear,
                              const std::vector<Candidate>& candidates, int degrees, int draws,
                              std::uint64_t seed) {
  const int count = static_cast<int>(linear.residual.size());
  const Eigen::VectorXd room =
      (1 - linear.basis.rowwise().squaredNorm().array()).max(1e-9).sqrt().inverse().matrix();
  Eigen::MatrixXd largest = Eigen::MatrixXd::Zero(draws, static_cast<int>(candidates.size()));
  constexpr int kLot = 250;
  RandomStream random(seed, 0);
  for (int first = 0; first < draws; first += kLot) {
    const int lot = std::min(kLot, draws - first);
    if (Stopped(bench.watch)) break;
    Eigen::MatrixXd noise(count, lot);
    for (int d = 0; d < lot; ++d) {
      for (int k = 0; k < count; ++k) noise(k, d) = bench.used[k] != 0 ? random.Normal() : 0.0;
    }
    TakeOut(linear.basis, &noise);
    const Eigen::VectorXd sums = noise.colwise().squaredNorm();
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      if (!candidates[c].score.testable) continue;
      Eigen::VectorXd best(lot);
      if (candidates[c].directions.cols() == 0) {
        best = (room.asDiagonal() * noise).cwiseAbs().colwise().maxCoeff();
      } else {
        const Eigen::MatrixXd along = TransposedTimes(candidates[c].directions, noise);
        best = candidates[c].two_sided ? along.cwiseAbs().colwise().maxCoeff().eval()
                                       : along.colwise().maxCoeff().cwiseMax(0.0).eval();
      }
      for (int d = 0; d < lot; ++d) {
        largest(first + d, static_cast<int>(c)) =
            Statistic(best[d], sums[d], degrees, bench.least_variance);
      }
    }
  }
  return largest;
}

ListLaw CountTheList(const Eigen::MatrixXd& nulls, int degrees,
                     const std::vector<Candidate>& candidates) {
  const int draws = static_cast<int>(nulls.rows());
  ListLaw list;
  list.smallest = Eigen::VectorXd::Ones(draws);
  list.edge = static_cast<int>(kTail * draws);
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (!candidates[c].score.testable) continue;
    list.laws.emplace_back(nulls.col(static_cast<int>(c)), degrees);
    for (int d = 0; d < draws; ++d) {
      list.smallest[d] =
          std::min(list.smallest[d], list.laws.back().Of(nulls(d, static_cast<int>(c))));
    }
  }
  std::sort(list.smallest.begin(), list.smallest.end());
  return list;
}

Candidate PrepareOutliers(const Workbench& bench, const Linearized& linear, const Effect& effect) {
  Candidate candidate;
  candidate.score.effect = &effect;
  candidate.two_sided = true;
  candidate.score.testable = true;
  candidate.score.kept = 1;
  Direction best;
  for (int k = 0; k < linear.residual.size(); ++k) {
    if (bench.used[k] == 0) continue;
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

// A law's candidates on their bench.
struct Prepared {
  Linearized linear;
  int degrees = 0;
  std::vector<Candidate> candidates;
};

Prepared PrepareAll(const Workbench& bench, const LawFit& fit,
                    const std::vector<const Effect*>& effects) {
  Prepared prepared;
  prepared.linear = Linearize(bench, fit);
  prepared.degrees = bench.count() - static_cast<int>(prepared.linear.basis.cols());
  const double sum = prepared.linear.residual.squaredNorm();
  for (const Effect* effect : effects) {
    if (Stopped(bench.watch)) break;
    const bool outliers = std::strcmp(effect->id, "outliers") == 0;
    Candidate candidate = outliers ? PrepareOutliers(bench, prepared.linear, *effect)
                                   : Prepare(bench, fit, prepared.linear, *effect);
    if (prepared.degrees < 3) candidate.score.testable = false;
    if (candidate.score.testable) {
      const double best = candidate.score.directions.front().score;
      const double size = candidate.two_sided ? std::fabs(best) : std::max(best, 0.0);
      candidate.score.statistic = Statistic(size, sum, prepared.degrees, bench.least_variance);
    }
    prepared.candidates.push_back(std::move(candidate));
  }
  return prepared;
}

// One null whose noise is estimated anew: statistics of the testable candidates.
class Refit {
 public:
  Refit(const Workbench& bench, const Prepared& prepared, const NoiseQuestion& question)
      : bench_(bench), prepared_(prepared), question_(question) {}

  std::vector<double> Draw(RandomStream* random) const {
    const Readings& readings = *bench_.readings;
    const int count = static_cast<int>(readings.points.size());
    Eigen::VectorXd noise(count);  // in noise units of the bench
    for (int k = 0; k < count; ++k) {
      const double fresh = random->Normal();
      noise[k] = bench_.used[k] != 0 ? fresh : 0.0;
    }
    Eigen::VectorXd left = noise;
    TakeOut(prepared_.linear.basis, &left);
    std::vector<double> residual(count);
    for (int k = 0; k < count; ++k) residual[k] = left[k] * bench_.sigma[k];
    const Noise again = EstimateNoise(readings, question_.dark, residual, bench_.used,
                                      question_.notes, question_.grids, question_.voltage);
    Eigen::VectorXd weight(count);
    for (int k = 0; k < count; ++k) {
      weight[k] = bench_.used[k] != 0 ? bench_.sigma[k] / again.sigma[k] : 0.0;
    }
    return Statistics(noise, weight);
  }

 private:
  std::vector<double> Statistics(const Eigen::VectorXd& noise,
                                 const Eigen::VectorXd& weight) const {
    const Eigen::MatrixXd jacobian = weight.asDiagonal() * prepared_.linear.basis;
    const Eigen::MatrixXd basis = OrthonormalBasis(jacobian);
    Eigen::VectorXd rest = weight.cwiseProduct(noise);
    TakeOut(basis, &rest);
    const double sum = rest.squaredNorm();
    std::vector<double> statistics;
    for (const Candidate& candidate : prepared_.candidates) {
      if (!candidate.score.testable) continue;
      double size = 0;
      if (candidate.directions.cols() == 0) {
        for (int k = 0; k < rest.size(); ++k) {
          const double room = std::max(1 - basis.row(k).squaredNorm(), 1e-9);
          size = std::max(size, std::fabs(rest[k]) / std::sqrt(room));
        }
      } else {
        Eigen::MatrixXd directions = weight.asDiagonal() * candidate.directions;
        TakeOut(basis, &directions);
        const Eigen::ArrayXd along = TransposedTimes(directions, rest).array() /
                                     directions.colwise().norm().transpose().array().max(1e-12);
        size = candidate.two_sided ? along.abs().maxCoeff() : std::max(along.maxCoeff(), 0.0);
      }
      statistics.push_back(Statistic(size, sum, prepared_.degrees, bench_.least_variance));
    }
    return statistics;
  }

  const Workbench& bench_;
  const Prepared& prepared_;
  const NoiseQuestion& question_;
};

}  // namespace

Eigen::VectorXd Signature(const Workbench& bench, const LawFit& fit, const Effect& effect,
                          const Probe& probe) {
  Law law = fit.law;
  law.effects.push_back(&effect);
  std::vector<double> p = fit.p;
  p.insert(p.end(), probe.begin(), probe.end());
  const int count = static_cast<int>(bench.readings->points.size());
  Eigen::VectorXd moved(count);
  LawWorkspace workspace;
  if (!EvaluateLaw(law, *bench.readings, p.data(), &workspace, moved.data(), nullptr)) {
    return Eigen::VectorXd::Zero(count);
  }
  for (int k = 0; k < count; ++k) moved[k] -= fit.current[k];
  return Whiten(bench, moved);
}

std::vector<Score> ScoreEffects(const Workbench& bench, const LawFit& fit,
                                const std::vector<const Effect*>& candidates, int draws,
                                std::uint64_t seed, const Calibration& calibration) {
  Prepared prepared = PrepareAll(bench, fit, candidates);
  std::vector<Score> scores;
  ListLaw list;
  if (prepared.degrees >= 3) {
    list = CountTheList(
        SimulateNulls(bench, prepared.linear, prepared.candidates, prepared.degrees, draws, seed),
        prepared.degrees, prepared.candidates);
  }
  std::size_t at = 0;
  for (Candidate& candidate : prepared.candidates) {
    Score& score = candidate.score;
    if (score.testable) {
      const NullLaw& law = list.laws[at++];
      score.p_value = law.Of(score.statistic);
      score.charge = 2 * std::log(law.Directions());
      score.catalogue = list.Catalogue();
      score.corrected_p = calibration.Corrected(list.Corrected(score.p_value));
    }
    scores.push_back(std::move(score));
  }
  return scores;
}

Calibration CalibrateScores(const Workbench& bench, const LawFit& fit,
                            const std::vector<const Effect*>& candidates,
                            const NoiseQuestion& question, int draws, std::uint64_t seed) {
  Calibration calibration;
  const Prepared prepared = PrepareAll(bench, fit, candidates);
  if (prepared.degrees < 3) return calibration;
  const ListLaw list = CountTheList(
      SimulateNulls(bench, prepared.linear, prepared.candidates, prepared.degrees, 2 * draws, seed),
      prepared.degrees, prepared.candidates);
  if (list.laws.empty()) return calibration;
  Begin(bench.watch, "nulls", draws);
  const Refit refit(bench, prepared, question);
  RandomStream random(seed, 1);
  for (int d = 0; d < draws && !Stopped(bench.watch); ++d) {
    const std::vector<double> statistics = refit.Draw(&random);
    Step(bench.watch);
    double smallest = 1;
    for (std::size_t c = 0; c < statistics.size(); ++c) {
      smallest = std::min(smallest, list.laws[c].Of(statistics[c]));
    }
    calibration.nulls.push_back(-std::log(std::max(list.Corrected(smallest), 1e-300)));
  }
  std::sort(calibration.nulls.begin(), calibration.nulls.end());
  return calibration;
}

}  // namespace lyrefit
