#include "lyrefit/read/sidecar.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

constexpr std::uintmax_t kLimit = 1 << 20;

TEST(ReadSidecarTest, ReadsPvlibsNamesOfTheBandGap) {
  const TempFolder folder;
  const std::string path = folder.Write("a.json", R"({"EgRef": 1.4, "dEgdT": -0.0003})");
  const auto sidecar = ReadSidecar(path, kLimit);
  ASSERT_TRUE(sidecar) << sidecar.error().ToString();
  EXPECT_EQ(sidecar->notes.bandgap_eV, 1.4);
  EXPECT_EQ(sidecar->notes.bandgap_slope_per_K, -0.0003);
  EXPECT_TRUE(sidecar->assumptions.empty());
}

TEST(ReadSidecarTest, ReadsEveryKey) {
  const TempFolder folder;
  const auto sidecar = ReadSidecar(folder.Write("a.json", R"({
    "name": "m1", "technology": "mono-Si", "setup": "flash", "cells_in_series": 60, "strings_in_parallel": 2,
    "nominal_temperature_C": 30, "nominal_irradiance_Wm2": 800, "bypass_diodes": 3,
    "bandgap_eV": 1.121, "bandgap_slope_per_K": -0.00027, "isc_tempco_per_K": -0.0005, "isc_tempco_A_per_K": 0.004,
    "current_noise": {"constant_A": 0.001, "relative": 0.0002}, "current_resolution_A": 0.01,
    "anything": {"else": [1, 2]}})"),
                                   kLimit);
  ASSERT_TRUE(sidecar) << sidecar.error().ToString();
  EXPECT_EQ(sidecar->name, "m1");
  EXPECT_EQ(sidecar->notes.technology, "mono-Si");
  EXPECT_EQ(sidecar->notes.setup, Setup::kFlash);
  EXPECT_EQ(sidecar->stated_in.setup, "\"setup\" of a.json");
  EXPECT_EQ(sidecar->cells_in_series, 60);
  EXPECT_EQ(sidecar->strings_in_parallel, 2);
  EXPECT_EQ(sidecar->temperature_C, 30);
  EXPECT_EQ(sidecar->irradiance_W_m2, 800);
  EXPECT_EQ(sidecar->notes.bypass_diodes, 3);
  EXPECT_EQ(sidecar->notes.bandgap_eV, 1.121);
  EXPECT_EQ(sidecar->notes.bandgap_slope_per_K, -0.00027);
  EXPECT_EQ(sidecar->notes.isc_tempco_per_K, -0.0005);
  EXPECT_EQ(sidecar->notes.isc_tempco_A_per_K, 0.004);
  EXPECT_EQ(sidecar->notes.current_noise_constant_A, 0.001);
  EXPECT_EQ(sidecar->notes.current_noise_relative, 0.0002);
  EXPECT_EQ(sidecar->notes.current_resolution_A, 0.01);
}

TEST(ReadSidecarTest, NullAndEmptyObjectSayNothing) {
  const TempFolder folder;
  for (const char* text : {"{}", R"({"cells_in_series": null, "cell_temperature_C": null,
                                     "irradiance_W_m2": null, "strings_in_parallel": null})"}) {
    const auto sidecar = ReadSidecar(folder.Write("a.json", text), kLimit);
    ASSERT_TRUE(sidecar);
    EXPECT_FALSE(sidecar->cells_in_series);
    EXPECT_FALSE(sidecar->temperature_C);
    EXPECT_FALSE(sidecar->irradiance_W_m2);
  }
}

TEST(ReadSidecarTest, TakesBothSpellingsAndTheMeasuredBeforeTheNominal) {
  const TempFolder folder;
  const auto sidecar =
      ReadSidecar(folder.Write("a.json", R"({"nominal_temperature_C": 25, "cell_temperature_C": 33,
                  "irradiance_W_m2": 950, "nominal_irradiance_Wm2": 1000})"),
                  kLimit);
  ASSERT_TRUE(sidecar);
  EXPECT_EQ(sidecar->temperature_C, 33);
  EXPECT_EQ(sidecar->irradiance_W_m2, 950);
}

TEST(ReadSidecarTest, VariedIsNotOneValue) {
  const TempFolder folder;
  const auto sidecar =
      ReadSidecar(folder.Write("a.json", R"({"irradiance_W_m2": "varied"})"), kLimit);
  ASSERT_TRUE(sidecar);
  EXPECT_FALSE(sidecar->irradiance_W_m2);
}

TEST(ReadSidecarTest, InASetRemarksStateNoValue) {
  const TempFolder folder;
  const std::string path =
      folder.Write("a.json", R"({"cell_temperature_C": "per curve", "nominal_temperature_C": 45,
                                 "irradiance_W_m2": "reference cell"})");
  EXPECT_FALSE(ReadSidecar(path, kLimit));
  const auto sidecar = ReadSidecar(path, kLimit, SidecarOf::kSet);
  ASSERT_TRUE(sidecar) << sidecar.error().ToString();
  EXPECT_EQ(sidecar->temperature_C, 45);
  EXPECT_FALSE(sidecar->irradiance_W_m2);
}

TEST(MergeTest, WhatTheFirstDoesNotSayIsTakenFromTheSecond) {
  Sidecar own;
  own.cells_in_series = 36;
  Sidecar common;
  common.cells_in_series = 60;
  common.temperature_C = 45;
  common.notes.technology = "CdTe";
  common.notes.isc_tempco_A_per_K = 0.001;
  const Sidecar merged = Merge(own, common);
  EXPECT_EQ(merged.cells_in_series, 36);
  EXPECT_EQ(merged.temperature_C, 45);
  EXPECT_EQ(merged.notes.technology, "CdTe");
  EXPECT_EQ(merged.notes.isc_tempco_A_per_K, 0.001);
  EXPECT_FALSE(merged.irradiance_W_m2);
}

