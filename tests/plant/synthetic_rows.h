#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/random.h"
#include "lyrefit/batch/result_row.h"
#include "lyrefit/report/page_shell.h"

namespace lyrefit {

// Synthetic result rows of a plant after a field test. Ids have the levels site, inverter, combiner
// and string, with 24 strings per combiner. One in 40 has a cause, one in 100 has no result. A row
// depends only on the seed and its number.

inline std::vector<ResultColumn> SyntheticPlantColumns() {
  constexpr CellType kText = CellType::kText;
  constexpr CellType kNumber = CellType::kNumber;
  constexpr CellType kWhole = CellType::kWhole;
  std::vector<ResultColumn> columns = {
      {"id", "", kText, "the curve's name; '/' separates the levels of a plant"},
      {"status", "", kText, "fine, not usable or broken"},
      {"reason", "", kText, "why it is not fine"},
      {"where", "", kText, "where the curve stands in the input"},
      {"date", "", kText, "of the measurement"},
      {"irradiance_Wm2", "W/m2", kNumber, "irradiance"},
      {"temperature_C", "C", kNumber, "cell temperature"},
      {"cells_in_series", "", kWhole, "cells in series"},
      {"points", "", kWhole, "readings of the curve"}};
  for (const char* name : {"Isc_A", "Voc_V", "Imp_A", "Vmp_V", "Pmax_W", "FF"}) {
    columns.push_back({name, "", kNumber, "measured"});
  }
  columns.push_back({"sparkline", "", kText, "24 currents at even voltages, base64"});
  for (const char* name : {"Iph_A", "Is1_A", "n1", "Rs_ohm", "Rsh_ohm", "RMSE_A"}) {
    columns.push_back({name, "", kNumber, "fitted"});
  }
  for (const char* name :
       {"cause", "cause_title", "cause_sentence", "equivalents", "separate_by"}) {
    columns.push_back({name, "", kText, "of the diagnosis"});
  }
  for (const char* name : {"lack_of_fit_percent", "recoverable_power_W", "Pmax_stc_W",
                           "Pmax_stc_U_W", "rated_power_W", "performance_factor",
                           "wrong_decision_probability", "group_deviation_percent", "history_p"}) {
    columns.push_back({name, "", kNumber, "of the field test"});
  }
  columns.push_back({"zone", "", kText, "of four"});
  columns.push_back({"group_flag", "", CellType::kTruth, "stands out in its combiner"});
  columns.push_back({"page", "", kText, "its own page"});
  return columns;
}

struct SyntheticCause {
  const char* id;
  const char* title;
  double loss;
};

inline std::string SyntheticSparkline(double knee, double step, double slope) {
  std::string bytes;
  for (int i = 0; i < 24; ++i) {
    const double v = i / 23.0;
    double current = (1 - std::pow(v, knee)) * (1 - slope * v);
    if (v > 0.55) current *= 1 - step;
    bytes += static_cast<char>(std::lround(255 * std::clamp(current, 0.0, 1.0)));
  }
  return Base64(bytes);
}

class SyntheticPlantRow {
 public:
  SyntheticPlantRow(std::uint64_t seed, std::int64_t row)
      : random_(seed, static_cast<std::uint64_t>(row)) {
    const std::int64_t comb = row / 24, inv = comb / 8, site = inv / 50;
    Set("id", fmt::format("site{}/inv{:02}/comb{}/str{:02}", 1 + site, 1 + inv % 50, 1 + comb % 8,
                          1 + row % 24));
    Set("where", fmt::format("strings.csv:{}", row + 2));
    const int day = static_cast<int>(row / 450 % 28);
    Set("date", fmt::format("2026-{:02}-{:02}T{:02}:{:02}:00Z", 3 + site % 9, 1 + day,
                            9 + row % 450 / 75, row % 60));
    Set("status", std::string("fine"));
    if (random_.Uniform() < 0.01) {
      Break();
    } else {
      Measure();
    }
  }

  ResultRow Row() const {
    static const std::vector<ResultColumn> kColumns = SyntheticPlantColumns();
    ResultRow row;
    for (const ResultColumn& column : kColumns) row.cells.push_back(Get(column.name));
    return row;
  }

 private:
  void Set(const std::string& name, ResultCell cell) { cells_.emplace_back(name, std::move(cell)); }
  ResultCell Get(const std::string& name) const {
    for (auto cell = cells_.rbegin(); cell != cells_.rend(); ++cell) {
      if (cell->first == name) return cell->second;
    }
    return {};
  }

