#include <algorithm>

#include "lyrefit/report/document.h"
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

// One line that shows what stands there.
std::string Literal(const std::string& text) {
  std::string line;
  for (const char c : text) {
    if (std::string_view("\\`*_[]<>~&$").find(c) != std::string_view::npos) line += '\\';
    line += c == '\n' || c == '\r' || c == '\t' ? ' ' : c;
  }
  return line;
}

// The same at the beginning of a block, where '#', "- " or "1. " would open another one.
std::string Opening(const std::string& text) {
  std::string line = Literal(text);
  const std::size_t mark = line.find_first_not_of("0123456789");
  if (mark == std::string::npos) return line;
  const bool listed =
      mark == 0 ? line[mark] == '-' || line[mark] == '+' : line[mark] == '.' || line[mark] == ')';
  const bool alone =
      mark + 1 == line.size() || line[mark + 1] == ' ' || line[mark + 1] == line[mark];
  if ((mark == 0 && line[mark] == '#') || (listed && alone)) line.insert(mark, "\\");
  return line;
}

std::string MarkdownText(const block::Field& field) {
  if (field.name.empty()) return "- " + Opening(field.text) + "\n";
  return "- **" + Literal(field.name) + "**: " + Literal(field.text) + "\n";
}

std::string MarkdownText(const block::Sentence& sentence) { return Opening(sentence.text) + "\n"; }

std::string MarkdownText(const block::Conclusion& conclusion) {
  return "**" + Literal(conclusion.text) + "**\n";
}

std::string MarkdownText(const block::List& list) {
  std::string text;
  for (const std::string& sentence : list.sentences) text += "- " + Opening(sentence) + "\n";
  return text;
}

// Only one row can be the head of a table.
std::string MarkdownText(const block::Table& table) {
  MarkdownTable text(table.alignment);
  const auto add = [&text](block::Table::Row row) {
    std::transform(row.begin(), row.end(), row.begin(), Literal);
    text.Add(std::move(row));
  };
  block::Table::Row head(table.alignment.size());
  for (const auto& row : table.heads) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      head[c] += (head[c].empty() || row[c].empty() ? "" : " ") + row[c];
    }
  }
  add(std::move(head));
  for (const auto& row : table.rows) add(row);
  std::string drawn = text.Text();
  drawn.pop_back();  // the blank line behind
  return drawn;
}

std::string MarkdownText(const block::Preformatted& text) { return "    " + text.line + "\n"; }

std::string MarkdownText(const block::Figure& figure) {
  return "*" + Literal(figure.caption) + "*\n";
}

// Neighbours of one kind stand together, others apart.
std::string MarkdownText(const Section& section, const std::string& marks) {
  std::string text;
  if (!section.heading.empty()) text = marks + " " + Literal(section.heading) + "\n\n";
  const std::vector<block::Any>& blocks = section.blocks;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    text += std::visit([](const auto& any) { return MarkdownText(any); }, blocks[i]);
    const bool listed = std::holds_alternative<block::Field>(blocks[i]) ||
                        std::holds_alternative<block::Preformatted>(blocks[i]);
    const bool goes_on =
        listed && i + 1 < blocks.size() && blocks[i + 1].index() == blocks[i].index();
    if (!goes_on) text += "\n";
  }
  return text;
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

std::string DrawMarkdown(const Document& document) {
  std::string text;
  for (const std::string& banner : document.banners) {
    text += "> **" + Literal(banner) + "**\n\n";
  }
  text += MarkdownText(document.head, "#");
  for (const Section& section : document.sections) {
    text += MarkdownText(section, section.depth == 0 ? "##" : "###");
  }
  if (!text.empty()) text.pop_back();  // one newline at the end
  return text;
}

}  // namespace lyrefit
