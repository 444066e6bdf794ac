#include "lyrefit/report/certificate_json.h"

#include "lyrefit/report/json_parts.h"

namespace lyrefit {
namespace {

Json FloorJson(const Floor& floor) {
  Json diodes = Json::array();
  for (const FloorDiode& diode : floor.diodes) {
    diodes.push_back({{"n", Number(diode.n)},
                      {"saturation_current", Number(diode.saturation_current_A)},
                      {"current_at_reference_A", Number(diode.current_A)}});
  }
  return {{"rmse_A", Number(floor.rmse_A)},
          {"lower_bound_A", Number(floor.lower_bound_A)},
          {"gap", Number(floor.gap)},
          {"certified", floor.certified},
          {"photocurrent", Number(floor.photocurrent_A)},
          {"resistance_series", Number(floor.resistance_series_ohm)},
          {"conductance_shunt", Number(floor.conductance_shunt_S)},
          {"diodes", diodes},
          {"duality_gap", Number(floor.duality_gap)},
          {"largest_correlation", Number(floor.largest_correlation)},
          {"dual_A", Numbers(floor.dual_A)},
          {"problems_solved", floor.solved}};
}

Json ModelJson(const ModelCertificate& model, const Certificate& certificate) {
  const Device device = MakeDevice(model.model, certificate.curve.conditions);
  Json parameters = Json::object();
  for (int i = 0; i < device.size(); ++i) {
    parameters[device.parameters[i].name] = Number(model.parameters[i]);
  }
  return {{"model", ToText(model.model)},
          {"rmse_A", Number(model.rmse_A)},
          {"lower_bound_A", Number(model.lower_bound_A)},
          {"gap", Number(model.gap)},
          {"above_floor", Number(model.above_floor)},
          {"certified", model.certified},
          {"problems_solved", model.solved},
          {"parameters", parameters}};
}

}  // namespace

std::string CertificateJson(const Certificate& certificate) {
  Json models = Json::array();
  for (const ModelCertificate& model : certificate.models) {
    models.push_back(ModelJson(model, certificate));
  }
  const Json json = {{"lyrefit_version", certificate.version},
                     {"curve", CurveJson(certificate.curve)},
                     {"objective", ToText(Objective::kMeasuredCurrent)},
                     {"constants", ToText(certificate.options.constants)},
                     {"n_lower", Number(certificate.options.n_lower)},
                     {"n_upper", Number(certificate.options.n_upper)},
                     {"rs_lower_ohm", Number(certificate.options.rs_lower_ohm)},
                     {"rs_upper_ohm", Number(certificate.rs_upper_ohm)},
                     {"reference_voltage_V", Number(certificate.reference_voltage_V)},
                     {"module_thermal_voltage_V", Number(certificate.module_thermal_voltage_V)},
                     {"floor", FloorJson(certificate.floor)},
                     {"models", models},
                     {"options", OptionsJson(certificate.non_default_options)},
                     {"interrupted", certificate.interrupted},
                     {"warnings", certificate.doubts},
                     {"seconds", Number(certificate.seconds)},
                     {"data",
                      {{"voltage_V", Numbers(certificate.curve.voltage_V)},
                       {"current_A", Numbers(certificate.curve.current_A)}}}};
  // Names and files may hold bytes that are not UTF-8.
  return JsonText(json);
}

}  // namespace lyrefit
