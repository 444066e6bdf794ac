#include "lyrefit/curve/technology.h"

#include <gtest/gtest.h>

#include <utility>

namespace lyrefit {
namespace {

TEST(TechnologyTest, SiliconIsTakenWhereNoneIsKnown) { EXPECT_STREQ(Silicon().name, "c-Si"); }

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
