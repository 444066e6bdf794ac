#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/version.h"
#include "lyrefit/family/family_documents.h"
#include "lyrefit/family/family_parts.h"
#include "lyrefit/model/pvlib_parameters.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/json_parts.h"

namespace lyrefit {
namespace {

constexpr char kCells[] = "cells_in_series";

Json NamedJson(const std::vector<NamedValue>& values) {
  Json json = Json::object();
  for (const NamedValue& value : values) json[value.name] = value.value;
  if (const auto cells = json.find(kCells); cells != json.end()) {
    *cells = static_cast<int>(cells->get<double>());
  }
  return json;
}

// Sorts values by pvlib function: calcparams_* raises a TypeError for unknown keywords.
void AddKeywords(const Json& values, bool pvsyst, Json* json) {
  Json arguments = Json::object(), bishop88 = Json::object();
  for (const auto& [name, value] : values.items()) {
    if (name == kCells) (*json)[kCells] = value;
    if (name == "d2mutau" || name == "NsVbi") {
      bishop88[name] = value;
    } else if (name != kCells || pvsyst) {
      arguments[name] = value;
    }
  }
  (*json)["parameters"] = std::move(arguments);
  if (!bishop88.empty()) (*json)["bishop88"] = std::move(bishop88);
}

}  // namespace

// The row starts with the columns of SAM's own rows.
void to_json(Json& j, const CecModule& module) {
  j = {{"Name", module.name}, {"Technology", module.technology}};
  j.update(NamedJson(module.values));
}

std::string PvlibJson(const std::string& name, TranslationLaw law,
                      const std::vector<NamedValue>& keywords, const Expected<CecModule>& cec) {
  const bool pvsyst = law == TranslationLaw::kPvsyst;
  Json json = {
      {"lyrefit_version", Version()}, {"name", name}, {"function", "calcparams_" + ToText(law)}};
  AddKeywords(NamedJson(keywords), pvsyst, &json);
  json["cec"] = cec ? Json(*cec) : Json();
  json["cec_reason"] = cec ? std::string() : cec.error().message;
  return Dump(json);
}

namespace {

// Names, units and SAM's identifiers of the columns.
constexpr const char* kSamColumns[][3] = {{"Name", "Units", "[0]"},
                                          {"Manufacturer", "", "lib_manufacturer"},
                                          {"Technology", "", "cec_material"},
                                          {"Bifacial", "", "lib_is_bifacial"},
                                          {"STC", "", ""},
                                          {"PTC", "", ""},
                                          {"A_c", "m2", "cec_area"},
                                          {"Length", "m", "lib_length"},
                                          {"Width", "m", "lib_width"},
                                          {"N_s", "", "cec_n_s"},
                                          {"I_sc_ref", "A", "cec_i_sc_ref"},
                                          {"V_oc_ref", "V", "cec_v_oc_ref"},
                                          {"I_mp_ref", "A", "cec_i_mp_ref"},
                                          {"V_mp_ref", "V", "cec_v_mp_ref"},
                                          {"alpha_sc", "A/K", "cec_alpha_sc"},
                                          {"beta_oc", "V/K", "cec_beta_oc"},
                                          {"T_NOCT", "C", "cec_t_noct"},
                                          {"a_ref", "V", "cec_a_ref"},
                                          {"I_L_ref", "A", "cec_i_l_ref"},
                                          {"I_o_ref", "A", "cec_i_o_ref"},
                                          {"R_s", "Ohm", "cec_r_s"},
                                          {"R_sh_ref", "Ohm", "cec_r_sh_ref"},
                                          {"Adjust", "%", "cec_adjust"},
                                          {"gamma_r", "%/C", "cec_gamma_r"},
                                          {"BIPV", "", ""},
                                          {"Version", "", ""},
                                          {"Date", "", ""}};

}  // namespace

std::string CecLibraryCsv(const CecModule& module) {
  std::map<std::string, double> values;
  for (const NamedValue& one : module.values) values[one.name] = one.value;
  values["STC"] = values["I_mp_ref"] * values["V_mp_ref"];
  std::vector<std::string> names, units, identifiers, row;
  for (const auto& [name, unit, identifier] : kSamColumns) {
    names.emplace_back(name);
    units.emplace_back(unit);
    identifiers.emplace_back(identifier);
    const auto value = values.find(name);
    row.push_back(names.back() == "Name"         ? CsvField(module.name)
                  : names.back() == "Technology" ? CsvField(module.technology)
                  : value != values.end()        ? CsvField(value->second)
                                                 : std::string());
  }
  return CsvLine(names) + CsvLine(units) + CsvLine(identifiers) + CsvLine(row);
}

std::string IndividualFitsCsv(const FamilyReport& report) {
  const bool two = report.translation.spec.model == Model::kDoubleDiode;
  std::string csv =
      "Index,photocurrent,saturation_current,resistance_series,resistance_shunt,n,cells_in_series";
  if (two) csv += ",saturation_current_2,n_2";
  const std::vector<ParameterInfo> infos = FreeInfos(report);
  const int base = MakeDevice(report.translation.spec.model, {}).size();
  for (std::size_t k = base; k < infos.size(); ++k) csv += "," + infos[k].name;
  csv += "\n";
  for (const FamilyCurve& curve : report.curves) {
    const std::vector<double>& values =
        curve.individual_parameters.empty() ? curve.parameters : curve.individual_parameters;
    const auto field = [&values](int index) {
      const bool there = index < static_cast<int>(values.size());
      return "," + CsvField(there ? values[index] : kUnknown);
    };
    csv += CsvField(curve.id);
    for (const int index : {kIph, SaturationCurrentIndex(0), kRs, kRsh, IdealityIndex(0)}) {
      csv += field(index);
    }
    csv += "," + std::to_string(report.cells_in_series);
    if (two) csv += field(SaturationCurrentIndex(1)) + field(IdealityIndex(1));
    for (int k = base; k < static_cast<int>(infos.size()); ++k) csv += field(k);
    csv += "\n";
  }
  return csv;
}

}  // namespace lyrefit
