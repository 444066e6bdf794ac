// Clearness of the measured days, from files or from a short table.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "trend/years_weather.h"

namespace years {
namespace {

// Clearness every ten minutes, of nist_ground_2015-07-01 (07:20 to 18:30), nist_ground_2015-07-20
// (09:15 to 15:05) and sdle_ddiv_timeseries (09:00 to 13:50), as FromFolder gives it.
constexpr double kTable[][80] = {
    {0.51, 0.52, 0.43, 0.72, 0.71, 0.51, 0.74, 0.75, 0.76, 0.79, 0.81, 0.82, 0.84, 0.86, 0.86,
     0.86, 0.86, 0.88, 0.89, 0.90, 0.90, 0.91, 0.91, 0.92, 0.92, 0.92, 0.93, 0.94, 0.94, 0.94,
     0.95, 0.96, 0.94, 0.94, 1.03, 1.09, 0.76, 1.03, 0.98, 0.98, 1.08, 0.27, 0.90, 1.00, 1.00,
     0.97, 0.55, 0.39, 1.04, 0.32, 0.99, 0.92, 0.77, 1.08, 0.98, 1.00, 0.79, 0.97, 0.99, 0.98,
     0.49, 0.88, 0.65, 0.91, 0.87, 0.84, 0.57, 0.77, 0.56, 0.78, 0.80, 0.79, 0.77, 0.72, 0.70},
    {0.82, 0.83, 0.87, 1.09, 0.96, 0.95, 0.92, 0.91, 0.90, 0.91, 0.90, 0.91,
     1.04, 0.89, 0.91, 0.90, 1.02, 1.14, 1.00, 0.91, 0.91, 0.90, 0.89, 0.89},
    {0.02, 0.07, 0.06, 0.05, 0.10, 0.47, 0.31, 0.31, 0.09, 0.12, 0.09, 0.19, 0.24, 0.25, 0.12,
     0.16, 0.11, 0.15, 0.79, 0.28, 0.27, 0.16, 0.17, 1.00, 0.22, 0.30, 0.28, 0.39, 0.49, 0.40},
};

struct Table {
  std::map<std::string, std::size_t> columns;
  std::vector<std::vector<std::string>> rows;

  double Number(std::size_t row, const std::string& column) const {
    const std::string& text = rows[row][columns.at(column)];
    return text.empty() ? std::nan("") : std::strtod(text.c_str(), nullptr);
  }
  double Hour(std::size_t row) const {  // of "2015-07-01 04:25:00"
    const std::string& text = rows[row][columns.at("timestamp")];
    return std::atof(text.substr(11, 2).c_str()) + std::atof(text.substr(14, 2).c_str()) / 60;
  }
};

std::vector<std::string> Fields(const std::string& line) {
  std::vector<std::string> fields;
  std::stringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

// Rows shorter than the head are left out. Empty if a column is missing, or after an error.
Table ReadTable(const std::string& path, const std::vector<std::string>& needed,
                std::string* error) {
  Table table;
  if (!error->empty()) return table;
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> head = Fields(line);
  for (std::size_t i = 0; i < head.size(); ++i) table.columns[head[i]] = i;
  for (const std::string& column : needed) {
    if (table.columns.count(column) == 0) {
      *error = path + ": cannot be read, or has no column " + column;
      return table;
    }
  }
  while (std::getline(file, line)) {
    std::vector<std::string> fields = Fields(line);
    if (fields.size() >= head.size()) table.rows.push_back(std::move(fields));
  }
  return table;
}

struct Sample {
  double hour, clearness;
};

// Half hours of a day: the sky by mean and scatter, and the change between neighbours. A stretch
// lasts as long as the sky stays.
void AddDay(const std::vector<Sample>& day, double minutes, Measured* measured) {
  const std::size_t length = std::max<std::size_t>(3, static_cast<std::size_t>(30 / minutes));
  for (std::size_t from = 0; from + length <= day.size(); from += length) {
    double mean = 0, square = 0, change = 0;
    for (std::size_t i = from; i < from + length; ++i) {
      mean += day[i].clearness / length;
      if (i > from) {
        const double step = day[i].clearness - day[i - 1].clearness;
        change += step * step / (length - 1);
      }
    }
    for (std::size_t i = from; i < from + length; ++i) {
      square += std::pow(day[i].clearness - mean, 2) / length;
    }
    const double scatter = std::sqrt(square) / mean;
    Stretch own;
    own.minutes = minutes;
    own.sky = mean < 0.45                     ? Sky::kOvercast
              : scatter < 0.03 && mean > 0.75 ? Sky::kClear
                                              : Sky::kBroken;
    own.restless = std::sqrt(change / 2) / mean / std::sqrt(minutes);
    for (std::size_t i = from; i < from + length; ++i) own.clearness.push_back(day[i].clearness);
    if (from > 0 && measured->stretches.back().sky == own.sky) {
      Stretch& last = measured->stretches.back();
      last.clearness.insert(last.clearness.end(), own.clearness.begin(), own.clearness.end());
      last.restless = std::max(last.restless, own.restless);
    } else {
      measured->stretches.push_back(own);
    }
  }
}

// Clear-sky light at the place and day of a measurement, horizontal or in the plane of the module.
double ClearLight(const Site& site, int day, double solar_hour, bool in_plane) {
  const Sun sun = SunAt(site, day, solar_hour);
  const double horizontal = ClearHorizontal(sun.height);
  if (!in_plane) return horizontal;
  const double beam = 0.88 * horizontal / std::max(sun.height, 0.06);
  return beam * std::max(sun.incidence, 0.0) + 0.12 * horizontal;
}

// Scales a day so that its clear hours (the 90th percentile, or `top` where given) are 1.
void Scale(double top, std::vector<Sample>* day) {
  if (top == 0) {
    std::vector<double> sorted;
    for (const Sample& sample : *day) sorted.push_back(sample.clearness);
    std::sort(sorted.begin(), sorted.end());
    top = sorted[sorted.size() * 9 / 10];
  }
  for (Sample& sample : *day) sample.clearness = std::min(sample.clearness / top, 1.25);
}

void FitRise(const Table& pairs, Measured* measured) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < pairs.rows.size(); ++i) {
    const double suns = pairs.Number(i, "irradiance_W_m2") / 1000;
    const double celsius = pairs.Number(i, "temperature_C");
    n += 1, x += suns, y += celsius, xx += suns * suns, xy += suns * celsius;
  }
  measured->rise_K = (n * xy - x * y) / (n * xx - x * x);
  // Sweeps that follow each other share the air: their scatter is the wind's.
  double square = 0;
  for (std::size_t i = 1; i < pairs.rows.size(); ++i) {
    const double suns =
        (pairs.Number(i, "irradiance_W_m2") - pairs.Number(i - 1, "irradiance_W_m2")) / 1000;
    const double celsius = pairs.Number(i, "temperature_C") - pairs.Number(i - 1, "temperature_C");
    square += std::pow(celsius - measured->rise_K * suns, 2);
  }
  measured->scatter_K = std::min(3.0, std::sqrt(square / (2 * (n - 1))));
}

}  // namespace

