#include "lyrefit/report/json_parts.h"

#include "lyrefit/certify/certificate_documents.h"
#include "lyrefit/model/device.h"
#include "lyrefit/report/csv.h"

namespace lyrefit {

void to_json(Json& j, const FloorDiode& diode) {
  j = {{"n", diode.n},
       {"saturation_current", diode.saturation_current_A},
       {"current_at_reference_A", diode.current_A}};
}

void to_json(Json& j, const DiodeRanges& diode) {
  j = {{"n", {diode.n_lower, diode.n_upper}}, {"Is", {diode.is_lower_A, diode.is_upper_A}}};
}

void to_json(Json& j, const Floor& floor) {
  LYREFIT_PUT_FIELDS(j, floor, rmse_A, lower_bound_A, gap, certified);
  j["photocurrent"] = floor.photocurrent_A;
  j["resistance_series"] = floor.resistance_series_ohm;
  j["conductance_shunt"] = floor.conductance_shunt_S;
  LYREFIT_PUT_FIELDS(j, floor, diodes, duality_gap, largest_correlation, dual_A,
                     junction_voltage_V);
  j["problems_solved"] = floor.solved;
}

void to_json(Json& j, const ModelCertificate& model) {
  LYREFIT_PUT_FIELDS(j, model, model, rmse_A, lower_bound_A, gap, above_floor, certified);
  j["problems_solved"] = model.solved;
  j["parameters"] = Json::object();
  const Device device = MakeDevice(model.model, {});
  for (int i = 0; i < device.size(); ++i) {
    Json& parameter = j["parameters"][ParameterKey(device.parameters[i])] = device.parameters[i];
    parameter["value"] = model.parameters[i];
  }
}

void to_json(Json& j, const Certificate& certificate) {
  const CertifyOptions& options = certificate.options;
  const IvCurve& curve = certificate.curve;
  j = {{"lyrefit_version", certificate.version},
       {"curve", curve},
       {"objective", options.objective},
       {"constants", options.constants},
       {"rigorous", options.rigorous},
       {"n_lower", options.n_lower},
       {"n_upper", options.n_upper},
       {"rs_lower_ohm", options.rs_lower_ohm},
       {"rs_upper_ohm", certificate.rs_upper_ohm},
       {"bounds", options.bounds},
       {"ranges",
        {{"Iph", {options.iph_lower_A, options.iph_upper_A}},
         {"Rs", {options.rs_lower_ohm, options.rs_upper_ohm}},
         {"Rsh", {options.rsh_lower_ohm, options.rsh_upper_ohm}},
         {"diodes", options.diodes}}},
       {"reference_voltage_V", certificate.reference_voltage_V},
       {"module_thermal_voltage_V", certificate.module_thermal_voltage_V},
       {"floor", certificate.floor},
       {"models", certificate.models},
       {"options", certificate.non_default_options},
       {"interrupted", certificate.interrupted},
       {"warnings", certificate.doubts},
       {"seconds", certificate.seconds},
       {"data", {{"voltage_V", curve.voltage_V}, {"current_A", curve.current_A}}}};
}

std::string CertificateJson(const Certificate& certificate) { return Dump(certificate); }

std::string CertificateCsv(const Certificate& certificate) {
  std::vector<ParameterInfo> infos;  // of the largest model
  for (const ModelCertificate& model : certificate.models) {
    const Device device = MakeDevice(model.model, certificate.curve.conditions);
    if (device.parameters.size() > infos.size()) infos = device.parameters;
  }
  std::string csv = "model,certified,rmse_A,lower_bound_A,gap,above_floor";
  for (const ParameterInfo& info : infos) {
    csv += "," + CsvField(info.symbol + (info.unit.empty() ? "" : "_" + info.unit));
  }
  csv += "\n";
  const Floor& floor = certificate.floor;
  csv += CsvLine({"floor", floor.certified ? "yes" : "no", CsvField(floor.rmse_A),
                  CsvField(floor.lower_bound_A), CsvField(floor.gap), "0"});
  csv.insert(csv.size() - 1, std::string(infos.size(), ','));
  for (const ModelCertificate& model : certificate.models) {
    std::vector<std::string> fields = {ToText(model.model),    model.certified ? "yes" : "no",
                                       CsvField(model.rmse_A), CsvField(model.lower_bound_A),
                                       CsvField(model.gap),    CsvField(model.above_floor)};
    for (std::size_t k = 0; k < infos.size(); ++k) {
      fields.push_back(k < model.parameters.size() ? CsvField(model.parameters[k]) : "");
    }
    csv += CsvLine(fields);
  }
  return csv;
}

}  // namespace lyrefit
