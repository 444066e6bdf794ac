#include "lyrefit/study/compare_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "lyrefit/base/parallel.h"

namespace lyrefit {
namespace {

constexpr int kMostRuns = 1000000;

Expected<void> CheckOptions(std::size_t curves, std::size_t contenders,
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
                      static_cast<double>(contenders) * options.runs;
  if (jobs > std::numeric_limits<int>::max()) return Fail("more than 2147483647 runs in all");
  return {};
}

Expected<void> CheckContenders(const std::vector<Contender>& contenders) {
  if (contenders.empty()) return Fail("no algorithm to compare");
  for (auto contender = contenders.begin(); contender != contenders.end(); ++contender) {
    if (contender->name.empty()) return Fail("an algorithm has no name");
    const bool twice = std::any_of(contenders.begin(), contender, [&](const Contender& other) {
      return other.name == contender->name;
    });
    if (twice) return Fail(fmt::format("the algorithm {} is named twice", contender->name));
    if (auto valid = ValidateOptions(contender->search, kSearchOptionTable); !valid) {
      return Fail(fmt::format("{}: {}", contender->name, valid.error().message));
    }
  }
  return {};
}

}  // namespace

Expected<void> CheckComparison(const std::vector<CompareCurve>& curves,
                               const std::vector<Contender>& contenders,
                               const CompareOptions& options) {
  if (auto checked = CheckContenders(contenders); !checked) return checked;
  const bool hard = std::any_of(contenders.begin(), contenders.end(),
                                [](const Contender& c) { return c.candidates != SearchVariables::kAll; });
  const bool family = std::any_of(curves.begin(), curves.end(),
                                  [](const CompareCurve& curve) { return curve.set.has_value(); });
  if (hard && family) return Fail("candidates hard is for curves: families are searched completely");
  return CheckOptions(curves.size(), contenders.size(), options);
}

}  // namespace lyrefit
