#include "lyrefit/read/read_pvlib.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "lyrefit/family/family_documents.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/model/pvlib_parameters.h"
#include "lyrefit/report/json.h"
#include "model/synthetic_translation.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

std::string Written(const Translation& translation, const std::vector<double>& shared) {
  const auto keywords = PvlibParameters(translation, shared);
  EXPECT_TRUE(keywords.has_value());
  return PvlibJson("m", translation.spec.law, *keywords, Fail("no row"));
}

void ExpectTheSameCurves(const Translation& translation, const std::vector<double>& shared,
                         const NamedParameters& read, double voc) {
  for (double g = 100; g <= 1100; g += 250) {
    for (double t = 0; t <= 70; t += 35) {
      const TranslatedDevice ours = TranslateTo(translation, shared, g, t + kZeroCelsius_K);
      const TranslatedDevice back =
          TranslateTo(read.translation, read.shared, g, t + kZeroCelsius_K);
      for (double v = 0; v <= voc; v += 0.2 * voc) {
        EXPECT_NEAR(SolveOperatingPoint(ours.device, ours.parameters.data(), v).current_A,
                    SolveOperatingPoint(back.device, back.parameters.data(), v).current_A, 1e-9)
            << "G = " << g << ", T = " << t << ", V = " << v;
      }
    }
  }
}

TEST(ReadPvlibParameters, TakesBackWhatPvlibJsonWroteOfDeSoto) {
  const TempFolder folder;
  for (const double shunt : {380.0, std::numeric_limits<double>::infinity()}) {
    for (const ConstantSet constants : {ConstantSet::kCodata, ConstantSet::kPaper}) {
      TranslationSpec spec = DeSoto60();
      spec.constants = constants;
      std::vector<double> shared = kSilicon;
      shared[4] = shunt;
      const Translation translation = *MakeTranslation(spec);
      const auto read =
          ReadPvlibParameters(folder.Write("module.json", Written(translation, shared)));
      ASSERT_TRUE(read.has_value()) << read.error().ToString();
      EXPECT_EQ(read->name, "module.json");
      EXPECT_TRUE(read->cells_stated);
      EXPECT_EQ(read->translation.spec.cells_in_series, 60);
      ExpectTheSameCurves(translation, shared, *read, 37);
    }
  }
}

TEST(ReadPvlibParameters, TakesBackWhatPvlibJsonWroteOfPvsyst) {
  const TempFolder folder;
  for (const bool recombination : {false, true}) {
    for (const ShuntLaw shunt : {ShuntLaw::kExponential, ShuntLaw::kConstant}) {
      std::vector<double> shared = {1.2, 2e-10, 1.4, 5.1, 3100, 0.0006, 1.5, -0.001};
      if (shunt == ShuntLaw::kExponential) shared.insert(shared.end(), {9000, 5.5});
      if (recombination) shared.insert(shared.end(), {1.6, 0.9 * 106});
      const Translation translation = *MakeTranslation(Pvsyst106(shunt, recombination));
      const auto read =
          ReadPvlibParameters(folder.Write("module.json", Written(translation, shared)));
      ASSERT_TRUE(read.has_value()) << read.error().ToString();
      EXPECT_EQ(read->translation.spec.recombination, recombination);
      ExpectTheSameCurves(translation, shared, *read, 82);
    }
  }
}

// Files of earlier versions have all keywords in one object.
TEST(ReadPvlibParameters, TakesFilesWithAllKeywordsInOnePlace) {
  const TempFolder folder;
  const Translation thin = *MakeTranslation(Pvsyst106(ShuntLaw::kExponential, true));
  const std::vector<double> values = {1.2, 2e-10, 1.4,  5.1, 3100, 0.0006,
                                      1.5, -1e-3, 9000, 5.5, 1.6,  0.9 * 106};
  const Translation desoto = *MakeTranslation(DeSoto60());
  const struct {
    const Translation& translation;
    const std::vector<double>& values;
    double voc;
  } kCases[] = {{desoto, kSilicon, 37}, {thin, values, 82}};
  for (const auto& c : kCases) {
    json file = json::parse(Written(c.translation, c.values));
    file["parameters"]["cells_in_series"] = file["cells_in_series"];
    file.erase("cells_in_series");
    if (file.contains("bishop88")) file["parameters"].update(file["bishop88"]);
    file.erase("bishop88");
    const auto read = ReadPvlibParameters(folder.Write("old.json", file.dump()));
    ASSERT_TRUE(read.has_value()) << read.error().ToString();
    EXPECT_TRUE(read->cells_stated || read->translation.spec.law == TranslationLaw::kPvsyst);
    ExpectTheSameCurves(c.translation, c.values, *read, c.voc);
  }
}

json Keywords(const Translation& translation, const std::vector<double>& shared) {
  return json::parse(Written(translation, shared))["parameters"];
}

