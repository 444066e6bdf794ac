// Sets of measured curves: a module over weeks of weather, an array with irradiance that was not
// logged with the sweeps, and the families of the diagnosis panel.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "lyrefit/base/file.h"
#include "lyrefit/base/median.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/devices/data_sheet.h"
#include "lyrefit/family/fit_family.h"
#include "lyrefit/read/read_curve_set.h"
#include "repeats.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = LYREFIT_FIELD_DATA_DIR;

CurveSet ReadOrFail(const fs::path& path) {
  Expected<CurveSet> set = ReadCurveSet(path.string());
  EXPECT_TRUE(set.has_value()) << set.error().ToString();
  return set ? std::move(*set) : CurveSet();
}

// Common values for the Mitsubishi PV-UE125MF5N, with the coefficients of its data set.
NamedParameters DataSheetOfThePvue125() {
  DataSheet sheet;
  sheet.values = {7.90, 21.8, 7.23, 17.3, 0.0054, -0.0774};
  sheet.half_unit = {0.005, 0.05, 0.005, 0.05, 0.00005, 0.00005};
  sheet.cells_in_series = 36;
  const Expected<DataSheetFit> fit = FitDataSheet(sheet);
  EXPECT_TRUE(fit.has_value()) << fit.error().ToString();
  return {"data sheet", fit->translation, fit->shared, true, {}};
}

int Count(const FamilyReport& report, CurveRole role) {
  int count = 0;
  for (const FamilyCurve& curve : report.curves) count += curve.role == role;
  return count;
}

class FamilyOfThePvue125 : public ::testing::TestWithParam<TranslationLaw> {};

TEST_P(FamilyOfThePvue125, PredictsTheCurvesItDidNotSeeBetterThanTheDataSheet) {
  const CurveSet set = ReadOrFail(kRoot / "field" / "sandia_pvue125");
  FamilyOptions options;
  options.law = GetParam();
  options.fit_curves = 30;
  options.against = {DataSheetOfThePvue125()};
  const Expected<FamilyReport> report = FitFamily(set, options);
  ASSERT_TRUE(report.has_value()) << report.error().ToString();
  EXPECT_EQ(Count(*report, CurveRole::kFitted), 30);
  EXPECT_EQ(Count(*report, CurveRole::kHeldOut), 548);
  EXPECT_EQ(Count(*report, CurveRole::kLeftOut), 0);
  EXPECT_TRUE(report->rejected.empty());
  EXPECT_TRUE(report->usable);
  EXPECT_EQ(report->refine.termination, "converged");
  ASSERT_TRUE(report->held_out.has_value());
  EXPECT_EQ(report->held_out->curves, 548);
  const double isc = report->reference.short_circuit_current_A;
  EXPECT_NEAR(isc, 7.9, 0.4);
  EXPECT_LT(report->held_out->median_rmse_A, 0.005 * isc);
  EXPECT_LT(report->held_out->median_individual_rmse_A, report->held_out->median_rmse_A);
  ASSERT_EQ(report->against.size(), 1U);
  EXPECT_EQ(report->against[0].result.curves, 548);
  EXPECT_GT(report->against[0].result.median_rmse_A, report->held_out->median_rmse_A);
  for (const FamilyCurve& curve : report->curves) {
    EXPECT_EQ(curve.individual_parameters.size(), 5U) << curve.id;
    EXPECT_LT(curve.individual_rmse.solved_current_A, 0.02 * curve.short_circuit_current_A)
        << curve.id;
  }
}

INSTANTIATE_TEST_SUITE_P(ByBothLaws, FamilyOfThePvue125,
                         ::testing::Values(TranslationLaw::kDeSoto, TranslationLaw::kPvsyst),
                         [](const auto& law) { return std::string(ToText(law.param)); });

