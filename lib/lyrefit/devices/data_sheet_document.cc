#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/version.h"
#include "lyrefit/devices/data_sheet.h"
#include "lyrefit/devices/data_sheet_parts.h"
#include "lyrefit/devices/device_documents.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/json_parts.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

constexpr int kDataSheetDigits = 6;

std::string Rounding(const DataSheetFit& fit, const std::string& name) {
  for (const DataSheetRange& range : fit.ranges) {
    if (range.name == name) return Range(range.low, range.high);
  }
  return fit.ranges.empty() ? "" : "fixed";
}

Section SheetParameterSection(const DataSheetFit& fit) {
  block::Table table = {
      "llrl", {{"parameter", "name", "value", fit.ranges.empty() ? "" : "within the rounding"}}};
  for (int i = 0; i < fit.translation.size(); ++i) {
    const ParameterInfo& info = fit.translation.parameters[i];
    const double value = fit.shared[i];
    table.rows.push_back({LabelWithUnit(info), info.name,
                          std::isinf(value) ? "infinite" : Significant(value, kDataSheetDigits),
                          Rounding(fit, info.name)});
  }
  Section section = {"Parameters at 1000 W/m2 and 25 C"};
  AddTable(std::move(table), &section);
  if (fit.ranges.empty()) return section;
  AddSentence(
      "within the rounding: how far a parameter moves while the printed values move, together, "
      "within half a unit of their last digits",
      &section);
  return section;
}

Section CheckSection(const DataSheetFit& fit) {
  block::Table table = {"lrrrl", {{"", "printed", "given", "difference", "unit"}}};
  for (const DataSheetCheck& check : fit.checks) {
    const double percent = 100 * (check.given / check.asked - 1);
    table.rows.push_back({check.name, Significant(check.asked, kDataSheetDigits),
                          Significant(check.given, kDataSheetDigits),
                          std::isfinite(percent) ? fmt::format("{:+.4f} %", percent) : "-",
                          check.unit});
  }
  Section section = {"What the sheet prints and what the device gives"};
  AddTable(std::move(table), &section);
  AddSentence(fmt::format("Largest relative error of the five equations: {}",
                          Significant(fit.largest_relative_error, 2)),
              &section);
  return section;
}

std::string LastText(const DataSheetFamily& family) {
  return family.bound == FamilyBound::kSeriesResistance ? "Rs = 0" : "1/Rsh = 0";
}

std::string ApartText(const MemberSpread& spread) {
  return fmt::format("{} A ({} % of Isc, at {} V)", Significant(spread.difference_A, 3),
                     Significant(spread.difference_percent, 3), Significant(spread.at_V, 3));
}

Section FamilySection(const DataSheetFit& fit) {
  const DataSheetFamily& family = fit.family;
  Section section = {"All devices through the sheet's three points"};
  if (family.members.empty()) return {};
  AddSentence(fmt::format("Three points and a flat power at the third are four equations for five "
                          "parameters: one device for every n up to {}, where {}. beta_oc, by De "
                          "Soto's law, picks one.",
                          Significant(family.members.back().n, 5), LastText(family)),
              &section);
  AddTable(MemberTable(fit), &section);
  std::string apart =
      "apart: the largest distance of the curve from that of the picked one, in % of Isc. Any two "
      "curves, down to n = 0, are at most " +
      ApartText(family.spread) + " apart";
  if (family.rounding_spread) {
    apart += "; those whose n the rounding allows, " + ApartText(*family.rounding_spread);
  }
  AddSentence(apart, &section);
  return section;
}

}  // namespace

std::string ConditionsText(const MemberConditions& at) {
  std::string light = fmt::format("{:g} W/m2", at.irradiance_W_m2);
  const std::string warmth = fmt::format("{:g} C", at.temperature_C);
  if (at.temperature_C == kReferenceTemperature_C) return light;
  return at.irradiance_W_m2 == kReferenceIrradiance_W_m2 ? warmth : light + ", " + warmth;
}

