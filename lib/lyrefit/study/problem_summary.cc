#include "lyrefit/study/problem_summary.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "lyrefit/base/median.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/study/summary.h"

namespace lyrefit {
namespace {

// A run and its device.
struct SummaryRun {
  const ProblemResult* device = nullptr;
  const RunRecord* run = nullptr;
  double Ratio(PolishLevel level) const {
    const double ratio = RmseAt(*run, level) / device->reference.rmse_A;
    return std::min(ratio, 1e300);
  }
};

const std::vector<double>& ParametersAt(const RunRecord& run, PolishLevel level) {
  static const std::vector<double> kNone;
  if (level == PolishLevel::kOwn) return run.own_parameters;
  return level == PolishLevel::kHybrid ? run.parameters : kNone;
}

// Runs of one device that ended in the same wrong local optimum.
struct WrongOptimum {
  const ProblemResult* device;
  double ratio;  // RMSE / reference, the lowest of these runs
  int runs;
};

std::vector<WrongOptimum> GroupByEnd(std::vector<SummaryRun> runs, PolishLevel level) {
  std::stable_sort(runs.begin(), runs.end(), [&](const SummaryRun& a, const SummaryRun& b) {
    if (a.device != b.device) return a.device < b.device;
    return a.Ratio(level) < b.Ratio(level);
  });
  std::vector<WrongOptimum> local_optima;
  double last = 0;
  for (const SummaryRun& run : runs) {
    const double ratio = run.Ratio(level);
    const bool same = !local_optima.empty() && local_optima.back().device == run.device &&
                      ratio <= last * (1 + kHit);
    if (same) {
      ++local_optima.back().runs;
    } else {
      local_optima.push_back({run.device, ratio, 1});
    }
    last = ratio;
  }
  return local_optima;
}

Failures SumUpFailures(const std::vector<SummaryRun>& missed, PolishLevel level) {
  Failures failures;
  failures.runs = static_cast<int>(missed.size());
  if (missed.empty()) return failures;
  const std::vector<WrongOptimum> local_optima = GroupByEnd(missed, level);
  failures.local_optima = static_cast<int>(local_optima.size());
  const auto rarer = [](const WrongOptimum& a, const WrongOptimum& b) {
    return a.runs != b.runs ? a.runs < b.runs : a.ratio > b.ratio;
  };
  const WrongOptimum& commonest =
      *std::max_element(local_optima.begin(), local_optima.end(), rarer);
  failures.commonest = commonest.runs;
  failures.commonest_device = commonest.device->curve_name;
  failures.commonest_excess = commonest.ratio - 1;
  std::vector<double> excess, deviations;
  for (const SummaryRun& run : missed) {
    excess.push_back(run.Ratio(level) - 1);
    const Deviation deviation = LargestDeviation(*run.device, ParametersAt(*run.run, level));
    if (deviation.parameter < 0) continue;
    deviations.push_back(deviation.value);
    if (deviation.value < failures.worst_deviation) continue;  // false while worst_deviation is NaN
    failures.worst_deviation = deviation.value;
    failures.worst_parameter = run.device->parameters[deviation.parameter];
  }
  failures.worst_excess = *std::max_element(excess.begin(), excess.end());
  failures.median_excess = Median(std::move(excess));
  if (!deviations.empty()) failures.median_deviation = Median(std::move(deviations));
  return failures;
}

std::optional<LevelSummary> ProblemLevel(const std::vector<SummaryRun>& runs, PolishLevel level) {
  std::vector<double> ratios, seconds;
  std::vector<SummaryRun> missed;
  for (const SummaryRun& run : runs) {
    const double ratio = run.Ratio(level);
    if (std::isnan(RmseAt(*run.run, level))) return {};
    ratios.push_back(ratio);
    seconds.push_back(SecondsAt(*run.run, level));
    if (ratio > 1 + kHit) missed.push_back(run);
  }
  LevelSummary summarised;
  summarised.runs = static_cast<int>(runs.size());
  summarised.hits = summarised.runs - static_cast<int>(missed.size());
  summarised.excess = SpreadOf(std::move(ratios), 1);
  for (double* figure : {&summarised.excess.min, &summarised.excess.mean, &summarised.excess.median,
                         &summarised.excess.max}) {
    *figure -= 1;
  }
  const bool timed =
      std::none_of(seconds.begin(), seconds.end(), [](double value) { return std::isnan(value); });
  if (timed) summarised.seconds = Median(std::move(seconds));
  summarised.failures = SumUpFailures(missed, level);
  return summarised;
}

AlgorithmSummary Summarise(const AlgorithmResult& compared, const std::vector<SummaryRun>& runs) {
  AlgorithmSummary summarised;
  summarised.name = compared.name;
  summarised.algorithm = compared.algorithm;
  summarised.kind = compared.kind;
  summarised.budget = compared.budget;
  std::vector<double> evaluations, of_curves;
  for (const SummaryRun& run : runs) {
    evaluations.push_back(static_cast<double>(run.run->evaluations));
    of_curves.push_back(static_cast<double>(run.run->curve_evaluations));
  }
  summarised.evaluations = Median(std::move(evaluations));
  summarised.curve_evaluations = Median(std::move(of_curves));
  for (const PolishLevel level : kPolishLevels) {
    if (compared.kind != AlgorithmKind::kSearch && level != PolishLevel::kHybrid) continue;
    summarised.levels[static_cast<std::size_t>(level)] = ProblemLevel(runs, level);
  }
  return summarised;
}

// Order: by the first device that has the algorithm, then by its position there.
std::vector<AlgorithmSummary> SummariseAlgorithms(
    const std::vector<const ProblemResult*>& devices) {
  std::vector<AlgorithmSummary> done;
  for (const ProblemResult* first : devices) {
    for (const AlgorithmResult& compared : first->algorithms) {
      if (std::any_of(done.begin(), done.end(),
                      [&](const auto& other) { return other.name == compared.name; })) {
        continue;
      }
      std::vector<SummaryRun> runs;
      for (const ProblemResult* device : devices) {
        for (const AlgorithmResult& same : device->algorithms) {
          if (same.name != compared.name) continue;
          for (const RunRecord& run : same.runs) runs.push_back({device, &run});
        }
      }
      done.push_back(Summarise(compared, runs));
    }
  }
  return done;
}

}  // namespace

double RmseAt(const RunRecord& run, PolishLevel level) {
  switch (level) {
    case PolishLevel::kSearch:
      return run.searched_A;
    case PolishLevel::kPlain:
      return run.plain_polished_A;
    case PolishLevel::kOwn:
      return run.own_polished_A;
    case PolishLevel::kHybrid:
      return run.polished_A;
  }
  return kUnknown;
}

double SecondsAt(const RunRecord& run, PolishLevel level) {
  switch (level) {
    case PolishLevel::kSearch:
      return run.search_seconds;
    case PolishLevel::kPlain:
      return run.search_seconds + run.plain_seconds;
    case PolishLevel::kOwn:
      return run.search_seconds + run.own_seconds;
    case PolishLevel::kHybrid:
      return run.search_seconds + run.polish_seconds;
  }
  return kUnknown;
}

Deviation LargestDeviation(const ProblemResult& device, const std::vector<double>& parameters) {
  const std::vector<double>& there = device.reference.parameters;
  Deviation largest;
  if (parameters.size() != there.size()) return largest;
  const std::size_t begin = std::max(device.first_effect, 0);
  for (std::size_t i = begin; i < there.size() && i < device.parameters.size(); ++i) {
    const double apart = std::fabs(parameters[i] - there[i]);
    double value = there[i] == 0 ? 1.0 : apart / std::fabs(there[i]);
    if (apart == 0) value = 0;
    if (value <= largest.value) continue;  // false while largest.value is NaN
    largest = {value, static_cast<int>(i)};
  }
  return largest;
}

std::vector<ProblemSummary> SummariseProblems(const Comparison& comparison) {
  std::vector<ProblemSummary> summaries;
  for (const ProblemResult& device : comparison.problems) {
    if (device.problem.empty()) continue;
    auto summary =
        std::find_if(summaries.begin(), summaries.end(),
                     [&](const ProblemSummary& other) { return other.name == device.problem; });
    if (summary == summaries.end()) {
      summaries.emplace_back();
      summary = summaries.end() - 1;
      summary->name = device.problem;
    }
    summary->devices.push_back(&device);
    summary->certified += device.reference.certified;
  }
  for (ProblemSummary& summary : summaries) {
    summary.algorithms = SummariseAlgorithms(summary.devices);
  }
  return summaries;
}

namespace {

// The searches of a budget, in the order of the comparison.
std::vector<std::string> SearchesOf(const std::vector<const ProblemSummary*>& summaries,
                                    std::int64_t budget) {
  std::vector<std::string> names;
  for (const ProblemSummary* summary : summaries) {
    for (const AlgorithmSummary& compared : summary->algorithms) {
      if (compared.kind != AlgorithmKind::kSearch || compared.budget != budget) continue;
      if (std::find(names.begin(), names.end(), compared.algorithm) != names.end()) continue;
      names.push_back(compared.algorithm);
    }
  }
  return names;
}

// Appends the figures of one device, run by run, for the runs that all searches have done.
void AddBlocks(const ProblemResult& device, const SummaryRanking& ranking, PolishLevel level,
               std::vector<std::vector<double>>* values) {
  std::map<int, std::vector<double>> blocks;  // by run
  for (const std::string& name : ranking.names) {
    for (const AlgorithmResult& compared : device.algorithms) {
      if (compared.algorithm != name || compared.budget != ranking.budget) continue;
      for (const RunRecord& run : compared.runs) {
        const double rmse = RmseAt(run, level);
        if (!std::isnan(rmse)) {
          blocks[run.run].push_back(std::min(rmse / device.reference.rmse_A, 1e300));
        }
      }
    }
  }
  for (auto& [run, block] : blocks) {
    if (block.size() != ranking.names.size()) continue;
    block = JoinEqual(std::move(block), kHit);
    for (std::size_t c = 0; c < block.size(); ++c) (*values)[c].push_back(block[c]);
  }
}

Ranking RankLevel(const std::vector<const ProblemSummary*>& summaries,
                  const SummaryRanking& ranking, PolishLevel level) {
  std::vector<std::vector<double>> values(ranking.names.size());
  for (const ProblemSummary* summary : summaries) {
    for (const ProblemResult* device : summary->devices)
      AddBlocks(*device, ranking, level, &values);
  }
  return RankAll(std::move(values));
}

void AddRankings(const std::vector<const ProblemSummary*>& summaries, const std::string& problem,
                 std::vector<SummaryRanking>* rankings) {
  std::set<std::int64_t> budgets;
  for (const ProblemSummary* summary : summaries) {
    for (const AlgorithmSummary& compared : summary->algorithms) {
      if (compared.budget > 0) budgets.insert(compared.budget);
    }
  }
  for (const std::int64_t budget : budgets) {
    SummaryRanking ranking{problem, budget, SearchesOf(summaries, budget), {}, {}};
    ranking.searched = RankLevel(summaries, ranking, PolishLevel::kSearch);
    ranking.own = RankLevel(summaries, ranking, PolishLevel::kOwn);
    if (ranking.searched.friedman.algorithms > 0) rankings->push_back(std::move(ranking));
  }
}

}  // namespace

std::vector<SummaryRanking> RankProblems(const std::vector<ProblemSummary>& summaries) {
  std::vector<SummaryRanking> rankings;
  std::vector<const ProblemSummary*> all;
  all.reserve(summaries.size());
  for (const ProblemSummary& summary : summaries) all.push_back(&summary);
  if (all.size() > 1) AddRankings(all, "", &rankings);
  for (const ProblemSummary* summary : all) AddRankings({summary}, summary->name, &rankings);
  return rankings;
}

}  // namespace lyrefit
