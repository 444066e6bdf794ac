#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "run_app.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// Points of a cell that a fit accepts without warnings.
const char kGoodRows[] =
    "0,0.76\n0.1,0.759\n0.2,0.758\n0.3,0.755\n0.4,0.73\n0.45,0.69\n0.5,0.57\n0.55,0.3\n0.57,0.05\n";
const std::string kGood = std::string("voltage_V,current_A\n") + kGoodRows;

std::string Sample(int rows) {
  std::string text = "voltage_V,current_A\n";
  for (int i = 0; i < rows; ++i)
    text += "0." + std::to_string(i) + ",0.7" + std::to_string(9 - i) + "\n";
  return text;
}

// Expects an error of one sentence that holds every text of `says`, exit code 1 and no file
// written.
void ExpectRefused(const TempFolder& folder, const std::string& arguments,
                   const std::vector<std::string>& says) {
  const auto files = [&] {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.Path(""))) {
      names.push_back(entry.path().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  };
  const auto before = files();
  const AppResult result = RunApp("fit " + arguments);
  EXPECT_EQ(result.exit_code, 1) << arguments;
  EXPECT_EQ(result.out, "") << arguments;
  EXPECT_THAT(result.err, StartsWith("lyrefit: "));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_LT(result.err.size(), 400U) << result.err;
  for (const std::string& text : says) EXPECT_THAT(result.err, HasSubstr(text));
  EXPECT_EQ(files(), before) << arguments;
}

// Expects a file with this content to be refused when every output is requested.
void ExpectFileRefused(const std::string& content, const std::vector<std::string>& says,
                       const std::string& flags = "") {
  const TempFolder folder;
  const std::string curve = folder.Write("curve.csv", content);
  ExpectRefused(folder,
                curve + " --json " + folder.Path("out.json") + " --plot " + folder.Path("out.svg") +
                    " " + flags,
                says);
}

TEST(BadInput, MissingFile) {
  const TempFolder folder;
  ExpectRefused(folder, folder.Path("no.csv") + " --json " + folder.Path("out.json"),
                {"no.csv", "does not exist"});
  ExpectRefused(folder,
                folder.Path("no.csv") + " --bounds literature --json " + folder.Path("out.json"),
                {"no.csv", "does not exist"});
}

TEST(BadInput, EmptyFile) { ExpectFileRefused("", {"curve.csv", "empty"}); }

TEST(BadInput, HeaderOnly) { ExpectFileRefused("voltage_V,current_A\n", {"curve.csv"}); }

TEST(BadInput, OneColumn) { ExpectFileRefused("voltage_V\n0\n0.1\n0.2\n", {"curve.csv:1"}); }

TEST(BadInput, TextInANumber) { ExpectFileRefused(kGood + "0.58,abc\n", {"curve.csv:11", "abc"}); }

TEST(BadInput, NotANumberAndInfinity) {
  ExpectFileRefused(kGood + "0.58,nan\n", {"curve.csv:11", "nan"});
  ExpectFileRefused(kGood + "inf,0\n", {"curve.csv:11", "inf"});
}

TEST(BadInput, UnequalLengths) { ExpectFileRefused(kGood + "0.58\n", {"curve.csv:11"}); }

TEST(BadInput, TooFewPoints) {
  for (int points = 1; points <= 4; ++points)
    ExpectFileRefused(Sample(points), {"curve.csv", "point"});
}

TEST(BadInput, AllVoltagesEqual) {
  ExpectFileRefused("voltage_V,current_A\n1,2\n1,2.1\n1,2.2\n1,2.3\n1,2.4\n1,2.5\n",
                    {"curve.csv", "different voltages"});
}

TEST(BadInput, KelvinGivenAsCelsius) {
  ExpectFileRefused(kGood, {"--temperature-C", "looks like kelvin"}, "--temperature-C 306.15");
  ExpectFileRefused(kGood, {"--temperature-C", "-100 to 150"}, "--temperature-C -150");
  ExpectFileRefused(kGood, {"--temperature-C"}, "--temperature-C nan");
}

TEST(BadInput, KelvinInTheSidecar) {
  const TempFolder folder;
  const std::string curve = folder.Write("curve.csv", kGood);
  folder.Write("curve.json", "{\n\"cells_in_series\": 1,\n\"nominal_temperature_C\": 306.15\n}\n");
  ExpectRefused(folder, curve, {"curve.json:3"});
}

TEST(BadInput, NegativeCells) {
  ExpectFileRefused(kGood, {"--cells", "at least 1"}, "--cells -3");
  ExpectFileRefused(kGood, {"--cells", "at least 1"}, "--cells 0");
  ExpectFileRefused(kGood, {"--cells"}, "--cells 1.5");
}

