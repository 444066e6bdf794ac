#include "lyrefit/read/read_pan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "cases.h"
#include "error_of.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/model/translation.h"
#include "lyrefit/read/cec_library.h"
#include "lyrefit/read/read_module.h"
#include "read/pan_text.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kInvented = std::string(LYREFIT_DATA_DIR) + "/datasheet/invented.PAN";

// Key points of read_pan_reference.py.
struct Reference {
  double light_W_m2, celsius, isc, voc, pmp;
};

void ExpectReference(const NamedParameters& module, const std::vector<Reference>& references) {
  for (const Reference& expected : references) {
    const TranslatedDevice at = TranslateTo(module.translation, module.shared, expected.light_W_m2,
                                            expected.celsius + kZeroCelsius_K);
    const KeyPoints points = ModelKeyPoints(at.device, at.parameters.data());
    EXPECT_NEAR(points.short_circuit_current_A / expected.isc, 1, 1e-6);
    EXPECT_NEAR(points.open_circuit_voltage_V / expected.voc, 1, 1e-6);
    EXPECT_NEAR(points.max_power_W / expected.pmp, 1, 1e-6);
  }
}

TEST(ReadPanParameters, GiveTheCurvesOfAnIndependentComputation) {
  const auto module = ReadModuleParameters(kInvented);
  ASSERT_TRUE(module) << module.error().ToString();
  EXPECT_EQ(module->name, "invented.PAN");
  EXPECT_EQ(module->translation.spec.law, TranslationLaw::kPvsyst);
  EXPECT_EQ(module->translation.spec.cells_in_series, 60);
  EXPECT_THAT(module->warnings, IsEmpty());
  EXPECT_NEAR(module->shared[module->translation.photocurrent], 9.7453083, 1e-7);
  EXPECT_NEAR(module->shared[module->translation.saturation_current] / 1.177343929e-10, 1, 1e-8);
  EXPECT_EQ(module->shared[module->translation.bandgap], 1.12);
  ExpectReference(*module, {{1000, 25, 9.74, 39.9, 304.104455},
                            {800, 45, 7.87001408, 37.0501844, 225.229208},
                            {200, 25, 1.94860401, 37.3277647, 58.5167259},
                            {1100, 65, 10.9281216, 35.0728121, 284.42558},
                            {50, 5, 0.482330257, 37.7854392, 14.5878032}});
}

TEST(ReadPanParameters, OfThinFilmsHaveTheRecombinationLoss) {
  const auto module = ReadPanParameters(kThinPan.Text(), "thin.PAN");
  ASSERT_TRUE(module) << module.error().ToString();
  EXPECT_THAT(module->warnings, IsEmpty());
  EXPECT_TRUE(module->translation.spec.recombination);
  EXPECT_EQ(module->shared[module->translation.bandgap], 1.5);
  EXPECT_NEAR(module->shared[module->translation.built_in_voltage], 0.9 * 108, 1e-12);
  ExpectReference(*module, {{1000, 25, 1.8, 88, 116.041466},
                            {800, 45, 1.45156677, 82.617625, 87.0065004},
                            {200, 25, 0.360130985, 81.2985701, 22.5443256},
                            {1100, 65, 2.01148649, 79.7876314, 110.267503},
                            {50, 5, 0.0893252673, 80.8786014, 5.49072565}});
}

TEST(ReadPanParameters, AreTheSameInEveryEncoding) {
  const TempFolder folder;
  const std::string text = kSiliconPan.Text("\r\n");
  std::string utf16 = "\xff\xfe";
  for (const char c : text) utf16 += std::string(1, c) + '\0';
  const auto plain = ReadPanParameters(kSiliconPan.Text(), "plain.PAN");
  ASSERT_TRUE(plain) << plain.error().ToString();
  const std::string maker =
      "  PVObject_Commercial=pvCommercial\n    Manufacturer=Z\xfcrich\n"
      "  End of PVObject pvCommercial\n";
  for (const std::string& bytes :
       {text, "\xef\xbb\xbf" + text, utf16, kSiliconPan.Text().insert(19, maker)}) {
    const auto module = ReadModuleParameters(folder.Write("module.PAN", bytes));
    ASSERT_TRUE(module) << module.error().ToString();
    EXPECT_EQ(module->shared, plain->shared);
  }
}

// The invented module with changes, "RSerie=0.3; Technol=mtCdTe", or without a key, "Isc".
std::string Changed(PanLines lines, const std::string& changes) {
  std::istringstream parts(changes);
  for (std::string part; parts >> part;) {
    if (part.back() == ';') part.pop_back();
    const std::size_t equal = part.find('=');
    lines = equal == std::string::npos ? lines.Without(part)
                                       : lines.With(part.substr(0, equal), part.substr(equal + 1));
  }
  return lines.Text();
}

