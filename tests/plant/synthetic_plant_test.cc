#include "plant/synthetic_plant.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "temp_folder.h"

namespace made {
namespace {

using lyrefit::FileText;
using lyrefit::TempFolder;

TEST(SyntheticPlant, IsTheSameOnAnyNumberOfThreads) {
  const TempFolder folder;
  PlantRequest request;
  request.strings = 2;
  request.packed = folder.Path("one.csv");
  request.tree = folder.Path("tree");
  request.threads = 1;
  ASSERT_EQ(WritePlant(request), "");
  request.packed = folder.Path("two.csv");
  request.tree.clear();
  request.threads = 2;
  ASSERT_EQ(WritePlant(request), "");
  EXPECT_EQ(FileText(folder.Path("one.csv")), FileText(folder.Path("two.csv")));
  EXPECT_THAT(FileText(folder.Path("one.csv")), testing::HasSubstr("\nelm/inv01/comb01/str02,"));
  EXPECT_THAT(FileText(folder.Path("tree/elm/inv01/comb01/str02.csv")),
              testing::HasSubstr("Number of cells,1200"));
}

TEST(SyntheticPlant, ALaterCampaignHasTwentyChangesAndRoomForThem) {
  EXPECT_EQ(PlantChanges().size(), 20u);
  PlantRequest request;
  request.strings = 20;
  request.years = 1;
  EXPECT_THAT(WritePlant(request), testing::HasSubstr("needs 50 strings"));
}

TEST(SyntheticPlant, HasTwelveKindsOfFaults) { EXPECT_EQ(PlantFaults().size(), 12u); }

}  // namespace
}  // namespace made
