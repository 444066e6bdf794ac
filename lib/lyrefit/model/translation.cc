#include "lyrefit/model/translation.h"

#include "lyrefit/model/model_points.h"

namespace lyrefit {
namespace {

int Add(ParameterInfo info, Translation* translation) {
  translation->parameters.push_back(std::move(info));
  return translation->size() - 1;
}

void AddDiode(ParameterInfo saturation, ParameterInfo ideality, int* is, int* n, Translation* t) {
  saturation.kind = ParameterKind::kSaturation;
  ideality.kind = ParameterKind::kIdeality;
  *is = Add(std::move(saturation), t);
  *n = Add(std::move(ideality), t);
  t->parameters[*is].with[0] = *n;
}

void AddShunt(Translation* t) {
  if (t->spec.shunt != ShuntLaw::kExponential) return;
  t->resistance_shunt_dark =
      Add({"Rsh0", "R_sh_0", "ohm", "shunt resistance in the dark", ParameterKind::kDarkShunt}, t);
  t->shunt_exponent = Add({"Rexp", "R_sh_exp", "", "how fast the shunt follows irradiance"}, t);
  t->parameters[t->resistance_shunt_dark].with = {t->resistance_shunt, t->shunt_exponent};
}

}  // namespace

std::optional<int> Translation::Find(const std::string& symbol_or_name) const {
  return FindParameter(parameters, symbol_or_name);
}

Expected<Translation> MakeTranslation(const TranslationSpec& spec) {
  const bool pvsyst = spec.law == TranslationLaw::kPvsyst;
  if (spec.model == Model::kTripleDiode) {
    return Fail("a family is fitted with one or two diodes: expected sd or dd, found td");
  }
  if (spec.recombination && !pvsyst) {
    return Fail("the recombination loss belongs to the law pvsyst, not to " + ToText(spec.law));
  }
  if (spec.shunt == ShuntLaw::kExponential && !pvsyst) {
    return Fail("the exponential shunt belongs to the law pvsyst, not to " + ToText(spec.law));
  }
  Translation t;
  t.spec = spec;
  Conditions reference;
  reference.cell_temperature_K = kReferenceTemperature_K;
  reference.cells_in_series = spec.cells_in_series;
  t.device = MakeDevice(spec.model, reference, spec.constants);
  t.photocurrent = Add(
      {"Iph", "I_L_ref", "A", "photocurrent at the reference", ParameterKind::kPhotocurrent}, &t);
  AddDiode({"Is1", "I_o_ref", "A", "saturation current at the reference"},
           pvsyst ? ParameterInfo{"n1", "gamma_ref", "", "ideality at the reference, per cell"}
                  : ParameterInfo{"n1", "n", "", "ideality, per cell"},
           &t.saturation_current, &t.n, &t);
  t.resistance_series = Add({"Rs", "R_s", "ohm", "series resistance", ParameterKind::kSeries}, &t);
  t.resistance_shunt = Add(
      {"Rsh", "R_sh_ref", "ohm", "shunt resistance at the reference", ParameterKind::kShunt}, &t);
  t.alpha_sc = Add({"alpha", "alpha_sc", "A/K", "temperature coefficient of Isc",
                    ParameterKind::kPhotocurrent, 0.01},
                   &t);
  if (spec.law == TranslationLaw::kCec) {
    t.adjust = Add({"Adjust", "Adjust", "%",
                    "how far alpha_sc of the photocurrent is below that "
                    "of Isc",
                    ParameterKind::kPlain, 10},
                   &t);
  }
  t.bandgap = Add({"Eg", "EgRef", "eV", "band gap at the reference"}, &t);
  if (pvsyst) {
    t.n_slope = Add({"mu", "mu_gamma", "1/K", "temperature coefficient of the ideality",
                     ParameterKind::kPlain, 0.01},
                    &t);
  } else {
    t.bandgap_slope =
        Add({"dEg", "dEgdT", "1/K", "relative temperature coefficient of the band gap",
             ParameterKind::kPlain, 0.01},
            &t);
  }
  AddShunt(&t);
  if (spec.model == Model::kDoubleDiode) {
    AddDiode({"Is2", "I_o_ref_2", "A", "saturation current of diode 2 at the reference"},
             {"n2", "n_2", "", "ideality of diode 2, per cell"}, &t.saturation_current_2, &t.n_2,
             &t);
  }
  if (spec.recombination) {
    AddRecombination(&t.device);
    t.recombination = Add(t.device.parameters[t.device.size() - 2], &t);
    t.built_in_voltage = Add(t.device.parameters[t.device.size() - 1], &t);
  }
  return t;
}

TranslatedDevice TranslateTo(const Translation& translation, const std::vector<double>& shared,
                             double irradiance_W_m2, double temperature_K) {
  TranslatedDevice result;
  result.device = translation.device;
  result.parameters.resize(result.device.size());
  Translate(translation, shared.data(), irradiance_W_m2, temperature_K, result.parameters.data());
  const double ratio = temperature_K / kReferenceTemperature_K;
  result.device.module_thermal_voltage_V *= ratio;
  for (int diode = 0; diode < static_cast<int>(translation.spec.model); ++diode) {
    result.parameters[IdealityIndex(diode)] /= ratio;
  }
  return result;
}

TemperatureCoefficients CoefficientsAtReference(const Translation& translation,
                                                const std::vector<double>& shared,
                                                double half_step_K) {
  const auto at = [&](double difference_K) {
    const TranslatedDevice device = TranslateTo(translation, shared, kReferenceIrradiance_W_m2,
                                                kReferenceTemperature_K + difference_K);
    return ModelKeyPoints(device.device, device.parameters.data());
  };
  const KeyPoints cold = at(-half_step_K);
  const KeyPoints reference = at(0);
  const KeyPoints hot = at(half_step_K);
  const double step = 2 * half_step_K;
  return {(hot.short_circuit_current_A - cold.short_circuit_current_A) / step,
          (hot.open_circuit_voltage_V - cold.open_circuit_voltage_V) / step,
          100 * (hot.max_power_W - cold.max_power_W) / (step * reference.max_power_W)};
}

}  // namespace lyrefit
