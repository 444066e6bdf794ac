#include "lyrefit/read/device_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "error_of.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

IvCurve OfUnknownCells() {
  IvCurve curve;
  curve.cells_known = false;
  curve.assumptions.emplace_back("number of cells not given", About::kCells);
  return curve;
}

DeviceLayout OfAString() { return {60, 3, 20, "module.json"}; }

TEST(FillLayout, MakesCellsAndDiodesOfTheModules) {
  IvCurve curve = OfUnknownCells();
  FillLayout(OfAString(), &curve);
  EXPECT_EQ(curve.conditions.cells_in_series, 1200);
  EXPECT_TRUE(curve.cells_known);
  EXPECT_EQ(curve.notes.bypass_diodes, 60);
  EXPECT_EQ(curve.notes.modules_in_series, 20);
  EXPECT_THAT(SentencesOf(curve.assumptions),
              ElementsAre("1200 cells and 60 bypass diodes: 20 modules of 60 cells, module.json"));
}

TEST(FillLayout, LeavesWhatTheCurveStates) {
  IvCurve curve;
  curve.conditions.cells_in_series = 1140;
  curve.notes.modules_in_series = 19;
  FillLayout(OfAString(), &curve);
  EXPECT_EQ(curve.conditions.cells_in_series, 1140);
  EXPECT_EQ(curve.notes.bypass_diodes, 57) << "of its own modules";
  EXPECT_THAT(SentencesOf(curve.assumptions),
              ElementsAre("57 bypass diodes: 19 modules of 3 bypass diodes, module.json"));
  FillLayout(OfAString(), &curve);
  EXPECT_EQ(curve.assumptions.size(), 1U) << "nothing is left to fill";
  IvCurve counted;
  counted.conditions.cells_in_series = 1200;
  FillLayout({60, 3, {}, "module.json"}, &counted);
  EXPECT_EQ(counted.notes.bypass_diodes, 60) << "its cells are 20 modules";
  IvCurve unlike;
  unlike.conditions.cells_in_series = 1200;
  FillLayout({60, 3, 1, "module.json"}, &unlike);
  EXPECT_FALSE(unlike.notes.bypass_diodes) << "1200 cells are not one module";
  IvCurve other = OfUnknownCells();
  FillLayout(DeviceLayout(), &other);
  EXPECT_FALSE(other.cells_known);
  EXPECT_FALSE(other.notes.bypass_diodes);
}

TEST(ReadDeviceLayoutTest, ReadsASheet) {
  const TempFolder folder;
  const std::string sheet = folder.Write(
      "m.json", R"({"cells_in_series": 60, "bypass_diodes": 3, "modules_in_series": 20})");
  const auto layout = ReadDeviceLayout(sheet);
  ASSERT_TRUE(layout) << layout.error().ToString();
  EXPECT_EQ(layout->module_cells, 60);
  EXPECT_EQ(layout->module_diodes, 3);
  EXPECT_EQ(layout->modules_in_series, 20);
  EXPECT_EQ(layout->source, "m.json");
  EXPECT_TRUE(IsModuleSheet(sheet));
}

TEST(ReadDeviceLayoutTest, ListsTheKeysWhereOneIsWrong) {
  const TempFolder folder;
  const auto layout =
      ReadDeviceLayout(folder.Write("m.json", "{\n \"cells_in_series\": 60,\n \"diodes\": 3}"));
  ASSERT_FALSE(layout);
  EXPECT_THAT(layout.error().ToString(),
              AllOf(HasSubstr("m.json:3:2: "), HasSubstr("\"diodes\""),
                    HasSubstr("cells_in_series, bypass_diodes, modules_in_series, rated_power_W")));
  EXPECT_THAT(MessageOf(ReadDeviceLayout(folder.Write("n.json", R"({"bypass_diodes": 0})"))),
              HasSubstr("a number from 1 up in \"bypass_diodes\""));
}

TEST(ReadDeviceLayoutTest, ThePageOfBatchHasEveryKey) {
  const TempFolder folder;
  const std::string message = MessageOf(ReadDeviceLayout(folder.Write("m.json", R"({"x": 1})")));
  const std::string page = FileText(LYREFIT_DATA_DIR "/../apps/lyrefit/verbs/batch.md");
  std::istringstream keys(message.substr(message.find("one of ") + 7));
  int count = 0;
  for (std::string key; keys >> key; ++count) {
    key = key.substr(0, key.find(','));
    EXPECT_THAT(page, HasSubstr("`" + key + "`"));
  }
  EXPECT_EQ(count, 24) << message;
}

TEST(ReadDeviceLayoutTest, ACurveIsNoSheet) {
  const TempFolder folder;
  EXPECT_FALSE(IsModuleSheet(folder.Write("c.json", R"({"voltage": [0, 1], "current": [1, 0]})")));
  EXPECT_FALSE(IsModuleSheet(folder.Write("c.csv", "V,I\n0,1\n1,0\n")));
  EXPECT_FALSE(IsModuleSheet(folder.Path("nowhere.json")));
  EXPECT_FALSE(IsModuleSheet(folder.Write("e.json", "{}")));
}

}  // namespace
}  // namespace lyrefit
