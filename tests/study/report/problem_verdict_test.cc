#include "lyrefit/study/verdict.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "cases.h"
#include "lyrefit/study/verdict.h"
#include "study/synthetic_summary.h"

namespace lyrefit {
namespace {

// Of "RUNS: ALGORITHM BUDGET OWN HYBRID MS; ...": how many of the runs, each of a device, hit after the
// polish of the best candidate and with all starts, and the time of a search.
std::string VerdictOf(const std::string& given) {
  std::istringstream rows(given.substr(given.find(':') + 1));
  const int count = std::stoi(given);
  std::vector<std::vector<AlgorithmResult>> devices(count);
  std::string algorithm, separator;
  std::int64_t budget = 0;
  double search_ms = 0;
  for (int own = 0, hybrid = 0; rows >> algorithm >> budget >> own >> hybrid >> search_ms;) {
    for (int d = 0; d < count; ++d) {
      const SyntheticRun run = {9, d < own ? 1.0 : 2, d < hybrid ? 1.0 : 2};
      devices[d].push_back(SyntheticAlgorithm(algorithm, budget, {run}, search_ms));
    }
    rows >> separator;
  }
  std::vector<ProblemResult> problems;
  for (int d = 0; d < count; ++d) {
    problems.push_back(SyntheticDevice("x " + std::to_string(d), "x", std::move(devices[d])));
  }
  const Comparison comparison = SyntheticComparison(std::move(problems));
  const auto summaries = SummariseProblems(comparison);
  return VerdictText(summaries[0]) + "\n" + PeerText(summaries[0]);
}

TEST(VerdictText, SaysWhichSearchWillDoAndHowItStandsBesidePeers) {
  CheckCases("study_verdicts",
             {{"verdict", VerdictOf}, {"enough of", [](const std::string& runs) {
                                         return std::to_string(EnoughHits(std::stoi(runs)));
                                       }}});
}

}  // namespace
}  // namespace lyrefit
