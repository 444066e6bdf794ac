#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/report/figure.h"

// A report as data: what is said, in the order in which it is read. How that looks in a terminal,
// in Markdown or on a page is the business of who draws it.
namespace LYREFIT_PUBLIC lyrefit {

// What a section is made of. Texts are plain: nobody has wrapped or escaped them.
namespace block {

// A name and what is to be said of it. One without a name is one more text under the name above.
struct Field {
  std::string name;  // may be empty
  std::string text;  // a line or several sentences
};

// A sentence or a few: a paragraph.
struct Sentence {
  std::string text;
};

// What must be known to read what comes next.
struct Legend {
  std::string text;
};

// What the whole report comes to.
struct Conclusion {
  std::string text;
};

// What is to be looked at twice.
struct Warning {
  std::string text;
};

// Sentences, each on its own.
struct List {
  std::vector<std::string> sentences;
};

// A title and what is to be said below it, one thing after the other.
struct Entry {
  std::string title;
  std::vector<std::string> sentences = {};
};

// `alignment` holds one letter a column: 'l', 'r', or 'w' for a last column of long texts. Heads
// that need more than one line have as many rows. Missing cells are empty.
struct Table {
  // One text a column.
  using Row = std::vector<std::string>;
  // A line across the table which names the rows from `row` on to the next one.
  struct Span {
    std::size_t row = 0;  // the first one below the line
    std::string title;
  };
  std::string alignment;       // a letter a column
  std::vector<Row> heads;      // above the line
  std::vector<Row> rows = {};  // below it
  std::string caption = {};
  std::vector<Span> spans = {};
};

// Lines whose blanks matter, each with its newline.
struct Preformatted {
  std::string lines;  // shown as they stand
};

// A picture, of which a terminal shows nothing. Pages show the `file` it was drawn into, if there
// is one, else the caption alone; DrawPage() of page.h draws the `figure`, and below it what it
// shows in numbers.
struct Figure {
  std::string caption;
  std::string file = {};        // that the picture was drawn into; may be empty
  lyrefit::Figure figure = {};  // the picture as data
  Table readings = {};
};

// Any of these.
using Any = std::variant<Field, Sentence, Legend, Conclusion, Warning, List, Entry, Table,
                         Preformatted, Figure>;

}  // namespace block

// A heading may be missing. A section of depth 1 belongs to the one of depth 0 before it.
struct Section {
  std::string heading;                  // may be empty
  std::vector<block::Any> blocks = {};  // in reading order
  int depth = 0;                        // 0, or 1 below the last of 0
  bool warns = false;                   // of warnings, which pages show before all else
};

// A report: its sections in reading order, and what stands before and after them.
struct Document {
  std::vector<std::string> banners = {};  // what must be known before anything else is read
  Section head = {};                      // its heading is the title
  std::vector<Section> sections = {};
  // What the report comes to, in a line or a few: DrawPage() begins with it. Texts say it in one of
  // their sections.
  std::string verdict = {};
  // Who signs it: DrawPage() has a line for each at the end of what is printed on paper.
  std::vector<std::string> signatures = {};
};

// Puts one more block at the end of a section.
void AddField(std::string name, std::string text, Section* section);
void AddSentence(std::string text, Section* section);
void AddList(std::vector<std::string> sentences, Section* section);
void AddTable(block::Table table, Section* section);
void AddFigure(block::Figure figure, Section* section);  // not one without panels

// A heading and a list below it.
Section ListSection(std::string heading, std::vector<std::string> sentences);

// The section "Warnings".
Section WarningSection(std::vector<std::string> warnings);

// One after the other. A section without blocks has nothing to say and is left out.
void AddSections(std::vector<Section> sections, Document* document);

// For a terminal of 100 columns. Ends with a newline.
std::string DrawText(const Document& document);

// Whether texts are plain, and escaped so that they look as they are, or written as Markdown.
enum class Texts { kPlain, kMarkdown };
std::string DrawMarkdown(const Document& document, Texts texts = Texts::kPlain);

// A page of plain HTML 5 that is well-formed XML too. Nothing in it is run, nothing is fetched.
std::string DrawHtml(const Document& document);

}  // namespace lyrefit
