#include "plant/scale_judge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "lyrefit/base/random.h"
#include "lyrefit/batch/count_rows.h"
#include "plant/scale_strings.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

constexpr double kLevel = 0.001;

// The cells of a string by the names of their columns.
class Said {
 public:
  Said(const std::vector<ScaleMember>& group, std::size_t i) {
    const auto residuals = ScaleResiduals(group);
    ScaleScatter scatter;
    scatter.Add(residuals);
    cells_ = ScaleCells(group, residuals, scatter.ErrorsOf(residuals), kLevel)[i];
  }
  std::string Text(const char* name) const {
    const auto* const text = std::get_if<std::string>(&At(name));
    return text == nullptr ? std::string() : *text;
  }
  double Number(const char* name) const {
    const auto* const number = std::get_if<double>(&At(name));
    return number == nullptr ? kUnknown : *number;
  }
  bool Shared() const { return std::get<bool>(At("plan_shared")); }

 private:
  const ResultCell& At(const char* name) const {
    return cells_.at(ColumnPlace(ScaleColumns(), name));
  }
  std::vector<ResultCell> cells_;
};

// A string with a fault, exactly.
struct ExactFault {
  const char* cause;
  const char* sentence;
  std::function<void(ScaleMember*)> change;
  double lost_W;  // unknown: not compared
};

std::vector<ExactFault> ExactFaults() {
  const ExplicitModule module;
  const auto power = [](const StringFigures& f) { return f.imp_A * f.vmp_V; };
  const double healthy_W = power(FiguresOfModules(module, 20, 0.2));
  const auto built = [=](double modules) {
    return [=](ScaleMember* m) { m->measured = FiguresOfModules({}, modules, 0.2); };
  };
  const auto reversed = FiguresOfLaw(
      [module](double current) {
        return 19 * module.VoltageAt(current) - module.VoltageAt(-current) - 0.2 * current;
      },
      module.photocurrent);
  ExplicitModule dim = module, warm = module;
  dim.photocurrent *= 0.88;
  warm.celsius += 14;
  const StringFigures dirty = FiguresOfModules(dim, 20, 0.2);
  const StringFigures resistive = FiguresOfModules(module, 20, 2.7);
  return {
      {"missing_module", "1 module of 20", built(19), healthy_W / 20},
      {"missing_module", "2 modules of 20", built(18), healthy_W / 10},
      {"bypassed_substring", "2 substrings of 60", built(20 - 2.0 / 3), healthy_W / 30},
      {"reversed_module", "1 module of 20", [=](ScaleMember* m) { m->measured = reversed; },
       healthy_W - power(reversed)},
      {"extra_module", "1 module of 20 too many", built(21), 0},
      {"cable_resistance", "2.5 ohm more", [=](ScaleMember* m) { m->measured = resistive; },
       healthy_W - power(resistive)},
      {"uniform_soiling", "% less current than at the stated light",
       [=](ScaleMember* m) { m->measured = dirty; }, healthy_W - power(dirty)},
      {"light_sensor", "reads low",
       [](ScaleMember* m) {
         m->irradiance_W_m2 *= 0.88;
         m->planned = {};
       },
       0},
      {"temperature_sensor", "14 K warmer",
       [=](ScaleMember* m) { m->measured = FiguresOfModules(warm, 20, 0.2); }, 0},
      {"wrong_module_type", "Isc and",
       [](ScaleMember* m) {
         ExplicitModule other;
         other.photocurrent = 7.3;
         other.voc_V = 41;
         other.series_ohm = 0.45;
         m->measured = FiguresOfModules(other, 20, 0.2);
       },
       kUnknown},
  };
}

