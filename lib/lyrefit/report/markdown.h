#pragma once

#include <string>
#include <vector>

namespace lyrefit {

// A table of a Markdown page; `alignment` holds one letter a column, 'l' or 'r'. The first row is
// the head. '|' in cells is escaped.
class MarkdownTable {
 public:
  explicit MarkdownTable(std::string alignment) : alignment_(std::move(alignment)) {}
  void Add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  std::string Text() const;  // ends with a blank line

 private:
  std::string alignment_;
  std::vector<std::vector<std::string>> rows_;
};

// One paragraph, broken at blanks, with a blank line behind it.
std::string Paragraph(const std::string& text);

// The text between "<!-- NAME -->" and "<!-- end of NAME -->" in `page` replaced by `block`; the
// page as it is where there is no such pair.
std::string ReplaceBlock(const std::string& page, const std::string& name,
                         const std::string& block);

}  // namespace lyrefit
