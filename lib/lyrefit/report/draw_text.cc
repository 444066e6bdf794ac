#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/report/document.h"
#include "lyrefit/report/readable.h"
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

}  // namespace lyrefit
