#include <algorithm>
#include <string>
#include <string_view>

#include "lyrefit/inspect/inspect_parts.h"
#include "lyrefit/read/results_above.h"
#include "lyrefit/read/rewrite_table.h"
#include "lyrefit/read/table_head.h"
#include "lyrefit/read/table_lines.h"

namespace lyrefit {
namespace {

std::string NameOfSeparator(char delimiter) {
  switch (delimiter) {
    case '\t':
      return "tab";
    case ';':
      return "semicolon";
    case ',':
      return "comma";
    case '|':
      return "stroke";
    case ' ':
      return "blanks";
    default:
      return "";
  }
}

// Whether the numbers of the rows have a decimal comma. A point before one marks thousands.
bool HasDecimalComma(const TableView& view) {
  if (view.delimiter == ',') return false;
  for (const Fields& row : view.rows) {
    for (const std::string& field : row) {
      if (field.find_first_not_of("+-0123456789.,eE") != std::string::npos) continue;
      const std::size_t mark = field.find_last_of(".,");
      if (mark != std::string::npos && field[mark] == ',') return true;
    }
  }
  return false;
}

// The values that a line gave: the first words of the sentences that it added, before "taken from".
std::string TakenFrom(const TableHead& head, std::size_t first) {
  std::string taken;
  for (std::size_t i = first; i < head.assumptions.size(); ++i) {
    const std::string& sentence = head.assumptions[i].sentence;
    taken += (taken.empty() ? "" : ", ") + sentence.substr(0, sentence.find(" taken from "));
  }
  return taken;
}

// Describes the lines before line `end`: what each states. Lines without a number state nothing.
void TakeHead(std::string_view text, int end, Inspection* found) {
  LineReader lines(text);
  TableHead head;
  ResultsAbove results;
  for (std::string_view line; lines.Next(&line) && lines.number() < end;) {
    const std::size_t begin = line.find_first_not_of(" \t");
    if (begin == std::string_view::npos) continue;
    const std::size_t taken = head.assumptions.size();
    const bool dated = !head.said.notes.date.empty();
    const bool comment = BeginsComment(line[begin]);
    const bool result = !comment && TakeResults(line, lines.number(), &results, &head);
    if (!result) {
      ReadHeadLine(line, lines.number(), comment ? HeadLine::kComment : HeadLine::kText, &head);
    }
    HeadLineNote note{lines.number(), std::string(line.substr(begin)), TakenFrom(head, taken)};
    if (!dated && !head.said.notes.date.empty()) note.taken = "date " + head.said.notes.date;
    if (result && note.taken.empty()) note.taken = "results of a sweep, not used in a fit";
    if (note.taken.empty() && line.find_first_of("0123456789") == std::string_view::npos) continue;
    found->head.push_back(std::move(note));
  }
}

}  // namespace

void TakeTable(const Inspected& file) {
  const DecodedText rewritten = RewriteTable(file.text);
  Inspection* const found = file.found;
  if (rewritten.remark != file.text.remark) found->assumed.push_back(rewritten.remark);
  ListedTable listed = ListTable(rewritten.text, file.path, file.options);
  const TableView& view = listed.view;
  if (view.delimiter == 0) return;
  found->separator = NameOfSeparator(view.delimiter);
  found->decimal = HasDecimalComma(view) ? "comma" : "point";
  found->header_line = view.header_line;
  found->first_row_line = view.first_row_line;
  found->rows = view.count;
  found->columns = std::move(listed.columns);
  TakeHead(rewritten.text, view.header_line == 0 ? view.first_row_line : view.header_line, found);
}

}  // namespace lyrefit
