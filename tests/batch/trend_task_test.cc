#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "../error_of.h"
#include "repeats.h"
#include "strings.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

// Three modules of data/trend/plant, and a table without a sweep.
class TrendTaskTest : public testing::Test {
 protected:
  TrendTaskTest() {
    std::filesystem::copy(std::filesystem::path(LYREFIT_DATA_DIR) / "trend" / "plant",
                          folder_.Path("plant"), std::filesystem::copy_options::recursive);
    folder_.Write("plant/roof/comb2/mod2.csv", "date,voltage_V,current_A\nno sweep\n");
  }

  Expected<BatchSummary> Run(const BatchOptions& options, const Observer& observer = {}) const {
    BatchReadOptions reading;
    reading.shard = options.shard;
    reading.reading.whole_files = true;
    auto source = OpenBatch({folder_.Path("plant")}, reading);
    if (!source) return tl::unexpected(source.error());
    return RunBatch(source->get(), TrendTask({}), options, observer);
  }

  std::vector<nlohmann::json> Rows(const std::string& out) const {
    std::vector<nlohmann::json> rows;
    std::istringstream lines(FileText(folder_.Path(out) + "/results.jsonl"));
    for (std::string line; std::getline(lines, line);) rows.push_back(nlohmann::json::parse(line));
    return rows;
  }

  TempFolder folder_;
};

TEST_F(TrendTaskTest, EachFileIsADeviceWithARowOfItsTrend) {
  const auto summary = Run(Into(folder_.Path("out")));
  ASSERT_TRUE(summary) << MessageOf(summary);
  const std::vector<nlohmann::json> rows = Rows("out");
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0]["id"], "roof/comb1/mod1");
  for (int r = 0; r < 3; ++r) {
    EXPECT_EQ(rows[r]["status"], "fine") << rows[r]["reason"];
    EXPECT_GT(rows[r]["measurements"], rows[r]["measurements_used"].get<int>());
    EXPECT_GT(rows[r]["reference_power_W"], 240);
    EXPECT_TRUE(rows[r]["p_mp_rate_percent"].is_null()) << "below a year";
    for (const std::string loss : {"loss_", "loss_now_"}) {
      double parts = 0;
      for (const char* part :
           {"light", "resistance_series", "recombination", "shunt", "mismatch"}) {
        parts += rows[r][loss + part + "_percent"].get<double>();
      }
      // Each part is against its own clean reference days, known to 0.1 %.
      EXPECT_NEAR(parts, rows[r][loss + "total_percent"].get<double>(), 1e-9) << loss;
    }
  }
  EXPECT_EQ(rows[0]["onsets"], 0);
  for (const char* name : {"cause", "cause_about", "onset_date", "recoverable_power_W"}) {
    EXPECT_TRUE(rows[0][name].is_null()) << name;
  }
  // A bypass diode of three fails on day 50.
  EXPECT_EQ(rows[1]["cause"], "lost_substrings");
  EXPECT_EQ(rows[1]["cause_title"], "1 of 3 substrings without voltage");
  EXPECT_EQ(rows[1]["largest_loss"], "mismatch");
  EXPECT_GE(rows[1]["onset_date"], "2025-02-19");
  EXPECT_LE(rows[1]["onset_date"], "2025-02-22");
  const double third_W = rows[1]["reference_power_W"].get<double>() / 3;
  EXPECT_NEAR(rows[1]["recoverable_power_W"].get<double>(), third_W, 0.03 * third_W);
  // Potential-induced degradation from day 40 on.
  EXPECT_THAT(rows[2]["cause"].get<std::string>(),
              testing::AnyOf("growing_shunt", "potential_induced_degradation"));
  EXPECT_EQ(rows[2]["cause_about"], "device");
  EXPECT_EQ(rows[2]["largest_loss"], "shunt");
  EXPECT_TRUE(rows[2]["conductance_shunt_rate_S_low_95"].is_null());
}

TEST_F(TrendTaskTest, BrokenFileIsABrokenRow) {
  ASSERT_TRUE(Run(Into(folder_.Path("out"))));
  const nlohmann::json row = Rows("out").at(3);
  EXPECT_EQ(row["id"], "roof/comb2/mod2");
  EXPECT_EQ(row["status"], "broken");
  EXPECT_NE(row["reason"], "");
  EXPECT_TRUE(row["loss_total_percent"].is_null());
}

TEST_F(TrendTaskTest, ThreadsShardsAndResumeGiveTheSameBytes) {
  SKIP_IF_SANITIZED();
  BatchOptions options = Into(folder_.Path("whole"), 1);
  options.pages = PagesOf::kAll;
  ASSERT_TRUE(Run(options));
  const std::string whole = ResultsIn(folder_.Path("whole"));
  const std::string page = FileText(folder_.Path("whole/pages/roof/comb1/mod2.html"));
  EXPECT_THAT(page, HasSubstr("1 of 3 substrings without voltage"));

  options.folder = folder_.Path("threads");
  options.threads = 3;
  ASSERT_TRUE(Run(options));
  EXPECT_EQ(ResultsIn(options.folder), whole);
  EXPECT_EQ(FileText(options.folder + "/pages/roof/comb1/mod2.html"), page);

  options.folder = folder_.Path("resumed");
  options.threads = 1;
  const auto stopped = Run(options, StopAfter(1));
  ASSERT_TRUE(stopped) << MessageOf(stopped);
  EXPECT_TRUE(stopped->interrupted);
  options.start = BatchStart::kResume;
  const auto resumed = Run(options);
  ASSERT_TRUE(resumed) << MessageOf(resumed);
  EXPECT_GE(resumed->rows_before, 1);
  EXPECT_EQ(ResultsIn(options.folder), whole);

  options.start = BatchStart::kNew;
  options.folder = folder_.Path("shards");
  for (int k = 1; k <= 2; ++k) {
    options.shard = {k, 2};
    ASSERT_TRUE(Run(options));
  }
  const auto merged = MergeShards({folder_.Path("shards")}, {folder_.Path("merged")});
  ASSERT_TRUE(merged) << MessageOf(merged);
  EXPECT_EQ(ResultsIn(folder_.Path("merged")), whole);
}

TEST(WholeFiles, AStreamIsRefused) {
  BatchReadOptions reading;
  reading.reading.whole_files = true;
  EXPECT_THAT(MessageOf(OpenBatch({"-"}, reading)), HasSubstr("one a device"));
}

}  // namespace
}  // namespace lyrefit
