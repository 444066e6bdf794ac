// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/report/figure.h"

// A report as data: its content in reading order. The functions that draw it define its layout in a
// terminal, in Markdown or on a page.
namespace LYREFIT_PUBLIC lyrefit {

// Blocks of a section. Texts are plain, neither wrapped nor escaped.
namespace block {

// A name and its text. A field without a name continues the named field above.
struct Field {
  std::string name;      // may be empty
  std::string text;      // a line or several sentences
  bool further = false;  // see Section
};

// A paragraph.
struct Sentence {
  std::string text;
};

// Explains the notation of the next blocks.
struct Legend {
  std::string text;
};

// Conclusion of the whole report.
struct Conclusion {
  std::string text;
};

// A problem that the reader should check.
struct Warning {
  std::string text;
};

// Sentences, one on each line.
struct List {
  std::vector<std::string> sentences;
};

// A title and sentences below it.
struct Entry {
  std::string title;
  std::vector<std::string> sentences = {};
};

// A table. `alignment` has one letter for each column: 'l', 'r', or 'w' for a last column of
// wrapped text. Heads of more than one line are several rows. Missing cells are empty.
struct Table {
  // One text for each column.
  using Row = std::vector<std::string>;
  // A line across the table that titles the rows from `row` up to the next span.
  struct Span {
    std::size_t row = 0;  // the first one below the line
    std::string title;
  };
  std::string alignment;       // one letter for each column
  std::vector<Row> heads;      // above the line
  std::vector<Row> rows = {};  // below it
  std::string caption = {};
  std::vector<Span> spans = {};
  // Relative URLs to which pages link the first cells of the rows; missing and empty ones: no link.
  std::vector<std::string> links = {};
};

// Lines whose blanks are significant, each with its newline.
struct Preformatted {
  std::string lines;  // shown unchanged
};

// A picture. A terminal omits it. Markdown and HTML pages show `file`, or the caption alone if it
// is empty. DrawPage() of page.h draws `figure` with the table `readings` below it.
struct Figure {
  std::string caption;
  std::string file = {};        // path of the drawn picture; may be empty
  lyrefit::Figure figure = {};  // the picture as data
  Table readings = {};
};

// A table of many rows, which are in a CSV file. Only pages show it, with search, filters and a
// choice of columns (DrawPage() of page.h); a document has one at most.
struct LongTable {
  // A column of the file.
  struct Column {
    std::string name;     // in the head of the file
    std::string doc;      // description in one line
    bool number = false;  // sorted as numbers
    bool shown = true;    // before another choice
  };
  std::vector<Column> columns;  // as they are shown; in any order
  std::string links = {};       // prefix of the relative paths in the column "page"
};

// Any block.
using Any = std::variant<Field, Sentence, Legend, Conclusion, Warning, List, Entry, Table,
                         Preformatted, Figure, LongTable>;

}  // namespace block

// A titled group of blocks. A section of depth 1 belongs to the last section of depth 0.
struct Section {
  std::string heading;                  // may be empty
  std::vector<block::Any> blocks = {};  // in reading order
  int depth = 0;                        // 0, or 1 below the last of 0
  bool warns = false;                   // holds warnings, which pages show first
  bool folded = false;                  // pages show its heading only, until it is opened
  // Left out of a short text, as folded ones are. Pages show it.
  bool further = false;
};

// A report: its sections in reading order, with banners before them.
struct Document {
  std::vector<std::string> banners = {};  // shown before everything else
  Section head = {};                      // its heading is the title
  std::vector<Section> sections = {};
  // The result in one line or a few, shown first by DrawPage(). DrawText() and DrawMarkdown() show
  // it in one of the sections only.
  std::string verdict = {};
  // Names of signature lines, which DrawPage() adds at the end of the printed page.
  std::vector<std::string> signatures = {};
};

// Appends a block to a section.
void AddField(std::string name, std::string text, Section* section);
void AddFurtherField(std::string name, std::string text, Section* section);
void AddSentence(std::string text, Section* section);
void AddList(std::vector<std::string> sentences, Section* section);
void AddTable(block::Table table, Section* section);
void AddFigure(block::Figure figure, Section* section);  // ignored without panels

// The section, folded on a page.
Section Folded(Section section);
// The section, which a short text leaves out.
Section Further(Section section);

// A heading and a list below it.
Section ListSection(std::string heading, std::vector<std::string> sentences);

// The section "Warnings".
Section WarningSection(std::vector<std::string> warnings);

// Appends the sections in order and omits those without blocks.
void AddSections(std::vector<Section> sections, Document* document);

// How much of a report a text has: kShort is without what is folded or further.
enum class Length { kShort, kWhole };

// For a terminal of 100 columns. Ends with a newline.
std::string DrawText(const Document& document, Length length = Length::kWhole);

// Whether texts are plain, and so must be escaped, or Markdown already.
enum class Texts { kPlain, kMarkdown };
std::string DrawMarkdown(const Document& document, Texts texts = Texts::kPlain);

// A page of plain HTML 5 that is also well-formed XML, without scripts or network access.
std::string DrawHtml(const Document& document);

}  // namespace lyrefit