TEST(FamilyOfTheNistArray, WarnsThatTheIrradianceDoesNotBelongToTheSweeps) {
  const CurveSet set = ReadOrFail(kRoot / "field" / "nist_ground_2015-07-20");
  ASSERT_EQ(set.curves.size(), 241U);
  FamilyOptions options;
  options.fit_curves = 30;  // no law fits them quickly
  options.intervals = false;
  const Expected<FamilyReport> report = FitFamily(set, options);
  ASSERT_TRUE(report.has_value()) << report.error().ToString();
  bool warned = report->without_outliers.has_value();
  for (const std::string& warning : report->warnings) {
    warned = warned || warning.find("The joint fit misses the curves") != std::string::npos;
  }
  EXPECT_TRUE(warned);
}

std::vector<std::string> FamiliesOfThePanel() {
  const auto text = ReadTextFile((kRoot / ".." / "panel" / "labels.json").string(), 1U << 26);
  EXPECT_TRUE(text.has_value()) << text.error().ToString();
  std::vector<std::string> names;
  const auto labels = nlohmann::json::parse(text.value_or("{}"));
  for (const auto& [name, label] : labels.items()) {
    const std::string kind = label["kind"];
    if (kind == "famG" || kind == "famGT") names.push_back(name);
  }
  return names;
}

TEST(FamiliesOfThePanel, AreAllReadAndFittedWithIntervals) {
  const std::vector<std::string> names = FamiliesOfThePanel();
  EXPECT_EQ(names.size(), 35U);
  for (std::size_t i = 0; i < names.size(); i += kSanitized ? 10 : 1) {
    const std::string& name = names[i];
    SCOPED_TRACE(name);
    const CurveSet set = ReadOrFail(kRoot / ".." / "panel" / "cases" / (name + ".csv"));
    EXPECT_TRUE(set.rejected.empty());
    FamilyOptions options;
    options.shunt = ShuntLaw::kConstant;  // shunt law of the panel
    options.individual_fits = false;
    options.folds = 0;
    const Expected<FamilyReport> report = FitFamily(set, options);
    ASSERT_TRUE(report.has_value()) << report.error().ToString();
    EXPECT_TRUE(report->usable);
    EXPECT_EQ(report->refine.termination, "converged");
    for (const Estimate& e : report->estimates) {
      if (e.fixed || e.at_bound != BoundSide::kNone) continue;
      EXPECT_TRUE(std::isfinite(e.low_95) && std::isfinite(e.high_95)) << e.info.name;
    }
  }
}

// Matrices of indoor measurements beside pvlib's own fit of the same law (reference.csv): rms error of
// Pmp over the conditions as a part of nominal power.
TEST(MatricesOfModules, AreFittedBetterThanByPvlib) {
  std::ifstream reference(kRoot / "matrix" / "reference.csv");
  std::string line;
  std::getline(reference, line);
  std::vector<double> ratios;
  int covered = 0, held_out = 0;
  while (std::getline(reference, line)) {
    std::vector<std::string> fields;
    std::istringstream cells(line);
    for (std::string field; std::getline(cells, field, ',');) fields.push_back(field);
    ASSERT_GT(fields.size(), 5U);
    const fs::path file = kRoot / "matrix" / (fields[0] + ".csv");
    if (!fs::exists(file)) continue;
    FamilyOptions options;
    options.law = TranslationLaw::kPvsyst;
    const auto report = FitFamily(ReadOrFail(file), options);
    ASSERT_TRUE(report) << report.error().ToString();
    ASSERT_TRUE(report->key_points) << file;
    const double percent = 100 * report->key_points->max_power_of_reference;
    ratios.push_back(percent / std::stod(fields[5]));
    EXPECT_LE(ratios.back(), 1) << fields[0];
    covered += report->key_points->covered;
    held_out += report->key_points->held_out;
  }
  ASSERT_EQ(ratios.size(), 12U);
  EXPECT_LT(Median(ratios), 0.3);
  EXPECT_GT(covered, 0.9 * held_out);
}

}  // namespace
}  // namespace lyrefit
