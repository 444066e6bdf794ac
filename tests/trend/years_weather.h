#pragma once

#include <string>
#include <vector>

#include "faults/random.h"

namespace years {

enum class Sky { kClear, kBroken, kOvercast };

// A stretch of a measured day: clearness (light over clear-sky light) in equal steps of time.
struct Stretch {
  double minutes = 1;  // a step
  std::vector<double> clearness;
  Sky sky = Sky::kClear;  // by mean and scatter
  double restless = 0;    // rms change within a step, relative
};

// Measured sequences of clearness in stretches of half an hour or longer, and how much cells warm.
struct Measured {
  std::vector<Stretch> stretches;
  double rise_K = 23.5;    // of the cells at 1000 W/m2
  double scatter_K = 1.9;  // by wind, at 1000 W/m2
};
// A short table made from the measured days.
Measured BuiltIn();
// Reads nist_ground_2015-07-01, nist_ground_2015-07-20, sdle_ddiv_timeseries and sandia_pvue125 in
// `folder`. An empty result has no stretches and says why in `error`.
Measured FromFolder(const std::string& folder, std::string* error);

struct Site {
  double latitude = 40;
  double tilt = 30;      // to the south, degrees
  double mean_C = 11;    // air, of the year
  double season_C = 11;  // amplitude of the year
};

struct Sun {
  double height;     // sine of the elevation
  double incidence;  // cosine to the plane of the module
};
Sun SunAt(const Site& site, int day, double hour);
// Light on a horizontal plane under a clear sky, W/m2 (Haurwitz 1945).
double ClearHorizontal(double height);

struct Instant {
  int day = 0;       // since the start
  double hour = 0;   // solar time
  double light = 0;  // W/m2 in the plane of the module
  double incidence = 1;
  double restless = 0;  // relative rms of the light over a minute
  Sky sky = Sky::kClear;
  double kelvin = 298.15;  // of the cells
};

struct Day {
  Sky sky = Sky::kClear;
  double air_C = 0;  // mean
  double rain = 0;   // 0: none; else strength, 0 to 1
  bool snowfall = false;
};

struct Weather {
  std::vector<Day> days;
  std::vector<Instant> instants;  // with light above the least
};

struct WeatherRequest {
  Site site;
  int first_day = 0;  // of the year
  int days = 365;
  double minutes = 30;  // between instants
  double least_Wm2 = 50;
};
Weather MakeWeather(const WeatherRequest& request, const Measured& measured,
                    faults::Random* random);

}  // namespace years
