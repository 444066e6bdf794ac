// Measured curves of every kind, from a cell in the dark to a module with a bypass step: the polish
// must settle, and a richer model must never end above a poorer one.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "lyrefit/curve/read_curve.h"
#include "lyrefit/fit/fit.h"

namespace lyrefit {
namespace {

std::vector<std::string> SingleCurves() {
  std::vector<std::string> paths;
  for (const char* folder : {"showcase", "isfh_cell_32-14", "nrel_cell_32-14", "nrel_ibc2x2",
                             "hzb_perovskite_batch1", "sdle_ddiv", "load_steps_poly"}) {
    const auto root = std::filesystem::path(LYREFIT_FIELD_DATA_DIR) / "field" / folder;
    for (const auto& entry : std::filesystem::directory_iterator(root)) {
      if (entry.path().extension() == ".csv") paths.push_back(entry.path().string());
    }
  }
  return paths;
}

TEST(FitOfFieldCurves, SettlesAndGetsNoWorseWithMoreDiodes) {
  const std::vector<std::string> paths = SingleCurves();
  ASSERT_GE(paths.size(), 20U);
  for (const std::string& path : paths) {
    const auto curve = ReadCurve(path);
    ASSERT_TRUE(curve.has_value()) << curve.error().ToString();
    double poorer = HUGE_VAL;
    for (const Model model : {Model::kSingleDiode, Model::kDoubleDiode}) {
      FitOptions options;
      options.model = model;
      options.intervals = Intervals::kNone;
      const auto report = Fit(*curve, options);
      ASSERT_TRUE(report.has_value()) << report.error().ToString();
      EXPECT_EQ(report->refine.termination, "converged") << path << ' ' << ToText(model);
      EXPECT_LE(report->refine.projected_gradient, 1e-6) << path << ' ' << ToText(model);
      const double rmse = report->rmse.refined.solved_current_A;
      EXPECT_LE(rmse, poorer * (1 + 1e-9)) << path;
      poorer = rmse;
    }
  }
}

// The contest sets hold curves of 1 to 140 cells , computed to many digits.
TEST(FitOfContestCurves, FitsExactCurvesToTheRoundingOfTheirNumbers) {
  const std::string folder = LYREFIT_FIELD_DATA_DIR "/ivcurves/";
  for (const char* name : {"case1", "case2"}) {
    const auto curves = ReadIvCurvesJson(folder + name + ".json");
    ASSERT_TRUE(curves.has_value()) << curves.error().ToString();
    for (const IvCurve& curve : *curves) {
      FitOptions options;
      options.intervals = Intervals::kNone;
      const auto report = Fit(curve, options);
      ASSERT_TRUE(report.has_value()) << report.error().ToString();
      double largest = 0;
      for (const double i : curve.current_A) largest = std::max(largest, std::fabs(i));
      EXPECT_LE(report->rmse.refined.solved_current_A, 1e-10 * largest) << name << curve.name;
    }
  }
}

}  // namespace
}  // namespace lyrefit