  void Break() {
    static constexpr const char* kReasons[] = {
        "no readings", "voltage and current differ in length", "the sweep ends before the knee"};
    Set("status", std::string(random_.Uniform() < 0.7 ? "broken" : "not usable"));
    Set("reason", std::string(kReasons[random_.Index(3)]));
  }

  void Measure() {
    static constexpr SyntheticCause kCauses[] = {{"mismatch", "Partial shading", 0.22},
                                                 {"bypass_short", "Bypass diode shorted", 0.055},
                                                 {"series", "High series resistance", 0.08},
                                                 {"shunt", "Low shunt resistance", 0.06},
                                                 {"soiling", "Uneven soiling", 0.05}};
    const bool ill = random_.Uniform() < 0.025;
    const SyntheticCause& cause = kCauses[random_.Index(5)];
    const double loss = ill ? cause.loss * (0.6 + 0.8 * random_.Uniform()) : 0;
    const double light = 780 + 200 * random_.Uniform();
    const double factor = (1 - loss) * (0.995 + 0.008 * random_.Normal());
    const double rated = 8800;
    const double stc = rated * factor;
    Set("irradiance_Wm2", std::round(light * 10) / 10);
    Set("temperature_C", std::round((38 + 6 * random_.Normal()) * 10) / 10);
    Set("cells_in_series", std::int64_t{1440});
    Set("points", std::int64_t{100 + random_.Index(3)});
    Set("Isc_A", 9.6 * light / 1000 * (1 + 0.003 * random_.Normal()));
    Set("Voc_V", 905 * (1 + 0.004 * random_.Normal()));
    Set("Imp_A", 9.1 * light / 1000 * (1 - loss / 2));
    Set("Vmp_V", 740 * (1 - loss / 2) * (1 + 0.004 * random_.Normal()));
    Set("Pmax_W", stc * light / 1000 * 0.94);
    Set("FF", 0.775 * (1 - loss / 2) + 0.003 * random_.Normal());
    Set("sparkline", SyntheticSparkline(14 + random_.Normal() - (ill && cause.id[0] == 's' ? 6 : 0),
                                        ill && cause.id[0] == 'm' ? loss : 0, 0.03));
    Set("Iph_A", 9.61 * light / 1000 * (1 + 0.003 * random_.Normal()));
    Set("Is1_A", 1e-9 * std::exp(random_.Normal()));
    Set("n1", 1.1 + 0.03 * random_.Normal());
    Set("Rs_ohm", 4.1 + 0.2 * random_.Normal() + (cause.id[1] == 'e' && ill ? 3 : 0));
    Set("Rsh_ohm", 9000 * std::exp(0.3 * random_.Normal()));
    Set("RMSE_A", 0.004 * std::exp(0.3 * random_.Normal()) + loss / 5);
    Set("cause", ill ? std::string(cause.id) : std::string("none"));
    if (ill) {
      Set("cause_title", std::string(cause.title));
      Set("cause_sentence",
          fmt::format("{}: {:.1f} % of the power is lost.", cause.title, 100 * loss));
      Set("separate_by", std::string("a second sweep at another light"));
    }
    Set("lack_of_fit_percent", 100 * loss + 0.2 * random_.Uniform());
    if (ill) Set("recoverable_power_W", loss * rated);
    Set("Pmax_stc_W", stc);
    Set("Pmax_stc_U_W", 0.03 * stc);
    Set("rated_power_W", rated);
    Set("performance_factor", factor);
    Set("wrong_decision_probability", 0.5 * std::exp(-std::fabs(factor - 0.95) / 0.015));
    Set("group_deviation_percent", -100 * loss + 0.8 * random_.Normal());
    Set("history_p", random_.Uniform() * (ill ? 0.01 : 1));
    Set("zone", std::string(factor > 0.98    ? "pass"
                            : factor > 0.95  ? "pass within uncertainty"
                            : factor > 0.925 ? "fail within uncertainty"
                                             : "fail"));
    Set("group_flag", ill && loss > 0.04);
    if (ill) Set("page", "pages/" + std::get<std::string>(Get("id")) + ".html");
  }

  RandomStream random_;
  std::vector<std::pair<std::string, ResultCell>> cells_;
};

inline ResultRow SyntheticPlantResult(std::uint64_t seed, std::int64_t row) {
  return SyntheticPlantRow(seed, row).Row();
}

}  // namespace lyrefit
