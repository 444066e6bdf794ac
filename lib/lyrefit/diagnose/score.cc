#include "lyrefit/diagnose/score.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "lyrefit/base/random.h"
#include "lyrefit/diagnose/nulls.h"

namespace lyrefit {
namespace {

using Draws = Eigen::Map<const Eigen::MatrixXf>;

// Numbers of one stream, of which every measurement needs the first so many: those drawn last are
// kept, for the next of a batch.
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

// Of the nulls, and of those that estimate their noise anew.
NormalNumbers& NumbersOfNulls() {
  static NormalNumbers numbers(0);
  return numbers;
}
NormalNumbers& NumbersOfRefits() {
  static NormalNumbers numbers(1);
  return numbers;
}

// By the tail of one direction, counted as often as it has any.
void CountDirections(const Candidate& candidate, int degrees, Score* score) {
  const double directions = std::max<double>(candidate.directions.cols(), 1);
  score->p_value = std::min(1.0, directions * TailOf(score->statistic, degrees));
  score->charge = 2 * std::log(directions);
}

// `list`: a smaller one than what is to be calibrated, so that it scatters more and errs to the
// safe side.
Calibration Calibrate(const Workbench& bench, const Prepared& prepared, const ListLaw& list,
                      const NoiseEstimator& noise, const Draws& draws) {
  Calibration calibration;
  Begin(bench.watch, "nulls", draws.cols());
  const Eigen::MatrixXf nulls = SimulateRefits(bench, prepared, noise, draws);
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

}  // namespace

ScoreWorth SimulateWorth(const Workbench& bench, const Prepared& prepared,
                         const NoiseEstimator* noise, int draws, std::uint64_t seed) {
  ScoreWorth worth;
  if (prepared.degrees < 3) return worth;
  for (const Candidate& candidate : prepared.candidates) {
    if (candidate.score.testable) worth.effects.push_back(candidate.score.effect);
  }
  if (worth.effects.empty()) return worth;
  // A row a reading and a column a null.
  const int readings = static_cast<int>(bench.sigma.size());
  const std::size_t numbers = static_cast<std::size_t>(readings) * draws;
  const auto normal = NumbersOfNulls().First(numbers, seed);
  const Eigen::MatrixXf nulls =
      SimulateNulls(bench, prepared, Draws(normal->data(), readings, draws));
  worth.list = ListLaw(nulls, prepared.degrees);
  if (noise == nullptr) return worth;
  const auto others = NumbersOfRefits().First(numbers / 5, seed);
  worth.calibration =
      Calibrate(bench, prepared, ListLaw(nulls.topRows(draws / 5 * 2), prepared.degrees), *noise,
                Draws(others->data(), readings, draws / 5));
  return worth;
}

std::vector<Score> JudgeScores(const Prepared& prepared, const ScoreWorth& worth) {
  std::vector<Score> scores;
  for (const Candidate& candidate : prepared.candidates) {
    Score score = candidate.score;
    if (score.testable) {
      const auto at = std::find(worth.effects.begin(), worth.effects.end(), score.effect);
      if (at != worth.effects.end()) {
        const NullLaw& law = worth.list.laws[at - worth.effects.begin()];
        score.p_value = law.Of(score.statistic);
        score.charge = 2 * std::log(law.Directions());
      } else {
        CountDirections(candidate, prepared.degrees, &score);
      }
      if (!worth.effects.empty()) {
        score.catalogue = worth.list.Catalogue();
        score.corrected_p = worth.calibration.Corrected(worth.list.Corrected(score.p_value));
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
