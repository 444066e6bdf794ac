// Measured curves, from a cell in the dark to a module with a bypass step. The polish must
// converge, and a model with more diodes must not end with a larger RMSE.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "lyrefit/curve/curve_set.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/read/read_curve_set.h"

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

// The contest sets hold curves of 1 to 140 cells, computed to many digits.
TEST(FitOfContestCurves, FitsExactCurvesToTheRoundingOfTheirNumbers) {
  const std::string folder = LYREFIT_FIELD_DATA_DIR "/ivcurves/";
  for (const char* name : {"case1", "case2"}) {
    const auto curves = ReadCurveSet(folder + name + ".json");
    ASSERT_TRUE(curves.has_value()) << curves.error().ToString();
    for (const IvCurve& curve : curves->curves) {
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

// Contest score of the noisy sets: the sum of |fitted / true - 1| over the five parameters. The
// fitted value of a set is the mean over its 50 fits; for Rsh the mean is taken over 1 / Rsh.
TEST(FitOfContestCurves, ScoresOnTheNoisySets) {
  const struct {
    const char* name;
    double iph, is, n, rs, rsh;
    double highest;
  } kSets[] = {{"case3a", 8, 5e-10, 1.01, 0.1, 3000, 0.046},
               {"case3b", 1, 3e-08, 1.3, 1.0, 300, 0.0098},
               {"case3c", 2.5, 1e-09, 1.3, 0.1, 3000, 0.031},
               {"case3d", 0.5, 1e-08, 1.5, 1.0, 300, 0.235}};
  for (const auto& set : kSets) {
    const auto curves =
        ReadCurveSet(std::string(LYREFIT_FIELD_DATA_DIR) + "/ivcurves/" + set.name + ".json");
    ASSERT_TRUE(curves.has_value()) << curves.error().ToString();
    double scores[2];
    for (const bool field : {false, true}) {
      const std::vector<double> truth = {set.iph, set.is, set.n, set.rs, 1 / set.rsh};
      std::vector<double> mean(5);
      for (const IvCurve& curve : curves->curves) {
        FitOptions options;
        options.intervals = Intervals::kNone;
        options.random_baseline = false;
        options.bounds.overrides["n1"] = {0.5, 3};
        if (field) options.errors = {ErrorKind::kField, {}, "field"};
        const auto report = Fit(curve, options);
        ASSERT_TRUE(report.has_value()) << report.error().ToString();
        for (int i = 0; i < 5; ++i) {
          const double value = report->refined[i];
          mean[i] += (i == 4 ? 1 / value : value) / static_cast<double>(curves->curves.size());
        }
      }
      double score = 0;
      for (int i = 0; i < 5; ++i) {
        score += std::fabs(i == 4 ? truth[i] / mean[i] - 1 : mean[i] / truth[i] - 1);
      }
      scores[field ? 1 : 0] = score;
    }
    std::printf("%s: least squares %.4f, --noise field %.4f\n", set.name, scores[0], scores[1]);
    EXPECT_LT(scores[1], scores[0]) << set.name;
    EXPECT_LT(scores[1], set.highest) << set.name;
  }
}

}  // namespace
}  // namespace lyrefit
