#include "lyrefit/study/coverage_journal.h"

#include "lyrefit/base/version.h"

namespace lyrefit {

JournalLine CoverageHead(const CoverageOptions& options) {
  JournalLine head = {{"lyrefit", Version()},
                      {"cells", options.cells_in_series},
                      {"law", ToText(options.family.law)},
                      {"model", ToText(options.family.model)},
                      {"noise", ToText(options.noise)}};
  for (const OptionRow<CoverageOptions>& row : kCoverageOptionTable) {
    if (std::string(row.name) == "sets" || row.Is(OptionTrait::kNoEcho)) continue;
    std::visit(
        [&](const auto& field) {
          if constexpr (IsNumberField<std::decay_t<decltype(field)>>::value) {
            head[row.name] = options.*field;
          }
        },
        row.field);
  }
  for (const auto& [name, value] : options.module) head["set " + name] = value;
  for (const OptionEcho& echo : NonDefaults(options.family, kFamilyOptionTable)) {
    JournalLine& value = head["fit " + echo.name];  // an option may be given more than once
    value = value.is_string() ? value.get<std::string>() + ", " + echo.value : echo.value;
  }
  return head;
}

JournalLine WriteSet(int index, const CoverageSet& set) {
  JournalLine rows = JournalLine::array();
  for (const CoverageRow& row : set.rows) {
    const Interval& interval = row.interval;
    rows.push_back(
        ExactNumbers({row.truth, interval.value, interval.standard_error, interval.low_95,
                      interval.high_95, row.fixed ? 1.0 : 0.0, row.identifiable ? 1.0 : 0.0}));
  }
  return {{"set", index},
          {"cells_in_series", set.cells_in_series},
          {"curves", set.curves},
          {"error", set.error},
          {"weights_isc", set.weights == FamilyWeights::kIsc ? 1 : 0},
          {"correlated", set.correlated ? 1 : 0},
          {"rows", std::move(rows)},
          {"seconds", ExactNumber(set.seconds)}};
}

Expected<WrittenSet> ReadSet(const Journal& journal, const Journal::Record& record) {
  RecordReader read(journal, record);
  WrittenSet written;
  written.index = static_cast<int>(read.Whole("set"));
  CoverageSet& set = written.set;
  set.cells_in_series = static_cast<int>(read.Whole("cells_in_series"));
  set.curves = static_cast<int>(read.Whole("curves"));
  set.error = read.Text("error");
  set.weights = read.Whole("weights_isc") == 1 ? FamilyWeights::kIsc : FamilyWeights::kEqual;
  set.correlated = read.Whole("correlated") == 1;
  set.seconds = read.Number("seconds");
  bool sound = written.index >= 0;
  for (const std::vector<double>& row : read.Rows("rows")) {
    sound = sound && row.size() == 7;
    if (!sound) break;
    set.rows.push_back({row[0], {row[1], row[2], row[3], row[4]}, row[5] != 0, row[6] != 0});
  }
  if (auto checked = read.Checked(); !checked) return tl::unexpected(checked.error());
  if (!sound) return Fail("this record is of no set of the study", journal.path(), record.line);
  return written;
}

}  // namespace lyrefit
