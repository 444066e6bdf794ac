#include "lyrefit/report/document.h"

namespace lyrefit {

void AddField(std::string name, std::string text, Section* section) {
  section->blocks.push_back(block::Field{std::move(name), std::move(text)});
}

void AddFurtherField(std::string name, std::string text, Section* section) {
  section->blocks.push_back(block::Field{std::move(name), std::move(text), true});
}

void AddSentence(std::string text, Section* section) {
  section->blocks.push_back(block::Sentence{std::move(text)});
}

void AddList(std::vector<std::string> sentences, Section* section) {
  if (sentences.empty()) return;
  section->blocks.push_back(block::List{std::move(sentences)});
}

void AddTable(block::Table table, Section* section) { section->blocks.push_back(std::move(table)); }

void AddFigure(block::Figure figure, Section* section) {
  if (!figure.figure.panels.empty()) section->blocks.push_back(std::move(figure));
}

Section ListSection(std::string heading, std::vector<std::string> sentences) {
  Section section = {std::move(heading)};
  AddList(std::move(sentences), &section);
  return section;
}

Section WarningSection(std::vector<std::string> warnings) {
  Section section = ListSection("Warnings", std::move(warnings));
  section.warns = true;
  return section;
}

Section Folded(Section section) {
  section.folded = true;
  return section;
}

Section Further(Section section) {
  section.further = true;
  return section;
}

void AddSections(std::vector<Section> sections, Document* document) {
  for (Section& section : sections) {
    if (!section.blocks.empty()) document->sections.push_back(std::move(section));
  }
}

}  // namespace lyrefit
