// Every seed reaches the certified optima of data/*/expected.json.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/read/read_curve.h"

namespace lyrefit {
namespace {

constexpr int kSeeds = 50;

struct Row {
  std::string data_set;
  nlohmann::json expected;
};

void PrintTo(const Row& row, std::ostream* out) { *out << row.data_set; }

std::vector<Row> ExpectedRows() {
  std::vector<Row> rows;
  for (const char* name : {"rtc_france", "pwp201", "msx60", "stm6_40_36", "stp6_120_36"}) {
    std::ifstream file(std::string(LYREFIT_DATA_DIR "/") + name + "/expected.json");
    for (const auto& row : nlohmann::json::parse(file)) rows.push_back({name, row});
  }
  return rows;
}

IvCurve DataSet(const std::string& name) {
  auto curve = ReadCurve(LYREFIT_DATA_DIR "/" + name);
  EXPECT_TRUE(curve.has_value()) << curve.error().ToString();
  return *curve;
}

Model ModelOf(const std::string& text) {
  return text == "SD"   ? Model::kSingleDiode
         : text == "DD" ? Model::kDoubleDiode
                        : Model::kTripleDiode;
}

FitOptions OptionsOf(const nlohmann::json& row) {
  FitOptions options;
  options.model = ModelOf(row["model"]);
  options.objective = *FromText<Objective>(row["objective"].get<std::string>());
  options.constants = *FromText<ConstantSet>(row["constants"].get<std::string>());
  options.intervals = Intervals::kNone;
  return options;
}

// RMSE of the fitted objective, for each seed.
std::vector<double> RefinedFromAllSeeds(const IvCurve& curve, FitOptions options) {
  std::vector<double> rmse;
  for (int seed = 0; seed < kSeeds; ++seed) {
    options.search.seed = seed;
    const auto report = Fit(curve, options);
    EXPECT_TRUE(report.has_value());
    if (!report) return rmse;
    EXPECT_LE(report->search.evaluations, 5000);
    // The projected gradient is a cosine. On MSX-60 the residuals are only 1e10 times the rounding
    // errors of the current.
    EXPECT_LE(report->refine.projected_gradient, curve.name == "msx60" ? 1e-5 : 1e-6);
    rmse.push_back(report->rmse.refined.Of(options.objective));
  }
  return rmse;
}

class CertifiedOptimum : public ::testing::TestWithParam<Row> {};

TEST_P(CertifiedOptimum, IsReachedFromEverySeed) {
  const nlohmann::json& row = GetParam().expected;
  IvCurve curve = DataSet(GetParam().data_set);
  if (row.contains("temperature_C")) {
    curve.conditions.cell_temperature_K = row["temperature_C"].get<double>() + kZeroCelsius_K;
  }
  const double certified = row["rmse_A"];
  const double tolerance = row["relative_tolerance"];
  FitOptions options = OptionsOf(row);
  for (const auto& [key, range] : row["bounds"].items()) {
    options.bounds.table[key] = {range[0], range[1]};
  }
  // Fits in the bounds of the row. At the curve's own conditions, fits again in the default bounds.
  std::vector<std::string> boxes = {"published"};
  if (!row.contains("temperature_C") && !row.value("these_bounds_only", false)) {
    boxes.push_back("physical");
  }
  for (const std::string& box : boxes) {
    options.bounds.name = box;
    for (const double rmse : RefinedFromAllSeeds(curve, options)) {
      EXPECT_NEAR(rmse / certified, 1, tolerance) << box;
    }
  }
}

std::string RowName(const ::testing::TestParamInfo<Row>& info) {
  const nlohmann::json& row = info.param.expected;
  std::string name = info.param.data_set + "_" + row["model"].get<std::string>() + "_" +
                     row["objective"].get<std::string>() + "_" +
                     row["constants"].get<std::string>() + "_" + std::to_string(info.index);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Data, CertifiedOptimum, ::testing::ValuesIn(ExpectedRows()), RowName);

// How often the search leads to the certified optimum of the RTC France cell: from the best
// candidate alone, and from the whole set of starts. Compared are MLO, differential evolution and
// random points.
TEST(Baseline, OfRandomPointsReachesTheOptimumAsOftenAsMlo) {
  const IvCurve curve = DataSet("rtc_france");
  std::printf("hits of %d: best candidate's own polish / all starts\n", kSeeds);
  for (const Algorithm algorithm : {Algorithm::kMlo, Algorithm::kDe, Algorithm::kRandom}) {
    std::printf("%-7s", ToText(algorithm).c_str());
    for (const auto& [model, optimum] : {std::pair(Model::kSingleDiode, 7.730062689942e-4),
                                         std::pair(Model::kDoubleDiode, 7.326480808687e-4),
                                         std::pair(Model::kTripleDiode, 7.326480808687e-4)}) {
      int candidate = 0, all = 0;
      for (int seed = 0; seed < kSeeds; ++seed) {
        FitOptions options;
        options.model = model;
        options.search.algorithm = algorithm;
        options.search.seed = seed;
        options.intervals = Intervals::kNone;
        const FitReport report = *Fit(curve, options);
        candidate += report.rmse.refined_best_candidate.solved_current_A <= optimum * (1 + 1e-9);
        all += report.rmse.refined.solved_current_A <= optimum * (1 + 1e-9);
      }
      std::printf("  %s %2d / %2d", ToText(model).c_str(), candidate, all);
      EXPECT_EQ(all, kSeeds) << ToText(algorithm) << ' ' << ToText(model);
    }
    std::printf("\n");
  }
}

using TruthCase = std::tuple<std::string, Model, Objective>;

class OneValue : public ::testing::TestWithParam<TruthCase> {};

TEST_P(OneValue, IsReachedFromEverySeed) {
  const auto [name, model, objective] = GetParam();
  FitOptions options;
  options.model = model;
  options.objective = objective;
  options.intervals = Intervals::kNone;
  const std::vector<double> rmse = RefinedFromAllSeeds(DataSet(name), options);
  const auto [low, high] = std::minmax_element(rmse.begin(), rmse.end());
  EXPECT_LE(*high / *low - 1, 1e-9);
  char text[32];
  std::snprintf(text, sizeof text, "%.9e", *low);
  RecordProperty("rmse_A", text);
  std::printf("%s %s %s: %s A from %d of %d seeds\n", name.c_str(), ToText(model).c_str(),
              ToText(objective).c_str(), text, static_cast<int>(rmse.size()), kSeeds);
}

std::string CaseName(const ::testing::TestParamInfo<TruthCase>& info) {
  const auto& [data_set, model, objective] = info.param;
  std::string name = data_set + "_" + ToText(model) + "_" + ToText(objective);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(
    Modules, OneValue,
    ::testing::Combine(::testing::Values("stm6_40_36", "stp6_120_36", "pwp201", "msx60"),
                       ::testing::Values(Model::kSingleDiode, Model::kDoubleDiode,
                                         Model::kTripleDiode),
                       ::testing::Values(Objective::kMeasuredCurrent, Objective::kSolvedCurrent)),
    CaseName);

}  // namespace
}  // namespace lyrefit
