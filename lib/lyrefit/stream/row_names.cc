// Optimized fully: rows are parsed character by character.
#include "lyrefit/stream/row_names.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>

#include "lyrefit/base/number_text.h"
#include "lyrefit/read/sidecar.h"
#include "lyrefit/read/table_head.h"

namespace lyrefit {
namespace {

struct IdName {
  std::string_view text;  // letters only, lower case
  IdPart part;
};

constexpr IdName kIdNames[] = {
    {"id", IdPart::kWhole},
    {"uid", IdPart::kWhole},
    {"uuid", IdPart::kWhole},
    {"curveid", IdPart::kWhole},
    {"stringid", IdPart::kWhole},
    {"path", IdPart::kWhole},
    {"site", IdPart::kSite},
    {"plant", IdPart::kSite},
    {"park", IdPart::kSite},
    {"block", IdPart::kBlock},
    {"section", IdPart::kBlock},
    {"zone", IdPart::kBlock},
    {"inverter", IdPart::kInverter},
    {"inv", IdPart::kInverter},
    {"wr", IdPart::kInverter},
    {"combiner", IdPart::kCombiner},
    {"combinerbox", IdPart::kCombiner},
    {"cb", IdPart::kCombiner},
    {"scb", IdPart::kCombiner},
    {"gak", IdPart::kCombiner},
    {"mppt", IdPart::kMppt},
    {"tracker", IdPart::kMppt},
    {"string", IdPart::kString},
    {"str", IdPart::kString},
    {"curve", IdPart::kCurve},
    {"name", IdPart::kOtherwise},
    {"label", IdPart::kOtherwise},
    {"module", IdPart::kOtherwise},
    {"panel", IdPart::kOtherwise},
    {"device", IdPart::kOtherwise},
    {"sample", IdPart::kOtherwise},
    {"serial", IdPart::kOtherwise},
};

constexpr std::string_view kEndings[] = {"number", "name", "id", "no", "nr"};

constexpr std::string_view kPairNames[] = {"ivdf",    "piv",    "iv",    "vi",
                                           "ivcurve", "ivdata", "points"};

IdPart FindIdName(std::string_view letters) {
  const auto* const found = std::find_if(std::begin(kIdNames), std::end(kIdNames),
                                         [&](const IdName& name) { return name.text == letters; });
  return found == std::end(kIdNames) ? IdPart::kNone : found->part;
}

IdPart IdPartOf(std::string_view name) {
  std::string letters;
  for (const char c : LowerCase(name)) {
    if (c >= 'a' && c <= 'z') letters += c;
    if (c >= '0' && c <= '9') return IdPart::kNone;  // "string2_V" does not name a level
  }
  if (const IdPart part = FindIdName(letters); part != IdPart::kNone) return part;
  for (const std::string_view ending : kEndings) {
    if (letters.size() <= ending.size()) continue;
    const std::size_t front = letters.size() - ending.size();
    if (std::string_view(letters).substr(front) != ending) continue;
    const IdPart part = FindIdName(std::string_view(letters).substr(0, front));
    if (part != IdPart::kNone) return part;
  }
  return IdPart::kNone;
}

NameMeaning Understand(std::string_view name) {
  NameMeaning meaning;
  meaning.id = IdPartOf(name);
  meaning.column = RecogniseColumn(name);
  meaning.sidecar = name != "name" && IsSidecarKey(name);
  // 30 is a valid value of every condition: cells, degrees, W/m2 and cm2.
  TableHead head;
  constexpr double kAnything = 30;
  meaning.states =
      !meaning.sidecar && meaning.id == IdPart::kNone && TakeStatement(name, kAnything, "", &head);
  meaning.pairs = std::find(std::begin(kPairNames), std::end(kPairNames), LowerCase(name)) !=
                  std::end(kPairNames);
  meaning.more = name == "more";
  if (name == "current_noise_constant_A") meaning.noise = "constant_A";
  if (name == "current_noise_relative") meaning.noise = "relative";
  meaning.sidecar = meaning.sidecar || meaning.noise != nullptr;
  return meaning;
}

using Names = std::map<std::string, NameMeaning, std::less<>>;

Names& NamesOfThread() {
  thread_local Names names;
  return names;
}

}  // namespace

const NameMeaning& MeaningOf(std::string_view name) {
  Names& names = NamesOfThread();
  const auto found = names.find(name);
  if (found != names.end()) return found->second;
  return names.emplace(std::string(name), Understand(name)).first->second;
}

void ForgetManyNames() {
  constexpr std::size_t kMany = 1000;
  Names& names = NamesOfThread();
  if (names.size() > kMany) names.clear();
}

std::string AsLevel(std::string_view text) {
  std::string level(TrimBlanks(text));
  std::replace(level.begin(), level.end(), '/', '_');
  return level;
}

std::string IdOf(const std::vector<RecordScalar>& scalars, std::vector<bool>* used) {
  constexpr std::size_t kParts = static_cast<std::size_t>(IdPart::kOtherwise) + 1;
  std::array<int, kParts> places;
  places.fill(-1);
  for (std::size_t i = 0; i < scalars.size(); ++i) {
    const auto part = static_cast<std::size_t>(MeaningOf(scalars[i].name).id);
    if (places[part] == -1 && !TrimBlanks(scalars[i].text).empty()) {
      places[part] = static_cast<int>(i);
    }
  }
  const auto take = [&](std::size_t part) {
    if (used != nullptr) (*used)[places[part]] = true;
    return std::string(TrimBlanks(scalars[places[part]].text));
  };
  if (used != nullptr) used->assign(scalars.size(), false);
  constexpr auto kWhole = static_cast<std::size_t>(IdPart::kWhole);
  constexpr auto kOtherwise = static_cast<std::size_t>(IdPart::kOtherwise);
  if (places[kWhole] != -1) return take(kWhole);
  std::string id;
  for (std::size_t part = kWhole + 1; part < kOtherwise; ++part) {
    if (places[part] != -1) id += (id.empty() ? "" : "/") + AsLevel(take(part));
  }
  if (id.empty() && places[kOtherwise] != -1) id = take(kOtherwise);
  return id;
}

}  // namespace lyrefit
