#include "lyrefit/read/rewrite_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lyrefit/base/number_text.h"
#include "lyrefit/read/column.h"
#include "lyrefit/read/table_header.h"
#include "lyrefit/read/table_lines.h"

namespace lyrefit {
namespace {

constexpr std::size_t kFewest = 10;  // readings of a scan
constexpr std::size_t kMost = 1 << 16;
constexpr int kLargestHead = 50;  // lines above the registers

// The readings of a scan before the zeros at its end.
std::size_t LengthOf(const std::vector<double>& voltages, const std::vector<double>& currents) {
  std::size_t length = voltages.size();
  while (length > 0 && voltages[length - 1] == 0 && currents[length - 1] == 0) --length;
  return length;
}

// 1: rises all the way, -1: falls, 0: neither.
int Direction(const std::vector<double>& values, std::size_t length) {
  if (length < kFewest) return 0;
  const int sign = values[length - 1] > values[0] ? 1 : -1;
  for (std::size_t k = 1; k < length; ++k) {
    if (!((values[k] - values[k - 1]) * sign > 0)) return 0;
  }
  return sign;
}

bool IsScan(const std::vector<double>& voltages, const std::vector<double>& currents) {
  constexpr double kNoise = 0.1;  // of the range of the currents, which may rise by so much
  const std::size_t length = LengthOf(voltages, currents);
  const int direction = Direction(voltages, length);
  if (direction == 0 || *std::min_element(voltages.begin(), voltages.end()) < 0) return false;
  const double range = (currents[0] - currents[length - 1]) * direction;
  if (!(range > 0)) return false;
  for (std::size_t k = 1; k < length; ++k) {
    if ((currents[k] - currents[k - 1]) * direction > kNoise * range) return false;
  }
  return true;
}

std::optional<RegisterScan> ScanOfPairs(const std::vector<double>& registers) {
  if (registers.size() % 2 != 0) return std::nullopt;
  std::vector<double> first, second;
  for (std::size_t k = 0; k < registers.size(); k += 2) {
    first.push_back(registers[k]);
    second.push_back(registers[k + 1]);
  }
  const bool voltage_first = IsScan(first, second);
  const bool current_first = IsScan(second, first);
  if (!voltage_first && !current_first) return std::nullopt;
  // If both fit, the voltages are those with the larger numbers: tenths of hundreds of volt.
  const double largest[] = {*std::max_element(first.begin(), first.end()),
                            *std::max_element(second.begin(), second.end())};
  if (voltage_first && (!current_first || largest[0] >= largest[1]))
    return RegisterScan{first, {second}};
  return RegisterScan{second, {first}};
}

std::optional<RegisterScan> ScanOfBlocks(const std::vector<double>& registers) {
  constexpr std::size_t kMostBlocks = 40;
  for (std::size_t blocks = 2; blocks <= kMostBlocks; ++blocks) {
    const std::size_t length = registers.size() / blocks;
    if (registers.size() % blocks != 0 || length < kFewest) continue;
    const auto block = [&](std::size_t i) {
      const auto begin = registers.begin() + static_cast<std::ptrdiff_t>(i * length);
      return std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(length));
    };
    RegisterScan scan{block(0), {}};
    bool all = true;
    for (std::size_t i = 1; i < blocks && all; ++i) {
      scan.currents.push_back(block(i));
      all = IsScan(scan.voltages, scan.currents.back());
    }
    if (all) return scan;
  }
  return std::nullopt;
}

// A register of 16 bits, signed. 0xFFFF stands for no value and becomes a zero of the padding.
double Signed(double number) {
  constexpr double kNone = 65535, kBits = 65536, kLargest = 32767;
  if (number == kNone) return 0;
  return number > kLargest ? number - kBits : number;
}

std::optional<double> WholeNumber(std::string_view text) {
  constexpr double kLowest = -32768, kHighest = 65535;
  const auto number = ParseNumber(text);
  const bool fits = number && *number == std::floor(*number) && *number >= kLowest &&
                    *number <= kHighest && text.find_first_of(".eE") == std::string_view::npos;
  return fits ? number : std::nullopt;
}

// A hexadecimal number of at most four digits, with or without 0x.
std::optional<double> Hexadecimal(std::string_view text) {
  if (text.substr(0, 2) == "0x" || text.substr(0, 2) == "0X") text.remove_prefix(2);
  if (text.empty() || text.size() > 4) return std::nullopt;
  double number = 0;
  for (const char c : text) {
    const std::size_t digit = std::string_view("0123456789abcdef").find(LowerCase({&c, 1}));
    if (digit == std::string_view::npos) return std::nullopt;
    number = 16 * number + static_cast<double>(digit);
  }
  return number;
}

// The words of a dump as registers. They are hexadecimal if one has letters and all have 0x or four
// digits.
std::optional<std::vector<double>> RegistersOf(const std::vector<std::string>& words) {
  const bool hexadecimal =
      std::any_of(words.begin(), words.end(),
                  [](const std::string& word) { return !WholeNumber(word); }) &&
      std::all_of(words.begin(), words.end(), [](const std::string& word) {
        return word.size() == 4 || word.substr(0, 2) == "0x" || word.substr(0, 2) == "0X";
      });
  std::vector<double> registers;
  for (const std::string& word : words) {
    const auto number = hexadecimal ? Hexadecimal(word) : WholeNumber(word);
    if (!number || registers.size() >= kMost) return std::nullopt;
    registers.push_back(Signed(*number));
  }
  return registers;
}

// What the lines of a dump hold.
struct RegisterText {
  std::string head;                // lines above the registers
  std::vector<std::string> words;  // the registers
};

// Whether a field is the name of a column of addresses, or of one of values.
bool IsOneOf(const std::string& field, std::initializer_list<std::string_view> names) {
  const std::string name = LowerCase(TrimBlanks(field));
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Lines of `address,value` below a line that names them so.
std::optional<RegisterText> ReadAddressed(std::string_view text, char delimiter) {
  RegisterText dump;
  std::optional<std::size_t> address, value;
  std::optional<double> last;
  LineReader lines(text);
  for (std::string_view line; lines.Next(&line);) {
    const auto fields = SplitFields(line, delimiter);
    if (!fields || fields->empty()) continue;
    if (!value) {
      for (std::size_t i = 0; i < fields->size(); ++i) {
        if (IsOneOf((*fields)[i], {"address", "addr", "register", "reg", "offset"})) address = i;
        if (IsOneOf((*fields)[i], {"value", "raw", "raw value", "data", "content"})) value = i;
      }
      if (!address || !value) address = value = std::nullopt;
      if (!value && lines.number() > kLargestHead) return std::nullopt;
      if (!value) dump.head.append(line).append("\n");
      continue;
    }
    if (std::max(*address, *value) >= fields->size()) return std::nullopt;
    const std::string& place = (*fields)[*address];
    const auto number = place.substr(0, 2) == "0x" ? Hexadecimal(place) : WholeNumber(place);
    if (!number || (last && *number != *last + 1)) return std::nullopt;
    last = number;
    dump.words.push_back((*fields)[*value]);
  }
  return value ? std::optional<RegisterText>(dump) : std::nullopt;
}

// Lists of many numbers a line, below lines that are none.
std::optional<RegisterText> ReadList(std::string_view text) {
  constexpr std::size_t kFewestInLine = 8;
  RegisterText dump;
  LineReader lines(text);
  for (std::string_view line; lines.Next(&line);) {
    std::string plain(line);
    std::replace_if(
        plain.begin(), plain.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
    const auto fields = SplitFields(plain, ' ');
    if (!fields || fields->empty()) continue;
    const bool numbers = std::all_of(fields->begin(), fields->end(), [](const std::string& word) {
      return WholeNumber(word) ||
             ((word.size() == 4 || word.substr(0, 2) == "0x") && Hexadecimal(word));
    });
    const bool begins = numbers && fields->size() >= kFewestInLine;
    if (dump.words.empty() && !begins) {
      if (lines.number() > kLargestHead) return std::nullopt;
      dump.head.append(line).append("\n");
      continue;
    }
    if (!numbers) return std::nullopt;
    dump.words.insert(dump.words.end(), fields->begin(), fields->end());
  }
  return dump;
}

// The scale that a part of the head states for a quantity, as "0.1"; empty if none does.
std::string ScaleIn(std::string_view head, ColumnKind kind) {
  while (!head.empty()) {
    const std::size_t end = std::min(head.find_first_of(",;:\n"), head.size());
    std::string_view part = head.substr(0, end);
    head.remove_prefix(std::min(end + 1, head.size()));
    part.remove_prefix(std::min(part.find_first_not_of("#% \t"), part.size()));
    const Column column = RecogniseColumn(part);
    if (column.kind == kind && column.refusal.empty() && column.factor < 1) {
      return fmt::format("{:g}", column.factor);
    }
  }
  return "";
}

}  // namespace

std::optional<RegisterScan> AsRegisterScan(const std::vector<double>& registers) {
  if (registers.size() < 2 * kFewest) return std::nullopt;
  if (auto pairs = ScanOfPairs(registers)) return pairs;
  return ScanOfBlocks(registers);
}

std::string RowsOfRegisters(std::string_view text) {
  constexpr std::size_t kLongest = 1 << 20;
  if (text.size() > kLongest) return "";
  std::optional<RegisterText> dump = ReadAddressed(text, ',');
  if (!dump) dump = ReadAddressed(text, ';');
  if (!dump) dump = ReadList(text);
  if (!dump || dump->words.size() < 2 * kFewest) return "";
  const auto registers = RegistersOf(dump->words);
  const auto scan = registers ? AsRegisterScan(*registers) : std::nullopt;
  if (!scan) return "";
  const auto name = [&](std::string_view quantity, ColumnKind kind, char unit) {
    const std::string scale = ScaleIn(dump->head, kind);
    return scale.empty() ? std::string(quantity) : fmt::format("{} ({}{})", quantity, scale, unit);
  };
  std::string rows = dump->head + name("voltage", ColumnKind::kVoltage, 'V');
  for (std::size_t i = 0; i < scan->currents.size(); ++i) {
    const std::string number = scan->currents.size() > 1 ? fmt::format("PV{} ", i + 1) : "";
    rows += "\t" + name(number + "current", ColumnKind::kCurrent, 'A');
  }
  for (std::size_t k = 0; k < scan->voltages.size(); ++k) {
    rows += fmt::format("\n{:g}", scan->voltages[k]);
    for (const std::vector<double>& current : scan->currents)
      rows += fmt::format("\t{:g}", current[k]);
  }
  return rows + "\n";
}

}  // namespace lyrefit