TEST(ScaleJudge, NamesEachFaultThatThePlanShows) {
  for (const ExactFault& fault : ExactFaults()) {
    auto group = TenStrings(true);
    fault.change(&group[4]);
    if (std::string(fault.cause) == "light_sensor") {  // the plan follows the stated light
      ExplicitModule less;
      less.photocurrent *= 0.88;
      group[4].planned = FiguresOfModules(less, 20);
    }
    const Said said(group, 4);
    EXPECT_EQ(said.Text("plan_cause"), fault.cause) << said.Text("plan_sentence");
    EXPECT_THAT(said.Text("plan_sentence"), HasSubstr(fault.sentence));
    EXPECT_FALSE(said.Text("plan_action").empty());
    EXPECT_FALSE(said.Shared());
    if (std::isfinite(fault.lost_W)) {
      EXPECT_NEAR(said.Number("plan_lost_W"), fault.lost_W, 0.02 * fault.lost_W + 8) << fault.cause;
    }
    for (const std::size_t healthy : {0, 3, 9}) {
      EXPECT_EQ(Said(group, healthy).Text("plan_cause"), "") << fault.cause;
    }
  }
}

TEST(ScaleJudge, NamesEachFaultThatNeighboursShow) {
  for (const ExactFault& fault : ExactFaults()) {
    auto group = TenStrings(false);
    fault.change(&group[4]);
    const Said said(group, 4);
    const std::string cause = fault.cause;
    if (cause == "extra_module") continue;  // no count of cells is known to be too many
    EXPECT_EQ(said.Text("plan_cause"), cause) << said.Text("plan_sentence");
    EXPECT_EQ(Said(group, 0).Text("plan_cause"), "") << cause;
  }
}

TEST(ScaleJudge, NamesADisconnectedParallelString) {
  for (const bool planned : {true, false}) {
    auto group = TenStrings(planned, 3);
    group[2].measured = FiguresOfModules({}, 20, 0.2, 2);
    const Said said(group, 2);
    EXPECT_EQ(said.Text("plan_cause"), "disconnected_string");
    EXPECT_THAT(said.Text("plan_sentence"),
                HasSubstr(planned ? "1 parallel string of 3" : "33.3 % of the parallel strings"));
  }
}

TEST(ScaleJudge, NamesSoilingAndTheLightSensorAsOneSet) {
  auto group = TenStrings(true);
  ExplicitModule dim;
  dim.photocurrent *= 0.9;
  group[4].measured = FiguresOfModules(dim, 20, 0.2);
  const Said one(group, 4);
  EXPECT_EQ(one.Text("plan_cause"), "uniform_soiling");
  EXPECT_EQ(one.Text("plan_equivalents"), "light_sensor");
  EXPECT_THAT(one.Text("plan_separate_by"), HasSubstr("a second light sensor"));
  EXPECT_THAT(one.Text("plan_separate_by"), HasSubstr("wash the string"));
  // All strings of a combiner: the sensor is the more likely, dirt is not excluded.
  ExplicitModule dark;
  dark.photocurrent *= 0.8;
  for (ScaleMember& member : group) member.measured = FiguresOfModules(dark, 20, 0.2);
  const Said all(group, 4);
  EXPECT_EQ(all.Text("plan_cause"), "light_sensor");
  EXPECT_EQ(all.Text("plan_equivalents"), "uniform_soiling");
  EXPECT_TRUE(all.Shared());
  EXPECT_EQ(all.Number("plan_lost_W"), 0);
}

TEST(ScaleJudge, NamesExchangedStringsAndTheirPartner) {
  for (const bool planned : {true, false}) {
    auto group = TenStrings(planned);
    for (const std::size_t i : {1, 5, 7}) {  // planned with 18 modules
      group[i].measured = FiguresOfModules({}, 18, 0.2);
      if (planned) group[i].planned = FiguresOfModules({}, 18);
      if (planned) group[i].modules = 18;
      group[i].cells = 18 * 60;
    }
    std::swap(group[5].measured, group[6].measured);
    const Said five(group, 5), six(group, 6);
    EXPECT_EQ(five.Text("plan_cause"), "exchanged_strings");
    EXPECT_EQ(six.Text("plan_cause"), "exchanged_strings");
    EXPECT_THAT(five.Text("plan_sentence"), HasSubstr("site/comb/str6"));
    EXPECT_THAT(six.Text("plan_sentence"), HasSubstr("site/comb/str5"));
    EXPECT_EQ(Said(group, 1).Text("plan_cause"), "");
  }
}

