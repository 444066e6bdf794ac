#include "studies/coverage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <mutex>

#include "lyrefit/base/constants.h"
#include "lyrefit/model/kernel.h"
#include "studies/coverage_sets.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

CoverageOptions Small(int sets = 20) {
  CoverageOptions options;
  options.sets = sets;
  options.curves = 5;
  options.points = 10;
  options.threads = 2;
  return options;
}

int IndexOf(const CurveSet& set) { return std::stoi(set.name.substr(4)); }

// A report whose intervals contain the truth of the set, unless `change` alters them.
Expected<FamilyReport> Pretend(const CoverageOptions& options, const CurveSet& set,
                               const std::function<void(int, FamilyReport*)>& change) {
  const auto made = SimulateSet(options, IndexOf(set));
  FamilyReport report;
  report.translation = made->translation;
  for (const double truth : made->truth) {
    Estimate e;
    e.refined = truth;
    e.low_95 = truth - 0.02 * std::fabs(truth);
    e.high_95 = truth + 0.02 * std::fabs(truth);
    report.estimates.push_back(e);
  }
  change(IndexOf(set), &report);
  return report;
}

FamilyFitter Fitter(const CoverageOptions& options,
                    std::function<void(int, FamilyReport*)> change) {
  return [options, change](const CurveSet& set, const FamilyOptions&, const Observer&) {
    return Pretend(options, set, change);
  };
}

const ParameterCoverage& Of(const CoverageReport& report, const std::string& symbol) {
  for (const ParameterCoverage& p : report.parameters) {
    if (p.info.symbol == symbol) return p;
  }
  ADD_FAILURE() << symbol;
  return report.parameters[0];
}

TEST(WilsonInterval, EndsWhereTheScoreTestJustRejects) {
  const Share share = WilsonInterval(475, 500);
  EXPECT_LT(share.low_95, 0.95);
  EXPECT_GT(share.high_95, 0.95);
  for (const double end : {share.low_95, share.high_95}) {
    EXPECT_NEAR(std::fabs(0.95 - end) / std::sqrt(end * (1 - end) / 500), 1.959963984540054, 1e-9);
  }
  EXPECT_NEAR(WilsonInterval(10, 10).low_95, 10 / (10 + 1.959963984540054 * 1.959963984540054),
              1e-12);
  EXPECT_NEAR(WilsonInterval(10, 10).high_95, 1, 1e-15);
  EXPECT_EQ(WilsonInterval(0, 0).low_95, 0);
  EXPECT_EQ(WilsonInterval(0, 0).high_95, 1);
}

TEST(Coverage, CountsHitsMissesHeldAndNotIdentifiable) {
  const CoverageOptions options = Small();
  const auto report = Coverage(options, Fitter(options, [](int set, FamilyReport* r) {
                                 std::vector<Estimate>& e = r->estimates;
                                 // the interval misses the truth
                                 if (set < 5) e[0].low_95 = e[0].refined * 1.001;
                                 if (set == 7) e[0].high_95 = e[0].refined * 0.999;
                                 if (set % 2 == 0) e[1].identifiable = false;
                                 if (set == 3) e[2].low_95 = kUnknown;
                                 e[3].fixed = true;
                                 e[4].high_95 = kInfinity;
                               }));
  ASSERT_TRUE(report) << report.error().ToString();
  EXPECT_EQ(report->failed, 0);
  const ParameterCoverage& iph = Of(*report, "Iph");
  EXPECT_EQ(iph.counted, 20);
  EXPECT_EQ(iph.covered, 14);
  EXPECT_DOUBLE_EQ(iph.coverage, 0.7);
  EXPECT_DOUBLE_EQ(iph.low_95, WilsonInterval(14, 20).low_95);
  EXPECT_NEAR(iph.median_half_width, 0.02, 1e-9);
  EXPECT_EQ(Of(*report, "Is1").fitted, 20);
  EXPECT_EQ(Of(*report, "Is1").not_identifiable, 10);
  EXPECT_EQ(Of(*report, "Is1").counted, 10);
  EXPECT_EQ(Of(*report, "n1").counted, 19) << "no interval is no miss";
  EXPECT_EQ(Of(*report, "Rs").fitted, 0);
  EXPECT_TRUE(std::isnan(Of(*report, "Rs").coverage));
  EXPECT_EQ(Of(*report, "Rsh").covered, 20) << "no upper end holds everything above";
}