block::Table MemberTable(const DataSheetFit& fit) {
  const DataSheetFamily& family = fit.family;
  std::vector<std::pair<DataSheetMember, std::string>> shown;
  const std::size_t count = family.members.size();
  for (std::size_t quarter = 1; quarter <= 4 && count > 0; ++quarter) {
    const std::size_t place = std::max<std::size_t>(1, quarter * count / 4) - 1;
    shown.push_back({family.members[place], quarter < 4 ? "" : "last"});
  }
  if (family.rounding_low) shown.push_back({*family.rounding_low, "rounding, low"});
  if (family.rounding_high) shown.push_back({*family.rounding_high, "rounding, high"});
  if (family.picked) shown.push_back({*family.picked, "picked"});
  std::stable_sort(shown.begin(), shown.end(),
                   [](const auto& a, const auto& b) { return a.first.n < b.first.n; });
  block::Table table = {
      "rrrrr", {{"", "", "", "", "beta_oc"}, {"n", "Rs (ohm)", "Rsh (ohm)", "Is (A)", "(V/K)"}}};
  for (const MemberConditions& at : family.conditions) {
    table.heads[0].push_back(&at == &family.conditions.front() ? "Pmax (W)" : "Pmax");
    table.heads[1].push_back(ConditionsText(at));
  }
  table.heads[0].insert(table.heads[0].end(), {"apart", ""});
  table.heads[1].insert(table.heads[1].end(), {"(%)", ""});
  table.alignment.resize(table.heads[0].size(), 'r');
  table.alignment.back() = 'l';
  const double isc_A = fit.checks.empty() ? kUnknown : fit.checks.front().given;
  for (const auto& [member, name] : shown) {
    const double rsh = member.resistance_shunt_ohm;
    block::Table::Row row = {Significant(member.n, 4), Significant(member.resistance_series_ohm, 4),
                             std::isinf(rsh) ? "infinite" : Significant(rsh, 4),
                             Scientific(member.saturation_current_A, 3),
                             Significant(member.beta_oc_V_K, 4)};
    for (const double power_W : member.max_power_W) row.push_back(Significant(power_W, 4));
    row.push_back(Significant(100 * member.difference_A / isc_A, 3));
    row.push_back(name);
    table.rows.push_back(std::move(row));
  }
  return table;
}

Document DataSheetDocument(const DataSheetFit& fit) {
  const TranslationSpec& spec = fit.translation.spec;
  Document document;
  document.head.heading =
      fmt::format("lyrefit {}: {} device by the law of De Soto behind a data sheet", Version(),
                  ModelTitle(spec.model));
  AddField("device",
           fmt::format("{} in series; constants {}", Plural(spec.cells_in_series, "cell"),
                       ToText(spec.constants)),
           &document.head);
  if (!fit.Solved() && !fit.usual) {
    AddField("answer", "none: no device of one junction a cell has these values", &document.head);
    AddSections({WarningSection(fit.warnings)}, &document);
    return document;
  }
  AddSections({SheetParameterSection(fit), CheckSection(fit), FamilySection(fit),
               WarningSection(fit.warnings)},
              &document);
  AddFigure(FigureBlock(fit), &document.head);
  return document;
}

std::string DataSheetText(const DataSheetFit& fit) { return DrawText(DataSheetDocument(fit)); }

