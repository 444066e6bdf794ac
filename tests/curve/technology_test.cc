#include "lyrefit/curve/technology.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {
namespace {

TEST(TechnologyTest, IsFoundUnderTheNamesOfDataSheetsAndOfOtherPrograms) {
  for (const auto& [text, name] : {std::pair("Mono-c-Si", "c-Si"),
                                   {"mtSiMono", "c-Si"},
                                   {"n-type silicon", "c-Si"},
                                   {"Multi-c-Si", "poly-Si"},
                                   {"mtSiPoly", "poly-Si"},
                                   {"mono PERC", "PERC"},
                                   {"n-TOPCon", "TOPCon"},
                                   {"HIT-Si", "HJT"},
                                   {"mtHIT", "HJT"},
                                   {"a-Si/mono", "HJT"},
                                   {"CdTe", "CdTe"},
                                   {"mtCdTe", "CdTe"},
                                   {"CIGS", "CIGS"},
                                   {"mtCIS", "CIGS"},
                                   {"1-a-Si", "a-Si"},
                                   {"2-a-Si", "a-Si tandem"},
                                   {"mtuCSi_aSiH", "micromorph"},
                                   {"GaAs", "GaAs"},
                                   {"perovskite", "perovskite"},
                                   {"perovskite/silicon", "perovskite/Si"},
                                   {"InGaP/GaAs/Ge triple junction", "triple junction"},
                                   {"organic (PM6:Y6)", "organic"},
                                   {"DSSC", "dye"},
                                   {"GaSb", "GaSb"},
                                   {"Ge", "Ge"}}) {
    const Technology* const found = FindTechnology(text);
    ASSERT_NE(found, nullptr) << text;
    EXPECT_STREQ(found->name, name) << text;
  }
}

TEST(TechnologyTest, AWordThatOnlyHoldsAShortNameIsNone) {
  for (const char* const text : {"", "unknown", "germane", "gear", "basis"}) {
    EXPECT_EQ(FindTechnology(text), nullptr) << text;
  }
}

TEST(TechnologyTest, SiliconIsTakenWhereNoneIsKnown) {
  EXPECT_STREQ(Silicon().name, "c-Si");
  EXPECT_FALSE(IsThinFilm("poly"));
  EXPECT_FALSE(IsThinFilm("a-Si/mono"));
  EXPECT_TRUE(IsThinFilm("CdTe"));
  EXPECT_TRUE(IsThinFilm("thin film"));
  EXPECT_EQ(JunctionsPerCell("triple junction"), 3);
  EXPECT_EQ(JunctionsPerCell(""), 1);
}

// Cells of record: Green et al. 2024, doi:10.1002/pip.3831. All lie below the limit of their
// material, and most of them not far below.
TEST(TechnologyTest, CellsOfRecordStayBelowTheHighestVoltage) {
  for (const auto& [text, voc_V] : {std::pair("HJT", 0.751),
                                    {"c-Si", 0.741},
                                    {"GaAs", 1.127},
                                    {"CdTe", 0.917},
                                    {"CIGS", 0.767},
                                    {"a-Si", 0.896},
                                    {"perovskite", 1.19},
                                    {"organic", 0.915},
                                    {"triple junction", 3.0},
                                    {"perovskite/Si", 1.98}}) {
    const double most_V = HighestVoc_V(*FindTechnology(text), 298.15, 1);
    EXPECT_LT(voc_V, most_V) << text;
    EXPECT_GT(voc_V, 0.6 * most_V) << text;
  }
}

TEST(TechnologyTest, TheHighestVoltageFallsWithTemperatureAndRisesWithLight) {
  const Technology& silicon = Silicon();
  EXPECT_NEAR(HighestVoc_V(silicon, 298.15, 1), silicon.most_Voc_V, 1e-12);
  EXPECT_NEAR(HighestVoc_V(silicon, 298.15, 1000) - silicon.most_Voc_V, 0.0257 * 6.908, 1e-3);
  EXPECT_LT(HighestVoc_V(silicon, 348.15, 1), silicon.most_Voc_V);
  EXPECT_GT(HighestVoc_V(silicon, 248.15, 1), silicon.most_Voc_V);
  EXPECT_LT(HighestVoc_V(silicon, 1, 1), 1.22);  // the gap at 0 K, extrapolated
}

}  // namespace
}  // namespace lyrefit
