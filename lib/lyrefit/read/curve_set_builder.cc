#include "lyrefit/read/curve_set_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <string_view>
#include <utility>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/settle_conditions.h"
#include "lyrefit/read/table_header.h"
#include "lyrefit/read/table_layout.h"
#include "lyrefit/read/table_lines.h"
#include "lyrefit/read/table_reading.h"
#include "lyrefit/read/text_encoding.h"

namespace lyrefit {
namespace {

struct IndexLayout {
  char delimiter = ',';
  std::vector<Column> columns;
  int id = kNoColumn;
  int irradiance = kNoColumn;
  int temperature = kNoColumn;
  int date = kNoColumn;
};

bool Contains(const std::string& text, std::string_view part) {
  return LowerCase(text).find(part) != std::string::npos;
}

// A column `file` has priority, since a column `curve` beside it may be a mere count.
int FindId(const std::vector<Column>& columns, IndexIds ids) {
  int found = kNoColumn;
  for (int i = 0; i < static_cast<int>(columns.size()); ++i) {
    if (ids == IndexIds::kFiles && LowerCase(columns[i].label) == "file") return i;
    const bool numbers =
        columns[i].kind == ColumnKind::kCurve || columns[i].kind == ColumnKind::kSweep;
    if (numbers && found == kNoColumn) found = i;
  }
  return found;
}

// The first usable column of the kind. A column whose label contains `lesser` is used only if there
// is no other.
int FindCondition(const std::vector<Column>& columns, ColumnKind kind, std::string_view lesser) {
  int found = kNoColumn;
  for (int i = 0; i < static_cast<int>(columns.size()); ++i) {
    if (columns[i].kind != kind) continue;
    const bool better = found == kNoColumn ||
                        (!columns[found].refusal.empty() && columns[i].refusal.empty()) ||
                        (Contains(columns[found].label, lesser) &&
                         !Contains(columns[i].label, lesser) && columns[i].refusal.empty());
    if (better) found = i;
  }
  return found;
}

// The first column named as a date.
int FindDate(const std::vector<Column>& columns) {
  for (int i = 0; i < static_cast<int>(columns.size()); ++i) {
    const std::string label = LowerCase(columns[i].label);
    for (const char* name : {"timestamp", "date", "datetime", "time"}) {
      if (label == name) return i;
    }
  }
  return kNoColumn;
}

Expected<IndexLayout> FindIndexLayout(std::string_view header, int line, const std::string& path,
                                      IndexIds ids) {
  for (const char delimiter : kDelimiters) {
    const auto fields = SplitFields(header, delimiter);
    if (!fields) continue;
    IndexLayout layout;
    layout.delimiter = delimiter;
    layout.columns = RecogniseAll(*fields);
    layout.id = FindId(layout.columns, ids);
    if (layout.id == kNoColumn) continue;
    layout.irradiance = FindCondition(layout.columns, ColumnKind::kIrradiance, "module");
    layout.temperature = FindCondition(layout.columns, ColumnKind::kTemperature, "module");
    layout.date = FindDate(layout.columns);
    for (const int used : {layout.irradiance, layout.temperature}) {
      if (used == kNoColumn || layout.columns[used].refusal.empty()) continue;
      return Fail(layout.columns[used].refusal, path, line, FieldColumn(header, delimiter, used));
    }
    return layout;
  }
  return Fail(fmt::format("expected a header with a column curve{}, found {}",
                          ids == IndexIds::kFiles ? " or file" : "", Quoted(header)),
              path, line, 1);
}

// The rows of an index while they are read.
struct IndexRows {
  const IndexLayout& layout;
  IndexIds ids;
  TableRow row;
  CurveIndex index;
};

Expected<std::string> IdOfRow(IndexRows* rows) {
  const std::string_view text = rows->row[rows->layout.id];
  if (text.empty()) return rows->row.RefuseField(rows->layout.id, "the id of a curve");
  if (rows->ids == IndexIds::kNumbers) {
    TRY(const int number, rows->row.WholeNumber(rows->layout.id));
    return std::to_string(number);
  }
  const std::filesystem::path file{std::string(text)};
  return IsTable(file) ? file.stem().string() : std::string(text);
}

Expected<std::optional<double>> NumberOfRow(IndexRows* rows, int field) {
  if (field == kNoColumn || rows->row[field].empty()) return std::optional<double>();
  TRY(const double value, rows->row.Value(field));
  return std::optional<double>(value);
}

Expected<void> ReadIndexRow(IndexRows* rows, std::string_view line, int number) {
  TRY(rows->row.Take(line, number));
  TRY(const std::string id, IdOfRow(rows));
  IndexRow row;
  row.missing =
      rows->row
          .Refuse(fmt::format("expected rows of curves that are there, found one of curve {}",
                              Quoted(id)),
                  rows->layout.id)
          .value();
  const auto irradiance = NumberOfRow(rows, rows->layout.irradiance);
  if (!irradiance) return tl::unexpected(irradiance.error());
  row.irradiance_W_m2 = *irradiance;
  if (irradiance->value_or(0) < -kLargestDarkOffset_W_m2) {
    return rows->row.RefuseField(rows->layout.irradiance, "an irradiance from 0 W/m2 up");
  }
  TRY(row.temperature_C, NumberOfRow(rows, rows->layout.temperature));
  if (rows->layout.date != kNoColumn) row.date = std::string(rows->row[rows->layout.date]);
  if (!rows->index.rows.try_emplace(id, std::move(row)).second) {
    return rows->row.Refuse(
        fmt::format("expected one row a curve, found a second one of curve {}", Quoted(id)),
        rows->layout.id);
  }
  return {};
}

// Records which conditions the index states, and the conversions of its columns.
void DescribeColumns(const IndexLayout& layout, CurveIndex* index) {
  index->states_irradiance = layout.irradiance != kNoColumn;
  index->states_temperature = layout.temperature != kNoColumn;
  for (const int used : {layout.irradiance, layout.temperature}) {
    if (used == kNoColumn) continue;
    const std::string& label = layout.columns[used].label;
    if (layout.columns[used].offset != 0) {
      index->assumptions.push_back(fmt::format(
          "column {} of the index converted from kelvin to degrees Celsius", Quoted(label)));
    }
    if (Contains(label, "module") && used == layout.temperature) {
      index->assumptions.push_back(fmt::format(
          "column {} of the index taken as the temperature of the cells", Quoted(label)));
    }
  }
}

}  // namespace

Expected<CurveIndex> ReadCurveIndex(const std::string& path, IndexIds ids,
                                    const ReadOptions& options) {
  TRY(const DecodedText text, ReadDecodedFile(path, options.largest_file_bytes));
  LineReader lines(text.text);
  std::string_view line;
  if (!lines.NextContent(&line)) {
    return Fail("the file holds no data, only blank lines and comments", path);
  }
  TRY(const IndexLayout layout, FindIndexLayout(line, lines.number(), path, ids));
  IndexRows rows{layout, ids, TableRow(layout.columns, layout.delimiter, path), {}};
  while (lines.NextContent(&line)) {
    TRY(ReadIndexRow(&rows, line, lines.number()));
  }
  DescribeColumns(layout, &rows.index);
  return std::move(rows.index);
}

namespace {

Expected<void> CheckIrradiance(const std::vector<double>& column) {
  if (column.empty()) return {};
  const double mean =
      std::accumulate(column.begin(), column.end(), 0.0) / static_cast<double>(column.size());
  if (mean >= -kLargestDarkOffset_W_m2) return {};
  return Fail(
      fmt::format("expected an irradiance from 0 W/m2 up, found a mean of {:.6g} W/m2", mean));
}

void SayWhereTheyDiffer(About about, const char* unit, const std::optional<double>& own,
                        const std::optional<double>& index, double tolerance, IvCurve* curve) {
  if (!own || !index || std::abs(*own - *index) <= tolerance) return;
  curve->assumptions.emplace_back(
      fmt::format("the {} in the index ({:.6g} {}) differs from the one in the file beside the "
                  "curve ({:.6g} {}): the latter counts",
                  ToText(about), *index, unit, *own, unit),
      about);
}

// Moves the assumptions that all curves share to the set.
void GatherAssumptions(CurveSet* set) {
  std::map<std::string, std::size_t> curves_saying;
  for (const IvCurve& curve : set->curves) {
    std::set<std::string> sentences;
    for (const Assumption& one : curve.assumptions) sentences.insert(one.sentence);
    for (const std::string& sentence : sentences) ++curves_saying[sentence];
  }
  const auto common = [&](const Assumption& one) {
    return curves_saying[one.sentence] == set->curves.size();
  };
  const std::vector<Assumption> first = set->curves.front().assumptions;
  std::copy_if(first.begin(), first.end(), std::back_inserter(set->assumptions), common);
  for (IvCurve& curve : set->curves) {
    auto& own = curve.assumptions;
    own.erase(std::remove_if(own.begin(), own.end(), common), own.end());
  }
}

}  // namespace

CurveSetBuilder::CurveSetBuilder(std::string name, std::string source, const ReadOptions& options)
    : options_(options) {
  set_.name = std::move(name);
  set_.source = std::move(source);
}

Expected<void> CurveSetBuilder::ReadCommon(const std::string& path, SidecarOf of) {
  if (!IsFile(path)) return {};
  TRY(common_, ReadSidecar(path, options_.largest_file_bytes, of));
  return {};
}

Expected<void> CurveSetBuilder::ReadIndex(const std::string& path, IndexIds ids) {
  if (!IsFile(path)) return {};
  TRY(CurveIndex index, ReadCurveIndex(path, ids, options_));
  Assume(index.assumptions);
  index_ = std::move(index);
  return {};
}

Expected<void> CurveSetBuilder::CheckIndex(const std::set<std::string>& ids) const {
  if (!index_) return {};
  const Error* first = nullptr;
  for (const auto& [id, row] : index_->rows) {
    if (ids.count(id) != 0) continue;
    if (first == nullptr || row.missing.line < first->line) first = &row.missing;
  }
  if (first != nullptr) return tl::unexpected(*first);
  return {};
}

void CurveSetBuilder::ApplyIndex(const Sidecar& own, Sidecar* stated, IvCurve* curve) const {
  if (!index_) return;
  // An empty field of the index means that the value is unknown for this curve, despite common
  // values.
  if (index_->states_irradiance) stated->irradiance_W_m2.reset();
  if (index_->states_temperature) stated->temperature_C.reset();
  const auto found = index_->rows.find(curve->name);
  if (found == index_->rows.end()) {
    curve->assumptions.emplace_back("the index has no row for this curve");
    return;
  }
  const IndexRow& row = found->second;
  if (index_->states_irradiance) stated->irradiance_W_m2 = row.irradiance_W_m2;
  if (index_->states_temperature) stated->temperature_C = row.temperature_C;
  if (!row.date.empty()) stated->notes.date = row.date;
  SayWhereTheyDiffer(About::kIrradiance, "W/m2", own.irradiance_W_m2, row.irradiance_W_m2,
                     0.02 * own.irradiance_W_m2.value_or(0), curve);
  SayWhereTheyDiffer(About::kTemperature, "C", own.temperature_C, row.temperature_C, 1, curve);
}

void CurveSetBuilder::TakeHead(const Sidecar& head) {
  common_ = MergeHead(std::move(common_), head);
}

void CurveSetBuilder::Add(RawCurve raw, int line) {
  std::string id = raw.curve.name;
  Sidecar stated = common_;
  // A common nominal value is used only if the curve has no column.
  if (!raw.curve.irradiance_W_m2.empty()) stated.irradiance_W_m2.reset();
  if (!raw.curve.temperature_C.empty()) stated.temperature_C.reset();
  ApplyIndex(raw.stated, &stated, &raw.curve);
  raw.stated = Merge(std::move(raw.stated), stated);
  const std::string source = raw.curve.source;
  auto valid = CheckIrradiance(raw.curve.irradiance_W_m2);
  if (!valid) return Reject(std::move(id), {valid.error().message, source, line});
  Expected<IvCurve> curve = FinishCurve(std::move(raw), options_);
  if (!curve) return Reject(std::move(id), {curve.error().message, source, line});
  curve->name = id;
  set_.curves.push_back(std::move(*curve));
}

void CurveSetBuilder::AddSettled(IvCurve curve) { set_.curves.push_back(std::move(curve)); }

void CurveSetBuilder::Reject(std::string id, Error error) {
  set_.rejected.push_back({std::move(id), std::move(error)});
}

void CurveSetBuilder::Assume(const std::vector<Assumption>& assumptions) {
  set_.assumptions.insert(set_.assumptions.end(), assumptions.begin(), assumptions.end());
}

Expected<CurveSet> CurveSetBuilder::Finish() {
  if (set_.curves.empty()) {
    if (!set_.rejected.empty()) return tl::unexpected(set_.rejected.front().error);
    return Fail("expected curves, found none", set_.source);
  }
  GatherAssumptions(&set_);
  return std::move(set_);
}

}  // namespace lyrefit
