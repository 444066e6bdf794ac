#include "lyrefit/read/read_pvlib.h"

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

}  // namespace
}  // namespace lyrefit
