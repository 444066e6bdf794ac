#include "lyrefit/read/table_layout.h"

#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/base/byte_input.h"
#include "lyrefit/base/file.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/key_point_table.h"
#include "lyrefit/read/results_above.h"

namespace lyrefit {
namespace {

constexpr int kLargestPreamble = 200;  // lines of text before the header

// Error for a file without a recognised table, at the line most similar to a header. The message
// lists the line's fields, split at the first delimiter that yields several.
Error NoLayout(std::string_view line, int number, const std::string& file) {
  const std::string expected =
      "expected a header with a voltage and a current, such as voltage_V,current_A";
  if (number == 0) return Error{"the file holds no data, only blank lines and comments", file};
  TableLine best;
  for (const char delimiter : kDelimiters) {
    const auto fields = SplitFields(line, delimiter);
    if (!fields || fields->size() < 2) continue;
    best = {delimiter, *fields, RecogniseAll(*fields)};
    break;  // in order of trial: blanks also separate words
  }
  if (best.delimiter == 0) {
    const char* what = ParseNumber(line, true) ? "a table of one column" : "one field";
    return Error{fmt::format("{}, found {}: {}", expected, what, Quoted(line)), file, number, 1};
  }
  if (AreKeyPoints(best.fields)) {
    return Error{fmt::format("expected the points of a curve, found its key points alone ({}): "
                             "`lyrefit datasheet` makes parameters of them",
                             ListOf(best.fields)),
                 file, number, 1};
  }
  std::string missing = "neither";
  if (HasKind(best.columns, ColumnKind::kVoltage)) missing = "no current";
  if (HasKind(best.columns, ColumnKind::kCurrent)) missing = "no voltage";
  return Error{fmt::format("{}, found {} among {}; name the columns with --voltage-column and "
                           "--current-column (name or number)",
                           expected, missing, ListOf(best.fields)),
               file, number, 1};
}

struct SkippedLine {
  std::string_view line;
  int number = 0;
};

// State of the search for the header or, without one, the first row.
struct LayoutSearch {
  LineReader lines;
  const std::string& file;
  HeaderRules rules;
  std::string_view line = {};
  std::string_view comment = {};
  Fields names = {};  // of columns, each given on a separate line
  SkippedLine first_text = {};
  SkippedLine last_text = {};
  SkippedLine text_before_row = {};
  bool row_after_text = false;
  bool demand_header = false;  // accept only a header with numbers below it
  bool found_header = false;   // a header with numbers below it
  std::optional<Expected<TableLayout>> second_best = {};
  TableHead head = {};
  std::vector<LineOfHead> head_lines = {};
  ResultsAbove results = {};
  int skipped = 0;  // lines of text, not counting comments
};

HeaderPlace PlaceOfHeader(const LayoutSearch& search, const TableLine& found) {
  return {search.file, search.lines.number(), search.line, found.delimiter};
}

// Whether the options select columns by place, so that no header is needed.
bool WishesArePlaces(const LayoutSearch& search) {
  return ParseNumber(search.rules.options.voltage_column) &&
         ParseNumber(search.rules.options.current_column);
}

Expected<TableLayout> Finished(const LayoutSearch& search, Expected<TableLayout> layout,
                               std::size_t offset, int lines_before) {
  if (!layout) return layout;
  layout->first_row_offset = offset;
  layout->first_row_line = lines_before;
  layout->head = search.head;
  ReadOwnHead(search.head_lines, layout->delimiter, layout->channels, layout->channel(),
              &layout->head);
  LineReader rows = search.lines;
  if (rows.offset() != offset) rows.StepBack(offset);
  FindDevices(rows, &*layout);
  SayWhatIsNotUsed(&*layout);
  std::vector<Assumption> about_head;
  if (search.skipped > 0) {
    about_head.push_back(fmt::format("{} line{} before the header in line {} skipped",
                                     search.skipped, search.skipped == 1 ? "" : "s",
                                     search.lines.number()));
  }
  const std::vector<Assumption> sentences = HeadSentences(layout->head);
  about_head.insert(about_head.end(), sentences.begin(), sentences.end());
  layout->assumptions.insert(layout->assumptions.begin(), about_head.begin(), about_head.end());
  return layout;
}

// The first lines with content below a line.
std::vector<std::string_view> LinesBelow(LineReader lines) {
  constexpr std::size_t kLooked = 3;
  std::vector<std::string_view> below;
  for (std::string_view line; below.size() < kLooked && lines.NextContent(&line);) {
    below.push_back(line);
  }
  return below;
}

std::optional<Expected<TableLayout>> TryHeaderWithUnits(LayoutSearch* search) {
  LineReader ahead = search->lines;
  std::string_view units;
  do {
    if (!ahead.Next(&units)) return std::nullopt;
  } while (IsBlankOrRule(units));
  const std::string joined = WithUnits(search->line, units);
  if (joined.empty()) return std::nullopt;
  const LineReader below = ahead;
  search->rules.below = LinesBelow(ahead);
  std::string_view next_line;
  ahead.NextContent(&next_line);
  TableLine header = AsHeader(joined, next_line, search->rules);
  if (header.delimiter == 0 || !header.fits) return std::nullopt;
  TakeGroupNames(search->last_text.line, &header);
  auto layout =
      LayoutOfHeader(header, PlaceOfHeader(*search, header), next_line, search->rules.options);
  search->lines = below;
  return Finished(*search, std::move(layout), search->lines.offset(), search->lines.number());
}

// Refuses names of key points over light and temperature: a matrix is no curve and no Suns-Voc trace.
std::optional<Expected<TableLayout>> TryMatrix(LayoutSearch* search) {
  for (const char delimiter : kDelimiters) {
    const auto fields = SplitFields(search->line, delimiter);
    if (!fields || !AsMatrix(*fields)) continue;
    search->found_header = true;
    return Expected<TableLayout>(
        Fail(fmt::format("expected the points of a curve, found key points over light and "
                         "temperature ({}): `lyrefit fit --family pvsyst` takes those of two "
                         "conditions or more",
                         ListOf(*fields)),
             search->file, search->lines.number(), 1));
  }
  return std::nullopt;
}

// Whether the end of a LabVIEW head follows, without a row before it: "Y_Unit_Label Volts Amps" in it
// is no header.
bool IsInHeadOfLabView(LineReader lines) {
  constexpr int kLooked = 10;
  constexpr std::string_view kMark = "***End_of_Header***";
  std::string_view line;
  for (int i = 0; i < kLooked && lines.NextContent(&line); ++i) {
    if (line.substr(0, kMark.size()) == kMark) return true;
    if (AsRow(line).delimiter != 0) return false;
  }
  return false;
}

// Interprets the line as a header, alone or with a line of units below it. A header without numbers
// below it is kept as second best: its rows produce a more specific error than no header would.
std::optional<Expected<TableLayout>> TryHeader(LayoutSearch* search) {
  if (auto matrix = TryMatrix(search)) return matrix;
  search->rules.below = LinesBelow(search->lines);
  if (IsInHeadOfLabView(search->lines)) return std::nullopt;
  if (auto with_units = TryHeaderWithUnits(search)) return with_units;
  const std::string_view next_line =
      search->rules.below.empty() ? std::string_view() : search->rules.below.front();
  TableLine header = AsHeader(search->line, next_line, search->rules);
  if (header.delimiter == 0) header = HeaderBelowResults(search->results, search->line, next_line);
  if (header.delimiter == 0 || (!header.fits && search->second_best)) return std::nullopt;
  TakeGroupNames(search->last_text.line, &header);
  search->found_header = search->found_header || header.fits;
  auto layout = Finished(
      *search,
      LayoutOfHeader(header, PlaceOfHeader(*search, header), next_line, search->rules.options),
      search->lines.offset(), search->lines.number());
  if (header.fits) return layout;
  search->second_best = std::move(layout);
  return std::nullopt;
}

void TakeHeadLine(HeadLine kind, LayoutSearch* search) {
  search->head_lines.push_back({search->line, search->lines.number(), kind});
  ReadHeadLine(search->line, search->lines.number(), kind, &search->head);
}

// Moves to the next line with content, like LineReader::NextContent. It also records comments and
// the offset of the line.
bool NextLineOf(LayoutSearch* search, std::size_t* offset) {
  while (true) {
    *offset = search->lines.offset();
    if (!search->lines.Next(&search->line)) return false;
    if (IsBlankOrRule(search->line)) continue;
    if (!BeginsComment(search->line[search->line.find_first_not_of(" \t")])) return true;
    search->comment = search->line;
    TakeHeadLine(HeadLine::kComment, search);
  }
}

// Whether the head of a LabVIEW file states that its X_Value is a voltage.
bool StatesVoltageOfX(std::string_view line) {
  const auto fields = SplitFields(line, '\t');
  return fields && fields->size() > 1 && (*fields)[0] == "X_Dimension" &&
         LowerCase((*fields)[1]) == "electric_potential";
}

void SkipLine(LayoutSearch* search) {
  search->last_text = {search->line, search->lines.number()};
  if (search->skipped++ == 0) search->first_text = search->last_text;
  TakeColumnName(search->line, &search->names);
  if (StatesVoltageOfX(search->line)) search->rules.x_is_voltage = true;
  if (TakeResults(search->line, search->lines.number(), &search->results, &search->head)) return;
  TakeHeadLine(HeadLine::kText, search);
}

Expected<TableLayout> LayoutFromRow(const LayoutSearch& search, const TableLine& row) {
  const TableLine header = HeaderInComment(search.comment, search.line, search.rules);
  if (header.delimiter == 0)
    return LayoutWithoutHeader(row, PlaceOfHeader(search, row), search.rules.options);
  Expected<TableLayout> layout =
      LayoutOfHeader(header, PlaceOfHeader(search, header), search.line, search.rules.options);
  if (layout) {
    layout->assumptions.push_back("column names taken from the comment above the numbers");
  }
  return layout;
}

Expected<TableLayout> FindLayout(LayoutSearch* search) {
  std::size_t offset = 0;
  while (search->skipped <= kLargestPreamble && NextLineOf(search, &offset)) {
    if (StoppableReads::Stopped()) return FailAsStopped(search->file);
    if (auto header = TryHeader(search)) return *header;
    const TableLine row = AsRow(search->line);
    if (const TableLine header = HeaderOfNames(search->names, row, search->rules);
        header.delimiter != 0) {
      Expected<TableLayout> layout = LayoutOfHeader(header, PlaceOfHeader(*search, header),
                                                    search->line, search->rules.options);
      if (layout) {
        layout->assumptions.push_back("column names taken from the lines that number them");
      }
      return Finished(*search, std::move(layout), offset, search->lines.number() - 1);
    }
    if (row.delimiter != 0 && !search->row_after_text && !search->demand_header) {
      if (search->skipped == 0 || WishesArePlaces(*search)) {
        return Finished(*search, LayoutFromRow(*search, row), offset, search->lines.number() - 1);
      }
      // Numbers may occur in text that a tracer writes before the header, so a header may still
      // follow.
      search->row_after_text = true;
      search->text_before_row = search->last_text;
    }
    SkipLine(search);
  }
  if (search->second_best && !search->demand_header) return *search->second_best;
  const SkippedLine& shown = search->row_after_text ? search->text_before_row : search->first_text;
  return tl::unexpected(NoLayout(shown.line, shown.number, search->file));
}

Expected<TableLayout> FindAnyLayout(std::string_view text, const std::string& file,
                                    const ReadOptions& options) {
  LayoutSearch known{LineReader(text), file, {options, false}};
  Expected<TableLayout> layout = FindLayout(&known);
  if (layout) return layout;
  LayoutSearch guessed{LineReader(text), file, {options, true}};
  Expected<TableLayout> guess = FindLayout(&guessed);
  return guess || guessed.found_header ? guess : layout;
}

// Chooses one of several devices by its name, else by its place.
Expected<TableLayout> WithDevice(TableLayout layout, const std::string& file,
                                 const std::string& wish) {
  const std::vector<std::string>& devices = layout.devices;
  const std::string label = layout.columns[layout.device_column].label + " ";
  const auto named = std::find_if(devices.begin(), devices.end(), [&](const std::string& device) {
    return device == wish || label + device == wish;
  });
  const auto place = ParseNumber(wish);
  if (named != devices.end()) layout.device = *named;
  for (std::size_t i = 0; i < devices.size() && place && layout.device.empty(); ++i) {
    if (*place == static_cast<double>(i + 1)) layout.device = devices[i];
  }
  if (!layout.device.empty()) {
    layout.assumptions.push_back(fmt::format("device {} of the {} in column {}",
                                             Quoted(layout.device), devices.size(),
                                             Quoted(layout.columns[layout.device_column].label)));
    return layout;
  }
  const std::string found =
      fmt::format("{} in column {}: {}", devices.size(),
                  Quoted(layout.columns[layout.device_column].label), ListOf(devices));
  if (wish.empty()) {
    return Fail(
        fmt::format("expected one device, found {}; choose one with --column NAME|N", found), file,
        layout.first_row_line);
  }
  return Fail(fmt::format("column {} was asked for, but the table has {}", Quoted(wish), found),
              file, layout.first_row_line);
}

}  // namespace

Expected<TableLayout> FindTableLayout(std::string_view text, const std::string& file,
                                      const ReadOptions& options) {
  Expected<TableLayout> layout = FindAnyLayout(text, file, options);
  if (layout && layout->devices.empty()) return layout;
  if (!layout) {
    if (options.column.empty()) return layout;
    ReadOptions any = options;
    any.column.clear();
    Expected<TableLayout> whole = FindAnyLayout(text, file, any);
    if (!whole || whole->devices.empty()) return layout;
    layout = std::move(whole);
  }
  const bool by_curve = options.column.empty() && options.curve;
  return WithDevice(std::move(*layout), file,
                    by_curve ? std::to_string(*options.curve) : options.column);
}

std::vector<std::string> MeasurementsOf(const TableLayout& layout) {
  if (!layout.devices.empty()) return layout.devices;
  std::vector<std::string> places;
  for (std::size_t i = 1; i <= layout.channels.size(); ++i) places.push_back(std::to_string(i));
  return places;
}

Expected<TableLayout> FindNextLayout(LineReader lines, const std::string& file,
                                     const ReadOptions& options) {
  LayoutSearch search{lines, file, {options, false}};
  search.demand_header = true;
  return FindLayout(&search);
}

}  // namespace lyrefit
