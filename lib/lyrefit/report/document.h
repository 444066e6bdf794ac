#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

// A report as data: what is said, in the order in which it is read. How that looks in a terminal,
// in Markdown or on a page is the business of who draws it.
namespace lyrefit {

// What a section is made of. Texts are plain: nobody has wrapped or escaped them.
namespace block {

// A name and what is to be said of it. One without a name is one more text under the name above.
struct Field {
  std::string name;
  std::string text;
};

// A sentence or a few: a paragraph.
struct Sentence {
  std::string text;
};

// What the whole report comes to.
struct Conclusion {
  std::string text;
};

struct List {
  std::vector<std::string> sentences;
};

// `alignment` holds one letter a column: 'l', 'r', or 'w' for a last column of long texts. Heads
// that need more than one line have as many rows. Missing cells are empty.
struct Table {
  using Row = std::vector<std::string>;
  std::string alignment;
  std::vector<Row> heads;
  std::vector<Row> rows = {};
};

// One line whose blanks matter.
struct Preformatted {
  std::string line;
};

// A picture, of which a terminal shows nothing; so far its caption alone.
struct Figure {
  std::string caption;
};

using Any = std::variant<Field, Sentence, Conclusion, List, Table, Preformatted, Figure>;

}  // namespace block

// A heading may be missing. A section of depth 1 belongs to the one of depth 0 before it.
struct Section {
  std::string heading;
  std::vector<block::Any> blocks = {};
  int depth = 0;
};

struct Document {
  std::vector<std::string> banners = {};  // what must be known before anything else is read
  Section head = {};                      // its heading is the title
  std::vector<Section> sections = {};
};

void AddField(std::string name, std::string text, Section* section);
void AddSentence(std::string text, Section* section);
void AddList(std::vector<std::string> sentences, Section* section);
void AddTable(block::Table table, Section* section);

// A heading and a list below it.
Section ListSection(std::string heading, std::vector<std::string> sentences);

// One after the other. A section without blocks has nothing to say and is left out.
void AddSections(std::vector<Section> sections, Document* document);

// For a terminal of 100 columns. Ends with a newline.
std::string DrawText(const Document& document);

// Names and texts are escaped: they look as they are.
std::string DrawMarkdown(const Document& document);

// A page of plain HTML 5 that is well-formed XML too. Nothing in it is run, nothing is fetched.
std::string DrawHtml(const Document& document);

}  // namespace lyrefit
