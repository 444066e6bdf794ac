#include "plant/scale_rows.h"

#include <cmath>
#include <iterator>
#include <utility>

#include "lyrefit/base/append.h"
#include "lyrefit/batch/count_rows.h"

namespace lyrefit {

ScaleReader::ScaleReader(const std::vector<ResultColumn>& columns) {
  constexpr const char* kNames[] = {"id",
                                    "irradiance_Wm2",
                                    "temperature_C",
                                    "cells_in_series",
                                    "Isc_A",
                                    "Voc_V",
                                    "Imp_A",
                                    "Vmp_V",
                                    kSlopeColumn,
                                    "plan_module",
                                    "plan_modules_in_series",
                                    "plan_strings_in_parallel",
                                    "plan_bypass_diodes",
                                    "plan_cells_in_series",
                                    "plan_Isc_A",
                                    "plan_Voc_V",
                                    "plan_Imp_A",
                                    "plan_Vmp_V",
                                    "plan_slope_ohm",
                                    "cause",
                                    "cause_about"};
  static_assert(std::size(kNames) == kKnown);
  for (int known = 0; known < kKnown; ++known) {
    places_[known] = ColumnPlace(columns, kNames[known]);
  }
  reads_ = places_[kSlope] != kNoColumn;
}

ScaleMember ScaleReader::Read(const ResultRow& row) const {
  const auto cell = [&](Known known) {
    return places_[known] < row.cells.size() ? row.cells[places_[known]] : ResultCell();
  };
  const auto text = [&](Known known) {
    const ResultCell value = cell(known);
    const auto* const found = std::get_if<std::string>(&value);
    return found == nullptr ? std::string() : *found;
  };
  const auto number = [&](Known known) {
    const ResultCell value = cell(known);
    if (const auto* const found = std::get_if<double>(&value)) return *found;
    const auto* const whole = std::get_if<std::int64_t>(&value);
    return whole == nullptr ? kUnknown : static_cast<double>(*whole);
  };
  const auto count = [&](Known known, int usual) {
    const double value = number(known);
    return std::isfinite(value) ? static_cast<int>(value) : usual;
  };
  ScaleMember member;
  member.id = text(kId);
  member.measured = {number(kIsc), number(kVoc), number(kImp), number(kVmp), number(kSlope)};
  member.planned = {number(kPlanIsc), number(kPlanVoc), number(kPlanImp), number(kPlanVmp),
                    number(kPlanSlope)};
  member.irradiance_W_m2 = number(kLight);
  member.temperature_C = number(kTemperature);
  const double planned_cells = number(kPlanCells);
  member.cells = std::isfinite(planned_cells) ? planned_cells : number(kCells);
  member.modules = count(kModules, 0);
  member.strings = count(kStrings, 0);
  member.bypass_diodes = count(kDiodes, 3);
  member.module = text(kModule);
  // Fewer cells in series, a resistance and what a fill factor lacks may be faults of the scale, of
  // which the plan says more than one curve.
  const std::string cause = text(kCause);
  const bool own = cause != "bypass_short" && !MayBeOfScale(cause);
  if (text(kAbout) == "device" && own) member.own_cause = cause;
  return member;
}

// All of a combiner together, other rows one by one.
std::vector<std::vector<ScaleMember>> ScaleAddition::MembersOf(const RowGroup& group) const {
  std::vector<std::vector<ScaleMember>> members;
  for (const ResultRow& row : group.rows) {
    if (members.empty() || !group.together) members.emplace_back();
    members.back().push_back(reader_->Read(row));
  }
  return members;
}

Expected<void> ScaleAddition::Open(const RowsInput& input) {
  reader_ = ScaleReader(input.columns);
  if (!reader_->reads()) reader_.reset();
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
