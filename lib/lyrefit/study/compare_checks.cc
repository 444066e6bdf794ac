#include "lyrefit/study/compare_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "lyrefit/base/parallel.h"

namespace lyrefit {
namespace {

constexpr int kMostRuns = 1000000;

Expected<void> CheckOptions(std::size_t curves, std::size_t algorithms,
                            const CompareOptions& options) {
  if (curves == 0) return Fail("no curve to compare on");
  if (options.models.empty()) return Fail("no model to compare on");
  for (auto model = options.models.begin(); model != options.models.end(); ++model) {
    if (std::find(options.models.begin(), model, *model) == model) continue;
    return Fail(fmt::format("the model {} is named twice", ToText(*model)));
  }
  if (options.runs < 1 || options.runs > kMostRuns) {
    return Fail(fmt::format("runs = {} is outside [1, {}]", options.runs, kMostRuns));
  }
  if (options.multistart < 0 || options.multistart > kMostRuns) {
    return Fail(fmt::format("multistart = {} is outside [0, {}]", options.multistart, kMostRuns));
  }
  if (auto threads = ValidateThreads(options.threads); !threads) return threads;
  if (!(options.target_gap > 0 && options.target_gap < kInfinity)) {
    return Fail(fmt::format("target-gap = {:g} must be above 0", options.target_gap));
  }
  const double jobs = static_cast<double>(curves) * static_cast<double>(options.models.size()) *
                      static_cast<double>(algorithms) * options.runs;
  if (jobs > std::numeric_limits<int>::max()) return Fail("more than 2147483647 runs in all");
  return {};
}

Expected<void> CheckAlgorithms(const std::vector<ComparedAlgorithm>& algorithms) {
  if (algorithms.empty()) return Fail("no algorithm to compare");
  for (auto compared = algorithms.begin(); compared != algorithms.end(); ++compared) {
    if (compared->name.empty()) return Fail("an algorithm has no name");
    const bool twice =
        std::any_of(algorithms.begin(), compared,
                    [&](const ComparedAlgorithm& other) { return other.name == compared->name; });
    if (twice) return Fail(fmt::format("the algorithm {} is named twice", compared->name));
    if (auto valid = ValidateOptions(compared->search, kSearchOptionTable); !valid) {
      return Fail(fmt::format("{}: {}", compared->name, valid.error().message));
    }
  }
  return {};
}

}  // namespace

Expected<void> CheckComparison(const std::vector<CompareCurve>& curves,
                               const std::vector<ComparedAlgorithm>& algorithms,
                               const CompareOptions& options) {
  if (auto checked = CheckAlgorithms(algorithms); !checked) return checked;
  return CheckOptions(curves.size(), algorithms.size(), options);
}

}  // namespace lyrefit
