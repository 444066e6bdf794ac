#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lyrefit/estimate/fit/fit.h"
#include "synthetic/curves.h"

namespace lyrefit {
namespace {

IvCurve Curve() { return ModuleCurve(Model::kSingleDiode, kSingleTruth, 1e-3); }

// A user-defined search that returns the middle of the box, after `change`.
FitOptions WithSearcher(const std::function<void(const Box&, SearchSummary*)>& change) {
  FitOptions options;
  options.intervals = Intervals::kNone;
  options.searcher = [change](const ObjectiveFunction& /*objective*/, const Box& box,
                              const SearchOptions& /*options*/, const Observer& /*observer*/) {
    SearchSummary summary;
    for (std::size_t j = 0; j < box.lower.size(); ++j) {
      summary.best.x.push_back(0.5 * (box.lower[j] + box.upper[j]));
    }
    change(box, &summary);
    return summary;
  };
  return options;
}

std::string ErrorOf(const std::function<void(const Box&, SearchSummary*)>& change) {
  testing::internal::CaptureStderr();
  const auto report = Fit(Curve(), WithSearcher(change));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  return report ? "no error" : report.error().message;
}

TEST(ForeignSearch, NeedsNoElites) {
  const auto report = Fit(Curve(), WithSearcher([](const Box&, SearchSummary*) {}));
  ASSERT_TRUE(report.has_value());
  EXPECT_EQ(report->search.elites.size(), 1U);
  EXPECT_EQ(report->search.best.objective, report->search.elites[0].objective);
  EXPECT_NEAR(report->search.best.objective / report->rmse.searched.solved_current_A, 1, 1e-12);
  EXPECT_NEAR(report->refined[kIph], kSingleTruth[kIph], 1e-3);
}

TEST(ForeignSearch, MayLeaveTheBestToTheElites) {
  EXPECT_EQ(ErrorOf([](const Box&, SearchSummary* summary) {
              summary->elites = {summary->best};
              summary->best = {};
            }),
            "no error");
}

TEST(ForeignSearch, IsToldWhatIsWrongWithItsCandidates) {
  EXPECT_EQ(ErrorOf([](const Box&, SearchSummary* summary) { summary->best = {}; }),
            "the searcher came back without a best candidate: set `best` to the best point it met");
  EXPECT_EQ(
      ErrorOf([](const Box&, SearchSummary* summary) { summary->best.x.pop_back(); }),
      "the searcher's best candidate has 4 coordinates, expected 5: one for each side of the box");
  EXPECT_EQ(ErrorOf([](const Box&, SearchSummary* summary) {
              summary->elites = {summary->best, summary->best};
              summary->elites[1].x.push_back(0);
            }),
            "the searcher's elite 2 has 6 coordinates, expected 5: one for each side of the box");
  EXPECT_EQ(ErrorOf([](const Box&, SearchSummary* summary) {
              summary->best.x[2] = std::numeric_limits<double>::quiet_NaN();
            }),
            "the searcher's best candidate is nan in coordinate 3, expected a number in [1, 2]");
  EXPECT_EQ(ErrorOf([](const Box&, SearchSummary* summary) { summary->best.x[2] = 2.5; }),
            "the searcher's best candidate is 2.5 in coordinate 3, expected a number in [1, 2]");
  EXPECT_EQ(ErrorOf([](const Box& box, SearchSummary* summary) {
              summary->best.x[2] = std::nextafter(box.upper[2], 3.0);
            }),
            "no error");
}

}  // namespace
}  // namespace lyrefit
