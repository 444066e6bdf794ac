#include <algorithm>

#include "run_app.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

const std::string kRow =
    R"({"id":"a/b","irradiance_W_m2":912,"cell_temperature_C":47,"cells_in_series":60,)"
    R"("voltage_V":[0,10,20,30,36],"current_A":[8.5,8.49,8.4,6,0.1]})";

TEST(Pack, MakesOneRowACurveOfAFolderTree) {
  const TempFolder folder;
  folder.Write("plant/i1/s1.csv", "V,A\n0,8\n30,0\n");
  folder.Write("plant/i1/s2.csv", "V,A\n0,8\n30,x\n");
  folder.Write("plant/photo.jpg", "x");
  const AppResult result =
      RunApp("pack '" + folder.Path("plant") + "' --out '" + folder.Path("p.jsonl") + "'");
  EXPECT_EQ(result.exit_code, 2);  // one file could not be read
  EXPECT_THAT(result.out, HasSubstr("2 curves in "));
  EXPECT_THAT(result.out, HasSubstr("1 of them could not be read; the first:\n"));
  EXPECT_THAT(result.err, HasSubstr("1 file of other kinds left aside (1 .jpg)"));
  const std::string text = FileText(folder.Path("p.jsonl"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
  EXPECT_THAT(text, HasSubstr(R"({"id": "i1/s1", )"));
  EXPECT_THAT(text, HasSubstr("s2.csv:3:4: expected a number in column A, found 'x'"));
  EXPECT_FALSE(std::filesystem::exists(folder.Path("p.jsonl.part")));
}

TEST(Pack, ReadsStandardInputAndWritesStandardOutput) {
  const TempFolder folder;
  const std::string in = folder.Write("in.jsonl", kRow + "\n");
  const AppResult result = RunApp("pack - --out -", in);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const auto row = nlohmann::json::parse(result.out, nullptr, false);
  ASSERT_TRUE(row.is_object());
  EXPECT_EQ(row["id"], "a/b");
  EXPECT_EQ(row["voltage_V"].size(), 5U);
  EXPECT_EQ(row["irradiance_W_m2"], 912);
  // The output is valid input and is reproduced unchanged.
  const AppResult again = RunApp("pack - --out -", folder.Write("out.jsonl", result.out));
  EXPECT_EQ(again.out, result.out);
}

}  // namespace
}  // namespace lyrefit
