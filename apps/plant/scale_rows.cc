#include "plant/scale_rows.h"

#include <cmath>
#include <utility>

#include "lyrefit/base/append.h"
#include "lyrefit/batch/count_rows.h"

namespace lyrefit {
namespace {

ScaleMember MemberOf(const RowReader& reader, const ResultRow& row) {
  const auto text = [&](const char* name) { return reader.Text(row, name); };
  const auto number = [&](const char* name) { return reader.Number(row, name); };
  const auto count = [&](const char* name, int usual) {
    const double value = number(name);
    return std::isfinite(value) ? static_cast<int>(value) : usual;
  };
  ScaleMember member;
  member.id = text("id");
  member.measured = {number("Isc_A"), number("Voc_V"), number("Imp_A"), number("Vmp_V"),
                     number(kSlopeColumn)};
  member.planned = {number("plan_Isc_A"), number("plan_Voc_V"), number("plan_Imp_A"),
                    number("plan_Vmp_V"), number("plan_slope_ohm")};
  member.irradiance_W_m2 = number("irradiance_Wm2");
  member.temperature_C = number("temperature_C");
  const double planned_cells = number("plan_cells_in_series");
  member.cells = std::isfinite(planned_cells) ? planned_cells : number("cells_in_series");
  member.modules = count("plan_modules_in_series", 0);
  member.strings = count("plan_strings_in_parallel", 0);
  member.bypass_diodes = count("plan_bypass_diodes", 3);
  member.module = text("plan_module");
  // Fewer cells in series, a resistance and what a fill factor lacks may be faults of the scale, of
  // which the plan says more than one curve.
  const std::string cause = text("cause");
  const bool own = cause != "bypass_short" && !MayBeOfScale(cause);
  if (text("cause_about") == "device" && own) member.own_cause = cause;
  return member;
}

}  // namespace

// All of a combiner together, other rows one by one.
std::vector<std::vector<ScaleMember>> ScaleAddition::MembersOf(const RowGroup& group) const {
  std::vector<std::vector<ScaleMember>> members;
  for (const ResultRow& row : group.rows) {
    if (members.empty() || !group.together) members.emplace_back();
    members.back().push_back(MemberOf(*reader_, row));
  }
  return members;
}

Expected<void> ScaleAddition::Open(const RowsInput& input) {
  reader_ = RowReader(input.columns);
  if (!reader_->Has(kSlopeColumn)) reader_.reset();
  level_ = input.head.at("options").value("group-level", 0.0);
  scatter_ = {};
  rows_ = 0;
  causes_.clear();
  return {};
}

std::vector<ResultColumn> ScaleAddition::Columns() const {
  return reader_ ? ScaleColumns() : std::vector<ResultColumn>();
}

void ScaleAddition::Learn(const RowGroup& group) {
  if (!reader_ || !group.together) return;
  for (const auto& members : MembersOf(group)) scatter_.Add(ScaleResiduals(members));
}

Expected<void> ScaleAddition::Add(RowGroup* group) {
  rows_ += static_cast<std::int64_t>(group->rows.size());
  if (!reader_) return {};
  const std::vector<ResultColumn> columns = ScaleColumns();
  const std::size_t cause_place = ColumnPlace(columns, "plan_cause");
  std::size_t i = 0;
  for (const auto& members : MembersOf(*group)) {
    const auto residuals = ScaleResiduals(members);
    for (auto& cells : ScaleCells(members, residuals, scatter_.ErrorsOf(residuals), level_)) {
      if (const auto* const cause = std::get_if<std::string>(&cells[cause_place])) {
        ++causes_[*cause];
      }
      Append(std::move(cells), &group->rows[i++].cells);
    }
  }
  return {};
}

AddedReport ScaleAddition::Report() const {
  if (results_ != nullptr) results_->plan_causes = causes_;
  AddedReport report;
  report.causes = {CountsSection("Against the plan", "cause", causes_, rows_)};
  return report;
}

}  // namespace lyrefit
