#include "lyrefit/study/summary.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lyrefit/base/median.h"
#include "lyrefit/base/numbers.h"

namespace lyrefit {
namespace {

constexpr double kEqual = 1e-9;  // relative difference below which two polished RMSEs are equal
constexpr double kClose = 1e-6;

double Mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

// The values of one member over all runs.
template <class T>
std::vector<double> Column(const std::vector<RunRecord>& runs, T RunRecord::*field) {
  std::vector<double> values;
  values.reserve(runs.size());
  for (const RunRecord& run : runs) values.push_back(static_cast<double>(run.*field));
  return values;
}

}  // namespace

std::vector<TracePoint> KeepGains(const std::vector<TracePoint>& trace) {
  std::vector<TracePoint> gains;
  for (const TracePoint& point : trace) {
    if (gains.empty() || point.best < gains.back().best) gains.push_back(point);
  }
  if (!trace.empty() && gains.back().evaluations < trace.back().evaluations) {
    gains.push_back(trace.back());
  }
  return gains;
}

std::int64_t EvaluationsTo(double target, const std::vector<TracePoint>& gains) {
  for (const TracePoint& point : gains) {
    if (point.best <= target) return point.evaluations;
  }
  return -1;
}

std::vector<MedianPoint> MedianCourse(const std::vector<RunOutcome>& outcomes, int marks) {
  CHECK(!outcomes.empty());
  std::int64_t first = 1;
  std::int64_t last = 1;
  for (const RunOutcome& outcome : outcomes) {
    first = std::max(first, outcome.gains.front().evaluations);
    last = std::max(last, outcome.gains.back().evaluations);
  }
  std::vector<std::size_t> at(outcomes.size(), 0);
  std::vector<double> best(outcomes.size());
  std::vector<MedianPoint> course;
  const double ratio = static_cast<double>(last) / static_cast<double>(first);
  for (int m = 0; m < marks; ++m) {
    const double exact = static_cast<double>(first) * std::pow(ratio, m / (marks - 1.0));
    const std::int64_t mark = m + 1 < marks ? std::llround(exact) : last;
    if (!course.empty() && mark <= course.back().evaluations) continue;
    for (std::size_t r = 0; r < outcomes.size(); ++r) {
      const std::vector<TracePoint>& gains = outcomes[r].gains;
      while (at[r] + 1 < gains.size() && gains[at[r] + 1].evaluations <= mark) ++at[r];
      best[r] = gains[at[r]].best;
    }
    course.push_back({mark, Median(best)});
  }
  return course;
}

BestFound BestOf(const std::vector<std::vector<RunOutcome>>& outcomes) {
  BestFound best{kInfinity, {}};
  for (const std::vector<RunOutcome>& of_algorithm : outcomes) {
    for (const RunOutcome& outcome : of_algorithm) {
      const RunRecord& run = outcome.record;
      for (const double rmse :
           {run.polished_A, run.own_polished_A, run.plain_polished_A, run.searched_A}) {
        if (!(rmse < best.rmse_A)) continue;  // also skips NaN
        const bool own = rmse == run.own_polished_A && !outcome.own_parameters.empty();
        best = {rmse, own ? outcome.own_parameters : outcome.parameters};
      }
    }
  }
  return best;
}

RunSpread SpreadOf(std::vector<double> values, double reference) {
  CHECK(!values.empty());
  RunSpread spread;
  const auto unknown = [](double value) { return std::isnan(value); };
  if (std::any_of(values.begin(), values.end(), unknown)) return spread;
  // Sorting makes the sums independent of the order of the runs.
  std::sort(values.begin(), values.end());
  spread.median = Median(values);
  spread.min = values.front();
  spread.max = values.back();
  // Rounding must not move the mean of equal values outside their range.
  spread.mean = std::clamp(Mean(values), spread.min, spread.max);
  double squares = 0;
  for (const double value : values) {
    squares += (value - spread.mean) * (value - spread.mean);
    spread.within_1e9 += value <= reference * (1 + kEqual);
    spread.within_1e6 += value <= reference * (1 + kClose);
  }
  const bool alone = values.size() == 1;
  spread.std = alone ? 0 : std::sqrt(squares / static_cast<double>(values.size() - 1));
  return spread;
}

Ranking RankAll(std::vector<std::vector<double>> values) {
  Ranking ranking;
  if (values.size() < 2 || values[0].size() < 2) return ranking;
  for (std::vector<double>& of_algorithm : values) {
    for (double& value : of_algorithm) {
      value = std::min(value, std::numeric_limits<double>::max());
    }
  }
  ranking.friedman = FriedmanTest(values);
  ranking.pairs = ComparePairs(ranking.friedman, values);
  const int algorithms = static_cast<int>(values.size());
  std::vector<double> p_values;
  for (int a = 0; a < algorithms; ++a) {
    for (int b = a + 1; b < algorithms; ++b) {
      ranking.signed_ranks.push_back({a, b, WilcoxonTest(values[a], values[b]), 1});
      p_values.push_back(ranking.signed_ranks.back().test.p_value);
    }
  }
  const std::vector<double> holm = HolmCorrection(p_values);
  for (std::size_t i = 0; i < holm.size(); ++i) ranking.signed_ranks[i].p_holm = holm[i];
  return ranking;
}

Ranking RankJoined(const std::vector<std::vector<double>>& values) {
  std::vector<double> all;
  for (const auto& one : values) all.insert(all.end(), one.begin(), one.end());
  all = JoinEqual(std::move(all), kEqual);
  std::vector<std::vector<double>> joined;
  auto next = all.begin();
  for (const auto& one : values) {
    const auto end = next + static_cast<std::ptrdiff_t>(one.size());
    joined.emplace_back(next, end);
    next = end;
  }
  return RankAll(std::move(joined));
}

AlgorithmResult Summarise(const ComparedAlgorithm& compared, std::vector<RunOutcome>* outcomes,
                          double reference, double target_gap, bool keep_parameters) {
  AlgorithmResult result;
  result.name = compared.name;
  result.algorithm = compared.algorithm.empty() ? compared.name : compared.algorithm;
  result.search = compared.search;
  result.own = static_cast<bool>(compared.searcher);
  result.kind = compared.kind;
  result.budget = compared.budget;
  for (RunOutcome& outcome : *outcomes) {
    outcome.record.evaluations_to_target =
        EvaluationsTo(reference * (1 + target_gap), outcome.gains);
    result.runs.push_back(outcome.record);
    if (!keep_parameters) continue;
    result.runs.back().parameters = outcome.parameters;
    result.runs.back().own_parameters = outcome.own_parameters;
  }
  result.searched = SpreadOf(Column(result.runs, &RunRecord::searched_A), reference);
  result.plain_polished = SpreadOf(Column(result.runs, &RunRecord::plain_polished_A), reference);
  result.own_polished = SpreadOf(Column(result.runs, &RunRecord::own_polished_A), reference);
  result.polished = SpreadOf(Column(result.runs, &RunRecord::polished_A), reference);
  double evaluations = 0;
  for (const RunRecord& run : result.runs) {
    const bool hit = run.evaluations_to_target >= 0;
    result.target_hits += hit;
    evaluations += static_cast<double>(hit ? run.evaluations_to_target : run.evaluations);
  }
  if (result.target_hits > 0) result.expected_evaluations = evaluations / result.target_hits;
  result.evaluations = Mean(Column(result.runs, &RunRecord::evaluations));
  result.curve_evaluations = Mean(Column(result.runs, &RunRecord::curve_evaluations));
  result.search_seconds = Mean(Column(result.runs, &RunRecord::search_seconds));
  result.polish_seconds = Mean(Column(result.runs, &RunRecord::polish_seconds));
  result.trace = MedianCourse(*outcomes);
  return result;
}

ProblemResult WithAlgorithms(ProblemResult result, const std::vector<ComparedAlgorithm>& algorithms,
                             const CompareOptions& options,
                             std::vector<std::vector<RunOutcome>> outcomes) {
  std::vector<int> done(options.runs, 0);  // number of algorithms that have done the run
  for (std::size_t c = 0; c < algorithms.size(); ++c) {
    if (outcomes[c].empty()) continue;
    for (const RunOutcome& outcome : outcomes[c]) ++done[outcome.record.run];
    result.algorithms.push_back(Summarise(algorithms[c], &outcomes[c], result.reference.rmse_A,
                                          options.target_gap, !result.problem.empty()));
  }
  if (!options.rankings) return result;
  std::vector<std::vector<double>> searched, polished;
  for (const AlgorithmResult& compared : result.algorithms) {
    searched.emplace_back();
    polished.emplace_back();
    for (const RunRecord& run : compared.runs) {
      if (done[run.run] < static_cast<int>(result.algorithms.size())) continue;
      searched.back().push_back(run.searched_A);
      polished.back().push_back(run.polished_A);
    }
  }
  result.searched = RankAll(std::move(searched));
  if (options.polish) result.polished = RankJoined(polished);
  return result;
}

}  // namespace lyrefit
