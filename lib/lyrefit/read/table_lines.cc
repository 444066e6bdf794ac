#include "lyrefit/read/table_lines.h"

#include <glog/logging.h>

#include <algorithm>

namespace lyrefit {
namespace {

bool IsBlank(char c) { return c == ' ' || c == '\t'; }

int NoSpace(unsigned char) { return 0; }

}  // namespace

bool IsBlankOrRule(std::string_view line) {
  std::size_t dashes = 0;
  for (const char c : line) {
    if (c == '-' || c == '=') ++dashes;
    const bool drawn = IsBlank(c) || c == '-' || c == '=' || c == '|' || c == '+' || c == ':';
    if (!drawn) return false;
  }
  return dashes >= 3 || line.find_first_not_of(" \t") == std::string_view::npos;
}

LineReader::LineReader(std::string_view text, std::size_t offset, int lines_before)
    : text_(text), at_(offset), number_(lines_before) {
  if (text.find('\n') == std::string_view::npos) end_ = '\r';
}

bool LineReader::Next(std::string_view* line) {
  if (at_ >= text_.size()) return false;
  const std::size_t end = std::min(text_.find(end_, at_), text_.size());
  *line = text_.substr(at_, end - at_);
  if (!line->empty() && line->back() == '\r') line->remove_suffix(1);
  at_ = end + 1;
  ++number_;
  return true;
}

bool LineReader::NextContent(std::string_view* line) {
  std::size_t offset = 0;
  return NextContent(line, &offset);
}

bool LineReader::NextContent(std::string_view* line, std::size_t* offset) {
  for (*offset = at_; Next(line); *offset = at_) {
    if (IsBlankOrRule(*line)) continue;
    if (!BeginsComment(*std::find_if_not(line->begin(), line->end(), IsBlank))) return true;
  }
  return false;
}

LineSplitter::LineSplitter(char delimiter) : delimiter_(delimiter) {
  CHECK_EQ(csv_init(&parser_, CSV_STRICT | CSV_STRICT_FINI), 0);
  csv_set_delim(&parser_, static_cast<unsigned char>(delimiter));
  if (delimiter == ' ') csv_set_space_func(&parser_, NoSpace);
}

LineSplitter::~LineSplitter() { csv_free(&parser_); }

void LineSplitter::TakeField(void* text, std::size_t length, void* self) {
  auto* splitter = static_cast<LineSplitter*>(self);
  if (splitter->delimiter_ == ' ' && length == 0) return;
  splitter->content_.append(static_cast<const char*>(text), length);
  splitter->ends_.push_back(splitter->content_.size());
}

bool LineSplitter::Split(std::string_view line) {
  content_.clear();
  ends_.clear();
  line_.assign(line);
  if (delimiter_ == ' ') std::replace(line_.begin(), line_.end(), '\t', ' ');
  // libcsv copies a field whenever it has grown by a block, so blocks are as large as the line.
  constexpr std::size_t kBlock = 128;
  csv_set_blk_size(&parser_, std::max(kBlock, line_.size()));
  const bool parsed =
      csv_parse(&parser_, line_.data(), line_.size(), TakeField, nullptr, this) == line_.size();
  const bool closed = csv_fini(&parser_, TakeField, nullptr, this) == 0;
  if (parsed && closed) return true;
  // The parser keeps the state of the broken line, so it is replaced.
  csv_free(&parser_);
  csv_init(&parser_, CSV_STRICT | CSV_STRICT_FINI);
  csv_set_delim(&parser_, static_cast<unsigned char>(delimiter_));
  if (delimiter_ == ' ') csv_set_space_func(&parser_, NoSpace);
  return false;
}

std::string_view LineSplitter::operator[](std::size_t i) const {
  const std::size_t begin = i == 0 ? 0 : ends_[i - 1];
  return std::string_view(content_).substr(begin, ends_[i] - begin);
}

int FieldColumn(std::string_view line, char delimiter, std::size_t index) {
  std::size_t at = 0;
  const auto skip_blanks = [&] {
    while (at < line.size() && IsBlank(line[at]) && line[at] != (delimiter == '\t' ? '\t' : '\0')) {
      ++at;
    }
  };
  skip_blanks();
  bool quoted = false;
  for (; index > 0 && at < line.size(); ++at) {
    if (line[at] == '"') quoted = !quoted;
    const bool ends = delimiter == ' ' ? IsBlank(line[at]) : line[at] == delimiter;
    if (quoted || !ends) continue;
    --index;
    ++at;
    skip_blanks();
    --at;
  }
  return static_cast<int>(at) + 1;
}

}  // namespace lyrefit
