#include "lyrefit/translate/field_inputs.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>

namespace lyrefit {
namespace {

constexpr double kFactor = 2;  // coverage factor of all sizes in the options
constexpr double kStandard_W_m2 = 1000;

constexpr LightClass kLightClasses[] = {
    {LightSource::kNotStated, "stated with the curve, sensor not named", "nobody stated by what",
     "irradiance, sensor not stated", 5,
     "nobody said what it was read from: as of a pyranometer, 5 %"},
    {LightSource::kReferenceCell, "reference cell", "by a reference cell",
     "irradiance, by a reference cell", 3, "reference cell that just meets IEC 61829:2015, 3 %"},
    {LightSource::kPyranometer, "pyranometer", "by a pyranometer", "irradiance, by a pyranometer",
     5, "pyranometer that just meets IEC 61829:2015, 5 %"},
    {LightSource::kLaboratory, "reference of a laboratory", "of a laboratory's simulator",
     "irradiance, in a laboratory", 1.2, "calibrated reference in a laboratory, 1.2 %"},
    {LightSource::kCurve, "the curve's own Isc",
     "from the curve's own Isc, which cannot see what dims all cells alike, such as dirt",
     "irradiance, from the curve's own Isc", 3,
     "usual tolerance of the rated Isc, 3 %; without soiling"},
};

// Source of a size: stated, or that of its class.
std::string Why(bool stated, const std::string& otherwise) {
  return stated ? std::string("stated") : otherwise;
}

const TranslationInput& QuantityOf(const std::string& name) {
  const auto* const found =
      std::find_if(std::begin(kTranslationInputs), std::end(kTranslationInputs),
                   [&](const TranslationInput& each) { return name == each.name; });
  CHECK(found != std::end(kTranslationInputs)) << "no input of a translation is called " << name;
  return *found;
}

class Collector {
 public:
  explicit Collector(const TranslationInputs& at) : at_(at) {}

  // `expanded` is in the unit of the quantity. `name` and `part` are set for a component of a
  // quantity.
  void Add(const char* quantity, const std::string& title, const char* group, double expanded,
           std::string source, const char* name = nullptr, double part = 0) {
    if (!(expanded > 0)) return;
    const TranslationInput& of = QuantityOf(quantity);
    UncertainInput input;
    input.name = name != nullptr ? name : quantity;
    input.title = title.empty() ? of.title : title;
    input.group = group;
    input.unit = of.unit;
    input.quantity = quantity;
    input.value = name != nullptr ? part : at_.*of.field;
    input.standard_uncertainty = expanded / kFactor;
    input.source = std::move(source);
    inputs.push_back(std::move(input));
  }

  // Adds an uncertainty in percent of the value.
  void AddPart(const char* quantity, const char* group, double percent, std::string source) {
    const double value = at_.*QuantityOf(quantity).field;
    Add(quantity, "", group, std::fabs(value) * percent / 100, std::move(source));
  }

  std::vector<UncertainInput> inputs;

