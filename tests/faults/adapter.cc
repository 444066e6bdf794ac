#include "faults/adapter.h"

#include <chrono>
#include <cmath>
#include <map>

#include "lyrefit/curve/curve_set.h"
#include "lyrefit/diagnose/diagnose.h"
#include "lyrefit/diagnose/priors.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/read/read_curve_set.h"

namespace faults {
namespace {

lyrefit::IvCurve Bare(const Measurement& from, std::size_t first, int number) {
  lyrefit::IvCurve curve;
  curve.name = "case " + std::to_string(number) + " curve " + std::to_string(from.curve[first]);
  curve.as_is = true;  // turns the input checks off, so that the diagnosis has to detect the fault
  curve.conditions.cells_in_series = from.cells;
  curve.conditions.irradiance_W_m2 = from.irradiance[first];
  curve.conditions.cell_temperature_K = from.temperature[first] + 273.15;
  curve.notes.technology = from.thin_film ? "thin film" : "crystalline silicon";
  if (from.bypass_diodes > 0) curve.notes.bypass_diodes = from.bypass_diodes;
  if (from.bandgap_eV > 0) curve.notes.bandgap_eV = from.bandgap_eV;
  curve.notes.bandgap_slope_per_K = 0;  // the cells of the generator have a constant band gap
  if (from.isc_tempco_per_K > 0) curve.notes.isc_tempco_per_K = from.isc_tempco_per_K;
  if (from.noise_constant_A > 0) {
    curve.notes.current_noise_constant_A = from.noise_constant_A;
    curve.notes.current_noise_relative = from.noise_relative;
  }
  return curve;
}

lyrefit::CurveSet ToSet(const Measurement& from, int number) {
  lyrefit::CurveSet set;
  set.name = "case " + std::to_string(number);
  for (std::size_t i = 0; i < from.voltage.size(); ++i) {
    if (i == 0 || from.curve[i] != from.curve[i - 1]) {
      set.curves.push_back(Bare(from, i, number));
    }
    lyrefit::IvCurve& curve = set.curves.back();
    curve.voltage_V.push_back(from.voltage[i]);
    curve.current_A.push_back(from.current[i]);
    if (!from.time.empty()) curve.time_s.push_back(from.time[i]);
    if (!from.sweep.empty()) curve.sweep.push_back(from.sweep[i]);
  }
  return set;
}

}  // namespace

namespace {

lyrefit::DiagnoseOptions OptionsOf(double probability, Mode mode) {
  lyrefit::DiagnoseOptions options =
      mode == Mode::kLaboratory ? lyrefit::LaboratoryOptions() : lyrefit::DiagnoseOptions();
  if (probability > 0) options.probability = probability;
  options.held_out = false;
  options.threads = 1;
  return options;
}

Answer AnswerOf(const lyrefit::CurveSet& set, const lyrefit::DiagnoseOptions& options) {
  Answer answer;
  const auto start = std::chrono::steady_clock::now();
  const auto diagnosis = lyrefit::Diagnose(set, options);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  answer.seconds = took.count();
  if (!diagnosis) {
    answer.error = diagnosis.error().message;
    return answer;
  }
  for (const lyrefit::Cause& cause : diagnosis->verdict.causes) {
    Claim claim{cause.id, cause.equivalents, cause.probability, cause.evidence == "values", {}};
    for (const lyrefit::Alternative& other : lyrefit::SaidBeside(cause, options.probability)) {
      claim.beside.push_back(other.id);
    }
    for (const lyrefit::CauseParameter& parameter : cause.strength) {
      claim.strengths.push_back({parameter.symbol, parameter.unit, parameter.value,
                                 parameter.low_95, parameter.high_95, parameter.name});
    }
    answer.claims.push_back(claim);
  }
  const lyrefit::Sized& gain = diagnosis->verdict.recoverable_power_W;
  answer.recoverable = {gain.value, gain.low_95, gain.high_95};
  std::map<std::string, double> stated;
  for (const lyrefit::Trial& trial : diagnosis->trials) {
    if (!std::isfinite(trial.probability)) continue;
    stated[lyrefit::FindEffect(trial.effect)->Finding()] +=
        trial.probability * trial.probability_material;
  }
  stated["none"] = diagnosis->verdict.probability_none;
  for (const auto& [id, probability] : stated) answer.stated.push_back({id, probability});
  return answer;
}

}  // namespace

Answer Ask(const Measurement& measurement, int number, double probability, std::uint64_t seed,
           bool second_diode, Mode mode) {
  lyrefit::DiagnoseOptions options = OptionsOf(probability, mode);
  options.seed = seed;
  if (second_diode) options.base = lyrefit::Model::kDoubleDiode;
  return AnswerOf(ToSet(measurement, number), options);
}

Answer AskFile(const std::string& path, double probability) {
  const auto set = lyrefit::ReadMeasurement(path);
  if (set) return AnswerOf(*set, OptionsOf(probability, Mode::kField));
  Answer answer;
  answer.error = set.error().ToString();
  return answer;
}

std::string FindingOf(const std::string& id) {
  const lyrefit::Effect* effect = lyrefit::FindEffect(id);
  return effect != nullptr ? effect->Finding() : id;
}

double PriorOf(const std::string& id, bool module, Mode mode) {
  const lyrefit::Effect* effect = lyrefit::FindEffect(id);
  return lyrefit::CausePriors{{}, mode == Mode::kLaboratory, ""}.Of(
      effect != nullptr ? *effect : lyrefit::Effect(), module);
}

}  // namespace faults
