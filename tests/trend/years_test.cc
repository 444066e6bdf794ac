#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "faults/field_case.h"
#include "trend/years_year.h"

namespace years {
namespace {

using faults::Random;
using faults::field::Cell;

Request Short(const std::string& effects) {
  Request request;
  request.days = 120;
  request.minutes = 240;
  EXPECT_EQ(ReadEffects(effects, &request.effects), "");
  return request;
}

ModuleYear Made(const std::string& effects) { return Simulate(Short(effects), BuiltIn()); }

faults::field::Module CellByCell(const Design& design) {
  faults::field::Module module;
  for (int g = 0; g < kGroups; ++g) {
    faults::field::Group group;
    group.diode = design.diodes[g];
    group.chains.resize(1);
    for (int c = g * kClasses / kGroups; c < (g + 1) * kClasses / kGroups; ++c) {
      for (int i = 0; i < kCellsOfClass; ++i) group.chains[0].push_back(design.cells[c]);
    }
    module.groups.push_back(group);
  }
  return module;
}

TEST(YearsModule, IsTheSumOfItsCells) {
  for (const bool shaded : {false, true}) {
    Random random(4);
    Design design = DrawDesign(&random);
    design.warmer.fill(0);
    faults::field::Module module = CellByCell(design);
    State state;
    state.covered = shaded;
    state.cover.fill(1);
    if (shaded) {
      state.cover[1] = 0.3;
      for (int i = 0; i < kCellsOfClass; ++i) {
        module.groups[0].chains[0][kCellsOfClass + i].photocurrent *= 0.3;
      }
    }
    LitModule own(design, state, 1, 298.15);
    const faults::field::Sampled curve = CurveOf(module);
    for (double voltage = 0; voltage < curve.VoltageAt(0); voltage += 0.7) {
      EXPECT_NEAR(own.AtVoltage(voltage, 1, 5).current, curve.CurrentAt(voltage), 2e-5) << voltage;
    }
    EXPECT_NEAR(own.MaximumPower().power(), MaximumPower(curve), 1e-4);
  }
}

TEST(YearsModule, ShortedGroupGivesNoVoltage) {
  Random random(4);
  const Design design = DrawDesign(&random);
  State state;
  state.shorted = 2;
  LitModule whole(design, State{}, 1, 298.15), short_(design, state, 1, 298.15);
  EXPECT_NEAR(short_.OpenCircuit() / whole.OpenCircuit(), 2.0 / 3, 0.01);
  EXPECT_NEAR(short_.MaximumPower().power() / whole.MaximumPower().power(), 2.0 / 3, 0.01);
}

TEST(YearsModule, FindsTheMaximumUnderAStrongShunt) {
  Random random(4);
  const Design design = DrawDesign(&random);
  State state;
  state.shunt = 300;
  LitModule module(design, state, 0.06, 298.15);
  double best = 0;
  for (double voltage = 0; voltage < 40; voltage += 0.01) {
    best = std::max(best, voltage * module.AtVoltage(voltage, 1, 0.3).current);
  }
  EXPECT_NEAR(module.MaximumPower().power() / best, 1, 1e-5);
}

TEST(Years, WithoutEffectsNothingIsLost) {
  const ModuleYear year = Made("none");
  EXPECT_GT(year.whole.undamaged, 1000);
  EXPECT_EQ(year.whole.Total(), 0);
}

TEST(Years, PartsAddUpToTheLoss) {
  Random random(7);
  const Design design = DrawDesign(&random);
  Effects effects;
  ASSERT_EQ(ReadEffects("soiling,bypass=20,series=5,pid=10,recombination=40", &effects), "");
  DayCover cover;
  cover.soiling = 0.9;
  const State state = StateAt(effects, cover, 100);
  Operating maximum;
  const Split split = SplitLoss(design, state, 0.7, 310, &maximum);
  const double undamaged = LitModule(design, State{}, 0.7, 310).MaximumPower().power();
  const double damaged = LitModule(design, state, 0.7, 310).MaximumPower().power();
  EXPECT_DOUBLE_EQ(split.undamaged, undamaged);
  EXPECT_DOUBLE_EQ(maximum.power(), damaged);
  EXPECT_NEAR(split.Total(), undamaged - damaged, 1e-9);
  for (const double lost : split.lost) EXPECT_GT(lost, 0);
}

TEST(Years, AnEffectAloneShowsInItsOwnPart) {
  const std::pair<const char*, Part> effects[] = {{"soiling=0.2", kLight},
                                                  {"series=5", kSeries},
                                                  {"step=0.1", kSeries},
                                                  {"recombination=40", kRecombination},
                                                  {"bypass=50", kMismatch}};
  for (const auto& [name, part] : effects) {
    Request request = Short(name);
    if (request.effects.step_day > 0) request.effects.step_day = 30;
    const ModuleYear year = Simulate(request, BuiltIn());
    for (int k = 0; k < kParts; ++k) {
      const double percent = 100 * year.whole.lost[k] / year.whole.undamaged;
      if (k == part) {
        EXPECT_GT(percent, 0.01) << name;
      } else {
        EXPECT_EQ(percent, 0) << name << ' ' << kPartNames[k];
      }
    }
  }
}

TEST(Years, PotentialInducedDegradationIsShuntAndRecombination) {
  const ModuleYear year = Made("pid=20");
  const Split& lost = year.whole;
  EXPECT_GT(lost.lost[kShunt], 0);
  EXPECT_GT(lost.lost[kRecombination], 0);
  EXPECT_EQ(lost.lost[kLight], 0);
  EXPECT_EQ(lost.lost[kSeries], 0);
  EXPECT_LT(std::fabs(lost.lost[kMismatch]), 0.1 * lost.Total());
  EXPECT_EQ(year.daily[19].energy.Total(), 0);
  EXPECT_GT(year.daily[119].energy.Total(), 0);
}

TEST(Years, SnowTakesLightAndMatchUntilItMelts) {
  Weather weather;
  weather.days.resize(12);
  for (Day& day : weather.days) day = {Sky::kBroken, 2, 0, false};
  weather.days[2].snowfall = true;
  Effects effects;
  effects.snow = true;
  Random random(5);
  const Design design = DrawDesign(&random);
  const std::vector<DayCover> cover = MakeCover(effects, weather, &random);
  EXPECT_FALSE(cover[1].snow);
  EXPECT_TRUE(cover[2].snow);
  EXPECT_FALSE(cover[11].snow);
  Operating maximum;
  const Split split = SplitLoss(design, StateAt(effects, cover[2], 2.5), 0.5, 275, &maximum);
  EXPECT_GT(split.lost[kLight] + split.lost[kMismatch], 0.1 * split.undamaged);
  EXPECT_EQ(split.lost[kSeries] + split.lost[kRecombination] + split.lost[kShunt], 0);
}

TEST(Years, RainWashesDustOff) {
  const ModuleYear year = Made("soiling=0.2");
  for (std::size_t d = 1; d < year.daily.size(); ++d) {
    const double before = year.daily[d - 1].state.light, now = year.daily[d].state.light;
    if (year.weather[d].rain > 0.2) {
      EXPECT_GE(now, before);
    } else {
      EXPECT_LT(now, before);
    }
  }
}

TEST(Years, SameSeedSameYear) {
  Request request = Short("none");
  request.days = 20;
  request.random = true;
  const ModuleYear one = Simulate(request, BuiltIn()), same = Simulate(request, BuiltIn());
  EXPECT_EQ(SweepsCsv(one), SweepsCsv(same));
  EXPECT_EQ(OperatingCsv(one), OperatingCsv(same));
  EXPECT_EQ(TruthJson(request, one), TruthJson(request, same));
  ++request.seed;
  EXPECT_NE(SweepsCsv(one), SweepsCsv(Simulate(request, BuiltIn())));
}

TEST(Years, PerfectSweepsHaveThePowerOfTheTruth) {
  Request request = Short("standard");
  request.days = 100;
  request.perfect = true;
  request.points = 400;
  const ModuleYear year = Simulate(request, BuiltIn());
  double swept = 0, held = 0;
  for (const Row& row : year.rows) {
    double best = 0;
    for (int i = 0; i < request.points; ++i) {
      best = std::max(best, row.sweep.voltage[i] * row.sweep.current[i]);
    }
    swept += best * request.minutes / 60;
    held += row.held.at.power() * request.minutes / 60;
  }
  const double truth = year.whole.undamaged - year.whole.Total();
  EXPECT_NEAR(swept / truth, 1, 1e-3);
  EXPECT_NEAR(held / truth, 1, 1e-6);
  EXPECT_EQ(year.recorded.undamaged, year.whole.undamaged);
}

TEST(Years, GapsHaveNoRows) {
  Request request = Short("none");
  request.days = 365;
  request.seed = 1;
  const ModuleYear year = Simulate(request, BuiltIn());
  ASSERT_FALSE(year.gaps.empty());
  EXPECT_LT(year.recorded.undamaged, year.whole.undamaged);
  for (const Gap& gap : year.gaps) {
    for (const Row& row : year.rows) {
      const std::string date = row.date.substr(0, 10);
      EXPECT_TRUE(date < DateOf(gap.first) || date > DateOf(gap.last)) << row.date;
    }
  }
}

TEST(Years, ClockChangeMovesSummerByAnHour) {
  Request request = Short("none");
  request.perfect = true;
  const ModuleYear plain = Simulate(request, BuiltIn());
  request.clock_change = true;
  const ModuleYear changed = Simulate(request, BuiltIn());
  ASSERT_EQ(plain.rows.size(), changed.rows.size());
  EXPECT_EQ(plain.rows.front().date, changed.rows.front().date);
  EXPECT_EQ(std::stoi(changed.rows.back().date.substr(11, 2)),
            std::stoi(plain.rows.back().date.substr(11, 2)) + 1);
}

TEST(Years, TruthListsQuantitiesAndOnsets) {
  Request request = Short("bypass=30,series=2,step=0.1,pid=130");
  request.effects.step_day = 60;
  const auto truth = nlohmann::json::parse(TruthJson(request, Simulate(request, BuiltIn())));
  const auto& series = truth.at("quantities").at(0);
  EXPECT_EQ(series.at("name"), "resistance_series");
  EXPECT_NEAR(series.at("rate_per_year").get<double>(), 0.02 * series.at("at_start").get<double>(),
              1e-6);
  EXPECT_EQ(series.at("steps").at(0).at("date"), "2025-03-02");
  EXPECT_EQ(truth.at("onsets").at(0).at("cause"), "bypass_short");
  EXPECT_EQ(truth.at("onsets").at(0).at("date"), "2025-01-31");
  EXPECT_EQ(truth.at("onsets").size(), 2);  // the third is after the end
  EXPECT_THAT(truth.at("varies"), testing::ElementsAre("mismatch", "resistance_series"));
}

TEST(Years, EffectsWithoutANameAreAnError) {
  Effects effects;
  EXPECT_EQ(ReadEffects("soiling,hail", &effects), "no effect is called hail");
}

TEST(YearsWeather, CalendarKnowsLeapYears) {
  EXPECT_EQ(DateOf(0), "2025-01-01");
  EXPECT_EQ(DateOf(59), "2025-03-01");
  EXPECT_EQ(DateOf(365 + 365 + 365 + 59), "2028-02-29");
  EXPECT_EQ(DateOf(365 + 365 + 365 + 60), "2028-03-01");
}

TEST(YearsWeather, IsThatOfATemperateYear) {
  Random random(3);
  const Weather weather = MakeWeather(WeatherRequest{}, BuiltIn(), &random);
  double energy = 0, warmest = 0;
  for (const Instant& now : weather.instants) {
    energy += now.light * 0.5 / 1000;
    warmest = std::max(warmest, now.kelvin - kKelvin);
    EXPECT_GE(now.light, 50);
    EXPECT_LT(now.light, 1500);
  }
  EXPECT_GT(energy, 1000);  // kWh/m2
  EXPECT_LT(energy, 2000);
  EXPECT_GT(warmest, 45);
  EXPECT_LT(warmest, 80);
}

TEST(YearsWeather, MissingFolderIsAnError) {
  std::string error;
  EXPECT_TRUE(FromFolder("/nowhere", &error).stretches.empty());
  EXPECT_THAT(error, testing::HasSubstr("nist_ground_2015-07-01/index.csv"));
}

}  // namespace
}  // namespace years
