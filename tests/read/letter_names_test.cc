#include "lyrefit/read/guess_columns.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lyrefit/read/table_columns.h"

namespace lyrefit {
namespace {

std::vector<Column> ColumnsNamed(const std::vector<std::string>& labels) {
  std::vector<Column> columns;
  for (const std::string& label : labels) columns.push_back(RecogniseColumn(label));
  return columns;
}

TEST(LetterNamesTest, DAndLBehindTheQuantityAreDarkAndLit) {
  for (const auto& labels : {std::vector<std::string>{"Vd", "Jd", "Vl", "Jl"},
                             {"q_V_D", "q_J_D", "q_V_L", "q_J_L"},
                             {"D_V", "D_J", "L_V", "L_J"},
                             {"DV", "DJ", "LV", "LJ"},
                             {"q Vd (V)", "q Jd (mA/cm2)", "q Vl (V)", "q Jl (mA/cm2)"}}) {
    std::vector<Column> columns = ColumnsNamed(labels);
    ASSERT_TRUE(TakeDarkLitLetters(&columns)) << labels[0];
    const std::vector<Channel> channels = FindChannels(columns);
    ASSERT_EQ(channels.size(), 2U);
    for (int k = 0; k < 2; ++k) {
      EXPECT_EQ(channels[k].voltage, 2 * k);
      EXPECT_EQ(channels[k].current, 2 * k + 1);
    }
    EXPECT_EQ(columns[1].tag.light, SweepLight::kDark);
    EXPECT_EQ(columns[3].tag.light, SweepLight::kLight);
    EXPECT_EQ(columns[3].factor, 1e-3);  // mA/cm2, named or not
    EXPECT_EQ(ChannelName(columns, channels[0]), columns[1].tag.device.empty() ? "dark" : "q dark");
  }
}

TEST(LetterNamesTest, DarkAndLitCurrentsMayShareAVoltage) {
  std::vector<Column> columns = ColumnsNamed({"V", "Jl", "Jd"});
  ASSERT_TRUE(TakeDarkLitLetters(&columns));
  const std::vector<Channel> channels = FindChannels(columns);
  ASSERT_EQ(channels.size(), 2U);
  EXPECT_EQ(channels[0].voltage, 0);
  EXPECT_EQ(channels[1].voltage, 0);
}

TEST(LetterNamesTest, FAndRAreDirectionsWhereBothOccur) {
  std::vector<Column> columns =
      ColumnsNamed({"q_F_V_D", "q_F_J_D", "q_F_V_L", "q_F_J_L", "q_R_V_L", "q_R_J_L"});
  ASSERT_TRUE(TakeDarkLitLetters(&columns));
  const std::vector<Channel> channels = FindChannels(columns);
  ASSERT_EQ(channels.size(), 2U);
  EXPECT_TRUE(channels[0].more.empty());
  ASSERT_EQ(channels[1].more.size(), 1U);
  EXPECT_EQ(channels[1].more[0].current, 5);
  EXPECT_EQ(ChannelName(columns, channels[1]), "q light");
}

TEST(LetterNamesTest, OneOfTheTwoLettersSaysNothing) {
  for (const auto& labels :
       {std::vector<std::string>{"V_D", "I_D", "V_G"}, {"Vl", "Il"}, {"V_D", "I_D", "V_L"}}) {
    std::vector<Column> columns = ColumnsNamed(labels);
    EXPECT_FALSE(TakeDarkLitLetters(&columns)) << labels[0];
  }
}

TEST(LetterNamesTest, ALetterBehindAUnitIsNoPrefixOfIt) {
  EXPECT_NE(RecogniseColumn("V_D (V)").factor, 0.1);
  EXPECT_NE(RecogniseColumn("I_D (A)").factor, 0.1);
  EXPECT_EQ(RecogniseColumn("Voltage dV").factor, 0.1);
}

TEST(LetterNamesTest, APairForEachNameInFront) {
  std::vector<Column> columns = ColumnsNamed({"AI", "AV", "BI", "BV", "Time"});
  ASSERT_TRUE(TakeNamedPairs(&columns));
  const std::vector<Channel> channels = FindChannels(columns);
  ASSERT_EQ(channels.size(), 2U);
  EXPECT_EQ(channels[1].voltage, 3);
  EXPECT_EQ(channels[1].current, 2);
  EXPECT_EQ(columns[2].tag.device, "B");
  columns = ColumnsNamed({"AV(1)", "AI(1)", "AV(2)", "AI(2)"});
  ASSERT_TRUE(TakeNamedPairs(&columns));
  ASSERT_EQ(FindChannels(columns).size(), 2U);
  EXPECT_EQ(columns[3].tag.device, "A 2");
  columns = ColumnsNamed({"AnodeV", "AnodeI (mA)"});
  ASSERT_TRUE(TakeNamedPairs(&columns));
  EXPECT_EQ(columns[1].factor, 1e-3);
}

TEST(LetterNamesTest, NoPairsAreQuantitiesThatAreNoReadings) {
  for (const auto& labels : {std::vector<std::string>{"AI", "BV"},
                             {"dV", "dI"},
                             {"maxV", "maxI"},
                             {"mppV", "mppI"},
                             {"AI", "AI2", "Time"}}) {
    std::vector<Column> columns = ColumnsNamed(labels);
    EXPECT_FALSE(TakeNamedPairs(&columns)) << labels[0];
  }
}

TEST(LetterNamesTest, DarkAndLitInOtherLanguages) {
  for (const char* label : {"Strom dunkel (A)", "I_dunkel", "Courant obscurit\u00e9 (A)",
                            "\u6697\u7535\u6d41 (A)", "Corriente oscuridad (A)"}) {
    EXPECT_EQ(RecogniseColumn(label).tag.light, SweepLight::kDark) << label;
  }
  for (const char* label :
       {"Strom hell (A)", "I_hell", "\u5149\u7167\u7535\u6d41 (A)", "Corriente iluminada (A)"}) {
    EXPECT_EQ(RecogniseColumn(label).tag.light, SweepLight::kLight) << label;
  }
}

TEST(LetterNamesTest, LampsSwitchedOnAndOff) {
  EXPECT_EQ(RecogniseColumn("Light off Current (A)").tag.light, SweepLight::kDark);
  EXPECT_EQ(RecogniseColumn("Lamp on Current (A)").tag.light, SweepLight::kLight);
}

}  // namespace
}  // namespace lyrefit
