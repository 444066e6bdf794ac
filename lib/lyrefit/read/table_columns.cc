#include "lyrefit/read/table_columns.h"

#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/base/number_text.h"
#include "lyrefit/read/column_names.h"
#include "lyrefit/read/label.h"

namespace lyrefit {
namespace {

std::vector<int> Usable(const std::vector<Column>& columns, ColumnKind kind) {
  std::vector<int> places;
  for (int i = 0; i < static_cast<int>(columns.size()); ++i) {
    if (columns[i].kind == kind && columns[i].refusal.empty()) places.push_back(i);
  }
  return places;
}

// The voltage with the tag of `current`; -1 unless there is exactly one.
int SameTag(const std::vector<Column>& columns, const std::vector<int>& voltages, int current) {
  int found = -1;
  const ColumnTag& wanted = columns[current].tag;
  for (const int voltage : voltages) {
    const ColumnTag& tag = columns[voltage].tag;
    const bool same = tag.device == wanted.device && tag.direction == wanted.direction &&
                      tag.light == wanted.light;
    if (!same) continue;
    if (found != -1) return -1;
    found = voltage;
  }
  return found;
}

// Removes averages from `currents` if other columns remain. Returns whether they are of two columns.
bool DropAverages(const std::vector<Column>& columns, std::vector<int>* currents) {
  std::vector<int> kept;
  for (const int current : *currents) {
    if (!columns[current].tag.average) kept.push_back(current);
  }
  if (kept.empty() || kept.size() == currents->size()) return false;
  *currents = std::move(kept);
  return currents->size() == 2;
}

// Joins the pairs of one device and light whose directions differ. `averaged`: the two pairs are
// sweeps of one device, since the file states their average.
std::vector<Channel> JoinSweeps(const std::vector<Column>& columns, bool averaged,
                                std::vector<Channel> pairs) {
  std::vector<Channel> channels;
  const auto tag_of = [&](const ColumnPair& pair) -> const ColumnTag& {
    return columns[pair.current].tag;
  };
  for (Channel& pair : pairs) {
    const ColumnTag& tag = tag_of(pair);
    const auto same = std::find_if(channels.begin(), channels.end(), [&](const Channel& channel) {
      const ColumnTag& first = tag_of(channel);
      if (averaged) return true;
      const auto is_new = [&](const ColumnPair& sweep) {
        return tag_of(sweep).direction != tag.direction &&
               tag_of(sweep).direction != SweepDirection::kUnknown;
      };
      return tag.direction != SweepDirection::kUnknown && tag.device == first.device &&
             tag.light == first.light && is_new(channel) &&
             std::all_of(channel.more.begin(), channel.more.end(), is_new);
    });
    if (same == channels.end()) {
      channels.push_back(std::move(pair));
    } else {
      same->more.push_back(pair);
    }
  }
  return channels;
}

}  // namespace

std::optional<int> FindColumn(const std::vector<Column>& columns, const std::string& wish) {
  const std::string name = LowerCase(TrimBlanks(wish));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (LowerCase(TrimBlanks(columns[i].label)) == name) return static_cast<int>(i);
  }
  const auto place = ParseNumber(wish);
  for (std::size_t i = 0; i < columns.size() && place; ++i) {
    if (*place == static_cast<double>(i + 1)) return static_cast<int>(i);
  }
  return std::nullopt;
}

void ApplyColumnWishes(const ReadOptions& options, std::vector<Column>* columns) {
  const std::pair<ColumnKind, const std::string*> wishes[] = {
      {ColumnKind::kVoltage, &options.voltage_column},
      {ColumnKind::kCurrent, &options.current_column}};
  for (const auto& [kind, wish] : wishes) {
    const auto place = wish->empty() ? std::nullopt : FindColumn(*columns, *wish);
    if (!place) continue;
    for (Column& column : *columns) {
      if (column.kind == kind || (IsCurrent(column.kind) && IsCurrent(kind)))
        column.kind = ColumnKind::kUnrecognised;
    }
    (*columns)[*place] = ColumnSaidToBe(kind, (*columns)[*place].label);
  }
}

Expected<void> ApplyUnitWishes(const ReadOptions& options, const Channel& channel,
                               std::vector<Column>* columns) {
  const struct {
    int place;
    const std::string& wish;
    ColumnKind kinds[2];
    const char* flag;
  } wishes[] = {{channel.voltage,
                 options.voltage_unit,
                 {ColumnKind::kVoltage, ColumnKind::kVoltage},
                 "--voltage-unit"},
                {channel.current,
                 options.current_unit,
                 {ColumnKind::kCurrent, ColumnKind::kCurrentDensity},
                 "--current-unit"}};
  const auto is_further = [&](int place, bool voltage) {
    return std::any_of(channel.more.begin(), channel.more.end(), [&](const ColumnPair& pair) {
      return (voltage ? pair.voltage : pair.current) == place;
    });
  };
  for (const auto& [place, wish, kinds, flag] : wishes) {
    if (wish.empty()) continue;
    const ScaledLabel scaled = TakeScale(wish);
    const std::vector<LabelWord> words = SplitLabel(scaled.label);
    const std::string text = JoinWords(words, 0, words.size());
    const Unit* unit = FindUnit(kinds[0], text);
    if (unit == nullptr) unit = FindUnit(kinds[1], text);
    if (unit == nullptr) {
      return Fail(
          fmt::format("{}: expected {}, found {}", flag, ExpectedUnits(kinds[0]), Quoted(wish)));
    }
    for (int i = 0; i < static_cast<int>(columns->size()); ++i) {
      if (i != place && !is_further(i, place == channel.voltage)) continue;
      Column& column = (*columns)[i];
      column.kind = unit->kind;
      column.unit = unit->text;
      column.factor = unit->factor * scaled.scale;
      column.offset = unit->offset;
    }
  }
  return {};
}

