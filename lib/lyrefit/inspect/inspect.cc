#include "lyrefit/inspect/inspect.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "lyrefit/base/file.h"
#include "lyrefit/base/reasons.h"
#include "lyrefit/base/try.h"
#include "lyrefit/inspect/inspect_parts.h"
#include "lyrefit/read/curve_text.h"
#include "lyrefit/read/json_text.h"
#include "lyrefit/read/key_point_table.h"
#include "lyrefit/read/multi_flash.h"
#include "lyrefit/read/results_above.h"
#include "lyrefit/read/rewrite_table.h"
#include "lyrefit/read/sidecar.h"
#include "lyrefit/read/table_curve.h"
#include "lyrefit/read/table_head.h"
#include "lyrefit/read/table_lines.h"
#include "lyrefit/read/table_view.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

std::string EncodingOf(const DecodedText& text) {
  if (text.remark.empty()) return "UTF-8";
  return text.remark.find("UTF-16") != std::string::npos ? "UTF-16" : "Windows-1252";
}

Expected<DecodedText> ReadText(const std::string& path, std::uintmax_t largest_bytes) {
  const bool input = path == "-";
  TRY(std::string bytes, ReadFileBytes(input ? "/dev/stdin" : path, largest_bytes));
  return DecodeText(std::move(bytes), input ? "standard input" : path);
}

// Describes a JSON document. False: the text is none.
bool TakeDocument(const Inspected& file) {
  const auto document = DocumentIn(file.text.text, file.path);
  if (!document) {
    file.found->form = "JSON document, which is broken";
    file.found->refusal = document.error().ToString();
    return true;
  }
  if (!*document) return false;
  file.found->form = "JSON document";
  if (IsReport(**document)) {
    file.found->form = "report of this program";
    file.found->next = {"lyrefit simulate --from " + file.path};
    return true;
  }
  TakeCurves(file);
  return true;
}

void TakeText(const Inspected& file) {
  Inspection* const found = file.found;
  if (TakeModule(file)) return;
  if (const auto log = FindOperatingLog(file.text.text)) {
    TakeTable(file);
    found->form = "operating points of a day";
    found->refusal = *log;
    found->next = {"lyrefit trend --operating " + file.path + " --module MODEL"};
    return;
  }
  const std::string first = file.text.text.substr(0, 1);
  if (TakeManyCurves(file)) {
    if (first != "{" && first != "[") TakeTable(file);
    return;
  }
  if (TakeDocument(file)) return;
  if (IsMultiFlash(file.text.text)) {
    found->form = "flashes of a multi-flash tester at fixed loads";
    TakeCurves(file);
    return;
  }
  found->form = HoldsKeyPoints(file.text.text, file.path)
                    ? "matrix of key points over irradiance and temperature"
                    : "table";
  TakeTable(file);
  if (found->form != "table") {  // its columns are key points and conditions, none of a sweep
    if (found->rows < 2) found->columns.clear();
    for (ColumnNote& column : found->columns) column.use = "of the matrix";
  }
  if (found->first_row_line == 0) found->form = "text without a table";
  TakeCurves(file);
}

// Sentences that the layout and the curves say alike.
std::vector<std::string> SaidOnce(const std::vector<std::string>& sentences) {
  std::vector<std::string> kept;
  for (const std::string& one : sentences) {
    if (std::find(kept.begin(), kept.end(), one) == kept.end()) kept.push_back(one);
  }
  return kept;
}

}  // namespace

Expected<CurveSet> CurvesIn(const Inspected& file, const ReadOptions& options) {
  if (TextHoldsCurveSet(file.text, file.path, options)) {
    return CurveSetOfFile(file.text, file.path, options);
  }
  TRY(IvCurve curve, CurveOfFile(file.text, file.path, options));
  return SetOfOne(std::move(curve));
}

Expected<Inspection> Inspect(const std::string& path, const ReadOptions& options) {
  Inspection found;
  found.file = path;
  ReadOptions all = options;
  all.curve.reset();
  all.column.clear();
  if (IsFolder(path) && CurveInFolder(path).empty()) {
    TakeFolder(path, all, &found);
    return found;
  }
  const std::string inside = IsFolder(path) ? CurveInFolder(path).string() : path;
  if (inside != "-") TRY(CheckIsNoStream(inside));
  TRY(const DecodedText text, ReadText(inside, options.largest_file_bytes));
  found.encoding = EncodingOf(text);
  TakeText({inside, all, text, &found});
  if (inside != path) found.form = "folder of one curve; in it " + inside + ": " + found.form;
  found.doubts = OncePerKind(found.doubts);
  found.assumed = SaidOnce(found.assumed);
  return found;
}

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
