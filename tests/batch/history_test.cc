#include "lyrefit/batch/history.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "../error_of.h"
#include "strings.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

TEST(History, IsThatOfTheSameString) {
  const TempFolder folder;
  std::string reference;
  for (int i = 0; i < 12; ++i) {
    SyntheticString sweep{fmt::format("inv/str1/sweep{}", i)};
    sweep.isc_A = 8 + 0.1 * i;
    sweep.irradiance_W_m2 = 1000 * sweep.isc_A / 9;
    reference += RowOf(sweep);
  }
  const auto old = OpenBatch({folder.Write("reference.jsonl", reference)});
  ASSERT_TRUE(old);
  const auto sweeps = ReadReferences(old->get(), {});
  ASSERT_TRUE(sweeps) << sweeps.error().ToString();
  const std::string file =
      folder.Write("now.jsonl", RowOf({"inv/str1", 8.5}) + RowOf({"inv/str2", 8.5}));  // soiled
  const std::string out = folder.Path("out");
  const auto done = RunOn(file, WithHistory(CountTask(), *sweeps, {}), Into(out));
  ASSERT_TRUE(done) << done.error().ToString();
  std::ifstream lines(out + "/results.jsonl");
  std::string line;
  std::getline(lines, line);
  const auto first = nlohmann::json::parse(line);
  EXPECT_EQ(first["history_sweeps"], 12) << line;
  EXPECT_LT(first["history_p"].get<double>(), 0.01) << line;
  EXPECT_THAT(first["history_sentence"].get<std::string>(), HasSubstr("current per light -5.6 %"));
  std::getline(lines, line);
  const auto second = nlohmann::json::parse(line);
  EXPECT_EQ(second["history_sweeps"], 0);
  EXPECT_EQ(second["history_sentence"], "no reference sweep has this id");
}

TEST(History, WithoutASweepThatCanBeReadIsAnError) {
  const TempFolder folder;
  const auto old = OpenBatch({folder.Write("h.jsonl", "{\"id\":\"a\",\"voltage_V\":[\n")});
  ASSERT_TRUE(old) << old.error().ToString();
  EXPECT_FALSE(ReadReferences(old->get(), {}));
}

}  // namespace
}  // namespace lyrefit
