#include "lyrefit/read/column.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cases.h"
#include "lyrefit/read/guess_columns.h"
#include "lyrefit/read/key_point_table.h"
#include "lyrefit/read/table_columns.h"

namespace lyrefit {
namespace {

std::string TextOf(const ColumnTag& tag) {
  constexpr const char* kDirections[] = {"", ", forward", ", reverse"};
  constexpr const char* kLights[] = {"", ", dark", ", light", ", Suns-Voc"};
  return (tag.device.empty() ? "" : ", of '" + tag.device + "'") +
         kDirections[static_cast<int>(tag.direction)] + kLights[static_cast<int>(tag.light)] +
         (tag.average ? ", average" : "");
}

std::string TextOf(const Column& column) {
  constexpr const char* kKinds[] = {"none",        "voltage",         "current", "sigma",
                                    "time",        "sweep",           "curve",   "irradiance",
                                    "temperature", "current density", "area"};
  std::string text = kKinds[static_cast<int>(column.kind)];
  if (!column.unit.empty()) text += " in " + column.unit;
  if (column.factor != 1) text += fmt::format(", times {:.6g}", column.factor);
  if (column.offset != 0) text += fmt::format(", plus {:.6g}", column.offset);
  return text + TextOf(column.tag) + (column.light ? ", light of a trace" : "") +
         (column.refusal.empty() ? "" : ": " + column.refusal);
}

std::vector<std::string> NamesIn(const std::string& list) {
  std::vector<std::string> names = {""};
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (list.compare(k, 3, " | ") == 0) {
      names.emplace_back();
      k += 2;
    } else {
      names.back() += list[k];
    }
  }
  return names;
}

// The measurements that `take` finds among columns with these names.
std::string ChannelsBy(bool (*take)(std::vector<Column>*), const std::string& names) {
  std::vector<Column> columns;
  for (const std::string& label : NamesIn(names)) columns.push_back(RecogniseColumn(label));
  if (!take(&columns)) return "none";
  std::string text;
  for (const Channel& channel : FindChannels(columns)) {
    text += (text.empty() ? "" : "; ") + ChannelName(columns, channel) + ":";
    const auto add = [&](const ColumnPair& pair) {
      text += fmt::format(" {}, {} ({})", columns[pair.voltage].label, columns[pair.current].label,
                          TextOf(columns[pair.current]));
    };
    add(channel);
    for (const ColumnPair& pair : channel.more) add(pair);
  }
  return text;
}

TEST(RecogniseColumnTest, KnowsEverySpelling) {
  const auto said_to_be = [](ColumnKind kind) {
    return [kind](const std::string& label) { return TextOf(ColumnSaidToBe(kind, label)); };
  };
  const auto by = [](bool (*take)(std::vector<Column>*)) {
    return [take](const std::string& names) { return ChannelsBy(take, names); };
  };
  CheckCases("read_columns",
             {{"column", [](const std::string& label) { return TextOf(RecogniseColumn(label)); }},
              {"tag", [](const std::string& text) { return "tag" + TextOf(ReadTag(text)); }},
              {"voltage column", said_to_be(ColumnKind::kVoltage)},
              {"current column", said_to_be(ColumnKind::kCurrent)},
              {"dark and lit", by(TakeDarkLitLetters)},
              {"named pairs", by(TakeNamedPairs)},
              {"key point",
               [](const std::string& label) -> std::string {
                 constexpr const char* kPoints[] = {"Isc", "Voc", "Imp", "Vmp", "Pmp"};
                 const auto column = AsKeyPoint(label);
                 if (!column) return "none";
                 return fmt::format("{}, times {:.6g}", kPoints[column->point], column->factor);
               }},
              {"matrix", [](const std::string& names) -> std::string {
                 const auto matrix = AsMatrix(NamesIn(names));
                 if (!matrix) return "none";
                 return fmt::format("irradiance in {}, temperature in {}", matrix->irradiance_place,
                                    matrix->temperature_place);
               }}});
}

}  // namespace
}  // namespace lyrefit
