#include "lyrefit/curve/table_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "lyrefit/base/try.h"
#include "lyrefit/curve/header_layout.h"
#include "lyrefit/curve/number_text.h"
#include "lyrefit/curve/table_header.h"
#include "lyrefit/curve/table_lines.h"

namespace lyrefit {
namespace {

constexpr int kLargestPreamble = 200;  // lines of text before the header

const char* NameOf(ColumnKind kind) {
  switch (kind) {
    case ColumnKind::kSigma:
      return "standard deviation of the current";
    case ColumnKind::kTime:
      return "time";
    case ColumnKind::kSweep:
    case ColumnKind::kCurve:
      return "number of the sweep or curve";
    case ColumnKind::kIrradiance:
      return "irradiance";
    case ColumnKind::kTemperature:
      return "cell temperature";
    default:
      return "used";
  }
}

// Isc, Voc and the like alone: what some call a curve.
bool AreKeyPoints(const Fields& names) {
  static constexpr std::string_view kPoints[] = {"isc", "voc", "imp", "vmp", "impp", "vmpp", "pmp"};
  const auto found = std::count_if(names.begin(), names.end(), [](const std::string& name) {
    std::string letters;
    for (const char c : LowerCase(name)) letters += c >= 'a' && c <= 'z' ? std::string(1, c) : "";
    return std::find(std::begin(kPoints), std::end(kPoints), letters) != std::end(kPoints);
  });
  return found >= 3;
}

// Why nothing could be made of the file, at the line that comes nearest to a header. Its fields are
// shown as the delimiter separates them that is really there.
Error NoLayout(std::string_view line, int number, const std::string& file) {
  const std::string expected =
      "expected a header with a voltage and a current, such as voltage_V,current_A";
  if (number == 0) return Error{"the file holds no data, only blank lines and comments", file};
  TableLine best;
  for (const char delimiter : kDelimiters) {
    const auto fields = SplitFields(line, delimiter);
    if (!fields || fields->size() < 2) continue;
    best = {delimiter, *fields, RecogniseAll(*fields)};
    break;  // in the order they are tried: blanks separate words, too
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

// The search for the first line that is a header or, without one, the first row.
class LayoutSearch {
 public:
  LayoutSearch(LineReader lines, const std::string& file, const HeaderRules& rules)
      : lines_(lines), file_(file), rules_(rules) {}

  // Only a header with numbers below it counts.
  void DemandHeader() { demand_header_ = true; }

  Expected<TableLayout> Run() {
    std::size_t offset = 0;
    while (skipped_ <= kLargestPreamble && NextContent(&offset)) {
      if (auto header = TryHeader()) return *header;
      const TableLine row = AsRow(line_);
      if (const TableLine header = HeaderOfNames(names_, row, rules_); header.delimiter != 0) {
        Expected<TableLayout> layout =
            LayoutOfHeader(header, PlaceOf(header), line_, rules_.options);
        if (layout) {
          layout->assumptions.push_back("column names taken from the lines that number them");
        }
        return Finish(std::move(layout), offset, lines_.number() - 1);
      }
      if (row.delimiter != 0 && !row_after_text_ && !demand_header_) {
        if (skipped_ == 0 || WishesArePlaces()) {
          return Finish(FromRow(row), offset, lines_.number() - 1);
        }
        // A header may still follow: numbers may stand in what a tracer writes before it.
        row_after_text_ = true;
        text_before_row_ = last_text_;
      }
      Skip();
    }
    if (second_best_ && !demand_header_) return *second_best_;
    const Text& shown = row_after_text_ ? text_before_row_ : first_text_;
    return tl::unexpected(NoLayout(shown.line, shown.number, file_));
  }

 private:
  struct Text {
    std::string_view line;
    int number = 0;
  };

  HeaderPlace PlaceOf(const TableLine& found) const {
    return {file_, lines_.number(), line_, found.delimiter};
  }

  // Whether columns are named by their places, so that no header is needed.
  bool WishesArePlaces() const {
    return ParseNumber(rules_.options.voltage_column) && ParseNumber(rules_.options.current_column);
  }

  // The line as a header, alone or with a line of units below it. One without numbers below is kept
  // in mind: it is still better than none, its rows tell what is wrong.
  std::optional<Expected<TableLayout>> TryHeader() {
    if (auto with_units = TryUnits()) return with_units;
    std::string_view next_line;
    LineReader ahead = lines_;
    ahead.NextContent(&next_line);
    const TableLine header = AsHeader(line_, next_line, rules_);
    if (header.delimiter == 0 || (!header.fits && second_best_)) return std::nullopt;
    auto layout = Finish(LayoutOfHeader(header, PlaceOf(header), next_line, rules_.options),
                         lines_.offset(), lines_.number());
    if (header.fits) return layout;
    second_best_ = std::move(layout);
    return std::nullopt;
  }

  std::optional<Expected<TableLayout>> TryUnits() {
    LineReader ahead = lines_;
    std::string_view units;
    do {
      if (!ahead.Next(&units)) return std::nullopt;
    } while (units.find_first_not_of(" \t") == std::string_view::npos);
    const std::string joined = WithUnits(line_, units);
    if (joined.empty()) return std::nullopt;
    const LineReader below = ahead;
    std::string_view next_line;
    ahead.NextContent(&next_line);
    const TableLine header = AsHeader(joined, next_line, rules_);
    if (header.delimiter == 0 || !header.fits) return std::nullopt;
    auto layout = LayoutOfHeader(header, PlaceOf(header), next_line, rules_.options);
    lines_ = below;
    return Finish(std::move(layout), lines_.offset(), lines_.number());
  }

  // Like LineReader's, but remembers comments and where the line began.
  bool NextContent(std::size_t* offset) {
    while (true) {
      *offset = lines_.offset();
      if (!lines_.Next(&line_)) return false;
      const std::size_t first = line_.find_first_not_of(" \t");
      if (first == std::string_view::npos) continue;
      if (!BeginsComment(line_[first])) return true;
      comment_ = line_;
      ReadHeadLine(line_, lines_.number(), HeadLine::kComment, &head_);
    }
  }

  void Skip() {
    last_text_ = {line_, lines_.number()};
    if (skipped_++ == 0) first_text_ = last_text_;
    TakeColumnName(line_, &names_);
    ReadHeadLine(line_, lines_.number(), HeadLine::kText, &head_);
  }

  Expected<TableLayout> FromRow(const TableLine& row) const {
    const TableLine header = HeaderInComment(comment_, line_, rules_);
    if (header.delimiter == 0) return LayoutWithoutHeader(row, PlaceOf(row), rules_.options);
    Expected<TableLayout> layout = LayoutOfHeader(header, PlaceOf(header), line_, rules_.options);
    if (layout) {
      layout->assumptions.push_back("column names taken from the comment above the numbers");
    }
    return layout;
  }

  Expected<TableLayout> Finish(Expected<TableLayout> layout, std::size_t offset,
                               int lines_before) const {
    if (!layout) return layout;
    layout->first_row_offset = offset;
    layout->first_row_line = lines_before;
    layout->head = head_;
    std::vector<Assumption> about_head;
    if (skipped_ > 0) {
      about_head.push_back(fmt::format("{} line{} before the header in line {} skipped", skipped_,
                                       skipped_ == 1 ? "" : "s", lines_.number()));
    }
    const std::vector<Assumption> sentences = HeadSentences(head_);
    about_head.insert(about_head.end(), sentences.begin(), sentences.end());
    layout->assumptions.insert(layout->assumptions.begin(), about_head.begin(), about_head.end());
    return layout;
  }

  LineReader lines_;
  const std::string& file_;
  HeaderRules rules_;
  std::string_view line_;
  std::string_view comment_;
  Fields names_;  // of columns, given one a line
  Text first_text_;
  Text last_text_;
  Text text_before_row_;
  bool row_after_text_ = false;
  bool demand_header_ = false;
  std::optional<Expected<TableLayout>> second_best_;
  TableHead head_;
  int skipped_ = 0;  // lines of text, not counting comments
};

}  // namespace

Expected<TableLayout> FindTableLayout(std::string_view text, const std::string& file,
                                      const ReadOptions& options) {
  Expected<TableLayout> known = LayoutSearch(LineReader(text), file, {options, false}).Run();
  if (known) return known;
  Expected<TableLayout> guessed = LayoutSearch(LineReader(text), file, {options, true}).Run();
  return guessed ? guessed : known;
}

Expected<TableLayout> FindNextLayout(LineReader lines, const std::string& file,
                                     const ReadOptions& options) {
  LayoutSearch search(lines, file, {options, false});
  search.DemandHeader();
  return search.Run();
}

Expected<std::vector<ColumnNote>> ListTableColumns(std::string_view text, const std::string& file,
                                                   const ReadOptions& options) {
  ReadOptions any = options;
  if (any.column.empty()) any.column = "1";
  TRY(const TableLayout layout, FindTableLayout(text, file, any));
  std::vector<ColumnNote> notes;
  for (int i = 0; i < static_cast<int>(layout.columns.size()); ++i) {
    std::string use;
    const bool several = layout.channels.size() > 1;
    for (std::size_t k = 0; k < layout.channels.size(); ++k) {
      const Channel& channel = layout.channels[k];
      const std::string pair = several ? fmt::format(" {}", k + 1) : "";
      if (channel.current == i) use = (layout.per_area() ? "current density" : "current") + pair;
      if (channel.voltage != i || !use.empty()) continue;
      const bool shared = several && layout.channels[0].voltage == layout.channels[1].voltage;
      use = "voltage" + (shared ? "" : pair);
    }
    if (use.empty()) use = IsUsed(layout, i) ? NameOf(layout.columns[i].kind) : "not used";
    notes.push_back({i + 1, layout.columns[i].label, use});
  }
  return notes;
}

}  // namespace lyrefit
