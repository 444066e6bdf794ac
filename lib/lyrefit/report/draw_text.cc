#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "lyrefit/report/document.h"
#include "lyrefit/report/text_layout.h"

// Layout of the terminal: headings, titles, legends and conclusions start at the left edge, other
// blocks in the third column. A blank line precedes a section and a table with a caption, and
// follows a banner.

namespace lyrefit {
namespace {

// A heading; wrapped only if it is too long, as its blanks may matter.
std::string Heading(const std::string& text) {
  return Columns(text) > kTextWidth ? Wrap("", text) : text + "\n";
}

std::string TerminalText(const block::Field& field) {
  return Wrap(fmt::format("  {:<13} ", field.name), field.text);
}

std::string TerminalText(const block::Sentence& sentence) { return Wrap("  ", sentence.text); }

std::string TerminalText(const block::Legend& legend) { return Wrap("", legend.text); }

std::string TerminalText(const block::Conclusion& conclusion) { return Wrap("", conclusion.text); }

std::string TerminalText(const block::Warning& warning) { return Wrap("  ! ", warning.text); }

std::string TerminalText(const block::List& list) {
  std::string text;
  for (const std::string& sentence : list.sentences) text += Wrap("  - ", sentence);
  return text;
}

std::string TerminalText(const block::Entry& entry) {
  std::string text = Wrap("  ", entry.title);
  for (const std::string& sentence : entry.sentences) text += Wrap("    ", sentence);
  return text;
}

// A line of a table, or several if its last column is wrapped.
std::string TerminalRow(const std::string& alignment, const std::vector<std::size_t>& widths,
                        const block::Table::Row& row) {
  std::string line;
  for (std::size_t c = 0; c < row.size(); ++c) {
    if (alignment[c] == 'w') return Wrap(line + "  ", row[c]);
    const std::string blanks(widths[c] - Columns(row[c]), ' ');
    line += "  " + (alignment[c] == 'r' ? blanks + row[c] : row[c] + blanks);
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

// A table with each column as wide as its widest cell. Rows below span titles are indented.
std::string TerminalText(const block::Table& table) {
  std::vector<block::Table::Row> lines = table.heads;
  lines.insert(lines.end(), table.rows.begin(), table.rows.end());
  std::vector<std::size_t> widths(table.alignment.size(), 0);
  for (block::Table::Row& row : lines) {
    if (!table.spans.empty() && !row.empty()) row[0].insert(0, "  ");
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], Columns(row[c]));
  }
  std::string text = table.caption.empty() ? "" : "\n" + Wrap("  ", table.caption);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (const block::Table::Span& span : table.spans) {
      if (table.heads.size() + span.row == i) text += Wrap("  ", span.title);
    }
    text += TerminalRow(table.alignment, widths, lines[i]);
  }
  return text;
}

std::string TerminalText(const block::Preformatted& text) { return text.lines; }

std::string TerminalText(const block::Figure&) { return ""; }  // shown by the other formats

std::string TerminalText(const block::LongTable&) { return ""; }

std::string TerminalText(const std::vector<block::Any>& blocks, Length length) {
  std::string text;
  for (const block::Any& one : blocks) {
    const auto* const field = std::get_if<block::Field>(&one);
    if (length == Length::kShort && field != nullptr && field->further) continue;
    text += std::visit([](const auto& any) { return TerminalText(any); }, one);
  }
  return text;
}

}  // namespace

std::string DrawText(const Document& document, Length length) {
  std::string text;
  for (const std::string& banner : document.banners) text += Wrap("", banner) + "\n";
  const Section& head = document.head;
  text += (head.heading.empty() ? "" : head.heading + "\n") + TerminalText(head.blocks, length);
  for (const Section& section : document.sections) {
    const bool seen =
        std::any_of(section.blocks.begin(), section.blocks.end(), [](const block::Any& any) {
          return !std::holds_alternative<block::Figure>(any) &&
                 !std::holds_alternative<block::LongTable>(any);
        });
    if (!seen && !section.blocks.empty()) continue;  // nothing that a terminal shows
    if ((section.folded || section.further) && length == Length::kShort) continue;
    if (!text.empty()) text += "\n";
    if (!section.heading.empty()) text += Heading(section.heading);
    text += TerminalText(section.blocks, length);
  }
  return Readable(text);
}

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
