#include "lyrefit/read/curve_files.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "temp_folder.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

TEST(CurveFilesTest, ATableIsReadWithItsSidecarIndexAndBounds) {
  const TempFolder folder;
  const std::string table = folder.Write("module.csv", "V,I\n");
  EXPECT_EQ(RoleOf(table, table), FileRole::kRead);
  for (const char* name : {"module.json", "module-index.csv", "bounds-paper.json"}) {
    EXPECT_EQ(RoleOf(folder.Path(name), table), FileRole::kConditions) << name;
    folder.Write(name, "{}");  // the file need not exist
    EXPECT_EQ(RoleOf(folder.Path(name), table), FileRole::kConditions) << name;
  }
  for (const char* name : {"fit.json", "module.svg", "modules.json", "sub/module.json"}) {
    EXPECT_EQ(RoleOf(folder.Path(name), table), FileRole::kNone) << name;
  }
}

TEST(CurveFilesTest, OneFileHasManyPaths) {
  const TempFolder folder;
  const std::string table = folder.Write("module.csv", "V,I\n");
  fs::create_symlink(table, folder.Path("soft.csv"));
  fs::create_hard_link(table, folder.Path("hard.csv"));
  fs::create_directory(folder.Path("sub"));
  fs::create_directory_symlink(folder.Path(""), folder.Path("sub/back"));
  for (const char* name :
       {"./module.csv", "sub/../module.csv", "sub/back/module.csv", "soft.csv", "hard.csv"}) {
    EXPECT_EQ(RoleOf(folder.Path(name), table), FileRole::kRead) << name;
  }
  // When the table is read through a link, sidecars beside the link and beside the table both
  // apply.
  EXPECT_EQ(RoleOf(folder.Path("soft.json"), folder.Path("soft.csv")), FileRole::kConditions);
  EXPECT_EQ(RoleOf(folder.Path("module.json"), folder.Path("soft.csv")), FileRole::kConditions);
  EXPECT_EQ(RoleOf(folder.Path("sub/back/Module.JSON"), table), FileRole::kConditions);
}

TEST(CurveFilesTest, AFolderOfTablesReadsAllOfThem) {
  const TempFolder folder;
  folder.Write("a.csv", "V,I\n");
  folder.Write("b.txt", "V,I\n");
  const std::string path = folder.Path(".");
  EXPECT_EQ(RoleOf(folder.Path("a.csv"), path), FileRole::kRead);
  EXPECT_EQ(RoleOf(folder.Path("b.txt"), path), FileRole::kRead);
  for (const char* name : {"a.json", "b.json", "index.csv", "dataset.json"}) {
    EXPECT_EQ(RoleOf(folder.Path(name), path), FileRole::kConditions) << name;
  }
  EXPECT_EQ(RoleOf(folder.Path("result.csv"), path), FileRole::kNewCurve);
  EXPECT_EQ(RoleOf(folder.Path("fit.json"), path), FileRole::kNone);
  EXPECT_EQ(RoleOf(folder.Path("sub/result.csv"), path), FileRole::kNone);
}

TEST(CurveFilesTest, AFolderOfOneTableReadsItAlone) {
  const TempFolder folder;
  folder.Write("one/curve.csv", "V,I\n");
  folder.Write("set/curves.csv", "curve,V,I\n");
  EXPECT_EQ(RoleOf(folder.Path("one/curve.csv"), folder.Path("one")), FileRole::kRead);
  EXPECT_EQ(RoleOf(folder.Path("one/curve.json"), folder.Path("one")), FileRole::kConditions);
  EXPECT_EQ(RoleOf(folder.Path("one/result.csv"), folder.Path("one")), FileRole::kNone);
  EXPECT_EQ(RoleOf(folder.Path("set/curves.csv"), folder.Path("set")), FileRole::kRead);
  for (const char* name : {"set/index.csv", "set/dataset.json"}) {
    EXPECT_EQ(RoleOf(folder.Path(name), folder.Path("set")), FileRole::kConditions) << name;
    EXPECT_EQ(RoleOf(folder.Path(name), folder.Path("set/curves.csv")), FileRole::kConditions);
  }
}

TEST(CurveFilesTest, NothingIsReadWhereThereIsNothing) {
  const TempFolder folder;
  EXPECT_EQ(RoleOf(folder.Path("a.csv"), folder.Path("a.csv")), FileRole::kNone);
  EXPECT_EQ(RoleOf(folder.Path("a.csv"), "-"), FileRole::kNone);
}

TEST(CurveFilesTest, OutputsAreTheSameFileBeforeTheyAreThere) {
  const TempFolder folder;
  EXPECT_TRUE(IsSameFile(folder.Path("a.json"), folder.Path("./a.json")));
  EXPECT_FALSE(IsSameFile(folder.Path("a.json"), folder.Path("b.json")));
  EXPECT_FALSE(IsSameFile(folder.Path("a.json"), folder.Path("no/a.json")));
}

}  // namespace
}  // namespace lyrefit