TEST(Coverage, CountsFitsThatFailApart) {
  const CoverageOptions options = Small();
  const FamilyFitter good = Fitter(options, [](int set, FamilyReport* r) { r->usable = set != 2; });
  const auto report = Coverage(
      options, [&](const CurveSet& set, const FamilyOptions& family, const Observer& observer) {
        if (IndexOf(set) == 4) return Expected<FamilyReport>(Fail("nothing to fit"));
        return good(set, family, observer);
      });
  ASSERT_TRUE(report);
  EXPECT_EQ(report->failed, 2);
  EXPECT_EQ(report->sets[4].error, "nothing to fit");
  EXPECT_EQ(Of(*report, "n1").counted, 18);
}

TEST(Coverage, HoldsTheFittedOffsetAgainstTheHiddenError) {
  CoverageOptions options = Small();
  options.temperature_error_K = 2;
  options.family.temperature_offset = true;
  const auto report = Coverage(options, Fitter(options, [](int set, FamilyReport* r) {
                                 // a wrong sign counts as a miss
                                 const double value = set < 15 ? -2.1 : 2.1;
                                 r->temperature_offset_K = {value, 0.1, value - 0.2, value + 0.2};
                               }));
  ASSERT_TRUE(report);
  const ParameterCoverage& offset = Of(*report, "dT");
  EXPECT_TRUE(offset.offset);
  EXPECT_EQ(offset.covered, 15);
  EXPECT_NEAR(offset.median_half_width, 0.2, 1e-12) << "in kelvin";
}

TEST(Coverage, SwitchesOffWhatOnlyCostsTime) {
  const CoverageOptions options = Small(1);
  FamilyOptions seen;
  const auto report = Coverage(
      options, [&](const CurveSet& set, const FamilyOptions& family, const Observer& /*observer*/) {
        seen = family;
        return Pretend(options, set, [](int, FamilyReport*) {});
      });
  ASSERT_TRUE(report);
  EXPECT_EQ(seen.threads, 1);
  EXPECT_FALSE(seen.individual_fits);
  EXPECT_EQ(seen.folds, 0);
  EXPECT_TRUE(seen.intervals);
}

TEST(Coverage, StopsWithWhatIsDone) {
  CoverageOptions options = Small();
  options.threads = 1;
  const auto report =
      Coverage(options, Fitter(options, [](int, FamilyReport*) {}), [](const Progress& progress) {
        return progress.iteration == 3 ? ObserverAction::kStop : ObserverAction::kContinue;
      });
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->interrupted);
  EXPECT_EQ(report->sets.size(), 3U);
}

TEST(Coverage, RefusesWhatCannotBeSimulated) {
  const auto error = [](const CoverageOptions& options) {
    const auto report = Coverage(options, Fitter(options, [](int, FamilyReport*) {}));
    return report ? "" : report.error().ToString();
  };
  CoverageOptions options = Small();
  options.noise_relative = 0.5;
  EXPECT_THAT(error(options), HasSubstr("noise-relative = 0.5 is outside"));
  options = Small();
  options.module = {{"Iph", 8}, {"n1", 1.1}};
  EXPECT_THAT(error(options), HasSubstr("no value for Is1"));
  options.module = {{"Icph", 8}};
  EXPECT_THAT(error(options), HasSubstr("the law has no parameter Icph"));
  options = Small();
  options.threads = -1;
  EXPECT_THAT(error(options), HasSubstr("threads = -1"));
  options = Small();
  options.family.model = Model::kTripleDiode;
  EXPECT_THAT(error(options), HasSubstr("expected sd or dd, found td"));
}

}  // namespace
}  // namespace lyrefit