std::vector<Channel> FindChannels(const std::vector<Column>& columns) {
  const std::vector<int> voltages = Usable(columns, ColumnKind::kVoltage);
  std::vector<int> currents = Usable(columns, ColumnKind::kCurrent);
  if (currents.empty()) currents = Usable(columns, ColumnKind::kCurrentDensity);
  const bool averaged = DropAverages(columns, &currents);
  std::vector<Channel> channels;
  if (voltages.size() == 1) {
    for (const int current : currents) channels.emplace_back(voltages[0], current);
    return JoinSweeps(columns, averaged, std::move(channels));
  }
  for (const int current : currents) {
    const int voltage = SameTag(columns, voltages, current);
    if (voltage != -1) channels.emplace_back(voltage, current);
  }
  if (channels.size() == currents.size()) return JoinSweeps(columns, averaged, std::move(channels));
  channels.clear();
  if (voltages.size() != currents.size()) return channels;
  for (std::size_t i = 0; i < currents.size(); ++i) {
    channels.emplace_back(voltages[i], currents[i]);
  }
  return JoinSweeps(columns, averaged, std::move(channels));
}

std::string ChannelName(const std::vector<Column>& columns, const Channel& channel) {
  const Column& current = columns[channel.current];
  if (channel.more.empty() && !current.tag.by_letter) return current.label;
  std::string name = current.tag.device;
  const bool averaged = !channel.more.empty() && current.tag.direction == SweepDirection::kUnknown;
  if (averaged) name.clear();
  if (current.tag.light == SweepLight::kDark) name += name.empty() ? "dark" : " dark";
  if (current.tag.light == SweepLight::kLight) name += name.empty() ? "light" : " light";
  return name.empty() ? current.label : name;
}

std::string ListChannels(const std::vector<Column>& columns, const std::vector<Channel>& channels) {
  constexpr std::size_t kShown = 12;
  std::string list;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (i == kShown) return list + fmt::format(", ... {}", channels.size());
    const std::string name = ChannelName(columns, channels[i]);
    list += fmt::format("{}{} {}", i == 0 ? "" : ", ", i + 1, Quoted(name));
  }
  return list;
}

std::optional<std::size_t> ChannelUnderLoad(const std::vector<Column>& columns,
                                            const std::vector<Channel>& channels) {
  std::optional<std::size_t> found;
  bool trace = false;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const SweepLight light = columns[channels[i].current].tag.light;
    trace = trace || light == SweepLight::kSunsVoc;
    if (light == SweepLight::kSunsVoc || light == SweepLight::kDark) continue;
    if (found) return std::nullopt;
    found = i;
  }
  return trace ? found : std::nullopt;
}

bool IsLightOfTrace(const std::vector<Column>& columns, int light) {
  for (int i = light - 1; i >= 0; --i) {
    if (!IsElectrical(columns[i].kind) || !columns[i].refusal.empty()) continue;
    return columns[i].tag.light == SweepLight::kSunsVoc;
  }
  return false;
}

Expected<Channel> ChooseChannel(const std::vector<Column>& columns,
                                const std::vector<Channel>& channels, const std::string& wish) {
  if (wish.empty()) {
    if (channels.size() == 1) return channels[0];
    if (const auto under_load = ChannelUnderLoad(columns, channels)) return channels[*under_load];
    return Fail(
        fmt::format("expected one current column, found {}: {}; choose one with --column NAME|N",
                    channels.size(), ListChannels(columns, channels)));
  }
  const auto place = ParseNumber(wish);
  const std::string name = LowerCase(TrimBlanks(wish));
  for (std::size_t i = 0; i < channels.size() && place; ++i) {
    if (*place == static_cast<double>(i + 1)) return channels[i];
  }
  const bool own_voltages = channels.size() > 1 && channels[0].voltage != channels[1].voltage;
  for (const Channel& channel : channels) {
    const Column& current = columns[channel.current];
    const bool called =
        LowerCase(TrimBlanks(current.label)) == name || current.tag.device == wish ||
        LowerCase(ChannelName(columns, channel)) == name ||
        (own_voltages && LowerCase(TrimBlanks(columns[channel.voltage].label)) == name);
    if (called) return channel;
  }
  return Fail(fmt::format("column {} was asked for, but the table has {}", Quoted(wish),
                          ListChannels(columns, channels)));
}

}  // namespace lyrefit
