#include "lyrefit/read/column_tag.h"

#include <string>
#include <string_view>
#include <utility>

#include "lyrefit/read/column_names.h"

namespace lyrefit {
namespace {

// Directions, lights and averages, as labels name them. "up" and "down" also stand alone.
constexpr std::pair<std::string_view, SweepDirection> kDirections[] = {
    {"forward", SweepDirection::kForward},  {"fwd", SweepDirection::kForward},
    {"for", SweepDirection::kForward},      {"fw", SweepDirection::kForward},
    {"up", SweepDirection::kForward},       {"reverse", SweepDirection::kReverse},
    {"backward", SweepDirection::kReverse}, {"back", SweepDirection::kReverse},
    {"bwd", SweepDirection::kReverse},      {"rev", SweepDirection::kReverse},
    {"rv", SweepDirection::kReverse},       {"down", SweepDirection::kReverse}};
constexpr std::pair<std::string_view, SweepLight> kLights[] = {
    {"dark", SweepLight::kDark},          {"light", SweepLight::kLight},
    {"lit", SweepLight::kLight},          {"illuminated", SweepLight::kLight},
    {"illumination", SweepLight::kLight}, {"sunsvoc", SweepLight::kSunsVoc},
    {"pseudo", SweepLight::kSunsVoc}};
constexpr std::string_view kLamps[] = {"light", "lamp", "illumination", "led", "sun", "laser"};
constexpr std::string_view kAverages[] = {"average", "averaged", "avg", "mean"};

template <class T, std::size_t N>
const T* FindWord(const std::pair<std::string_view, T> (&list)[N], std::string_view text) {
  for (const auto& [word, value] : list) {
    if (word == text) return &value;
  }
  return nullptr;
}

// Records one word of a tag; false if it is none. "forD" is a direction with the letter of a light.
bool TakeTagWord(const LabelWord& word, ColumnTag* tag) {
  if (const auto* direction = FindWord(kDirections, word.text)) {
    tag->direction = *direction;
    return true;
  }
  if (const auto* light = FindWord(kLights, word.text)) {
    tag->light = *light;
    return true;
  }
  if (IsAmong(kAverages, word.text)) return tag->average = true;
  const std::string_view original = word.original;
  if (original.size() < 3 || (original.back() != 'D' && original.back() != 'L')) return false;
  const auto* direction = FindWord(kDirections, word.text.substr(0, word.text.size() - 1));
  if (direction == nullptr) return false;
  tag->direction = *direction;
  tag->light = original.back() == 'D' ? SweepLight::kDark : SweepLight::kLight;
  return true;
}

}  // namespace

ColumnTag TakeTag(std::vector<LabelWord>* words) {
  ColumnTag tag;
  std::vector<LabelWord> kept;
  for (std::size_t i = 0; i < words->size(); ++i) {
    LabelWord word = (*words)[i];
    const std::string_view next = i + 1 < words->size() ? (*words)[i + 1].text : std::string_view();
    const bool suns_voc = word.text == "suns" && !word.marked_as_unit && next == "voc";
    const bool switched = IsAmong(kLamps, word.text) && (next == "on" || next == "off");
    if (suns_voc) word = {"sunsvoc", "SunsVoc", false};
    if (switched) word = {next == "on" ? "lit" : "dark", word.original, false};
    if (suns_voc || switched) ++i;
    if (TakeTagWord(word, &tag)) continue;
    const ColumnName* letter = FindName(std::string_view(word.text).substr(0, 1));
    const bool electrical = letter != nullptr && IsElectrical(letter->kind);
    if (electrical && word.text.size() > 3 && FindName(word.text) == nullptr &&
        TakeTagWord({word.text.substr(1), word.original.substr(1), false}, &tag)) {
      word.text.resize(1);
      word.original.resize(1);
    }
    kept.push_back(word);
  }
  *words = kept;
  return tag;
}

ColumnTag ReadTag(std::string_view text) {
  std::vector<LabelWord> words = SplitLabel(text);
  ColumnTag tag = TakeTag(&words);
  for (const LabelWord& word : words) {
    if (word.text == "txt" || word.text == "csv" || word.text == "dat") continue;
    tag.device += (tag.device.empty() ? "" : " ") + word.original;
  }
  return tag;
}

}  // namespace lyrefit
