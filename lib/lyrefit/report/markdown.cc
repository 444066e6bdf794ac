#include "lyrefit/report/markdown.h"

#include "lyrefit/report/text_layout.h"

namespace lyrefit {
namespace {

std::string Escaped(const std::string& cell) {
  std::string text;
  for (const char c : cell) {
    if (c == '|') text += '\\';
    text += c;
  }
  return text;
}

std::string Row(const std::vector<std::string>& cells, std::size_t columns) {
  std::string line = "|";
  for (std::size_t i = 0; i < columns; ++i) {
    line += " " + (i < cells.size() ? Escaped(cells[i]) : std::string()) + " |";
  }
  return line + "\n";
}

}  // namespace

std::string MarkdownTable::Text() const {
  if (rows_.empty()) return "";
  std::string text = Row(rows_[0], alignment_.size()) + "|";
  for (const char letter : alignment_) text += letter == 'r' ? "---:|" : "---|";
  text += "\n";
  for (std::size_t r = 1; r < rows_.size(); ++r) text += Row(rows_[r], alignment_.size());
  return text + "\n";
}

std::string Paragraph(const std::string& text) { return Wrap("", text) + "\n"; }

std::string ReplaceBlock(const std::string& page, const std::string& name,
                         const std::string& block) {
  const std::string first = "<!-- " + name + " -->\n";
  const std::string last = "<!-- end of " + name + " -->";
  const std::size_t begin = page.find(first);
  if (begin == std::string::npos) return page;
  const std::size_t end = page.find(last, begin);
  if (end == std::string::npos) return page;
  return page.substr(0, begin + first.size()) + block + page.substr(end);
}

}  // namespace lyrefit
