#include "lyrefit/read/read_pan.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <vector>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/try.h"
#include "lyrefit/model/translation.h"
#include "lyrefit/read/table_lines.h"

namespace lyrefit {
namespace {

constexpr std::string_view kObject = "PVObject_";
constexpr std::string_view kEnd = "End of ";

bool BeginsWith(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

constexpr std::size_t kDeepestBlock = 64;  // open blocks; PVsyst has up to six

// An open block. "End of ..." names it by its type or by its name.
struct PanBlock {
  std::string name;  // "Commercial" of PVObject_Commercial=pvCommercial
  std::string type;  // "pvCommercial"
  std::string text;  // of the line that opened it
  int line = 0;
};

// The block that a line opens; nullopt if it opens none.
std::optional<PanBlock> Opened(std::string_view key, std::string_view value) {
  const std::size_t comma = key.find(", ");  // Remarks, Count=5; OperPoints, list of=3 tOperPoint
  const bool profile = value.size() > 8 && value.substr(value.size() - 7) == "Profile";
  if (BeginsWith(key, kObject)) {
    key.remove_prefix(kObject.size());
  } else if (comma != std::string_view::npos) {
    key = key.substr(0, comma);
  } else if (!profile || value[0] != 'T') {  // IAMProfile=TCubicProfile
    return std::nullopt;
  }
  return PanBlock{std::string(key), std::string(value), {}, 0};
}

// Name in "End of PVObject pvModule", "End of List OperPoints", "End of Remarks=...".
std::string_view EndName(std::string_view line) {
  line.remove_prefix(kEnd.size());
  for (const std::string_view word : {"PVObject", "List"}) {
    if (BeginsWith(line, word)) line.remove_prefix(word.size());
  }
  while (!line.empty() && (line[0] == ' ' || line[0] == '_' || line[0] == '=')) {
    line.remove_prefix(1);
  }
  return TrimBlanks(line.substr(0, line.find('=')));
}

// Closes the innermost block of this name and those inside it. The end of a block whose beginning
// was not recognised closes nothing.
void Close(std::string_view name, std::vector<PanBlock>* open) {
  for (std::size_t k = open->size(); k-- > 0;) {
    const PanBlock& block = (*open)[k];
    if (name != block.type && (block.name.empty() || name != block.name)) continue;
    open->resize(k);
    return;
  }
}

bool IsOfModule(const std::vector<PanBlock>& open) {
  return open.size() == 1 ||
         (open.size() == 2 && (open[1].type == "pvCommercial" || open[1].name == "Commercial"));
}

}  // namespace

const PanEntry* PanObject::Find(const std::string& key) const {
  const auto found = entries_.find(LowerCase(key));
  return found == entries_.end() ? nullptr : &found->second;
}

std::string PanObject::Text(const std::string& key) const {
  const PanEntry* const entry = Find(key);
  return entry == nullptr ? std::string() : entry->value;
}

tl::unexpected<Error> PanObject::Refuse(const PanEntry& entry, const std::string& expected) const {
  return Fail(fmt::format("expected {} in {}, found {}", expected, entry.key, Quoted(entry.value)),
              path_, entry.line, entry.column);
}

Expected<std::optional<double>> PanObject::Number(const PanNumber& number) const {
  const PanEntry* const entry = Find(number.key);
  if (entry == nullptr) return std::nullopt;
  const std::optional<double> value = ParseNumber(entry->value);
  const bool high = value && (number.above_least ? *value > number.least : *value >= number.least);
  if (high && std::isfinite(*value) && *value <= number.most) return value;
  std::string range;
  if (std::isfinite(number.most)) {
    range = fmt::format(", {:g} to {:g},", number.least, number.most);
  } else if (std::isfinite(number.least)) {
    range = fmt::format(" {} {:g}", number.above_least ? "above" : "of at least", number.least);
  }
  return Refuse(*entry, number.what + range);
}

Expected<double> PanObject::Required(const PanNumber& number) const {
  TRY(const std::optional<double> value, Number(number));
  if (value) return *value;
  return Fail(fmt::format("the module ends without {}: expected {}", number.key, number.what),
              path_, last_line_, 1);
}

bool IsPan(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string::npos && text.compare(first, kObject.size(), kObject) == 0;
}

Expected<PanObject> ParsePan(const std::string& text, const std::string& path) {
  PanObject module;
  module.path_ = path;
  std::vector<PanBlock> open;
  LineReader reader(text);
  for (std::string_view whole; reader.Next(&whole);) {
    const std::string_view line = TrimBlanks(whole);
    const auto margin = static_cast<std::size_t>(line.data() - whole.data());
    if (BeginsWith(line, kEnd)) {
      Close(EndName(line), &open);
      module.last_line_ = reader.number();
      if (open.empty()) return module;
      continue;
    }
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) continue;
    const std::string_view key = TrimBlanks(line.substr(0, equals));
    const std::string_view value = TrimBlanks(line.substr(equals + 1));
    const int column = static_cast<int>(margin + line.find_first_not_of(" \t", equals + 1)) + 1;
    if (open.empty() && (key != kObject || value != "pvModule")) {
      return Fail(fmt::format("expected a module, PVObject_=pvModule, found {}", Quoted(line)),
                  path, reader.number(), static_cast<int>(margin) + 1);
    }
    if (auto block = Opened(key, value)) {
      if (open.size() >= kDeepestBlock) {
        return Fail(
            fmt::format("expected \"End of ...\", found a block within {} others", kDeepestBlock),
            path, reader.number(), static_cast<int>(margin) + 1);
      }
      open.push_back({block->name, block->type, std::string(line), reader.number()});
    } else if (IsOfModule(open)) {
      PanEntry entry = {std::string(key), std::string(value), reader.number(),
                        value.empty() ? static_cast<int>(margin + equals) + 2 : column};
      const auto [before, is_new] = module.entries_.emplace(LowerCase(key), entry);
      const bool of_both = open.size() == 2 || key == "Flags" || key == "Comment";
      if (!is_new && !of_both) {
        return Fail(
            fmt::format("the module has {} twice: here and in line {}", key, before->second.line),
            path, entry.line, static_cast<int>(margin) + 1);
      }
    }
  }
  if (open.empty()) return Fail("expected a module, PVObject_=pvModule, found nothing", path);
  return Fail(fmt::format("the file ends within the block {} of line {}: expected \"End of ...\"",
                          Quoted(open.back().text), open.back().line),
              path, reader.number(), 1);
}

namespace {

constexpr double kMostPanCells = 100000;
// Relative to Isc and Voc. Values in other units are beyond: a muISC in uA/K, a muVocSpec in %/K.
constexpr double kLargestTempco_1_K = 0.005;
constexpr double kSmallestVocTempco_1_K = 1e-4;
constexpr double kLargestVocTempco_1_K = 0.01;

}  // namespace

Expected<PanPoints> TakePanPoints(const PanObject& pan) {
  PanPoints p = {};
  TRY(p.isc, pan.Required({"Isc", "a current in A", 0}));
  TRY(p.voc, pan.Required({"Voc", "a voltage in V", 0}));
  TRY(p.imp, pan.Required({"Imp", "a current in A", 0}));
  TRY(p.vmp, pan.Required({"Vmp", "a voltage in V", 0}));
  if (p.imp >= p.isc) return pan.Refuse(*pan.Find("Imp"), "a current below Isc");
  if (p.vmp >= p.voc) return pan.Refuse(*pan.Find("Vmp"), "a voltage below Voc");
  return p;
}

Expected<int> TakePanCells(const PanObject& pan) {
  const PanNumber cells = {"NCelS", "a number of cells in series", 1, false, kMostPanCells};
  TRY(const double found, pan.Required(cells));
  if (found != std::floor(found)) return pan.Refuse(*pan.Find("NCelS"), "a whole number of cells");
  return static_cast<int>(found);
}

Expected<void> CheckPanReference(const PanObject& pan) {
  const struct {
    const char* key;
    double ours;
    const char* expected;
  } references[] = {{"GRef", kReferenceIrradiance_W_m2, "the reference 1000 W/m2"},
                    {"TRef", kReferenceTemperature_C, "the reference 25 C"}};
  for (const auto& [key, ours, expected] : references) {
    TRY(const auto found, pan.Number({key, expected}));
    if (found && *found != ours) return pan.Refuse(*pan.Find(key), expected);
  }
  return {};
}

Expected<double> TakeCurrentTempco(const PanObject& pan, double isc_A) {
  const double most = 1e3 * kLargestTempco_1_K * isc_A;
  return pan.Required({"muISC", "a coefficient in mA/K", -most, false, most})
      .map([](double milliampere) { return 1e-3 * milliampere; });
}

Expected<double> TakeVoltageTempco(const PanObject& pan, double voc_V) {
  const std::string expected = "a negative coefficient in mV/K";
  TRY(const auto found, pan.Number({"muVocSpec", expected.c_str()}));
  if (!found || *found == 0) return kUnknown;
  const double relative_1_K = -1e-3 * *found / voc_V;
  if (relative_1_K > kSmallestVocTempco_1_K && relative_1_K < kLargestVocTempco_1_K) {
    return 1e-3 * *found;
  }
  return pan.Refuse(*pan.Find("muVocSpec"),
                    fmt::format("{} of a Voc of {:g} V, not in percent", expected, voc_V));
}

Expected<std::optional<double>> TakePowerTempco(const PanObject& pan) {
  TRY(const auto found, pan.Number({"muPmpReq", "a coefficient in %/K", -2, false, 2}));
  return found && *found != 0 ? found : std::nullopt;
}

std::string NameOfPan(const PanObject& pan) {
  const std::string maker = pan.Text("Manufacturer"), model = pan.Text("Model");
  return maker + (maker.empty() || model.empty() ? "" : " ") + model;
}

}  // namespace lyrefit