TEST(ReadSidecarTest, ErrorsNameFileKeyAndPlace) {
  const TempFolder folder;
  const struct {
    const char* text;
    const char* phrase;
  } kCases[] = {
      {R"({"cells_in_series": 0})", "expected at least 1 in \"cells_in_series\", found '0'"},
      {R"({"cells_in_series": -36})", "expected at least 1"},
      {R"({"cells_in_series": 36.5})", "expected a whole number in \"cells_in_series\""},
      {R"({"cells_in_series": "36"})", "expected a number in \"cells_in_series\", found '\"36\"'"},
      {R"({"cells_in_series": 1e9})", "at most a million"},
      {R"({"cells_in_series": [36]})", "found a list"},
      {R"({"strings_in_parallel": 0})", "\"strings_in_parallel\""},
      {R"({"nominal_temperature_C": 298.15})", "looks like kelvin"},
      {R"({"cell_temperature_C": -200})", "degrees Celsius from -100 to 150"},
      {R"({"cell_temperature_C": "warm"})", "expected a number in \"cell_temperature_C\""},
      {R"({"nominal_irradiance_Wm2": -25})", "a number from 0 up"},
      {R"({"bypass_diodes": -1})", "a number from 0 up in \"bypass_diodes\""},
      {R"({"bandgap_eV": 0})", "a positive number in \"bandgap_eV\""},
      {R"({"isc_tempco_per_K": {}})", "found an object"},
      {R"({"current_noise": 0.1})", "constant_A and relative"},
      {R"({"current_noise": {"constant_A": -1}})", "\"constant_A\""},
      {R"({"current_resolution_A": 0})", "\"current_resolution_A\""},
      {R"({"name": 5})", "expected a text in \"name\", found '5'"},
      {R"([1, 2])", "expected a JSON object"},
      {R"({"name": )", "expected valid JSON"},
  };
  for (const auto& c : kCases) {
    SCOPED_TRACE(c.text);
    const std::string path = folder.Write("a.json", c.text);
    const auto sidecar = ReadSidecar(path, kLimit);
    ASSERT_FALSE(sidecar);
    EXPECT_EQ(sidecar.error().file, path);
    EXPECT_EQ(sidecar.error().line, 1);
    EXPECT_GT(sidecar.error().column, 0);
    EXPECT_THAT(sidecar.error().message, HasSubstr(c.phrase));
  }
}

TEST(ReadSidecarTest, AReportInItsPlaceGivesItsConditions) {
  const TempFolder folder;
  const auto sidecar = ReadSidecar(folder.Write("module.json", R"({"lyrefit_version": "0.1.0",
      "curve": {"name": "m", "conditions": {"cells_in_series": 36, "strings_in_parallel": 1,
      "cell_temperature_C": 51, "irradiance_Wm2": 1000},
      "assumed": ["strings_in_parallel", "irradiance_Wm2"],
      "assumptions": ["in any words"]}})"),
                                   kLimit);
  ASSERT_TRUE(sidecar) << sidecar.error().ToString();
  EXPECT_EQ(sidecar->cells_in_series, 36);
  EXPECT_EQ(sidecar->temperature_C, 51);
  EXPECT_FALSE(sidecar->irradiance_W_m2);  // it was assumed in the report
  EXPECT_FALSE(sidecar->strings_in_parallel);
  EXPECT_THAT(SentencesOf(sidecar->assumptions),
              ::testing::ElementsAre(HasSubstr("module.json is a report of lyrefit")));
}

// Reports of older versions do not list which conditions were assumed. Their conditions are used
// only if nothing was assumed.
TEST(ReadSidecarTest, AReportThatDoesNotSayWhichStatesConditionsIfItAssumedNothing) {
  const TempFolder folder;
  const auto read = [&](const std::string& assumptions) {
    return ReadSidecar(folder.Write("module.json", R"({"lyrefit_version": "0.1.0",
        "curve": {"name": "m", "conditions": {"cells_in_series": 36, "cell_temperature_C": 51},
        "assumptions": )" + assumptions + "}}"),
                       kLimit);
  };
  const auto sure = read("[]");
  ASSERT_TRUE(sure) << sure.error().ToString();
  EXPECT_EQ(sure->cells_in_series, 36);
  EXPECT_EQ(sure->temperature_C, 51);
  const auto unsure = read(R"(["something"])");
  ASSERT_TRUE(unsure) << unsure.error().ToString();
  EXPECT_FALSE(unsure->cells_in_series);
  EXPECT_FALSE(unsure->temperature_C);
  EXPECT_THAT(SentencesOf(unsure->assumptions), ::testing::ElementsAre(HasSubstr("none was used")));
}

TEST(ReadSidecarTest, AReportWithoutConditionsIsRefusedByName) {
  const TempFolder folder;
  const auto sidecar = ReadSidecar(
      folder.Write("module.json", R"({"lyrefit_version": "0.1.0", "curves": []})"), kLimit);
  ASSERT_FALSE(sidecar);
  EXPECT_THAT(sidecar.error().ToString(), HasSubstr("module.json: this is a report of lyrefit"));
}

TEST(ReadSidecarTest, NoKnownKeyIsSaid) {
  const TempFolder folder;
  const auto sidecar = ReadSidecar(folder.Write("a.json", R"({"cells": 60})"), kLimit);
  ASSERT_TRUE(sidecar);
  EXPECT_THAT(SentencesOf(sidecar->assumptions),
              ::testing::ElementsAre(HasSubstr("a.json has none of the keys of a sidecar")));
}

}  // namespace
}  // namespace lyrefit
