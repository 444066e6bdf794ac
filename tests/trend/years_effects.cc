#include "trend/years_effects.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>

namespace years {
namespace {

using faults::Random;

constexpr int kMarch1 = 59, kJune12 = 162, kSeptember1 = 243;

struct Named {
  double usual;  // size without one in the list
  void (*set)(double size, Effects* effects);
};

const std::map<std::string, Named>& Names() {
  static const std::map<std::string, Named> names = {
      {"soiling", {0.1, [](double size, Effects* to) { to->soiling = size; }}},
      {"snow", {1, [](double size, Effects* to) { to->snow = size > 0; }}},
      {"bypass", {kJune12, [](double day, Effects* to) { to->bypass_day = int(day); }}},
      {"series", {2, [](double size, Effects* to) { to->series = size; }}},
      {"step",
       {0.1,
        [](double size, Effects* to) {
          to->step_ohm = size;
          to->step_day = kSeptember1;
        }}},
      {"pid", {kMarch1, [](double day, Effects* to) { to->pid_day = int(day); }}},
      {"recombination", {20, [](double size, Effects* to) { to->recombination = size; }}},
  };
  return names;
}

// Light of the classes when snow covers a share of the module from below. Upright modules have
// cells of each group at the lower edge; others have one group there.
std::array<double, kClasses> UnderSnow(double share, bool upright, double through) {
  constexpr int kOfGroup = kClasses / kGroups;
  std::array<double, kClasses> light{};
  for (int c = 0; c < kClasses; ++c) {
    const double place = upright ? (c % kOfGroup + 0.5) / kOfGroup : (c + 0.5) / kClasses;
    light[c] = place < share ? through : 1;
  }
  return light;
}

void Cover(const std::array<double, kClasses>& light, DayCover* day) {
  constexpr int kOfGroup = kClasses / kGroups;
  day->snow = true;
  day->through = 0;
  for (int g = 0; g < kGroups; ++g) {
    const auto first = light.begin() + g * kOfGroup;
    day->through = std::max(day->through, *std::min_element(first, first + kOfGroup));
  }
  for (int c = 0; c < kClasses; ++c) day->cells[c] = light[c] / day->through;
}

}  // namespace

std::string ReadEffects(const std::string& list, Effects* effects) {
  std::stringstream stream(list);
  for (std::string item; std::getline(stream, item, ',');) {
    if (item == "none") continue;
    if (item == "standard") {
      for (const char* name : {"soiling", "snow", "bypass", "series", "pid"}) {
        const Named& named = Names().at(name);
        named.set(named.usual, effects);
      }
      continue;
    }
    const std::size_t equals = item.find('=');
    const auto found = Names().find(item.substr(0, equals));
    if (found == Names().end()) return "no effect is called " + item;
    const bool sized = equals != std::string::npos;
    found->second.set(sized ? std::atof(item.c_str() + equals + 1) : found->second.usual, effects);
  }
  return "";
}

Effects DrawEffects(int days, Random* random) {
  Effects effects;
  effects.washed = random->Uniform(0.6, 1);
  effects.bypass_group = random->Index(kGroups);
  const auto someday = [&] { return 20 + random->Index(std::max(1, days - 60)); };
  if (random->Chance(0.7)) effects.soiling = random->Uniform(0.01, 0.3);
  effects.snow = random->Chance(0.5);
  if (random->Chance(0.15)) return effects;  // clean years
  if (random->Chance(0.2)) effects.bypass_day = someday();
  if (random->Chance(0.6)) effects.series = random->Uniform(-0.5, 5);
  if (random->Chance(0.25)) {
    effects.step_day = someday();
    effects.step_ohm = random->LogUniform(0.03, 0.3);
  }
  if (random->Chance(0.3)) {
    effects.pid_day = someday();
    effects.pid_days = random->Uniform(40, 200);
    effects.pid_shunt = random->LogUniform(8, 150);
    effects.pid_recombination = random->LogUniform(1.5, 8);
  }
  if (random->Chance(0.3)) effects.recombination = random->Uniform(5, 60);
  return effects;
}

std::vector<DayCover> MakeCover(const Effects& effects, const Weather& weather, Random* random) {
  std::vector<DayCover> cover(weather.days.size());
  const bool upright = random->Chance(0.5);
  double dust = 0, snow = 0, through = 0.1;
  for (std::size_t d = 0; d < cover.size(); ++d) {
    const Day& day = weather.days[d];
    const double unlike = random->Uniform(0.4, 1.6);
    const double falls = random->Uniform(0.4, 1.6), thick = random->LogUniform(0.03, 0.25);
    const double slides = random->Uniform(0.5, 1.5);
    if (day.rain > 0.2) {
      dust *= 1 - effects.washed * (0.4 + 0.6 * day.rain);
    } else {
      dust += effects.soiling / 100 * unlike * (1 - dust / 0.3);
    }
    if (!effects.snow) {
      // dry
    } else if (day.snowfall) {
      snow = std::min(1.0, snow + falls);
      through = thick;
    } else {
      const double melts = day.sky == Sky::kClear ? 0.9 : day.sky == Sky::kBroken ? 0.6 : 0.25;
      snow -= slides * (melts + (day.air_C > 1 ? 0.1 * day.air_C : 0)) + (day.rain > 0 ? 0.4 : 0);
      snow = std::max(snow, 0.0);
    }
    cover[d].soiling = 1 - dust;
    if (snow > 0.05) Cover(UnderSnow(snow, upright, through), &cover[d]);
  }
  return cover;
}

State StateAt(const Effects& effects, const DayCover& cover, double day) {
  State state;
  const double years = day / 365.25;
  state.light = cover.soiling * cover.through;
  state.covered = cover.snow;
  state.cover = cover.cells;
  state.series = 1 + effects.series / 100 * years;
  state.recombination = 1 + effects.recombination / 100 * years;
  if (effects.step_day >= 0 && day >= effects.step_day) state.series_ohm = effects.step_ohm;
  if (effects.bypass_day >= 0 && day >= effects.bypass_day) state.shorted = effects.bypass_group;
  if (effects.pid_day >= 0 && day > effects.pid_day) {
    const double done = -std::expm1(-(day - effects.pid_day) / effects.pid_days);
    state.shunt = 1 + (effects.pid_shunt - 1) * done;
    state.recombination += (effects.pid_recombination - 1) * done;
    state.uneven = true;
  }
  return state;
}

}  // namespace years
