#include <algorithm>
#include <string_view>

#include "lyrefit/report/document.h"
#include "lyrefit/report/readable.h"
#include "lyrefit/report/text_layout.h"

namespace lyrefit {
namespace {

// Plain text as one line of Markdown that is displayed unchanged.
std::string Literal(const std::string& text) {
  std::string line;
  for (const char c : text) {
    if (std::string_view("\\`*_[]<>~&$").find(c) != std::string_view::npos) line += '\\';
    line += c == '\n' || c == '\r' || c == '\t' ? ' ' : c;
  }
  return line;
}

// Plain text at the start of a block, where '#', "- " or "1. " would start another block.
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

// A table row; '|' is escaped, as it would end a cell.
std::string MarkdownRow(const block::Table::Row& cells, std::size_t columns) {
  std::string line = "|";
  for (std::size_t c = 0; c < columns; ++c) {
    line += ' ';
    for (const char letter : c < cells.size() ? cells[c] : std::string()) {
      if (letter == '|') line += '\\';
      line += letter;
    }
    line += " |";
  }
  return line + "\n";
}

// Markdown tables allow one head row only, so the heads are joined.
block::Table::Row OneHead(const block::Table& table) {
  block::Table::Row head(table.alignment.size());
  for (const auto& row : table.heads) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      head[c] += (head[c].empty() || row[c].empty() ? "" : " ") + row[c];
    }
  }
  return head;
}

// Draws blocks; texts are of one kind.
struct Markdown {
  Texts texts;

  std::string Inline(const std::string& text) const {
    return texts == Texts::kPlain ? Literal(text) : text;
  }

  // A paragraph or an item. Plain text is not wrapped: its words could start a block at the start
  // of a line.
  std::string Block(const std::string& text) const {
    return texts == Texts::kPlain ? Opening(text) + "\n" : Wrap("", text);
  }

  std::string operator()(const block::Field& field) const {
    if (field.name.empty()) return "- " + Block(field.text);
    return "- **" + Inline(field.name) + "**: " + Inline(field.text) + "\n";
  }

  std::string operator()(const block::Sentence& sentence) const { return Block(sentence.text); }

  std::string operator()(const block::Legend& legend) const { return Block(legend.text); }

  std::string operator()(const block::Conclusion& conclusion) const {
    return "**" + Inline(conclusion.text) + "**\n";
  }

  std::string operator()(const block::Warning& warning) const { return "> " + Block(warning.text); }

  std::string operator()(const block::List& list) const {
    std::string text;
    for (const std::string& sentence : list.sentences) text += "- " + Block(sentence);
    return text;
  }

  std::string operator()(const block::Entry& entry) const {
    std::string text = "- **" + Inline(entry.title) + "**\n";
    for (const std::string& sentence : entry.sentences) text += "  - " + Block(sentence);
    return text;
  }

  std::string operator()(const block::Table& table) const {
    const std::size_t columns = table.alignment.size();
    const auto line = [&](block::Table::Row row) {
      for (std::string& cell : row) cell = Inline(cell);
      return MarkdownRow(row, columns);
    };
    std::string text = table.caption.empty() ? "" : "*" + Inline(table.caption) + "*\n\n";
    text += line(OneHead(table)) + "|";
    for (const char letter : table.alignment) text += letter == 'r' ? "---:|" : "---|";
    text += "\n";
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
      for (const block::Table::Span& span : table.spans) {
        if (span.row == r) text += MarkdownRow({"**" + Inline(span.title) + "**"}, columns);
      }
      text += line(table.rows[r]);
    }
    return text;
  }

  // A fence longer than any within the text.
  std::string operator()(const block::Preformatted& text) const {
    std::string fence = "```";
    while (text.lines.find(fence) != std::string::npos) fence += '`';
    return fence + "text\n" + text.lines + fence + "\n";
  }

  std::string operator()(const block::Figure& figure) const {
    const std::string caption = Inline(figure.caption);
    if (figure.file.empty()) return "*" + caption + "*\n";
    return "![" + caption + "](" + figure.file + ")\n";
  }

  std::string operator()(const block::LongTable&) const { return ""; }

  // Adjacent blocks of one type are not separated by a blank line; others are.
  std::string operator()(const Section& section, const std::string& marks) const {
    std::string text;
    if (!section.heading.empty()) text = marks + " " + Inline(section.heading) + "\n\n";
    const std::vector<block::Any>& blocks = section.blocks;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      text += std::visit(*this, blocks[i]);
      const bool listed = std::holds_alternative<block::Field>(blocks[i]) ||
                          std::holds_alternative<block::Entry>(blocks[i]);
      const bool goes_on =
          listed && i + 1 < blocks.size() && blocks[i + 1].index() == blocks[i].index();
      if (!goes_on) text += "\n";
    }
    return text;
  }
};

}  // namespace

std::string DrawMarkdown(const Document& document, Texts texts) {
  const Markdown draw = {texts};
  std::string text;
  for (const std::string& banner : document.banners) {
    text += "> **" + draw.Inline(banner) + "**\n\n";
  }
  text += draw(document.head, "#");
  for (const Section& section : document.sections) {
    text += draw(section, section.depth == 0 ? "##" : "###");
  }
  if (!text.empty()) text.pop_back();  // one newline at the end
  return Readable(text);
}

}  // namespace lyrefit
