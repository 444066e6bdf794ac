#include "trend/years_weather.h"

#include <algorithm>
#include <cmath>

namespace years {
namespace {

using faults::Random;

constexpr double kDegree = 0.017453292519943295;
constexpr double kTurn = 6.283185307179586;
constexpr double kKelvin = 273.15;

// Share of the diffuse light by the clearness against a clear sky.
double DiffuseShare(double clearness) { return std::clamp(1.05 - 0.9 * clearness, 0.12, 1.0); }

double InPlane(const Site& site, const Sun& sun, double clearness) {
  const double horizontal = ClearHorizontal(sun.height) * clearness;
  const double diffuse = horizontal * DiffuseShare(clearness);
  const double tilt = site.tilt * kDegree;
  const double direct = (horizontal - diffuse) / std::max(sun.height, 0.06);
  return direct * std::max(sun.incidence, 0.0) + diffuse * (1 + std::cos(tilt)) / 2 +
         0.2 * horizontal * (1 - std::cos(tilt)) / 2;
}

// Runs of like days: the sky of the day before stays with probability 0.5. Winters are duller.
Sky NextSky(Sky before, double summer, Random* random) {
  if (random->Chance(0.5)) return before;
  const double draw = random->Unit();
  const double overcast = 0.34 - 0.12 * summer, clear = 0.34 + 0.06 * summer;
  if (draw < overcast) return Sky::kOvercast;
  return draw < overcast + clear ? Sky::kClear : Sky::kBroken;
}

// Sky of a stretch on a day of the given sky.
Sky SkyOfStretch(Sky day, Random* random) {
  const double draw = random->Unit();
  if (day == Sky::kClear) return draw < 0.93 ? Sky::kClear : Sky::kBroken;
  if (day == Sky::kOvercast) return draw < 0.85 ? Sky::kOvercast : Sky::kBroken;
  return draw < 0.6 ? Sky::kBroken : draw < 0.85 ? Sky::kClear : Sky::kOvercast;
}

const Stretch& AnyStretch(const Measured& measured, Sky sky, Random* random) {
  int count = 0;
  for (const Stretch& stretch : measured.stretches) count += stretch.sky == sky ? 1 : 0;
  int left = random->Index(std::max(count, 1));
  for (const Stretch& stretch : measured.stretches) {
    if (stretch.sky == sky && left-- == 0) return stretch;
  }
  return measured.stretches[random->Index(static_cast<int>(measured.stretches.size()))];
}

std::vector<Day> MakeDays(const WeatherRequest& request, Random* random) {
  std::vector<Day> days(request.days);
  Sky sky = static_cast<Sky>(random->Index(3));
  double warmer = 3.5 * random->Normal();
  for (int d = 0; d < request.days; ++d) {
    const double summer = -std::cos(kTurn * (request.first_day + d - 20) / 365.25);
    sky = NextSky(sky, summer, random);
    warmer = 0.7 * warmer + 3.5 * std::sqrt(1 - 0.49) * random->Normal();
    Day& day = days[d];
    day.sky = sky;
    day.air_C = request.site.mean_C + request.site.season_C * summer + warmer;
    const double wet = sky == Sky::kOvercast ? 0.45 : sky == Sky::kBroken ? 0.15 : 0.0;
    const bool falls = random->Chance(wet);
    const double strength = random->Unit();
    day.snowfall = falls && day.air_C < 0.5;
    if (falls && !day.snowfall) day.rain = strength;
  }
  return days;
}

// The course of one day: measured stretches one after the other, a share of them followed through
// to their end.
void AddInstants(const WeatherRequest& request, const Measured& measured, int d, const Day& day,
                 Random* random, std::vector<Instant>* instants) {
  const double haze = 1 + 0.025 * random->Normal();
  const double wind = std::exp(0.15 * random->Normal());
  double gust = 0, within = 0;
  const Stretch* stretch = nullptr;
  for (double minute = 0; minute < 1440; minute += request.minutes) {
    const double hour = minute / 60;
    const Sun sun = SunAt(request.site, request.first_day + d, hour);
    if (sun.height < 0.02) continue;
    if (stretch == nullptr || within >= stretch->minutes * stretch->clearness.size()) {
      stretch = &AnyStretch(measured, SkyOfStretch(day.sky, random), random);
      within = random->Unit() * stretch->minutes * stretch->clearness.size();
    }
    const std::size_t step = std::min(static_cast<std::size_t>(within / stretch->minutes),
                                      stretch->clearness.size() - 1);
    within += request.minutes;
    Instant now;
    now.day = d;
    now.hour = hour;
    now.incidence = sun.incidence;
    now.light = InPlane(request.site, sun, haze * stretch->clearness[step]);
    now.restless = stretch->restless;
    now.sky = stretch->sky;
    gust = 0.6 * gust + 0.8 * random->Normal();
    const double suns = now.light / 1000;
    const double swing = (day.sky == Sky::kOvercast ? 2 : 5) * std::cos(kTurn * (hour - 15) / 24);
    now.kelvin =
        kKelvin + day.air_C + swing + suns * (measured.rise_K * wind + measured.scatter_K * gust);
    if (now.light >= request.least_Wm2) instants->push_back(now);
  }
}

}  // namespace

Sun SunAt(const Site& site, int day, double hour) {
  const double declination = 23.45 * kDegree * std::sin(kTurn * (284 + day + 1) / 365.0);
  const double angle = kTurn * (hour - 12) / 24, latitude = site.latitude * kDegree;
  const double flat = latitude - site.tilt * kDegree;
  const auto onto = [&](double tilted) {
    return std::sin(declination) * std::sin(tilted) +
           std::cos(declination) * std::cos(tilted) * std::cos(angle);
  };
  return {onto(latitude), onto(flat)};
}

double ClearHorizontal(double height) {
  return height <= 0 ? 0 : 1098 * height * std::exp(-0.057 / height);
}

Weather MakeWeather(const WeatherRequest& request, const Measured& measured, Random* random) {
  Weather weather;
  weather.days = MakeDays(request, random);
  for (int d = 0; d < request.days; ++d) {
    AddInstants(request, measured, d, weather.days[d], random, &weather.instants);
  }
  return weather;
}

}  // namespace years
