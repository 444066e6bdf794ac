#include "trend/years_year.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace years {
namespace {

using faults::Random;
using faults::SeedOf;

// A part of a year draws from its own numbers, so that the same module meets the same weather
// whatever else is asked for.
enum Draw : std::uint64_t {
  kDesign,
  kSite,
  kWeather,
  kEffects,
  kCover,
  kInstruments,
  kGaps,
  kRows
};

WeatherRequest DrawWeatherRequest(const Request& request, Random* random) {
  WeatherRequest drawn;
  drawn.site.latitude = random->Uniform(36, 50);
  drawn.site.tilt = random->Uniform(15, 45);
  drawn.site.mean_C = 13 - 0.5 * (drawn.site.latitude - 40) + random->Normal();
  drawn.site.season_C = random->Uniform(8, 13);
  drawn.days = request.days;
  drawn.minutes = request.minutes;
  return drawn;
}

std::vector<Gap> DrawGaps(int days, Random* random) {
  std::vector<Gap> gaps;
  for (int day = random->Index(200); day < days; day += 30 + random->Index(250)) {
    const int length = static_cast<int>(random->LogUniform(1.5, 22));
    gaps.push_back({day, std::min(day + length, days) - 1});
    day += length;
  }
  return gaps;
}

bool Inside(const std::vector<Gap>& gaps, int day) {
  return std::any_of(gaps.begin(), gaps.end(),
                     [&](const Gap& gap) { return day >= gap.first && day <= gap.last; });
}

std::string Stamp(const Instant& now, bool forward) {
  const int seconds = static_cast<int>(std::lround(now.hour * 3600)) + (forward ? 3600 : 0);
  char text[40];
  std::snprintf(text, sizeof text, " %02d:%02d:%02d", seconds / 3600 % 24, seconds / 60 % 60,
                seconds % 60);
  return DateOf(now.day) + text;
}

bool Summer(int day) { return day % 365 >= 88 && day % 365 < 298; }

Row Record(const Request& request, const ModuleYear& year, const Instant& now,
           const Operating& maximum, bool curtailed, LitModule* module, Random* random) {
  Row row;
  row.date = Stamp(now, request.clock_change && Summer(now.day));
  row.shown = Sensed(year.instruments, now, now.day / 365.25, random);
  row.sweep = Trace(year.instruments, now, module, random);
  row.held = Hold(year.inverter, maximum, curtailed, module, random);
  return row;
}

void Damage(const Request& request, Random* random, ModuleYear* year, Row* row) {
  const double draw = random->Unit();
  if (request.perfect || draw > 0.006) return;
  if (draw < 0.002) {
    row->sweep = {};
    ++year->missing;
  } else {
    Spoil(&row->sweep, random);
    ++year->bad;
  }
}

Instruments Perfect(const Request& request) {
  Instruments perfect;
  perfect.light_noise = perfect.kelvin_gap = perfect.kelvin_noise = perfect.noise = 0;
  perfect.current_step_A = perfect.voltage_step_V = 1e-6;
  perfect.points = request.points;
  perfect.steady = true;
  return perfect;
}

void Begin(const Request& request, ModuleYear* year) {
  const std::uint64_t seed = request.seed;
  Random design(SeedOf(seed, kDesign)), effects(SeedOf(seed, kEffects));
  Random instruments(SeedOf(seed, kInstruments)), gaps(SeedOf(seed, kGaps));
  year->design = DrawDesign(&design);
  year->effects = request.random ? DrawEffects(request.days, &effects) : request.effects;
  for (int* day : {&year->effects.bypass_day, &year->effects.step_day, &year->effects.pid_day}) {
    if (*day >= request.days) *day = -1;  // after the end
  }
  const double rated_W = LitModule(year->design, State{}, 1, 298.15).MaximumPower().power();
  if (request.perfect) {
    year->instruments = Perfect(request);
    year->inverter = {0, 0, 1e9, 0, 1e9, 0, 1e-6, 1e-6};
    return;
  }
  year->instruments = DrawInstruments(year->design, request.points, &instruments);
  year->inverter = DrawInverter(rated_W, &instruments);
  year->gaps = DrawGaps(request.days, &gaps);
}

}  // namespace

std::string DateOf(int day) {
  static constexpr int kLengths[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  int year = 2025;
  for (int length = 365; day >= length; ++year, length = year % 4 == 0 ? 366 : 365) day -= length;
  int month = 0;
  while (true) {
    const int length = kLengths[month] + (month == 1 && year % 4 == 0 ? 1 : 0);
    if (day < length) break;
    day -= length;
    ++month;
  }
  char text[40];
  std::snprintf(text, sizeof text, "%04d-%02d-%02d", year, month + 1, day + 1);
  return text;
}

ModuleYear Simulate(const Request& request, const Measured& measured) {
  const std::uint64_t seed = request.seed;
  ModuleYear year;
  Begin(request, &year);
  Random site(SeedOf(seed, kSite)), sky(SeedOf(seed, kWeather)), covers(SeedOf(seed, kCover));
  const Weather weather = MakeWeather(DrawWeatherRequest(request, &site), measured, &sky);
  const std::vector<DayCover> cover = MakeCover(year.effects, weather, &covers);
  year.weather = weather.days;
  year.daily.resize(request.days);
  for (int d = 0; d < request.days; ++d) {
    year.daily[d].state = StateAt(year.effects, cover[d], d + 0.5);
    year.daily[d].standard = LitModule(year.design, year.daily[d].state, 1, 298.15).MaximumPower();
  }
  for (const Instant& now : weather.instants) {
    Random random(SeedOf(seed, kRows, now.day, std::lround(now.hour * 3600)));
    const State state = StateAt(year.effects, cover[now.day], now.day + now.hour / 24);
    Operating maximum;
    const Split split = SplitLoss(year.design, state, now.light / 1000, now.kelvin, &maximum);
    year.daily[now.day].energy.Add(split, request.minutes / 60);
    year.whole.Add(split, request.minutes / 60);
    if (Inside(year.gaps, now.day)) continue;
    year.recorded.Add(split, request.minutes / 60);
    const bool curtailed = Random(SeedOf(seed, kGaps, now.day)).Chance(year.inverter.curtailed) &&
                           now.hour > 11 && now.hour < 14;
    LitModule module(year.design, state, now.light / 1000, now.kelvin);
    Row row = Record(request, year, now, maximum, curtailed, &module, &random);
    Damage(request, &random, &year, &row);
    ++year.modes[static_cast<int>(row.held.mode)];
    year.rows.push_back(std::move(row));
  }
  return year;
}

}  // namespace years
