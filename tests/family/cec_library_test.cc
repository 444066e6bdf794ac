#include "lyrefit/read/cec_library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "lyrefit/family/family_documents.h"
#include "lyrefit/model/pvlib_parameters.h"
#include "lyrefit/read/read_module.h"
#include "lyrefit/report/json.h"
#include "model/synthetic_translation.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

const std::string kLibrary = std::string(LYREFIT_DATA_DIR) + "/datasheet/invented_cec.csv";

TEST(ReadCecParameters, TakeOneModuleOfALibrary) {
  for (const char* name : {"#Invented I-304 M60", "#Invented_I_304_M60"}) {
    const auto module = ReadModuleParameters(kLibrary + name);
    ASSERT_TRUE(module) << module.error().ToString();
    EXPECT_EQ(module->name, std::string("invented_cec.csv") + name);
    const Translation& at = module->translation;
    EXPECT_EQ(at.spec.cells_in_series, 60);
    EXPECT_EQ(module->shared[at.photocurrent], 9.7453);
    EXPECT_EQ(module->shared[at.saturation_current], 1.17734e-10);
    EXPECT_EQ(module->shared[at.resistance_shunt], 400);
    EXPECT_NEAR(module->shared[at.n] * at.device.module_thermal_voltage_V, 1.58781, 1e-12);
    EXPECT_NEAR(module->shared[at.alpha_sc], 0.00487 * (1 - 0.065), 1e-15);  // Adjust is 6.5 %
    EXPECT_EQ(module->shared[at.bandgap], 1.121);
    EXPECT_EQ(module->shared[at.bandgap_slope], -0.0002677);
  }
  EXPECT_TRUE(ReadModuleParameters(kLibrary + "#Invented \"T\" 60, black"));
}

// A row as PvlibJson writes it, in JSON.
TEST(ReadModule, TakesBackACecRow) {
  const TempFolder folder;
  const Translation translation = *MakeTranslation(DeSoto60());
  const auto keywords = PvlibParameters(translation, kSilicon);
  const auto row = CecRow(translation, kSilicon, "A module", "Mono-c-Si");
  const std::string text = PvlibJson("A", TranslationLaw::kDeSoto, *keywords, row);
  const auto sheet = ReadModuleSheet(folder.Write("module.json", text));
  ASSERT_TRUE(sheet) << sheet.error().ToString();
  EXPECT_EQ(sheet->name, "A module");
  EXPECT_EQ(sheet->sheet.technology, "Mono-c-Si");
  EXPECT_EQ(sheet->sheet.cells_in_series, 60);
  EXPECT_EQ(sheet->sheet.values.alpha_sc_A_K, 0.0046);
  nlohmann::json bare = nlohmann::json::parse(text)["cec"];
  for (const double adjust : {0.0, 8.0}) {
    bare["Adjust"] = adjust;
    const auto read = ReadModuleParameters(folder.Write("row.json", bare.dump()));
    ASSERT_TRUE(read) << read.error().ToString();
    EXPECT_TRUE(read->cells_stated);
    EXPECT_EQ(read->translation.spec.cells_in_series, 60);
    EXPECT_NEAR(read->shared[translation.alpha_sc], 0.0046 * (1 - adjust / 100), 1e-15);
    EXPECT_NEAR(read->shared[translation.n], kSilicon[2], 1e-12);
  }
}

TEST(ReadCecSheet, RepeatsTheDataSheet) {
  const auto module = ReadModuleSheet(kLibrary + "#Invented I-304 M60");
  ASSERT_TRUE(module) << module.error().ToString();
  EXPECT_EQ(module->sheet.technology, "Mono-c-Si");
  EXPECT_EQ(module->rated_power_W, 304.2);
  EXPECT_EQ(module->sheet.values.alpha_sc_A_K, 0.00487);  // without Adjust
  EXPECT_EQ(module->sheet.values.beta_oc_V_K, -0.1225);
  EXPECT_NEAR(module->sheet.half_unit.open_circuit_voltage_V, 0.05, 1e-15);
  EXPECT_EQ(module->sheet.gamma_pmp_percent_K, -0.41);
}

}  // namespace
}  // namespace lyrefit
