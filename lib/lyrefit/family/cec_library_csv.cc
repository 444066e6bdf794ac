#include <map>
#include <string>
#include <vector>

#include "lyrefit/family/family_documents.h"
#include "lyrefit/model/pvlib_parameters.h"
#include "lyrefit/report/csv.h"

namespace lyrefit {
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

}  // namespace lyrefit
