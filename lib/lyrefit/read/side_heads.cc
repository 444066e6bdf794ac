#include "lyrefit/read/side_heads.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>

#include "lyrefit/base/number_text.h"
#include "lyrefit/read/label.h"
#include "lyrefit/read/table_header.h"

namespace lyrefit {
namespace {

// The fields from one column up to, not including, another.
struct Span {
  std::size_t begin, end;
};

std::size_t FirstColumn(const ColumnPair& pair) { return std::min(pair.voltage, pair.current); }

// The fields above a pair: up to the next pair to the right.
std::optional<Span> SpanOf(const std::vector<Channel>& channels, const ColumnPair& own) {
  Span span{FirstColumn(own), std::string_view::npos};
  for (const Channel& other : channels) {
    const bool is_own = other.voltage == own.voltage && other.current == own.current;
    if (!is_own && other.voltage == own.voltage) return std::nullopt;
    if (FirstColumn(other) > span.begin) span.end = std::min(span.end, FirstColumn(other));
  }
  return span;
}

// The own fields of a line whose label stands above every pair; none if it does not.
std::optional<Fields> OwnFields(std::string_view line, char delimiter,
                                const std::vector<Channel>& channels, const Span& own) {
  const auto fields = SplitFields(line, delimiter);
  if (!fields || own.begin >= fields->size()) return std::nullopt;
  const std::string& label = (*fields)[own.begin];
  const bool everywhere = std::all_of(channels.begin(), channels.end(), [&](const Channel& one) {
    return FirstColumn(one) < fields->size() && (*fields)[FirstColumn(one)] == label;
  });
  if (label.empty() || !everywhere || ParseNumber(label, true)) return std::nullopt;
  const std::size_t end = std::min(own.end, fields->size());
  return Fields(fields->begin() + static_cast<std::ptrdiff_t>(own.begin),
                fields->begin() + static_cast<std::ptrdiff_t>(end));
}

std::string Joined(const Fields& fields, char delimiter) {
  std::string line;
  for (const std::string& field : fields)
    line += (line.empty() ? "" : std::string(1, delimiter)) + field;
  return line;
}

// Takes what the value of a line without a number says of the light, whatever its label.
void TakeLightOf(const Fields& fields, int number, TableHead* head) {
  for (std::size_t i = 1; i < fields.size(); ++i) {
    TakeLight(fields[i], fmt::format("line {} {}", number, Quoted(fields[i])), head);
  }
}

}  // namespace

bool ReadOwnHead(const std::vector<LineOfHead>& lines, char delimiter,
                 const std::vector<Channel>& channels, const ColumnPair& own, TableHead* all) {
  const auto span = channels.size() > 1 ? SpanOf(channels, own) : std::nullopt;
  if (!span) return false;
  TableHead head;
  std::vector<std::pair<Fields, int>> parts;
  for (const LineOfHead& line : lines) {
    auto fields = OwnFields(line.text, delimiter, channels, *span);
    const std::string part = fields ? Joined(*fields, delimiter) : std::string(line.text);
    ReadHeadLine(part, line.number, line.kind, &head);
    if (fields) parts.emplace_back(std::move(*fields), line.number);
  }
  for (const auto& [fields, number] : parts) TakeLightOf(fields, number, &head);
  if (parts.empty()) return false;
  head.results = std::move(all->results);
  head.result_lines = std::move(all->result_lines);
  *all = std::move(head);
  return true;
}

}  // namespace lyrefit