namespace {

Json DataSheetParametersJson(const DataSheetFit& fit) {
  Json parameters = Json::object();
  for (int i = 0; i < fit.translation.size(); ++i) {
    const ParameterInfo& info = fit.translation.parameters[i];
    Json one = info;
    one.update({{"value", fit.shared[i]}, {"low", nullptr}, {"high", nullptr}});
    for (const DataSheetRange& range : fit.ranges) {
      if (range.name == info.name) one.update({{"low", range.low}, {"high", range.high}});
    }
    parameters[ParameterKey(info)] = std::move(one);
  }
  return parameters;
}

// A member of the family; an infinite shunt is null.
Json SheetMemberJson(const DataSheetMember& member) {
  return {{"n", member.n},
          {"I_L_ref", member.photocurrent_A},
          {"I_o_ref", member.saturation_current_A},
          {"R_s", member.resistance_series_ohm},
          {"R_sh_ref", member.resistance_shunt_ohm},
          {"beta_oc_V_K", member.beta_oc_V_K},
          {"gamma_pmp_percent_K", member.gamma_pmp_percent_K},
          {"max_power_W", member.max_power_W},
          {"difference_A", member.difference_A}};
}

Json SpreadJson(const MemberSpread& spread) {
  return {{"difference_A", spread.difference_A},
          {"difference_percent", spread.difference_percent},
          {"at_V", spread.at_V},
          {"lowest_power_W", spread.lowest_power_W},
          {"highest_power_W", spread.highest_power_W}};
}

template <class T, class F>
Json WhereKnown(const std::optional<T>& value, const F& write) {
  return value ? write(*value) : Json();
}

Json SheetFamilyJson(const DataSheetFamily& family) {
  const SharpKnee& knee = family.sharp_knee;
  Json conditions = Json::array(), members = Json::array();
  for (const MemberConditions& at : family.conditions) {
    conditions.push_back(
        {{"irradiance_Wm2", at.irradiance_W_m2}, {"temperature_C", at.temperature_C}});
  }
  for (const DataSheetMember& member : family.members) members.push_back(SheetMemberJson(member));
  return {{"bound", family.bound},
          {"sharp_knee",
           {{"I_L_ref", knee.photocurrent_A},
            {"R_s", knee.resistance_series_ohm},
            {"R_sh_ref", knee.resistance_shunt_ohm}}},
          {"conditions", std::move(conditions)},
          {"spread", SpreadJson(family.spread)},
          {"picked", WhereKnown(family.picked, SheetMemberJson)},
          {"rounding",
           {{"low", WhereKnown(family.rounding_low, SheetMemberJson)},
            {"high", WhereKnown(family.rounding_high, SheetMemberJson)},
            {"spread", WhereKnown(family.rounding_spread, SpreadJson)}}},
          {"members", std::move(members)}};
}

}  // namespace

void to_json(Json& j, const DataSheetFit& fit) {
  const TranslationSpec& spec = fit.translation.spec;
  j = {{"lyrefit_version", Version()}, {"law", spec.law},
       {"model", spec.model},          {"cells_in_series", spec.cells_in_series},
       {"constants", spec.constants},  {"parameters", DataSheetParametersJson(fit)},
       {"checks", Json::object()},     {"largest_relative_error", fit.largest_relative_error},
       {"warnings", fit.warnings},     {"family", SheetFamilyJson(fit.family)}};
  for (const DataSheetCheck& check : fit.checks) {
    j["checks"][check.name] = {
        {"unit", check.unit}, {"printed", check.asked}, {"given", check.given}};
  }
}

std::string DataSheetJson(const DataSheetFit& fit) { return Dump(fit); }

std::string DataSheetCsv(const DataSheetFit& fit) {
  std::string csv = "parameter,name,unit,value,low,high\n";
  for (std::size_t k = 0; k < fit.shared.size(); ++k) {
    const ParameterInfo& info = fit.translation.parameters[k];
    const auto range =
        std::find_if(fit.ranges.begin(), fit.ranges.end(),
                     [&info](const DataSheetRange& r) { return r.name == info.name; });
    const bool ranged = range != fit.ranges.end();
    csv += CsvLine({CsvField(info.symbol), CsvField(info.name), CsvField(info.unit),
                    CsvField(fit.shared[k]), CsvField(ranged ? range->low : kUnknown),
                    CsvField(ranged ? range->high : kUnknown)});
  }
  return csv;
}

}  // namespace lyrefit
