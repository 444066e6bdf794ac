#include <gtest/gtest.h>

#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/settings/bounds_file.h"

namespace lyrefit {
namespace {

// The unbounded best fits lie outside of the published boxes, which limit Is to at least 10 nA or
// at most 1 uA. The values are the certified optima within them (lyrefit certify data/msx60
// --bounds paper).
TEST(WithinBox, KeepsToTheRangeOfSaturationCurrents) {
  const struct {
    const char* curve;
    const char* bounds;
    Model model;
    Objective objective;
    double rmse_A;
  } optima[] = {
      {"rtc_france", "literature", Model::kDoubleDiode, Objective::kSolvedCurrent, 7.419370501e-4},
      {"msx60", "paper", Model::kSingleDiode, Objective::kSolvedCurrent, 7.603848252e-4},
      {"msx60", "paper", Model::kSingleDiode, Objective::kMeasuredCurrent, 8.824727075e-4},
      {"msx60", "paper", Model::kDoubleDiode, Objective::kMeasuredCurrent, 9.013852839e-4},
      {"msx60", "paper", Model::kTripleDiode, Objective::kMeasuredCurrent, 9.203506507e-4}};
  for (const auto& optimum : optima) {
    const std::string folder = std::string(LYREFIT_DATA_DIR) + "/" + optimum.curve;
    FitOptions options;
    options.model = optimum.model;
    options.objective = optimum.objective;
    options.intervals = Intervals::kNone;
    options.bounds = *NamedBounds(optimum.bounds, folder);
    const auto report = Fit(*ReadCurve(folder), options);
    ASSERT_TRUE(report) << report.error().ToString();
    for (const Estimate& estimate : report->estimates) {
      EXPECT_GE(estimate.refined, estimate.bounds.lower) << estimate.info.symbol;
      EXPECT_LE(estimate.refined, estimate.bounds.upper) << estimate.info.symbol;
    }
    const double rmse = report->rmse.refined.Of(optimum.objective);
    EXPECT_NEAR(rmse / optimum.rmse_A, 1, 1e-9) << ToText(optimum.model);
  }
}

}  // namespace
}  // namespace lyrefit