Measured BuiltIn() {
  Measured measured;
  for (const auto& row : kTable) {
    std::vector<Sample> day;
    for (const double clearness : row) {
      if (clearness > 0) day.push_back({0, clearness});
    }
    AddDay(day, 10, &measured);
  }
  return measured;
}

Measured FromFolder(const std::string& folder, std::string* error) {
  const std::string field = folder + "/field/";
  const Table july = ReadTable(field + "nist_ground_2015-07-01/index.csv",
                               {"timestamp", "global_horizontal_pyr_W_m2"}, error);
  const Table late = ReadTable(field + "nist_ground_2015-07-20/index.csv",
                               {"timestamp", "isc_A", "temperature_C"}, error);
  const Table index = ReadTable(field + "sdle_ddiv_timeseries/index.csv", {"timestamp"}, error);
  const Table curves =
      ReadTable(field + "sdle_ddiv_timeseries/curves.csv", {"curve", "current_A"}, error);
  const Table pairs =
      ReadTable(field + "sandia_pvue125/index.csv", {"irradiance_W_m2", "temperature_C"}, error);
  Measured measured;
  if (!error->empty()) return measured;
  const Site gaithersburg = {39.13, 20}, cleveland = {41.5, 35};
  std::vector<Sample> day;
  for (std::size_t i = 0; i < july.rows.size(); ++i) {  // solar time: 9 minutes behind the clock
    const double hour = july.Hour(i) - 0.15 - 0.06;
    const double clear = ClearLight(gaithersburg, 181, hour, false);
    const double light = july.Number(i, "global_horizontal_pyr_W_m2");
    if (clear > 150) day.push_back({hour, light / clear});
  }
  Scale(1, &day);
  AddDay(day, 1, &measured);
  day.clear();
  for (std::size_t i = 0; i < late.rows.size(); ++i) {  // by the current, in time with the sweeps
    const double hour = late.Hour(i) - 0.15 - 0.1;
    const double light = late.Number(i, "isc_A") / 8.6 * 1000;
    day.push_back({hour, light / ClearLight(gaithersburg, 200, hour, true)});
  }
  Scale(0, &day);
  AddDay(day, 1, &measured);
  day.clear();
  std::map<int, double> isc;  // the first reading of a sweep
  for (std::size_t i = 0; i < curves.rows.size(); ++i) {
    isc.emplace(static_cast<int>(curves.Number(i, "curve")), curves.Number(i, "current_A"));
  }
  for (std::size_t i = 0; i < index.rows.size(); ++i) {
    const double hour = index.Hour(i) - 0.45 - 0.04;
    day.push_back({hour, isc[static_cast<int>(i)] / ClearLight(cleveland, 362, hour, true)});
  }
  double top = 0;
  for (const Sample& sample : day) top = std::max(top, sample.clearness);
  Scale(top, &day);  // the gaps between its clouds are clear
  AddDay(day, 5, &measured);
  FitRise(pairs, &measured);
  return measured;
}

}  // namespace years
