#include "lyrefit/read/curve_text.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <functional>
#include <string>
#include <thread>

#include "lyrefit/base/file.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/read_curve_set.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

const std::string kData = LYREFIT_DATA_DIR;

// Calls `read` with the path of a pipe that delivers `text`, and with `beside` as the sidecar of
// that pipe.
void WithPipe(const std::string& text, const std::string& beside,
              const std::function<void(const std::string& path)>& read) {
  const TempFolder folder;
  const std::string path = folder.Path("pipe.csv");
  if (!beside.empty()) folder.Write("pipe.json", beside);
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(path) << text; });
  read(path);
  writer.join();
}

TEST(CurveOfAPipe, IsThatOfTheFile) {
  const std::string folder = kData + "/rtc_france/";
  const auto file = ReadCurve(folder + "curve.csv");
  WithPipe(FileText(folder + "curve.csv"), FileText(folder + "curve.json"),
           [&](const std::string& path) {
             const auto curve = ReadCurve(path);
             ASSERT_TRUE(curve) << curve.error().ToString();
             EXPECT_EQ(curve->current_A, file->current_A);
             EXPECT_EQ(curve->conditions.cell_temperature_K, file->conditions.cell_temperature_K);
             EXPECT_EQ(curve->name, file->name);
           });
}

TEST(CurveOfAPipe, MayBeJsonWhateverItsName) {
  WithPipe(R"({"voltage_V": [0, 0.2, 0.4, 0.5, 0.55], "current_A": [1, 1, 0.9, 0.6, 0.1]})", "",
           [](const std::string& path) {
             const auto curve = ReadCurve(path);
             ASSERT_TRUE(curve) << curve.error().ToString();
             EXPECT_EQ(curve->size(), 5U);
           });
}

TEST(CurvesOfAPipe, AreASetWhereItHoldsSeveral) {
  const std::string file = kData + "/s75_constructed/curves.csv";
  const auto set = ReadCurveSet(file);
  ASSERT_TRUE(set) << set.error().ToString();
  WithPipe(FileText(file), "", [&](const std::string& path) {
    const auto piped = ReadMeasurement(path);
    ASSERT_TRUE(piped) << piped.error().ToString();
    EXPECT_EQ(piped->curves.size(), set->curves.size());
  });
  WithPipe(FileText(kData + "/rtc_france/curve.csv"), "", [&](const std::string& path) {
    EXPECT_FALSE(HoldsCurveSet(path)) << "nothing is taken from it";
    const auto one = ReadMeasurement(path);
    ASSERT_TRUE(one) << one.error().ToString();
    EXPECT_EQ(one->curves.size(), 1U);
  });
}

TEST(CurveSets, RefuseAPipeAmongTheTablesOfAFolder) {
  const TempFolder folder;
  for (const char* name : {"a.csv", "b.csv"}) {
    folder.Write(name, FileText(kData + "/rtc_france/curve.csv"));
  }
  ASSERT_EQ(mkfifo(folder.Path("c.csv").c_str(), 0600), 0);
  const auto set = ReadCurveSet(folder.Path(""));
  ASSERT_TRUE(set) << set.error().ToString();
  EXPECT_EQ(set->curves.size(), 2U);
  ASSERT_EQ(set->rejected.size(), 1U);
  EXPECT_EQ(set->rejected[0].error.message, "expected a file, found a pipe, a socket or a device");
}

TEST(CurveSets, StopAmongCountlessColumns) {
  constexpr int kColumns = 3000;
  std::string table = "V";
  for (int i = 0; i < kColumns; ++i) table += ",I" + std::to_string(i);
  for (int row = 0; row < 12; ++row) {
    table += "\n" + std::to_string(0.05 * row);
    for (int i = 0; i < kColumns; ++i) table += "," + std::to_string(1 - 0.05 * row);
  }
  const TempFolder folder;
  const std::string path = folder.Write("wide.csv", table + "\n");
  int asked = 0;
  const StoppableReads reads(StopToken([&asked] { return ++asked > 100; }));
  const auto set = ReadCurveSet(path);
  ASSERT_FALSE(set);
  EXPECT_EQ(set.error().message, "stopped before the end of it was read");
  EXPECT_EQ(asked, 101);
}

}  // namespace
}  // namespace lyrefit
