#include "lyrefit/read/write_curve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/base/random.h"
#include "lyrefit/read/read_curve.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

// A lit curve whose numbers need all digits of a double.
IvCurve MakeCurve(RandomStream* random, bool all_columns) {
  IvCurve curve;
  curve.name = "made";
  for (int i = 0; i < 60; ++i) {
    const double voltage = -0.1 + 0.012 * i + 1e-4 * random->Normal();
    curve.voltage_V.push_back(voltage);
    curve.current_A.push_back(1 - 1e-9 * std::expm1(voltage / 0.03) + 1e-3 * random->Normal());
    if (!all_columns) continue;
    curve.sigma_A.push_back(1e-3 * (1 + random->Uniform()));
    curve.time_s.push_back(i * random->Uniform());
    curve.sweep.push_back(2);
    curve.irradiance_W_m2.push_back(900 + random->Uniform());
    curve.temperature_C.push_back(35 + 0.1 * random->Normal());
  }
  curve.conditions.cell_temperature_K = 308.15 + 0.1 * random->Uniform();
  curve.conditions.irradiance_W_m2 = 900 + random->Uniform();
  curve.conditions.cells_in_series = 3;
  curve.conditions.strings_in_parallel = 2;
  return curve;
}

TEST(CurveToCsvTest, ReadsBackToTheSameBits) {
  const TempFolder folder;
  RandomStream random(5);
  for (int repeat = 0; repeat < 20; ++repeat) {
    const IvCurve curve = MakeCurve(&random, repeat % 2 == 1);
    folder.Write("a.json", CurveSidecarJson(curve));
    const auto back = ReadCurve(folder.Write("a.csv", CurveToCsv(curve)));
    ASSERT_TRUE(back) << back.error().ToString();
    EXPECT_EQ(back->voltage_V, curve.voltage_V);
    EXPECT_EQ(back->current_A, curve.current_A);
    EXPECT_EQ(back->sigma_A, curve.sigma_A);
    EXPECT_EQ(back->time_s, curve.time_s);
    EXPECT_EQ(back->sweep, curve.sweep);
    EXPECT_EQ(back->irradiance_W_m2, curve.irradiance_W_m2);
    EXPECT_EQ(back->temperature_C, curve.temperature_C);
    EXPECT_EQ(back->name, curve.name);
    EXPECT_EQ(back->conditions.cell_temperature_K, curve.conditions.cell_temperature_K);
    EXPECT_EQ(back->conditions.irradiance_W_m2, curve.conditions.irradiance_W_m2);
    EXPECT_EQ(back->conditions.cells_in_series, 3);
    EXPECT_EQ(back->conditions.strings_in_parallel, 2);
    EXPECT_THAT(SentencesOf(back->assumptions), ::testing::IsEmpty());
  }
}

TEST(CurveToCsvTest, IsShortWhereTheNumbersAre) {
  IvCurve curve;
  curve.voltage_V = {0, 0.1};
  curve.current_A = {1, 1e-7};
  curve.sweep = {0, 1};
  EXPECT_EQ(CurveToCsv(curve), "voltage_V,current_A,sweep\n0,1,0\n0.1,1e-07,1\n");
}

TEST(CurveSidecarJsonTest, CarriesEveryNote) {
  const TempFolder folder;
  RandomStream random(6);
  IvCurve curve = MakeCurve(&random, false);
  curve.notes.technology = "multi-Si \"new\"";
  curve.notes.bypass_diodes = 3;
  curve.notes.bandgap_eV = 1.121;
  curve.notes.bandgap_slope_per_K = -0.00027;
  curve.notes.isc_tempco_per_K = 0.0005;
  curve.notes.isc_tempco_A_per_K = 0.004;
  curve.notes.current_noise_constant_A = 0.001;
  curve.notes.current_noise_relative = 0.0002;
  curve.notes.current_resolution_A = 0.01;
  folder.Write("a.json", CurveSidecarJson(curve));
  const auto back = ReadCurve(folder.Write("a.csv", CurveToCsv(curve)));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->notes.technology, curve.notes.technology);
  EXPECT_EQ(back->notes.bypass_diodes, curve.notes.bypass_diodes);
  EXPECT_EQ(back->notes.bandgap_eV, curve.notes.bandgap_eV);
  EXPECT_EQ(back->notes.bandgap_slope_per_K, curve.notes.bandgap_slope_per_K);
  EXPECT_EQ(back->notes.isc_tempco_per_K, curve.notes.isc_tempco_per_K);
  EXPECT_EQ(back->notes.isc_tempco_A_per_K, curve.notes.isc_tempco_A_per_K);
  EXPECT_EQ(back->notes.current_noise_constant_A, curve.notes.current_noise_constant_A);
  EXPECT_EQ(back->notes.current_noise_relative, curve.notes.current_noise_relative);
  EXPECT_EQ(back->notes.current_resolution_A, curve.notes.current_resolution_A);
}

TEST(CurveSidecarJsonTest, WritesRoundTemperaturesRound) {
  IvCurve curve;
  curve.conditions.cell_temperature_K = 306.15;
  EXPECT_THAT(CurveSidecarJson(curve), ::testing::HasSubstr("\"nominal_temperature_C\": 33.0,"));
}

}  // namespace
}  // namespace lyrefit
