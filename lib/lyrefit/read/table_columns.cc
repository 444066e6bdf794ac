#include "lyrefit/read/table_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>

#include "lyrefit/read/label.h"
#include "lyrefit/read/number_text.h"
#include "lyrefit/read/suns_voc.h"

namespace lyrefit {
namespace {

// Suffixes of V and I for key points and for quantities that were not measured.
constexpr std::string_view kNoReading[] = {
    "sc",  "oc",       "mp",    "mpp",   "pm",   "max",    "min", "x",   "xx",    "pmax",
    "set", "setpoint", "model", "fit",   "stc",  "ref",    "nom", "lim", "limit", "range",
    "src", "source",   "step",  "start", "stop", "offset", "ph",  "d",   "rms",   "nominal"};

bool IsCurrent(ColumnKind kind) {
  return kind == ColumnKind::kCurrent || kind == ColumnKind::kCurrentDensity;
}

bool SameSide(ColumnKind a, ColumnKind b) { return a == b || (IsCurrent(a) && IsCurrent(b)); }

// Interpretations of a column by its unit and by the first letter of its name.
struct Guess {
  ColumnKind by_unit = ColumnKind::kUnrecognised;
  ColumnKind by_letter = ColumnKind::kUnrecognised;
  std::string suffix;  // the name after the letter
  const Unit* unit = nullptr;
};

Guess GuessAt(std::string_view label) {
  Guess guess;
  const std::vector<LabelWord> words = SplitLabel(label);
  std::size_t name_words = 0;
  while (name_words < words.size() && !words[name_words].marked_as_unit) ++name_words;
  const std::string name = JoinWords(words, 0, name_words);
  const std::string unit = JoinWords(words, name_words, words.size());
  if (name.empty()) return guess;
  guess.suffix = name.substr(1);
  const bool no_reading =
      std::find(std::begin(kNoReading), std::end(kNoReading), guess.suffix) != std::end(kNoReading);
  if (no_reading) return guess;
  for (const ColumnKind kind :
       {ColumnKind::kVoltage, ColumnKind::kCurrent, ColumnKind::kCurrentDensity}) {
    const Unit* found = FindUnit(kind, unit);
    if (found == nullptr) continue;
    guess.by_unit = kind;
    guess.unit = found;
  }
  const char letter = name[0];
  ColumnKind by_letter = ColumnKind::kUnrecognised;
  if (letter == 'v' || letter == 'u') by_letter = ColumnKind::kVoltage;
  if (letter == 'i') by_letter = ColumnKind::kCurrent;
  if (letter == 'j') by_letter = ColumnKind::kCurrentDensity;
  const bool fits = unit.empty() || SameSide(guess.by_unit, by_letter);
  if (!guess.suffix.empty() && fits) guess.by_letter = by_letter;
  return guess;
}

void Become(ColumnKind kind, const Unit* unit, Column* column) {
  const std::string label = column->label;
  *column = {};
  column->label = label;
  column->kind = kind;
  if (unit == nullptr) return;
  column->unit = unit->text;
  column->factor = unit->factor;
}

// Sets the two columns as voltage and current; other columns of these kinds are no longer used.
void TakePair(const std::vector<Guess>& guesses, int voltage, int current,
              std::vector<Column>* columns) {
  for (Column& column : *columns) {
    if (column.kind == ColumnKind::kVoltage || IsCurrent(column.kind)) {
      column.kind = ColumnKind::kUnrecognised;
    }
  }
  Become(ColumnKind::kVoltage, guesses[voltage].unit, &(*columns)[voltage]);
  const Guess& guess = guesses[current];
  const ColumnKind kind =
      guess.by_unit != ColumnKind::kUnrecognised ? guess.by_unit : guess.by_letter;
  Become(kind, guess.unit, &(*columns)[current]);
}

bool GuessByLetter(const std::vector<Guess>& guesses, std::vector<Column>* columns) {
  std::map<std::string, std::pair<std::vector<int>, std::vector<int>>> pairs;
  for (int i = 0; i < static_cast<int>(guesses.size()); ++i) {
    if (guesses[i].by_letter == ColumnKind::kVoltage) pairs[guesses[i].suffix].first.push_back(i);
    if (IsCurrent(guesses[i].by_letter)) pairs[guesses[i].suffix].second.push_back(i);
  }
  std::vector<std::pair<int, int>> found;
  for (const auto& [suffix, sides] : pairs) {
    const auto& [voltages, currents] = sides;
    if (voltages.size() == 1 && currents.size() == 1) found.emplace_back(voltages[0], currents[0]);
  }
  if (found.size() != 1) return false;
  TakePair(guesses, found[0].first, found[0].second, columns);
  return true;
}

bool GuessByUnit(const std::vector<Guess>& guesses, std::vector<Column>* columns) {
  const auto only = [&](ColumnKind kind) {
    int place = -1;
    for (int i = 0; i < static_cast<int>(guesses.size()); ++i) {
      const bool known = (*columns)[i].kind == kind && (*columns)[i].refusal.empty();
      if (!known && guesses[i].by_unit != kind) continue;
      if (place != -1) return -1;
      place = i;
    }
    return place;
  };
  const int voltage = only(ColumnKind::kVoltage);
  int current = only(ColumnKind::kCurrent);
  if (current == -1) current = only(ColumnKind::kCurrentDensity);
  if (voltage == -1 || current == -1) return false;
  const Column kept[] = {(*columns)[voltage], (*columns)[current]};
  TakePair(guesses, voltage, current, columns);
  if (kept[0].kind == ColumnKind::kVoltage) (*columns)[voltage] = kept[0];
  if (IsCurrent(kept[1].kind)) (*columns)[current] = kept[1];
  return true;
}

// Pairs of "a_rev_V" and "a_rev": the voltage has the name of its current. All columns must be such
// pairs.
bool GuessByVoltageName(std::vector<Column>* columns) {
  constexpr std::string_view kEnding = "_v";
  std::vector<ColumnPair> pairs;
  for (int i = 0; i < static_cast<int>(columns->size()); ++i) {
    const std::string name = LowerCase(TrimBlanks((*columns)[i].label));
    if (name.size() <= kEnding.size() || name.substr(name.size() - kEnding.size()) != kEnding) {
      continue;
    }
    const std::string current = name.substr(0, name.size() - kEnding.size());
    for (int k = 0; k < static_cast<int>(columns->size()); ++k) {
      if (LowerCase(TrimBlanks((*columns)[k].label)) == current) pairs.push_back({i, k});
    }
  }
  if (pairs.empty() || 2 * pairs.size() != columns->size()) return false;
  for (const ColumnPair& pair : pairs) {
    const ColumnTag tag = ReadTag((*columns)[pair.current].label);
    Become(ColumnKind::kVoltage, FindUnit(ColumnKind::kVoltage, "v"), &(*columns)[pair.voltage]);
    Become(ColumnKind::kCurrent, nullptr, &(*columns)[pair.current]);
    (*columns)[pair.voltage].tag = (*columns)[pair.current].tag = tag;
  }
  return true;
}

// Whether a name is a word with a number: "series1", "Pixel 3".
bool IsNumberedName(const std::string& name) {
  const std::size_t letters = name.find_first_not_of("abcdefghijklmnopqrstuvwxyz");
  const std::size_t digits = name.find_first_of("0123456789");
  return letters != std::string::npos && letters > 3 && digits != std::string::npos &&
         digits <= letters + 1 && name.find_first_not_of("0123456789", digits) == std::string::npos;
}

// Open-circuit voltages over light. The light takes the place of the current.
bool GuessSunsVoc(std::vector<Column>* columns) {
  std::vector<std::string> labels;
  for (const Column& column : *columns) labels.push_back(column.label);
  const auto trace = FindSunsVoc(labels);
  if (!trace) return false;
  Become(ColumnKind::kVoltage, FindUnit(ColumnKind::kVoltage, "v"), &(*columns)[trace->voltage]);
  (*columns)[trace->voltage].factor = trace->voltage_factor;
  Become(ColumnKind::kCurrent, FindUnit(ColumnKind::kCurrent, "a"), &(*columns)[trace->light]);
  (*columns)[trace->light].light = true;
  return true;
}

// One voltage beside columns under the names of devices. They are currents if they share a unit of
// current, or if there is only one of them and its name is a word with a number.
bool GuessBesideVoltage(const std::vector<Guess>& guesses, std::vector<Column>* columns) {
  int voltage = -1;
  std::vector<int> others;
  for (int i = 0; i < static_cast<int>(columns->size()); ++i) {
    const Column& column = (*columns)[i];
    const bool known = column.kind == ColumnKind::kVoltage && column.refusal.empty();
    if (known || guesses[i].by_unit == ColumnKind::kVoltage) {
      if (voltage != -1) return false;
      voltage = i;
    } else if (column.kind == ColumnKind::kUnrecognised) {
      others.push_back(i);
    } else {
      return false;
    }
  }
  if (voltage == -1 || others.empty()) return false;
  const Guess& first = guesses[others[0]];
  const std::string name = LowerCase(TrimBlanks((*columns)[others[0]].label));
  const bool one_name = others.size() == 1 && columns->size() == 2 && IsNumberedName(name);
  const bool share_unit = IsCurrent(first.by_unit) &&
                          std::all_of(others.begin(), others.end(),
                                      [&](int other) { return guesses[other].unit == first.unit; });
  if (!one_name && !share_unit) return false;
  if ((*columns)[voltage].kind != ColumnKind::kVoltage) {
    Become(ColumnKind::kVoltage, guesses[voltage].unit, &(*columns)[voltage]);
  }
  for (const int other : others) {
    const std::string& label = (*columns)[other].label;
    const ColumnTag tag = ReadTag(std::string_view(label).substr(0, label.find_first_of("[(")));
    Become(share_unit ? first.by_unit : ColumnKind::kCurrent, first.unit, &(*columns)[other]);
    (*columns)[other].tag = tag;
  }
  return true;
}

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
      if (SameSide(column.kind, kind)) column.kind = ColumnKind::kUnrecognised;
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
    const std::vector<LabelWord> words = SplitLabel(wish);
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
      column.factor = unit->factor;
      column.offset = unit->offset;
    }
  }
  return {};
}

bool GuessColumns(std::vector<Column>* columns) {
  std::vector<Guess> guesses;
  for (const Column& column : *columns) guesses.push_back(GuessAt(column.label));
  return GuessByLetter(guesses, columns) || GuessByVoltageName(columns) ||
         GuessByUnit(guesses, columns) || GuessSunsVoc(columns) ||
         GuessBesideVoltage(guesses, columns);
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
  if (channel.more.empty()) return current.label;
  std::string name = current.tag.device;
  if (current.tag.direction == SweepDirection::kUnknown) name.clear();  // of two averaged columns
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

Expected<Channel> ChooseChannel(const std::vector<Column>& columns,
                                const std::vector<Channel>& channels, const std::string& wish) {
  if (wish.empty()) {
    if (channels.size() == 1) return channels[0];
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
