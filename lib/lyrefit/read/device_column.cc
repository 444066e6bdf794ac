#include "lyrefit/read/device_column.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/number_text.h"
#include "lyrefit/read/header_layout.h"
#include "lyrefit/read/label.h"

namespace lyrefit {
namespace {

constexpr std::size_t kMostDevices = 64;

// Whether a label is that of a device, with or without a word such as "number" after it.
bool NamesDevice(const std::string& label) {
  constexpr std::string_view kNames[] = {"channel", "chan",   "ch",     "pixel",  "px",
                                         "device",  "dut",    "cell",   "sample", "module",
                                         "subcell", "string", "contact"};
  constexpr std::string_view kEndings[] = {"",   "number", "no",    "nr",
                                           "id", "name",   "index", "label"};
  const std::vector<LabelWord> words = SplitLabel(label);
  const std::string name = JoinWords(words, 0, words.size());
  return std::any_of(std::begin(kNames), std::end(kNames), [&](std::string_view device) {
    return name.substr(0, device.size()) == device &&
           std::find(std::begin(kEndings), std::end(kEndings),
                     std::string_view(name).substr(device.size())) != std::end(kEndings);
  });
}

// The voltages that the rows of a device cover.
struct Covered {
  double low = 0;
  double high = 0;
  int rows = 0;

  void Add(double voltage) {
    low = rows == 0 ? voltage : std::min(low, voltage);
    high = rows == 0 ? voltage : std::max(high, voltage);
    ++rows;
  }
};

// The devices that a column holds; none if its values are no devices.
std::vector<std::string> DevicesIn(const TableLayout& layout, std::size_t place, LineReader lines) {
  constexpr int kLeastRows = 5;  // the parameters of one diode
  std::vector<std::string> order;
  std::map<std::string, Covered> covered;
  Covered all;
  const auto voltage_at = static_cast<std::size_t>(layout.voltage);
  for (std::string_view line; lines.NextContent(&line);) {
    const auto fields = SplitFields(line, layout.delimiter);
    if (!fields || fields->size() <= std::max(place, voltage_at)) break;
    const auto voltage = ParseNumber((*fields)[voltage_at], layout.delimiter != ',');
    if (!voltage && !IsMissingReading((*fields)[voltage_at], layout.delimiter != ',')) break;
    if (!voltage || *voltage != *voltage) continue;
    const auto [found, is_new] = covered.try_emplace((*fields)[place]);
    if (is_new) order.push_back((*fields)[place]);
    if (order.size() > kMostDevices) return {};
    found->second.Add(*voltage);
    all.Add(*voltage);
  }
  const bool curves = std::all_of(covered.begin(), covered.end(), [&](const auto& entry) {
    const Covered& own = entry.second;
    return own.rows >= kLeastRows && own.high - own.low >= 0.5 * (all.high - all.low);
  });
  if (!curves || order.size() < 2) return {};
  return order;
}

}  // namespace

void FindDevices(LineReader rows, TableLayout* layout) {
  const bool of_curves =
      layout->sweep != kNoColumn && layout->columns[layout->sweep].kind == ColumnKind::kCurve;
  if (of_curves || layout->channels.size() != 1) return;
  for (int place = 0; place < static_cast<int>(layout->columns.size()); ++place) {
    if (IsUsed(*layout, place) || !NamesDevice(layout->columns[place].label)) continue;
    layout->devices = DevicesIn(*layout, static_cast<std::size_t>(place), rows);
    if (layout->devices.empty()) continue;
    layout->device_column = place;
    return;
  }
}

}  // namespace lyrefit
