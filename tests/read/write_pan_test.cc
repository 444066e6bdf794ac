#include "lyrefit/read/write_pan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/read/read_module.h"
#include "model/synthetic_translation.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Shared parameters by PVsyst's law with the exponential shunt, in the order of the translation.
const std::vector<double> kFilm = {1.2, 2e-10, 1.4, 5.1, 3100, 0.0006, 1.5, -0.001, 9000, 5.5};

std::vector<double> With(std::vector<double> shared, const std::vector<double>& more) {
  shared.insert(shared.end(), more.begin(), more.end());
  return shared;
}

TEST(PanText, GivesTheSameCurvesWhenItIsReadBack) {
  const TempFolder folder;
  for (const bool recombination : {false, true}) {
    const Translation translation =
        *MakeTranslation(Pvsyst106(ShuntLaw::kExponential, recombination));
    const std::vector<double> shared = recombination ? With(kFilm, {1.6, 0.9 * 106}) : kFilm;
    const auto text = PanText(translation, shared, {"Film\n1", "Maker", "CdTe", 3});
    ASSERT_TRUE(text) << text.error().ToString();
    EXPECT_THAT(*text, HasSubstr("Only the electrical model is filled"));
    EXPECT_THAT(*text, HasSubstr("    Model=Film 1\r\n"));
    EXPECT_THAT(*text, HasSubstr("  Technol=mtCdTe\r\n  NCelS=106\r\n"));
    EXPECT_THAT(*text, HasSubstr("  NDiode=3\r\n"));
    EXPECT_THAT(*text, HasSubstr("  muGamma=-0.00"));
    EXPECT_THAT(*text, Not(HasSubstr("e-")));
    EXPECT_THAT(*text, Not(HasSubstr("Width")));
    const auto read = ReadModuleParameters(folder.Write("film.PAN", *text));
    ASSERT_TRUE(read) << read.error().ToString();
    EXPECT_TRUE(read->warnings.empty());
    const std::pair<double, double> kConditions[] = {
        {1000, 25}, {800, 45}, {200, 25}, {1100, 65}, {50, 5}};
    for (const auto& [light, celsius] : kConditions) {
      const auto ours = TranslateTo(translation, shared, light, celsius + kZeroCelsius_K);
      const auto back =
          TranslateTo(read->translation, read->shared, light, celsius + kZeroCelsius_K);
      for (double v = 0; v < 80; v += 8) {
        const double is = SolveOperatingPoint(ours.device, ours.parameters.data(), v).current_A;
        EXPECT_NEAR(SolveOperatingPoint(back.device, back.parameters.data(), v).current_A, is,
                    1e-8 * light / 1000);
      }
    }
  }
}

TEST(PanText, NamesTheTechnologyOfTheBandGap) {
  const Translation translation = *MakeTranslation(Pvsyst106(ShuntLaw::kExponential, false));
  std::vector<double> shared = kFilm;
  shared[translation.bandgap] = 1.12;
  EXPECT_THAT(*PanText(translation, shared, {}), HasSubstr("Technol=mtSiMono\r\n"));
  PanNotes notes;
  notes.technology = "Multi-c-Si";
  EXPECT_THAT(*PanText(translation, shared, notes), HasSubstr("Technol=mtSiPoly\r\n"));
  shared[translation.bandgap] = 1.03;
  EXPECT_THAT(*PanText(translation, shared, {}), HasSubstr("Technol=mtCIS\r\n"));
}

TEST(PanText, HasAmorphousTandemsAndTriples) {
  const Translation plain = *MakeTranslation(Pvsyst106(ShuntLaw::kExponential, false));
  const struct {
    const char* technology;
    double gap_eV;
    const char* name;
  } films[] = {{"Amorphous silicon tandem junction", 3.4, "mtaSiH_Tandem"},
               {"Amorphous silicon triple junction", 5.1, "mtaSiH_Triple"}};
  for (const auto& film : films) {
    PanNotes notes;
    notes.technology = film.technology;
    EXPECT_EQ(PanBandgap_eV(film.technology), film.gap_eV);
    std::vector<double> shared = kFilm;
    shared[plain.bandgap] = film.gap_eV;
    const auto text = PanText(plain, shared, notes);
    ASSERT_TRUE(text) << text.error().ToString();
    EXPECT_THAT(*text, HasSubstr("Technol=" + std::string(film.name)));
    EXPECT_THAT(*text, HasSubstr("Remarks, Count=4"));
    // The reader takes the same gap of that name.
    EXPECT_EQ(PanBandgap_eV(film.name), film.gap_eV);
  }
}

TEST(PanText, SaysWhatAPanFileCannotState) {
  EXPECT_THAT(MessageOf(PanText(*MakeTranslation(DeSoto60()), kSilicon, {})),
              HasSubstr("takes the law pvsyst, not desoto"));
  const Translation plain = *MakeTranslation(Pvsyst106(ShuntLaw::kExponential, false));
  std::vector<double> other = kFilm;
  other[plain.bandgap] = 1.121;
  EXPECT_THAT(MessageOf(PanText(plain, other, {})), HasSubstr("implies EgRef = 1.12 eV (silicon)"));
  PanNotes notes;
  notes.technology = "mono-Si";
  EXPECT_THAT(MessageOf(PanText(plain, other, notes)),
              HasSubstr("implies EgRef = 1.12 eV by its technology mtSiMono, found 1.121"));
  notes.technology = "organic";
  EXPECT_THAT(MessageOf(PanText(plain, other, notes)), HasSubstr("name of the technology organic"));
  const Translation film = *MakeTranslation(Pvsyst106(ShuntLaw::kExponential, true));
  EXPECT_THAT(MessageOf(PanText(film, With(kFilm, {1.6, 100}), {})),
              HasSubstr("implies NsVbi = 95.4 V by its technology mtCdTe, found 100"));
  TranslationSpec two = Pvsyst106(ShuntLaw::kExponential, false);
  two.model = Model::kDoubleDiode;
  EXPECT_THAT(MessageOf(PanText(*MakeTranslation(two), With(kFilm, {1e-7, 2}), {})),
              HasSubstr("one diode"));
}

}  // namespace
}  // namespace lyrefit
