#include "lyrefit/diagnose/score.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "lyrefit/base/random.h"
#include "lyrefit/diagnose/null_statistics.h"

namespace lyrefit {
namespace {

using Draws = Eigen::Map<const Eigen::MatrixXf>;

// Normal numbers of one random stream. Every measurement uses its first numbers, so the last ones
// drawn are kept for the next measurement of a batch.
class NormalNumbers {
 public:
  explicit NormalNumbers(std::uint64_t run) : run_(run) {}

  std::shared_ptr<const std::vector<float>> First(std::size_t count, std::uint64_t seed) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (seed_ == seed && drawn_ != nullptr && drawn_->size() >= count) return drawn_;
    auto drawn = std::make_shared<std::vector<float>>(count);
    RandomStream random(seed, run_);
    for (float& number : *drawn) number = static_cast<float>(random.Normal());
    seed_ = seed;
    drawn_ = std::move(drawn);
    return drawn_;
  }

 private:
  std::uint64_t run_;
  std::uint64_t seed_ = 0;
  std::mutex mutex_;
  std::shared_ptr<const std::vector<float>> drawn_;
};

// Streams for linear null statistics and for those with re-estimated noise.
NormalNumbers& NumbersOfNulls() {
  static NormalNumbers numbers(0);
  return numbers;
}
NormalNumbers& NumbersOfRefits() {
  static NormalNumbers numbers(1);
  return numbers;
}

// p-value by the F tail of one direction, times the number of directions.
void CountDirections(const CandidateEffect& candidate, int degrees, Score* score) {
  const double directions = std::max<double>(candidate.directions.cols(), 1);
  score->p_value = std::min(1.0, directions * TailOf(score->statistic, degrees));
  score->charge = 2 * std::log(directions);
}

// `list` has fewer draws than the list that is calibrated. Its larger scatter makes the calibration
// conservative.
Calibration Calibrate(const WeightedData& weighted, const Prepared& prepared,
                      const ListDistribution& list, const NoiseEstimator& noise,
                      const Draws& draws) {
  Calibration calibration;
  weighted.progress.Begin("null statistics", draws.cols());
  const Eigen::MatrixXf null_statistics = SimulateRefits(weighted, prepared, noise, draws);
  for (int d = 0; d < null_statistics.rows(); ++d) {
    double smallest = 1;
    for (int c = 0; c < null_statistics.cols(); ++c) {
      smallest = std::min(smallest, list.laws[c].Of(null_statistics(d, c)));
    }
    calibration.null_statistics.push_back(-std::log(std::max(list.Corrected(smallest), 1e-300)));
  }
  std::sort(calibration.null_statistics.begin(), calibration.null_statistics.end());
  return calibration;
}

}  // namespace

ScoreCalibration CalibrateScores(const WeightedData& weighted, const Prepared& prepared,
                                 const NoiseEstimator* noise, int draws, std::uint64_t seed) {
  ScoreCalibration calibration;
  if (prepared.degrees < 3) return calibration;
  for (const CandidateEffect& candidate : prepared.candidates) {
    if (candidate.score.testable) calibration.effects.push_back(candidate.score.effect);
  }
  if (calibration.effects.empty()) return calibration;
  // One row per reading, one column per draw.
  const int readings = static_cast<int>(weighted.sigma.size());
  const std::size_t numbers = static_cast<std::size_t>(readings) * draws;
  const auto normal = NumbersOfNulls().First(numbers, seed);
  const Eigen::MatrixXf null_statistics =
      SimulateNullDistribution(weighted, prepared, Draws(normal->data(), readings, draws));
  calibration.list = ListDistribution(null_statistics, prepared.degrees);
  if (noise == nullptr) return calibration;
  const auto others = NumbersOfRefits().First(numbers / 5, seed);
  calibration.calibration =
      Calibrate(weighted, prepared,
                ListDistribution(null_statistics.topRows(draws / 5 * 2), prepared.degrees), *noise,
                Draws(others->data(), readings, draws / 5));
  return calibration;
}

std::vector<Score> JudgeScores(const Prepared& prepared, const ScoreCalibration& calibration) {
  std::vector<Score> scores;
  for (const CandidateEffect& candidate : prepared.candidates) {
    Score score = candidate.score;
    if (score.testable) {
      const auto at =
          std::find(calibration.effects.begin(), calibration.effects.end(), score.effect);
      if (at != calibration.effects.end()) {
        const NullDistribution& law = calibration.list.laws[at - calibration.effects.begin()];
        score.p_value = law.Of(score.statistic);
        score.charge = 2 * std::log(law.Directions());
      } else {
        CountDirections(candidate, prepared.degrees, &score);
      }
      if (!calibration.effects.empty()) {
        score.catalogue = calibration.list.Catalogue();
        score.corrected_p =
            calibration.calibration.Corrected(calibration.list.Corrected(score.p_value));
      }
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
