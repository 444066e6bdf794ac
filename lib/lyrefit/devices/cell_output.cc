#include <fmt/format.h>

#include "lyrefit/devices/cell_parts.h"
#include "lyrefit/devices/device_documents.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json_parts.h"

namespace lyrefit {

LYREFIT_JSON_FIELDS(StatedKeyPoint, name, stated, found, source)
LYREFIT_JSON_FIELDS(DirectionPair, forward, reverse, index_power, index_noise, index_area,
                    index_at_80, index_at_50, gap_percent, noise_percent, voc_difference_V,
                    isc_difference, ff_difference, sense, cross, causes)
LYREFIT_JSON_FIELDS(HysteresisOverRate, pairs, finding, causes)
LYREFIT_JSON_FIELDS(VocPoint, light_A, voc_V)
LYREFIT_JSON_FIELDS(LocalIdeality, low_A, high_A, n)
LYREFIT_JSON_FIELDS(IdealityOverLight, source, points, n, junction, shunt_S, noise_V, local,
                    rises_to_low_light)
LYREFIT_JSON_FIELDS(DarkIdeality, sweep, least_n, at_V, plateau_low_V, plateau_high_V, fitted)
LYREFIT_JSON_FIELDS(PseudoFillFactor, value, ideal, source)
LYREFIT_JSON_FIELDS(FillFactorPart, name, loss)
LYREFIT_JSON_FIELDS(FillFactorLosses, sweep, ideal, without_resistances, without_series, fitted,
                    measured, parts, green_n1, green_fitted, missing)
LYREFIT_JSON_FIELDS(Superposition, lit, dark, lit_rs_ohm, dark_rs_ohm, rs_from, not_with,
                    rms_percent, largest_percent, largest_at_V, to_V, noise_percent, voc_shift_V,
                    dark_scale, scaled_rms_percent, departs, causes, decides)

namespace {

// A resistance, and per area.
Json OhmJson(const CellReport& report, double ohm) {
  return {{"ohm", ohm}, {"ohm_cm2", report.PerArea(ohm)}};
}

Json DiodeFitJson(const FitReport& fit) {
  Json parameters = Json::object();
  const auto& estimates = fit.under_errors.empty() ? fit.estimates : fit.under_errors;
  for (const Estimate& e : estimates) parameters[e.info.name] = e;
  return {{"parameters", parameters},    {"nNsVth", fit.nNsVth},
          {"rmse", fit.rmse.refined},    {"covariance", fit.covariance.values},
          {"t_95", fit.covariance.t_95}, {"under_errors", !fit.under_errors.empty()},
          {"usable", fit.usable},        {"warnings", fit.warnings}};
}

Json SweepJson(const CellReport& report, const CellSweep& sweep) {
  Json j = {{"name", sweep.name},
            {"file", sweep.file},
            {"kind", sweep.kind},
            {"direction", sweep.direction},
            {"irradiance_Wm2", sweep.irradiance_W_m2},
            {"irradiance_known", sweep.irradiance_known},
            {"scan_rate_V_s", sweep.scan_rate_V_s},
            {"elapsed_h", sweep.elapsed_h},
            {"key_points", sweep.key},
            {"jsc_mA_cm2", sweep.jsc_mA_cm2},
            {"efficiency", sweep.efficiency},
            {"resistance_at_isc", OhmJson(report, sweep.resistance_at_isc_ohm)},
            {"resistance_at_voc", OhmJson(report, sweep.resistance_at_voc_ohm)},
            {"least_slope_ratio", sweep.least_slope_ratio},
            {"noise_A", sweep.noise_A},
            {"limited", sweep.limited},
            {"suns_voc_A", sweep.suns_voc_A},
            {"fit", nullptr},
            {"no_fit_because", sweep.no_fit_because},
            {"void_because", sweep.void_because},
            {"stated", sweep.stated},
            {"data", {{"voltage_V", sweep.voltage_V}, {"current_A", sweep.current_A}}}};
  if (sweep.fit) j["fit"] = DiodeFitJson(*sweep.fit);
  return j;
}

Json ResistanceJson(const CellReport& report, const SeriesResistance& one) {
  Json j = {{"method", one.Name()}};
  j.update(OhmJson(report, one.ohm.value));
  j.update({{"low_95_ohm", one.ohm.low_95},
            {"high_95_ohm", one.ohm.high_95},
            {"note", one.note},
            {"missing", one.missing}});
  return j;
}

// Keys are those of the parameters.
Json JointJson(const JointEstimate& joint) {
  Json parameters = Json::object(), measurements = Json::array();
  for (const Estimate& e : joint.estimates) parameters[e.info.name] = e;
  for (const JointMeasurement& one : joint.measurements) {
    Json without = Json::object();
    for (int i = 0; i < joint.shared; ++i) {
      const Estimate& e = joint.estimates[i];
      if (!e.fixed) without[e.info.name] = one.without[i];
    }
    measurements.push_back({{"sweep", one.sweep},
                            {"readings", one.readings},
                            {"rms", one.rms},
                            {"own_rms", one.own_rms},
                            {"noise", one.noise},
                            {"standard_error_without", without}});
  }
  return {{"parameters", parameters},
          {"correlations", joint.correlations},
          {"measurements", measurements},
          {"second_diode", joint.second_diode},
          {"second_diode_p", joint.second_diode_p},
          {"warmer", joint.warmer},
          {"warmer_p", joint.warmer_p},
          {"either", joint.either},
          {"voc_per_K", joint.voc_per_K},
          {"contacts", joint.contacts},
          {"contacts_p", joint.contacts_p},
          {"contact_loss_W", joint.contact_loss_W},
          {"series_loss", joint.series_loss},
          {"shunt", joint.shunt},
          {"converged", joint.refine.termination == "converged"},
          {"void_because", joint.void_because},
          {"missing", joint.missing}};
}

}  // namespace

void to_json(Json& j, const CellReport& report) {
  Json sweeps = Json::array(), resistances = Json::array();
  for (const CellSweep& sweep : report.sweeps) sweeps.push_back(SweepJson(report, sweep));
  for (const SeriesResistance& one : report.series_resistance) {
    resistances.push_back(ResistanceJson(report, one));
  }
  j = {{"lyrefit_version", report.version},
       {"name", report.name},
       {"source", report.source},
       {"area_cm2", report.area_cm2},
       {"per_area", report.per_area},
       {"cells_in_series", report.cells_in_series},
       {"temperature_C", RoundCelsius(report.temperature_C)},
       {"sweeps", sweeps},
       {"main", report.main},
       {"hysteresis", report.pairs},
       {"hysteresis_over_rate", report.over_rate},
       {"ideality_over_light", report.over_light},
       {"ideality_dark", report.dark},
       {"resistance_series", resistances},
       {"pseudo_fill_factor", report.pseudo},
       {"fill_factor_losses", report.losses},
       {"superposition", report.superposition},
       {"joint", report.joint ? JointJson(*report.joint) : Json()},
       {"assumptions", SentencesOf(report.assumptions)},
       {"options", report.non_default_options},
       {"interrupted", report.interrupted},
       {"warnings", report.warnings}};
}

std::string CellJson(const CellReport& report) { return Dump(report); }

namespace {

// Value of a parameter of the sweep's fit; NaN where it is void.
double DiodeValue(const CellSweep& sweep, const std::string& symbol) {
  if (!sweep.diode()) return kUnknown;
  for (const Estimate& e : sweep.fit->estimates) {
    if (e.info.symbol == symbol) return e.refined;
  }
  return kUnknown;
}

std::string SweepLine(const CellReport& report, const CellSweep& sweep) {
  std::vector<std::string> fields = {
      CsvField(report.name),          CsvField(sweep.file),
      CsvField(sweep.name),           ToText(sweep.kind),
      ToText(sweep.direction),        CsvField(sweep.irradiance_W_m2),
      CsvField(report.temperature_C), CsvField(report.area_cm2)};
  for (const CellField& field : CellFields()) {
    fields.push_back(CsvField(field.value(sweep)));
  }
  fields.push_back(CsvField(VoidReasons(sweep)));
  return CsvLine(fields);
}

}  // namespace

const std::vector<CellField>& CellFields() {
  using Sweep = CellSweep;
  static const std::vector<CellField> fields = {
      {"isc_A", "A", "short-circuit current",
       [](const Sweep& s) { return s.key.short_circuit_current_A; }},
      {"jsc_mA_cm2", "mA/cm2", "short-circuit current over the area",
       [](const Sweep& s) { return s.jsc_mA_cm2; }},
      {"voc_V", "V", "open-circuit voltage",
       [](const Sweep& s) { return s.key.open_circuit_voltage_V; }},
      {"vmp_V", "V", "voltage at maximum power",
       [](const Sweep& s) { return s.key.max_power_voltage_V; }},
      {"imp_A", "A", "current at maximum power",
       [](const Sweep& s) { return s.key.max_power_current_A; }},
      {"pmp_W", "W", "maximum power", [](const Sweep& s) { return s.key.max_power_W; }},
      {"fill_factor", "", "fill factor, a fraction",
       [](const Sweep& s) { return s.key.fill_factor; }},
      {"efficiency", "", "maximum power over irradiance times area, a fraction",
       [](const Sweep& s) { return s.efficiency; }},
      {"resistance_at_isc_ohm", "ohm", "-dV/dI at 0 V",
       [](const Sweep& s) { return s.resistance_at_isc_ohm; }},
      {"resistance_at_voc_ohm", "ohm", "-dV/dI at Voc",
       [](const Sweep& s) { return s.resistance_at_voc_ohm; }},
      {"n", "", "ideality of the single-diode fit; none where it is void",
       [](const Sweep& s) { return DiodeValue(s, "n1"); }},
      {"Rs_ohm", "ohm", "series resistance of that fit",
       [](const Sweep& s) { return DiodeValue(s, "Rs"); }},
      {"Rsh_ohm", "ohm", "shunt resistance of that fit",
       [](const Sweep& s) { return DiodeValue(s, "Rsh"); }},
  };
  return fields;
}

std::string VoidReasons(const CellSweep& sweep) {
  return fmt::format("{}", fmt::join(sweep.void_because, "; "));
}

std::string CellCsv(const CellReport& report) {
  std::string csv = "cell,file,sweep,kind,direction,irradiance_Wm2,temperature_C,area_cm2,";
  for (const CellField& field : CellFields()) csv += std::string(field.name) + ",";
  csv += "void\n";
  for (const CellSweep& sweep : report.sweeps) csv += SweepLine(report, sweep);
  return csv;
}

}  // namespace lyrefit
