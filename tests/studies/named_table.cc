#include "studies/named_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "lyrefit/base/file.h"
#include "lyrefit/base/number_text.h"

namespace lyrefit {

Expected<void> NamedTable::Open(const std::string& path, const std::vector<std::string>& columns) {
  constexpr std::uintmax_t kLargestFile = 1U << 24;
  auto text = ReadTextFile(path, kLargestFile);
  if (!text) return tl::unexpected(text.error());
  path_ = path;
  text_ = std::move(*text);
  lines_.emplace(text_);
  if (!lines_->NextContent(&line_) || !fields_.Split(line_)) {
    return Fail(
        "expected a header line with the columns " + fmt::format("{}", fmt::join(columns, ", ")),
        path, 1);
  }
  for (const std::string& column : columns) {
    int at = 0;
    while (at < static_cast<int>(fields_.size()) && fields_[at] != column) ++at;
    if (at == static_cast<int>(fields_.size())) {
      return Fail("expected a column '" + column + "'", path, lines_->number());
    }
    position_.push_back(at);
  }
  return {};
}

Expected<bool> NamedTable::Next() {
  if (!lines_->NextContent(&line_)) return false;
  if (!fields_.Split(line_)) return Fail("the quotes do not close", path_, lines_->number());
  const int last = *std::max_element(position_.begin(), position_.end());
  if (static_cast<int>(fields_.size()) <= last) {
    return Fail(fmt::format("expected at least {} fields, found {}", last + 1, fields_.size()),
                path_, lines_->number());
  }
  return true;
}

tl::unexpected<Error> NamedTable::Refuse(int column, const std::string& expected) const {
  return Fail(fmt::format("expected {}, found {}", expected, Quoted((*this)[column])), path_,
              lines_->number(), FieldColumn(line_, ',', position_[column]));
}

}  // namespace lyrefit