TEST(ScaleJudge, SaysNothingWithinTheErrors) {
  auto group = TenStrings(true);
  // One substring of 60 is 1.7 %, four times the error: not enough in a plant of ten strings.
  group[7].measured = FiguresOfModules({}, 20 - 1.0 / 3, 0.2);
  EXPECT_EQ(Said(group, 7).Text("plan_cause"), "");
  group[4].measured.voc_V *= 0.992;  // 2 K, or half a substring
  group[4].measured.vmp_V *= 0.992;
  EXPECT_EQ(Said(group, 4).Text("plan_cause"), "");
  EXPECT_EQ(Said(group, 4).Text("plan_sentence"), "");
  EXPECT_GT(Said(group, 4).Number("plan_p"), kLevel);
}

TEST(ScaleJudge, NamesNoCauseOfADeviationThatNoneExplains) {
  auto group = TenStrings(true);
  group[4].measured.vmp_V *= 0.92;  // a step of the curve: Isc, Voc and slope are as ever
  const Said said(group, 4);
  EXPECT_EQ(said.Text("plan_cause"), "");
  EXPECT_THAT(said.Text("plan_sentence"), HasSubstr("no cause of the scale explains"));
  EXPECT_LT(said.Number("plan_p"), kLevel);
}

TEST(ScaleJudge, LeavesAStringToTheCauseOfItsCurve) {
  auto group = TenStrings(true);
  group[4].measured = FiguresOfModules({}, 19, 0.2);
  group[4].own_cause = "shading";
  const Said said(group, 4);
  EXPECT_EQ(said.Text("plan_cause"), "");
  EXPECT_THAT(said.Text("plan_sentence"), HasSubstr("shading"));
}

TEST(ScaleJudge, JudgesAStringWithoutPeersByItsPlanAlone) {
  auto group = TenStrings(true);
  group.resize(1);
  EXPECT_EQ(Said(group, 0).Text("plan_cause"), "");
  group[0].measured = FiguresOfModules({}, 18, 0.2);
  EXPECT_EQ(Said(group, 0).Text("plan_cause"), "missing_module");
  auto alone = TenStrings(false);
  alone.resize(3);
  alone[0].measured = FiguresOfModules({}, 18, 0.2);
  EXPECT_EQ(Said(alone, 0).Text("plan_cause"), "") << "too few neighbours";
}

TEST(ScaleJudge, ClaimsHealthyStringsBelowTheLevel) {
  // Errors of the usual size, in many plants of two combiners: at a level of 2 % the number of claims
  // is large enough for a rate.
  RandomStream random(3);
  const std::vector<ScaleMember> ten = TenStrings(true);
  int strings = 0, claims = 0;
  for (int plant = 0; plant < 150; ++plant) {
    ScaleScatter scatter;
    std::vector<std::vector<ScaleMember>> groups = {ten, ten};
    std::vector<std::vector<ScaleResidual>> residuals;
    for (auto& group : groups) {
      for (ScaleMember& member : group) {
        StringFigures& f = member.measured;
        const double light = 1 + 0.008 * random.Normal(), volts = 1 + 0.004 * random.Normal();
        f.isc_A *= light;
        f.imp_A *= light * (1 + 0.006 * random.Normal());
        f.voc_V *= volts;
        f.vmp_V *= volts * (1 + 0.004 * random.Normal());
        f.slope_ohm *= 1 + 0.03 * random.Normal();
      }
      residuals.push_back(ScaleResiduals(group));
      scatter.Add(residuals.back());
    }
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const ScaleErrors errors = scatter.ErrorsOf(residuals[g]);
      for (const auto& cells : ScaleCells(groups[g], residuals[g], errors, 0.02)) {
        ++strings;
        claims += std::holds_alternative<std::string>(cells[0]) ? 1 : 0;
      }
    }
  }
  RecordProperty("claims", std::to_string(claims));
  EXPECT_LE(claims, 0.02 * strings);
}

}  // namespace
}  // namespace lyrefit
