// The program of the studies at a small size.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../repeats.h"
#include "cli/run_app.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(CoverageStudy, CountsTheIntervalsThatHold) {
  const TempFolder folder;
  const AppResult result =
      RunApp("coverage --sets 2 --curves 5 --temperature-offset --csv " + folder.Path("a.csv"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("2 simulated sets"));
  EXPECT_THAT(result.out, HasSubstr("5 curves of 40 points each"));
  EXPECT_THAT(result.out, HasSubstr("as promised"));
  const std::string csv = FileText(folder.Path("a.csv"));
  EXPECT_THAT(csv, StartsWith("parameter,name,unit,fitted,not_identifiable,"));
  EXPECT_THAT(csv, HasSubstr("\nRs,R_s,ohm,2,"));
  EXPECT_THAT(csv, HasSubstr("\ndT,"));
}

TEST(JunctionsStudy, CountsTheIntervalsOfSimulatedTandems) {
  SKIP_IF_SANITIZED();
  const AppResult result = RunApp("junctions --spectra bias --sets 2");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, StartsWith("coverage of the 95 % intervals of two junctions, 2 tandems"));
  EXPECT_THAT(result.out, HasSubstr("bias of 60 points each"));
  EXPECT_THAT(result.out, HasSubstr("failed        0"));
}

TEST(TruthStudy, PrintsTheErrorsAgainstAKnownTruth) {
  const TempFolder folder;
  const std::string header =
      "Index,photocurrent,saturation_current,resistance_series,resistance_shunt,n,cells_in_"
      "series\n";
  const std::string set = "truth " + DataFolder("s75_constructed") + " ";
  const AppResult result =
      RunApp(set + folder.Write("truth.csv", header + "1,5,1e-9,0.3,300,1.1,36\n") +
             " --bound n1=0.5:3 --csv " + folder.Path("fits.csv"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("Truth (one device): "));
  EXPECT_THAT(result.out, HasSubstr("mean of the fits"));
  EXPECT_THAT(FileText(folder.Path("fits.csv")), StartsWith("Index,photocurrent,"));
  const AppResult broken =
      RunApp(set + folder.Write("broken.csv", header + "1,5,x,0.3,300,1.1,36\n"));
  EXPECT_EQ(broken.exit_code, 1);
  EXPECT_THAT(broken.err, HasSubstr("broken.csv:2:5: expected a number"));
}

TEST(Studies, RefuseWhatTheyDoNotKnow) {
  const struct {
    const char* arguments;
    const char* says;
  } cases[] = {
      {"tides", "no study 'tides': expected coverage, junctions or truth"},
      {"coverage --setts 3", "unknown flag --setts"},
      {"coverage --sets 0", "sets = 0 is outside [1, "},
      {"coverage --set Iph=8", "no value for Is1"},
      {"coverage --model td --sets 1", "expected sd or dd"},
      {"truth a.json", "expected a set of curves and a table of their truth"},
      {"truth a.json b.csv --family auto", "--family: expected free or one of"},
  };
  for (const auto& one : cases) {
    const AppResult result = RunApp(one.arguments);
    EXPECT_EQ(result.exit_code, 1) << one.arguments;
    EXPECT_THAT(result.err, HasSubstr(one.says)) << one.arguments;
  }
}

}  // namespace
}  // namespace lyrefit
