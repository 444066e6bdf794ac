#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "run_app.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

// The help of a verb with its line breaks replaced by spaces.
std::string HelpOf(const std::string& verb) {
  std::istringstream words(RunApp(verb + " --help").out);
  std::string text, word;
  while (words >> word) text += word + " ";
  return text;
}

#ifdef LYREFIT_HAS_PAGMO

TEST(Pagmo, HelpNamesThePeersThatAreIn) {
  EXPECT_THAT(HelpOf("compare"), HasSubstr("pagmo:NAME with NAME one of de, sade"));
}

const char kEverybody[] =
    "pagmo:de,pagmo:sade,pagmo:de1220,pagmo:cmaes,pagmo:xnes,pagmo:pso,pagmo:pso_gen,pagmo:gwo,"
    "pagmo:bee_colony,pagmo:gaco,pagmo:sga,pagmo:ihs,pagmo:sea,pagmo:simulated_annealing";

TEST(Pagmo, EveryAlgorithmSpendsTheSameBudgetFromTheSameFirstPoints) {
  const std::vector<std::pair<std::string, int>> budgets = {
      {"--iterations 30", 40 * 31}, {"--iterations 30 --max-evaluations 777", 777}};
  for (const auto& [budget, evaluations] : budgets) {
    const json j = CompareJson(kRtc + " --models dd --runs 1 --population 40 --algorithms mlo," +
                               kEverybody + " " + budget);
    const json& algorithms = j["problems"][0]["algorithms"];
    ASSERT_EQ(algorithms.size(), 15U);
    const json first = algorithms[0]["median_trace"]["best_A"][0];
    for (std::size_t c = 1; c < algorithms.size(); ++c) {
      const json& compared = algorithms[c];
      SCOPED_TRACE(compared["name"].dump() + " " + budget);
      EXPECT_EQ(compared["runs"][0]["evaluations"], evaluations);
      EXPECT_EQ(compared["median_trace"]["evaluations"][0], 40);
      EXPECT_EQ(compared["median_trace"]["best_A"][0], first);
      EXPECT_DOUBLE_EQ(compared["median_trace"]["best_A"].back().get<double>(),
                       compared["runs"][0]["searched_A"].get<double>());
      EXPECT_LE(compared["runs"][0]["searched_A"], first);
    }
  }
}

TEST(Pagmo, GivesTheSameBitsForTheSameSeedOnAnyNumberOfThreads) {
  const std::string arguments =
      std::string("--models sd --runs 3 --population 20 --iterations 20 --algorithms ") +
      kEverybody;
  json one = CompareJson(kRtc + " " + arguments + " --seed 6 --threads 1");
  json two = CompareJson(kRtc + " " + arguments + " --seed 6 --threads 2");
  json other = CompareJson(kRtc + " " + arguments + " --seed 7");
  RemoveSeconds(&one);
  RemoveSeconds(&two);
  EXPECT_EQ(one, two) << json::diff(one, two).dump();
  for (int c = 0; c < 14; ++c) {
    const auto searched = [c](const json& j) {
      return j["problems"][0]["algorithms"][c]["runs"][0]["searched_A"];
    };
    EXPECT_NE(searched(one), searched(other)) << kEverybody;
  }
}

TEST(Pagmo, RefusesWhatItDoesNotKnowOrCannotDo) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"pagmo:bee", "pagmo:bee: expected one of de, sade"},
      {"pagmo:", "expected one of de, sade"},
      {"pagmo:de1220 --population 5", "pagmo:de1220 with a population of 5: "},
      {"pagmo:de,pagmo:de", "the algorithm pagmo:de is named twice"},
  };
  for (const auto& [flags, says] : cases) {
    const AppResult result = RunApp("compare " + kRtc + " --algorithms " + flags);
    EXPECT_EQ(result.exit_code, 1) << flags;
    EXPECT_THAT(result.err, HasSubstr(says)) << flags;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << flags;
  }
}

#else

TEST(Pagmo, HelpSaysThatNoPeersAreInAndHowToGetThem) {
  EXPECT_THAT(HelpOf("compare"),
              HasSubstr("none of which is in this build: install libpagmo-dev and build again"));
}

TEST(Pagmo, IsAskedForWhereTheBuildHasNone) {
  const AppResult result = RunApp("compare " + kRtc + " --algorithms mlo,pagmo:de");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("this build has no pagmo2: install libpagmo-dev"));
}

#endif

}  // namespace
}  // namespace lyrefit
