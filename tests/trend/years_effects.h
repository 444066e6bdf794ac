#pragma once

#include <string>
#include <vector>

#include "faults/random.h"
#include "trend/years_module.h"
#include "trend/years_weather.h"

namespace years {

// What happens to a module over time. Days count from the start; negative: never.
struct Effects {
  double soiling = 0;    // mean of a dry day, % of the light
  double washed = 0.85;  // share that strong rain washes off
  bool snow = false;     // snowfall of winter days stays on the module
  int bypass_day = -1;   // a bypass diode fails short
  int bypass_group = 1;
  double series = 0;  // % a year of the first series resistance
  int step_day = -1;  // a connector adds resistance
  double step_ohm = 0;
  int pid_day = -1;       // potential-induced degradation begins and saturates
  double pid_days = 90;   // time constant
  double pid_shunt = 20;  // factor on the shunt conductance at saturation
  double pid_recombination = 3;
  double recombination = 0;  // % a year of the first recombination current, induced by light
};

// Names with an optional size, separated by commas: soiling=0.1, snow, bypass=DAY, series=2,
// step=OHM, pid=DAY, recombination=20; `standard` is the year of soiling, snow, a bypass diode
// that fails in June, series=2 and pid from March; `none` has nothing. Returns an error or "".
std::string ReadEffects(const std::string& list, Effects* effects);
Effects DrawEffects(int days, faults::Random* random);

// Light of each day: transmission of the dust, and the snow on the classes of cells.
struct DayCover {
  double soiling = 1;
  bool snow = false;
  double through = 1;                    // light of the best lit group, at its dimmest cell
  std::array<double, kClasses> cells{};  // light of a class over `through`
};
std::vector<DayCover> MakeCover(const Effects& effects, const Weather& weather,
                                faults::Random* random);

State StateAt(const Effects& effects, const DayCover& cover, double day);

}  // namespace years