 private:
  const TranslationInputs& at_;
};

void AddConditions(const TranslationInputs& at, const UncertaintyOptions& options, Collector* to) {
  const LightClass& light = LightClassOf(options.light_source);
  to->Add("irradiance_W_m2", light.title, "light",
          at.irradiance_W_m2 * IrradianceSize_percent(options) / 100,
          Why(options.irradiance_percent.has_value(), light.why));
  to->AddPart("rear_irradiance_W_m2", "light", options.rear_percent, "by judgement");
  if (at.rear_irradiance_W_m2 != 0) {
    to->AddPart("bifaciality_isc", "light", options.bifaciality_percent,
                "spread of data sheets, IEC TS 60904-1-2");
  }
  to->Add("temperature_C", "temperature, sensor", "temperature", TemperatureSize_K(options),
          Why(options.temperature_K.has_value(),
              options.temperature_source == TemperatureSource::kVoc
                  ? "IEC 60904-5 with the rated Voc within 1 %"
              : options.temperature_source == TemperatureSource::kLaboratory
                  ? "laboratory, in equilibrium"
                  : "sensor that just meets IEC 61829:2015, 1 K"));
  to->Add("temperature_C", "temperature, cells above the sensor", "temperature",
          CellOffsetSize_K(options, at.irradiance_W_m2),
          Why(options.cell_offset_K.has_value(),
              options.temperature_source == TemperatureSource::kBackOfModule
                  ? "corrected for, by mounting 0 to 3 K at 1000 W/m2 (SAND2004-3535)"
                  : "2 to 3 K at 1000 W/m2 where the sensor is on the back, not corrected for"),
          "cell_offset_K", CellCorrection_K(options, at.irradiance_W_m2));
}

void AddInstrument(const UncertaintyOptions& options, Collector* to) {
  const bool field = options.instrument == InstrumentClass::kField;
  const double usual = field ? 1 : 0.2;
  const std::string why =
      field ? "instrument that just meets IEC 61829:2015, 1 %" : "laboratory instrument, 0.2 %";
  to->Add("voltage_gain", "", "electrical", options.voltage_percent.value_or(usual) / 100,
          Why(options.voltage_percent.has_value(), why));
  to->Add("current_gain", "", "electrical", options.current_percent.value_or(usual) / 100,
          Why(options.current_percent.has_value(), why));
  to->AddPart("lead_resistance_ohm", "electrical", options.lead_percent, "of what is stated");
}

// Adds the stated uncertainty, else the scatter of the technology, else `usual_percent`.
void AddTempco(const char* quantity, std::optional<double> stated_percent,
               std::optional<double> scatter, double usual_percent, Collector* to) {
  const double assumed = scatter ? kFactor * 100 * *scatter : usual_percent;
  to->AddPart(quantity, "coefficients", stated_percent.value_or(assumed),
              stated_percent ? "stated"
              : scatter      ? "assumed of the technology, whose modules scatter by as much"
                             : "data sheets beside measurements, by judgement");
}

void AddCoefficients(const SettledInputs& settled, const UncertaintyOptions& options,
                     Collector* to) {
  AddTempco("alpha_sc_A_K", options.alpha_percent, settled.alpha_scatter, 20, to);
  AddTempco("beta_oc_V_K", options.beta_percent, settled.beta_scatter, 5, to);
  to->AddPart("kappa_ohm_K", "coefficients", options.kappa_percent, "by judgement");
  to->AddPart("resistance_series_ohm", "coefficients", options.series_resistance_percent,
              "by judgement");
  to->AddPart("b1", "coefficients", options.light_of_voc_percent, "by judgement");
  to->AddPart("b2", "coefficients", options.light_of_voc_percent, "by judgement");
  to->AddPart("epsilon_V", "coefficients", options.epsilon_percent,
              "what measured beta and Voc of crystalline silicon modules make of it");
  to->AddPart("EgRef_eV", "coefficients", options.bandgap_percent, "by judgement");
  to->AddPart("dEgdT_1_K", "coefficients", options.bandgap_slope_percent, "by judgement");
  to->Add("mu_gamma_1_K", "", "coefficients", options.ideality_slope_percent_per_K / 100,
          "by judgement");
}

}  // namespace

const LightClass& LightClassOf(LightSource source) {
  for (const LightClass& light : kLightClasses) {
    if (light.source == source) return light;
  }
  return kLightClasses[0];
}

double IrradianceSize_percent(const UncertaintyOptions& options) {
  return options.irradiance_percent.value_or(LightClassOf(options.light_source).percent);
}

double TemperatureSize_K(const UncertaintyOptions& options) {
  if (options.temperature_K) return *options.temperature_K;
  if (options.temperature_source == TemperatureSource::kVoc) return 2;
  return options.temperature_source == TemperatureSource::kLaboratory ? 0.5 : 1;
}

double CellCorrection_K(const UncertaintyOptions& options, double irradiance_W_m2) {
  constexpr double kOfBack_K = 2.5;
  const bool back = options.temperature_source == TemperatureSource::kBackOfModule;
  return options.cell_correction_K.value_or(back ? kOfBack_K : 0) * irradiance_W_m2 /
         kStandard_W_m2;
}

double CellOffsetSize_K(const UncertaintyOptions& options, double irradiance_W_m2) {
  constexpr double kCorrected_K = 1.5, kUnknown_K = 2.5;
  if (options.cell_offset_K) return *options.cell_offset_K;
  double at_standard_K = 0;
  if (options.cell_correction_K) {
    at_standard_K = *options.cell_correction_K == 0 ? 0 : kCorrected_K;
  } else if (options.temperature_source == TemperatureSource::kBackOfModule) {
    at_standard_K = kCorrected_K;
  } else if (options.temperature_source == TemperatureSource::kNotStated) {
    at_standard_K = kUnknown_K;
  }
  return at_standard_K * irradiance_W_m2 / kStandard_W_m2;
}

std::vector<UncertainInput> FieldInputs(const SettledInputs& settled,
                                        const UncertaintyOptions& options) {
  Collector collector(settled.values);
  AddConditions(settled.values, options, &collector);
  AddInstrument(options, &collector);
  AddCoefficients(settled, options, &collector);
  return std::move(collector.inputs);
}

InputFields FieldsOf(const std::vector<UncertainInput>& inputs) {
  InputFields fields;
  for (const UncertainInput& input : inputs) fields.push_back(QuantityOf(input.quantity).field);
  return fields;
}

TranslationInputs WithInputs(const TranslationInputs& at, const std::vector<UncertainInput>& inputs,
                             const InputFields& fields, const std::vector<double>& drawn) {
  TranslationInputs moved = at;
  for (std::size_t i = 0; i < fields.size(); ++i) moved.*fields[i] += drawn[i] - inputs[i].value;
  return moved;
}

}  // namespace lyrefit