// A dictionary from pvlib's fit_desoto has no number of cells, and default values may be missing.
TEST(ReadPvlibParameters, TakesADictionaryOfAPvlibUser) {
  const TempFolder folder;
  const Translation desoto = *MakeTranslation(DeSoto60());
  json bare = Keywords(desoto, kSilicon);
  for (const char* key : {"cells_in_series", "EgRef", "dEgdT", "irrad_ref", "temp_ref"}) {
    bare.erase(key);
  }
  const auto read = ReadPvlibParameters(folder.Write("bare.json", bare.dump()));
  ASSERT_TRUE(read.has_value()) << read.error().ToString();
  EXPECT_FALSE(read->cells_stated);
  ExpectTheSameCurves(desoto, kSilicon, *read, 37);

  const std::vector<double> thin = {1.2, 2e-10, 1.4, 5.1, 3100, 6e-4, 1.121, -0.001, 9000, 5.5};
  const Translation pvsyst = *MakeTranslation(Pvsyst106(ShuntLaw::kExponential, false));
  bare = Keywords(pvsyst, thin);
  for (const char* key : {"R_sh_exp", "EgRef"}) bare.erase(key);
  const auto other = ReadPvlibParameters(folder.Write("bare.json", bare.dump()));
  ASSERT_TRUE(other.has_value()) << other.error().ToString();
  ExpectTheSameCurves(pvsyst, thin, *other, 82);
}

class BadPvlibFile : public ::testing::Test {
 protected:
  std::string Complaint(const std::string& text) const {
    const auto read = ReadPvlibParameters(folder_.Write("bad.json", text));
    return read ? "" : read.error().ToString();
  }

  // The error for the dictionary with `value` at `key`.
  std::string With(const char* key, const json& value) const {
    json changed = good_;
    changed[key] = value;
    return Complaint(changed.dump(2));
  }

  std::string Without(const char* key) const {
    json changed = good_;
    changed.erase(key);
    return Complaint(changed.dump(2));
  }

  TempFolder folder_;
  json good_ = Keywords(*MakeTranslation(DeSoto60()), kSilicon);
};

TEST_F(BadPvlibFile, IsRefusedForAMissingKey) {
  EXPECT_THAT(Without("I_L_ref"), HasSubstr("bad.json: expected a number for the key \"I_L_ref\""));
  EXPECT_THAT(Without("R_sh_ref"), HasSubstr("R_sh_ref"));
  EXPECT_THAT(Without("a_ref"), HasSubstr("by De Soto (with the key \"a_ref\") or PVsyst"));
  json pvsyst = good_;
  pvsyst.erase("a_ref");
  pvsyst.erase("cells_in_series");
  pvsyst["gamma_ref"] = 1.1;
  EXPECT_THAT(Complaint(pvsyst.dump()), HasSubstr("cells_in_series"));
}

TEST_F(BadPvlibFile, IsRefusedForTextWithItsLineAndColumn) {
  EXPECT_THAT(With("R_s", "much"), HasSubstr("expected a number in \"R_s\", found"));
  EXPECT_THAT(Complaint("{\n  \"a_ref\": 1.5,\n  \"I_L_ref\": \"x\"}"), HasSubstr("bad.json:3:3:"));
  EXPECT_THAT(Complaint("{\n \"a_ref\": Infinity}"), HasSubstr("bad.json:2:"));
  EXPECT_THAT(Complaint("[1, 2]"), HasSubstr("bad.json:1:1: expected an object"));
  EXPECT_THAT(Complaint("{\"parameters\": 3}"), HasSubstr("expected an object in \"parameters\""));
  EXPECT_THAT(Complaint(""), HasSubstr("bad.json"));
}

TEST_F(BadPvlibFile, IsRefusedForValuesThatNoDeviceHas) {
  EXPECT_THAT(With("I_o_ref", 0), HasSubstr("expected a number above 0 in \"I_o_ref\""));
  EXPECT_THAT(With("R_s", -0.1), HasSubstr("expected a number of at least 0 in \"R_s\""));
  EXPECT_THAT(With("cells_in_series", 0), HasSubstr("cells_in_series"));
  EXPECT_THAT(With("cells_in_series", 36.5), HasSubstr("a whole number"));
  EXPECT_THAT(With("irrad_ref", 800), HasSubstr("expected the reference 1000 in \"irrad_ref\""));
  EXPECT_THAT(With("temp_ref", 20), HasSubstr("expected the reference 25 in \"temp_ref\""));
}

TEST_F(BadPvlibFile, IsRefusedForAnUnknownLaw) {
  json wrapped = {{"function", "sapm"}, {"parameters", good_}};
  EXPECT_THAT(Complaint(wrapped.dump(2)), HasSubstr("bad.json:2:3: expected calcparams_desoto, "
                                                    "calcparams_cec or calcparams_pvsyst"));
  wrapped["function"] = "calcparams_cec";
  EXPECT_THAT(Complaint(wrapped.dump(2)), HasSubstr("a number for the key \"Adjust\""));
  wrapped["parameters"]["Adjust"] = -101;
  EXPECT_THAT(Complaint(wrapped.dump(2)), HasSubstr("Adjust"));
  EXPECT_THAT(With("gamma_ref", 1.1), HasSubstr("found the keys of two"));
  EXPECT_THAT(Complaint("{}"), HasSubstr("expected pvlib's parameters"));
}

TEST_F(BadPvlibFile, IsRefusedWhereThereIsNone) {
  const auto read = ReadPvlibParameters(folder_.Path("none.json"));
  ASSERT_FALSE(read.has_value());
  EXPECT_THAT(read.error().ToString(), HasSubstr("none.json"));
}

}  // namespace
}  // namespace lyrefit