TEST(BadInput, BoundsReversed) { ExpectFileRefused(kGood, {"Rs", "reversed"}, "--bound Rs=0.5:0"); }

TEST(BadInput, BoundOutsideTheModel) {
  ExpectFileRefused(kGood, {"n2", "Iph"}, "--model sd --bound n2=1:2");
  ExpectFileRefused(kGood, {"n3"}, "--model dd --fix n3=2");
}

TEST(BadInput, BoundOrFixMisspelt) {
  for (const char* text : {"Rs", "Rs=1", "Rs=a:b", "=0:1", "Rs=0:1:2"}) {
    ExpectFileRefused(kGood, {"--bound", "Rs=0:0.5", text}, std::string("--bound ") + text);
  }
  for (const char* text : {"n2", "n2=", "n2=x", "=2"}) {
    ExpectFileRefused(kGood, {"--fix", "n2=2", text}, std::string("--fix ") + text);
  }
}

TEST(BadInput, BoundsFileBroken) {
  const TempFolder folder;
  const std::string curve = folder.Write("curve.csv", kGood);
  const std::string bounds = folder.Write("my.json", "{\"Iph\":[0,2],\n\"Is\":[0,oops]}\n");
  ExpectRefused(folder, curve + " --bounds " + bounds, {"my.json:2"});
  ExpectRefused(folder, curve + " --bounds nothing.json", {"nothing.json", "physical"});
}

TEST(BadInput, PublishedBoundsThatAreNotThere) {
  ExpectFileRefused(kGood, {"--bounds paper", "bounds-paper.json", "physical"}, "--bounds paper");
  ExpectFileRefused(kGood, {"--bounds table1", "bounds-paper.json", "physical"}, "--bounds table1");
}

TEST(BadInput, UnknownNames) {
  ExpectFileRefused(kGood, {"--model", "sd, dd, td, auto", "'qd'"}, "--model qd");
  ExpectFileRefused(kGood, {"--objective", "measured-current"}, "--objective wrong");
  ExpectFileRefused(kGood, {"--algorithm", "mlo, lo"}, "--algorithm ga");
  ExpectFileRefused(kGood, {"--constants", "codata"}, "--constants wrong");
  ExpectFileRefused(kGood, {"--kernel", "portable"}, "--kernel sse");
  ExpectFileRefused(kGood, {"--nonsense"}, "--nonsense");
}

TEST(BadInput, OptionsOutsideTheirRanges) {
  ExpectFileRefused(kGood, {"--population", "[4, 20000]"}, "--population 2");
  ExpectFileRefused(kGood, {"--memory-rate", "[0, 1]"}, "--memory-rate 1.5");
  ExpectFileRefused(kGood, {"--iterations"}, "--iterations abc");
  ExpectFileRefused(kGood, {"--seed"}, "--seed -1");
  ExpectFileRefused(kGood, {"--elites"}, "--elites 0");
}

TEST(BadInput, UnwritableOutput) {
  const TempFolder folder;
  const std::string curve = folder.Write("curve.csv", kGood);
  ExpectRefused(folder, curve + " --json " + folder.Path("no/out.json"), {"no/out.json"});
  ExpectRefused(folder, curve + " --plot " + folder.Path("no/out.svg"), {"no/out.svg"});
  ExpectRefused(folder, curve + " --json " + folder.Path(""), {"folder"});
  ExpectRefused(folder, curve + " --plot " + folder.Path("out.gif"), {".svg, .png or .pdf"});
  ExpectRefused(folder, curve + " --json /proc/out.json", {"/proc/out.json"});
}

TEST(BadInput, HugeFile) {
  const TempFolder folder;
  const std::string curve = folder.Write("curve.csv", kGood);
  std::filesystem::resize_file(curve, 200U << 20);
  ExpectRefused(folder, curve + " --json " + folder.Path("out.json"), {"curve.csv", "larger"});
}

TEST(BadInput, BinaryFile) {
  std::string bytes =
      "\x7f"
      "ELF";
  for (int i = 0; i < 5000; ++i) bytes += static_cast<char>(i * 37 % 256);
  ExpectFileRefused(bytes, {"curve.csv", "binary"});
}

TEST(BadInput, Folder) {
  const TempFolder folder;
  ExpectRefused(folder, folder.Path(""), {"curve.csv"});
}

TEST(BadInput, NoVerbOrNoCurve) {
  for (const char* arguments : {"-v", "fit", "frobnicate"}) {
    const AppResult result = RunApp(arguments);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, StartsWith("lyrefit: "));
  }
}

}  // namespace
}  // namespace lyrefit
