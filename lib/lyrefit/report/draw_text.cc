#include "lyrefit/report/document.h"
#include "lyrefit/report/text_layout.h"

// The customs of the terminal: headings and titles stand at the left edge, what is below them two
// columns in; a blank line goes before a section and after a banner.
namespace lyrefit {
namespace {

std::string TerminalText(const block::Field& field) { return Field(field.name, field.text); }

std::string TerminalText(const block::Sentence& sentence) { return Wrap("  ", sentence.text); }

std::string TerminalText(const block::Conclusion& conclusion) { return Wrap("", conclusion.text); }

std::string TerminalText(const block::List& list) {
  std::string text;
  for (const std::string& sentence : list.sentences) text += Wrap("  - ", sentence);
  return text;
}

std::string TerminalText(const block::Table& table) {
  TextTable text(table.alignment);
  for (const auto& head : table.heads) text.Add(head);
  for (const auto& row : table.rows) text.Add(row);
  return text.Text();
}

std::string TerminalText(const block::Preformatted& text) { return text.line + "\n"; }

std::string TerminalText(const block::Figure&) { return ""; }  // others show it

std::string TerminalText(const Section& section) {
  std::string text = section.heading.empty() ? "" : section.heading + "\n";
  for (const block::Any& one : section.blocks) {
    text += std::visit([](const auto& any) { return TerminalText(any); }, one);
  }
  return text;
}

}  // namespace

std::string DrawText(const Document& document) {
  std::string text;
  for (const std::string& banner : document.banners) text += Wrap("", banner) + "\n";
  text += TerminalText(document.head);
  for (const Section& section : document.sections) {
    text += (text.empty() ? "" : "\n") + TerminalText(section);
  }
  return text;
}

}  // namespace lyrefit
