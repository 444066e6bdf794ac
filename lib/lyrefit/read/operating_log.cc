#include "lyrefit/read/operating_log.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lyrefit/curve/curve_kind.h"
#include "lyrefit/curve/date_time.h"
#include "lyrefit/read/column.h"
#include "lyrefit/read/label.h"
#include "lyrefit/read/table_view.h"

namespace lyrefit {
namespace {

// The times of the rows, of one column or of a date and the time of day right of it; empty if a row
// has none.
std::vector<double> TimesIn(const TableView& view, std::size_t column) {
  std::vector<double> times;
  for (const Fields& row : view.rows) {
    auto time = ReadDateTime(row[column]);
    if (time && std::fmod(*time, kDay_s) == 0 && column + 1 < row.size()) {
      if (const auto joined = ReadDateTime(row[column] + " " + row[column + 1])) time = joined;
    }
    if (!time) return {};
    times.push_back(*time);
  }
  return times;
}

// Whether a name is that of a voltage, or begins as the symbol of one: "Vpv1(V)", "U_dc".
bool NamesVoltage(const std::string& name) {
  if (RecogniseColumn(name).kind == ColumnKind::kVoltage) return true;
  const std::vector<LabelWord> words = SplitLabel(name);
  if (words.empty()) return false;
  const char letter = words.front().text.front();
  const bool marked = words.size() > 1 && words.back().marked_as_unit;
  if (marked) return FindUnit(ColumnKind::kVoltage, words.back().text) != nullptr;
  return letter == 'v' || letter == 'u';
}

// Whether every row has a time of its own, as points have; the readings of a sweep often share one.
bool AreOneATime(std::vector<double> times) {
  constexpr double kMost = 0.9;
  const auto all = static_cast<double>(times.size());
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return static_cast<double>(times.size()) >= kMost * all;
}

}  // namespace

std::optional<std::string> FindOperatingLog(std::string_view text) {
  constexpr std::size_t kBeginning = 1 << 14;
  if (text.substr(0, kBeginning).find(':') == std::string_view::npos) return std::nullopt;
  const TableView view = ViewTable(text);
  for (std::size_t column = 0; column < view.names.size(); ++column) {
    const std::vector<double> times = TimesIn(view, column);
    if (times.empty() || !AreOneATime(times)) continue;
    for (std::size_t other = 0; other < view.names.size(); ++other) {
      if (other == column || !NamesVoltage(view.names[other])) continue;
      std::vector<double> kept_times, voltages;
      const std::vector<double> all = NumbersOf(view, other);
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (!std::isfinite(all[i])) continue;
        kept_times.push_back(times[i]);
        voltages.push_back(all[i]);
      }
      if (OperatingPointsOfADay(kept_times, voltages)) return OperatingPointsWords(kept_times);
    }
  }
  return std::nullopt;
}

}  // namespace lyrefit
