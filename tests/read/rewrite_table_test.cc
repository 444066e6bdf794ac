#include "lyrefit/read/rewrite_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(RewriteTableTest, AWholeBufferInOneLineIsTakenApart) {
  const DecodedText text =
      RewriteTable({"0,-2,9.91e37,0,21508,0.5,-1,+9.910000E+37,0.1,21508\n", ""});
  EXPECT_EQ(text.text, "0,-2,9.91e37,0,21508\n0.5,-1,+9.910000E+37,0.1,21508\n");
  EXPECT_THAT(text.remark, HasSubstr("as source meters send their buffer"));
}

TEST(RewriteTableTest, AScanGetsItsVoltagesAndKeepsItsLines) {
  const DecodedText text = RewriteTable(
      {"Start_V;100\nInterval_V;10\n\nNo;I1 (A);I2 (A)\n1;8,5;8,4\n\n2;8,4;8,3\n", "decoded"});
  EXPECT_EQ(text.text,
            "Start_V;100\nInterval_V;10\n\nvoltage_V;No;I1 (A);I2 (A)\n100;1;8,5;8,4\n\n"
            "110;2;8,4;8,3\n");
  EXPECT_THAT(text.remark, HasSubstr("decoded; currents without voltages"));
  EXPECT_EQ(text.setup, Setup::kInverter);
}

TEST(RewriteTableTest, PixelsOfALineBecomeColumns) {
  const std::string results = "\t1\t1\t1\t1\t1\t1\t1";  // eight a pixel, with the marked field
  const DecodedText text = RewriteTable(
      {"7\tnow\t1\t0\t1\t0\t2.0\thysteresis$1" + results + "\t-10\t-20\t0.5\t0\n", ""});
  EXPECT_EQ(text.text, "V7.1 (V)\tI7.1 (A)\n0.5\t-0.02\n0\t-0.04\n");
}

TEST(RewriteTableTest, OtherTextStaysAsItIs) {
  for (const std::string plain :
       {"V,I\n0,1\n", "", "1,2,3,4,5\n", "Start_V;100\nInterval_V;10\nV;I\n0;1\n",
        "Start_V;100\nNo;I1 (A)\n1;8\n", "7\tnow\t1\t0\t1\t0\t2.0\thysteresis$1\t2\n"}) {
    const DecodedText text = RewriteTable({plain, ""});
    EXPECT_EQ(text.text, plain);
    EXPECT_THAT(text.remark, IsEmpty());
  }
}

}  // namespace
}  // namespace lyrefit