template <class Module>
std::string WarningsOf(const Expected<Module>& module, std::vector<std::string> Module::*warnings) {
  if (!module) return "error " + module.error().ToString();
  std::string told = "read";
  for (const std::string& warning : (*module).*warnings) told += "; " + warning;
  return told;
}

// Rows of SAM's library of modules: "MODULE | ROWS", or the rows of the only one.
std::string Library(const std::string& text) {
  const std::size_t bar = text.find(" | ");
  const std::string head =
      "Name,N_s,alpha_sc,a_ref,I_L_ref,I_o_ref,R_s,R_sh_ref,Adjust\n"
      "Units,,A/K,V,A,A,Ohm,Ohm,%\n[0],a,b,c,d,e,f,g,h\n";
  return WarningsOf(
      ReadCecParameters(head + text.substr(bar == std::string::npos ? 0 : bar + 3), "bad.csv",
                        bar == std::string::npos ? "" : text.substr(0, bar)),
      &NamedParameters::warnings);
}

TEST(ReadModules, WarnOfWhatDoesNotAgreeAndRefuseTheRest) {
  const auto parameters = [](const PanLines& lines) {
    return [&lines](const std::string& changes) {
      return WarningsOf(ReadPanParameters(Changed(lines, changes), "m.PAN"),
                        &NamedParameters::warnings);
    };
  };
  const auto file = [](const char* name) {
    return [name](const std::string& text) {
      const TempFolder folder;
      auto module = ReadModuleParameters(folder.Write(name, text));
      if (!module) module.error().file = name;
      return WarningsOf(module, &NamedParameters::warnings) +
             (module && !module->cells_stated ? "; cells not stated" : "");
    };
  };
  CheckCases("read_modules", {{"silicon", parameters(kSiliconPan)},
                              {"thin", parameters(kThinPan)},
                              {"sheet",
                               [](const std::string& changes) {
                                 return WarningsOf(
                                     ReadPanSheet(Changed(kSiliconPan, changes), "m.PAN"),
                                     &ModuleSheet::assumptions);
                               }},
                              {"file", file("bad.PAN")},
                              {"pvlib", file("bad.json")},
                              {"cec", Library}});
}

TEST(ReadModules, RefuseAFileThatIsTooLarge) {
  const TempFolder folder;
  const std::string large = "PVObject_=pvModule\n" + std::string(70U << 20, ' ');
  EXPECT_THAT(MessageOf(ReadModuleParameters(folder.Write("bad.PAN", large))), HasSubstr("larger"));
}

// Values of remarks, incidence angles and operating points are not those of the module.
TEST(ReadPanSheet, RepeatsTheValuesAndTheirRounding) {
  const auto module = ReadModuleSheet(kInvented);
  ASSERT_TRUE(module) << module.error().ToString();
  EXPECT_EQ(module->name, "Invented I-304 M60");
  EXPECT_EQ(module->sheet.technology, "mtSiMono");
  EXPECT_EQ(module->rated_power_W, 304);
  const DataSheet& sheet = module->sheet;
  EXPECT_EQ(sheet.cells_in_series, 60);
  EXPECT_EQ(sheet.values.short_circuit_current_A, 9.74);
  EXPECT_EQ(sheet.values.max_power_voltage_V, 33.08);
  EXPECT_NEAR(sheet.values.alpha_sc_A_K, 0.00487, 1e-15);
  EXPECT_NEAR(sheet.values.beta_oc_V_K, -0.1225, 1e-15);
  EXPECT_NEAR(sheet.half_unit.short_circuit_current_A, 0.0005, 1e-15);
  EXPECT_NEAR(sheet.half_unit.beta_oc_V_K, 0.00005, 1e-15);
  EXPECT_EQ(sheet.gamma_pmp_percent_K, -0.362);
  const auto thin = ReadPanSheet(kThinPan.Text(), "thin.PAN");
  ASSERT_TRUE(thin) << thin.error().ToString();
  // muVocSpec is 0, not stated: beta_oc is that of the file's own model.
  const auto model = ReadPanParameters(kThinPan.Text(), "thin.PAN");
  ASSERT_TRUE(model) << model.error().ToString();
  EXPECT_EQ(thin->sheet.values.beta_oc_V_K,
            CoefficientsAtReference(model->translation, model->shared).beta_oc_V_K);
  EXPECT_LT(thin->sheet.values.beta_oc_V_K, 0);
  EXPECT_THAT(thin->assumptions, ::testing::ElementsAre(HasSubstr("muVocSpec is not stated")));
}

}  // namespace
}  // namespace lyrefit
