#include "lyrefit/read/read_pan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "error_of.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/model/translation.h"
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

TEST(ReadPanParameters, WarnOfWhatDoesNotAgree) {
  const auto warning = [](const PanLines& lines) {
    const auto module = ReadPanParameters(lines.Text(), "m.PAN");
    EXPECT_TRUE(module) << module.error().ToString();
    return module && module->warnings.size() == 1 ? module->warnings[0] : "not one warning";
  };
  EXPECT_THAT(warning(kSiliconPan.With("RSerie", "0.300")),
              HasSubstr("The model of m.PAN gives 297.25 W at 1000 W/m2 and 25 C"));
  EXPECT_THAT(warning(kSiliconPan.With("Technol", "mtCdTe").With("muPmpReq", "-0.362")),
              HasSubstr("muPmpReq says -0.362"));
  EXPECT_THAT(warning(kSiliconPan.With("muISC", "0.05").With("muPmpReq", "0")),
              HasSubstr("The muISC of m.PAN, 0.05 mA/K, is next to none beside an Isc of 9.74 A"));
  EXPECT_THAT(warning(kSiliconPan.With("Technol", "mtNew")), HasSubstr("'mtNew' of m.PAN"));
}

class BadPan : public ::testing::Test {
 protected:
  static void ExpectError(const std::string& text, int line, int column, const std::string& says) {
    ExpectErrorAt(ReadPanParameters(text, "bad.PAN"), "bad.PAN", line, column, says);
  }
};

TEST_F(BadPan, IsRefusedForAMissingKey) {
  for (const char* key : {"NCelS", "Isc", "Voc", "Imp", "Vmp", "muISC", "RShunt", "Rp_0", "RSerie",
                          "Gamma", "muGamma"}) {
    ExpectError(kSiliconPan.Without(key).Text(), 18, 1,
                std::string("the module ends without ") + key + ": expected ");
  }
  ExpectError(kSiliconPan.Without("Isc").Text(), 18, 1, "expected a current in A");
}

TEST_F(BadPan, IsRefusedForAValueThatNoModuleHas) {
  const auto with = [](const char* key, const char* value) {
    return kSiliconPan.With(key, value).Text();
  };
  ExpectError(with("Isc", "abc"), 6, 7, "expected a current in A above 0 in Isc, found 'abc'");
  ExpectError(with("Isc", "NaN"), 6, 7, "found 'NaN'");
  ExpectError(with("Isc", "inf"), 6, 7, "found 'inf'");
  ExpectError(with("Isc", "9,74"), 6, 7, "found '9,74'");
  ExpectError(with("Isc", ""), 6, 7, "found ''");
  ExpectError(with("Voc", "-39.9"), 7, 7, "expected a voltage in V above 0 in Voc");
  ExpectError(with("Imp", "9.8"), 8, 7, "expected a current below Isc in Imp, found '9.8'");
  ExpectError(with("Vmp", "40"), 9, 7, "expected a voltage below Voc in Vmp, found '40'");
  ExpectError(with("NCelS", "60.5"), 3, 9, "expected a whole number of cells in NCelS");
  ExpectError(with("NCelS", "0"), 3, 9, "1 to 100000, in NCelS, found '0'");
  ExpectError(with("RSerie", "-0.1"), 16, 10, "a resistance in ohm of at least 0 in RSerie");
  ExpectError(with("RShunt", "0"), 13, 10, "a resistance in ohm above 0 in RShunt");
  ExpectError(with("Gamma", "1e999"), 17, 9, "found '1e999'");
  // The shunt alone takes more than Isc at Voc; the band gap has no room for the voltage.
  ExpectError(kSiliconPan.With("RShunt", "3.5").With("Rp_0", "3.5").Text(), 7, 7,
              "expected a voltage that Isc, RSerie, RShunt, Gamma");
  ExpectErrorAt(ReadPanParameters(kThinPan.With("Voc", "98").Text(), "thin.PAN"), "thin.PAN", 7, 7,
                "the technology allow");
  ExpectErrorAt(
      ReadPanParameters(kSiliconPan.With("Rp_0", "960000").With("Rp_Exp", "1.1").Text(), "bad.PAN"),
      "bad.PAN", 0, 0, "0 ohm");
}

TEST_F(BadPan, IsRefusedForAnotherUnit) {
  const auto with = [](const char* key, const char* value) {
    return kSiliconPan.With(key, value).Text();
  };
  ExpectError(with("TRef", "298.15"), 5, 8, "expected the reference 25 C in TRef, found '298.15'");
  ExpectError(with("GRef", "1.0"), 4, 8, "expected the reference 1000 W/m2 in GRef");
  ExpectError(with("muISC", "4870"), 10, 9,
              "expected a coefficient in mA/K, -48.7 to 48.7, in muISC");
  ExpectErrorAt(ReadPanSheet(with("muVocSpec", "-0.31"), "bad.PAN"), "bad.PAN", 11, 13,
                "expected a negative coefficient in mV/K of a Voc of 39.9 V, not in percent");
  ExpectErrorAt(ReadPanSheet(with("muVocSpec", "122.5"), "bad.PAN"), "bad.PAN", 11, 13, "negative");
}

TEST_F(BadPan, IsRefusedForItsStructure) {
  const std::string text = kSiliconPan.Text();
  ExpectError(text.substr(0, text.find("End of")), 18, 1,
              "the file ends within the block 'PVObject_=pvModule' of line 1: expected \"End of");
  ExpectError("\n  PVObject_=pvInverter\nEnd of PVObject pvInverter\n", 2, 3,
              "expected a module, PVObject_=pvModule, found 'PVObject_=pvInverter'");
  std::string twice = text;
  twice.insert(twice.find("  Voc="), "  Isc=9.75\n");
  ExpectError(twice, 7, 3, "the module has Isc twice: here and in line 6");
  ExpectError("PVObject_=pvModule\n  PVObject_IAM=pvIAM\n", 2, 1, "'PVObject_IAM=pvIAM' of line 2");
  const TempFolder folder;
  const auto read = [&](const std::string& bytes) {
    return ReadModuleParameters(folder.Write("bad.PAN", bytes));
  };
  EXPECT_THAT(MessageOf(read("PVObject_=pvModule" + std::string(9, '\0'))), HasSubstr("binary"));
  EXPECT_THAT(MessageOf(read("")), HasSubstr("empty"));
  EXPECT_THAT(MessageOf(read("no module")), HasSubstr("expected a module: pvlib's parameters"));
  EXPECT_THAT(MessageOf(read("PVObject_=pvModule\n" + std::string(70U << 20, ' '))),
              HasSubstr("larger"));
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
