#include "lyrefit/translate/field_test.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/try.h"
#include "lyrefit/translate/field_inputs.h"

namespace lyrefit {
namespace {

constexpr double kExpanded = 2;  // coverage factor of all sizes in the options
constexpr double kStandardIrradiance_W_m2 = 1000;
constexpr double kStandardTemperature_C = 25;
// A bifacial module above snow reaches 1.3 times its rating, and a sensor error adds to it.
constexpr double kMostOfRating = 1.5;
// No fault that leaves a curve to be measured takes more than nine tenths.
constexpr double kLeastOfRating = 0.1;
constexpr int kManyModules = 3;
constexpr double kNearOne = 0.15;
constexpr double kDecided = 0.8;  // least probability of a verdict

Expected<void> CheckFieldTest(const UncertainOutput& standard, const FieldTestOptions& options) {
  TRY(ValidateOptions(options, kFieldTestOptionTable));
  if (!options.rated_W) return Fail("no rating to test against: state --rated-W");
  if (!(standard.value > 0) || !std::isfinite(standard.standard_uncertainty)) {
    return Fail("no Pmax at standard conditions with an uncertainty: nothing to test");
  }
  return {};
}

double Modules(const FieldTestOptions& options) {
  return static_cast<double>(std::max(options.modules, 1)) * options.strings;
}

// Fraction of the power behind the cables. Their loss I^2 R is a part of V I in proportion to the
// current.
double BehindCables(const FieldTestOptions& options, double irradiance_W_m2) {
  return 1 - options.cabling_percent / 100 * irradiance_W_m2 / kStandardIrradiance_W_m2;
}

// The rating plus a tolerance, for the whole string.
double WithTolerance(const FieldTestOptions& options, double tolerance) {
  const double module = options.tolerance.in_W ? *options.rated_W + tolerance
                                               : *options.rated_W * (1 + tolerance / 100);
  return Modules(options) * module * BehindCables(options, kStandardIrradiance_W_m2);
}

// Adds the uncertainty of the rating, and thus of the limit, to that of the power: the test is of
// their difference. The draws are widened in proportion.
UncertainOutput WithRating(UncertainOutput standard, double percent, double limit_W) {
  if (percent == 0) return standard;
  const double rating = percent / 100 / kExpanded * limit_W;
  const double before = standard.standard_uncertainty;
  const double after = std::hypot(before, rating);
  const double wider = before > 0 ? after / before : 0;
  standard.standard_uncertainty = after;
  standard.expanded_uncertainty =
      before > 0 ? standard.expanded_uncertainty * wider : kExpanded * after;
  if (before == 0) standard.samples.clear();
  for (double& sample : standard.samples) {
    sample = standard.value + (sample - standard.value) * wider;
  }
  standard.drawn.low = standard.value + (standard.drawn.low - standard.value) * wider;
  standard.drawn.high = standard.value + (standard.drawn.high - standard.value) * wider;
  return standard;
}

// Pmax corrected for gains, offsets and leads.
double TruePower(const KeyPoints& key, const TranslationInputs& in) {
  const double current = in.current_gain * key.max_power_current_A + in.current_offset_A;
  const double voltage = in.voltage_gain * key.max_power_voltage_V + in.voltage_offset_V +
                         in.lead_resistance_ohm * current;
  return voltage * current;
}

// The rating at the measured conditions by its temperature coefficient.
double Predicted(const FieldTestOptions& options, const TranslationInputs& in, double rated_W,
                 double coefficient_percent_K) {
  const double irradiance = EquivalentIrradiance(in);
  const double warmer = in.temperature_C - kStandardTemperature_C;
  return Modules(options) * rated_W * irradiance / kStandardIrradiance_W_m2 *
         (1 + coefficient_percent_K / 100 * warmer) * BehindCables(options, irradiance);
}

UncertainInput Promise(const char* name, const char* title, const char* unit, double value,
                       double percent, const char* source) {
  UncertainInput input;
  input.name = name;
  input.title = title;
  input.group = "rating";
  input.unit = unit;
  input.value = value;
  input.standard_uncertainty = std::fabs(value) * percent / 100 / kExpanded;
  input.source = source;
  return input;
}

// A stated prediction varies with irradiance and temperature as the rating does, in proportion.
UncertainModel PerformanceModel(const FieldMeasurement& measurement,
                                const FieldTestOptions& options,
                                const std::vector<UncertainInput>& inputs) {
  const double coefficient = options.power_coefficient_percent_K.value_or(0);
  const double at_inputs = Predicted(options, measurement.inputs, *options.rated_W, coefficient);
  const double scale = measurement.predicted_W ? *measurement.predicted_W / at_inputs : 1;
  UncertainModel model;
  model.outputs = {{"performance_factor", "performance factor", ""}};
  const std::size_t own = inputs.size() - 2;
  const InputFields fields = FieldsOf({inputs.begin(), inputs.begin() + own});
  model.evaluate = [&measurement, &options, inputs, scale, own,
                    fields](const std::vector<double>& drawn) {
    const TranslationInputs in = WithInputs(measurement.inputs, inputs, fields, drawn);
    return std::vector<double>{TruePower(measurement.measured, in) /
                               (scale * Predicted(options, in, drawn[own], drawn[own + 1]))};
  };
  return model;
}

// The uncertain inputs of irradiance, temperature and instrument only.
std::vector<UncertainInput> SensorInputs(const FieldMeasurement& measurement,
                                         const FieldTestOptions& options,
                                         const UncertaintyOptions& uncertainty) {
  SettledInputs settled;
  settled.values = measurement.inputs;
  std::vector<UncertainInput> inputs = FieldInputs(settled, uncertainty);
  inputs.erase(
      std::remove_if(inputs.begin(), inputs.end(),
                     [](const UncertainInput& each) { return each.group == "coefficients"; }),
      inputs.end());
  inputs.push_back(
      Promise("rated", "rated power", "W", *options.rated_W, options.rated_percent, "stated"));
  inputs.push_back(Promise("gamma", "gamma (Pmax)", "%/K",
                           options.power_coefficient_percent_K.value_or(0),
                           options.power_coefficient_percent, "data sheet, by judgement"));
  return inputs;
}

Expected<void> AddPerformance(const FieldMeasurement& measurement, const FieldTestOptions& options,
                              const UncertaintyOptions& uncertainty, const Observer& observer,
                              FieldTest* test) {
  test->measured_W = TruePower(measurement.measured, measurement.inputs);
  const double coefficient = options.power_coefficient_percent_K.value_or(0);
  test->predicted_W = measurement.predicted_W.value_or(
      Predicted(options, measurement.inputs, *options.rated_W, coefficient));
  test->predicted_by = measurement.predicted_W
                           ? measurement.predicted_by
                           : "the rating, in proportion to the light and by gamma";
  if (!measurement.predicted_W && !options.power_coefficient_percent_K) {
    test->predicted_by = "the rating, in proportion to the light";
    test->notes.push_back(
        fmt::format("no temperature coefficient of the power was stated (--gamma): the performance "
                    "factor at {:.1f} C holds the effect of the temperature as well",
                    measurement.inputs.temperature_C));
  }
  const std::vector<UncertainInput> inputs = SensorInputs(measurement, options, uncertainty);
  TRY(test->performance_budget,
      Propagate(PerformanceModel(measurement, options, inputs), {inputs}, uncertainty, observer));
  const UncertainOutput& factor = test->performance_budget.outputs[0];
  test->performance_factor = factor.value;
  test->performance_low = factor.low();
  test->performance_high = factor.high();
  return {};
}

// Why the power cannot be compared with the rating; empty: it can.
std::string WhyNotJudged(const FieldMeasurement& measurement, const FieldTestOptions& options,
                         const FieldTest& test) {
  if (!measurement.doubt.empty()) return measurement.doubt;
  constexpr char kReasons[] =
      "other units than were read (mA?), the rating of another device (of one module for a string: "
      "--modules), or more light than was stated";
  constexpr char kSmall[] =
      "other units than were read (A for mA?), the rating of a string or another device for one "
      "module, or less light than was stated";
  const auto no_device = [](double part) { return part > kMostOfRating || part < kLeastOfRating; };
  const auto reasons = [&](double part) { return part > 1 ? kReasons : kSmall; };
  if (no_device(test.performance_factor)) {
    return fmt::format("a performance factor of {:.4g} is of no device: {}",
                       test.performance_factor, reasons(test.performance_factor));
  }
  // The power of one of many modules, where two of three missing would be a fault.
  const bool many = options.modules >= kManyModules;
  if (many && std::fabs(test.performance_factor * options.modules - 1) < kNearOne) {
    return fmt::format("a performance factor of {:.4g} is about one of {} modules: {}",
                       test.performance_factor, options.modules, kSmall);
  }
  const double part = test.standard_W / test.rated_W;
  if (no_device(part)) {
    return fmt::format("{:.4g} times the rating at standard conditions is of no device: {}", part,
                       reasons(part));
  }
  return "";
}

std::string ZoneSentence(const FieldTest& test) {
  if (test.zone == Zone::kDoubtful) {
    return fmt::format(
        "doubtful: {:.1f} W at standard conditions cannot be held against the rating "
        "of {:.1f} W: {}",
        test.standard_W, test.rated_W, test.doubt);
  }
  const std::string least = fmt::format("{:.1f} W, the least that the rating of {:.1f} W allows",
                                        test.lowest_W, test.rated_W);
  const std::string have = fmt::format("{:.1f} W at standard conditions ({:.1f} .. {:.1f} W)",
                                       test.standard_W, test.standard_low_W, test.standard_high_W);
  const char* relation = IsPass(test.zone)   ? "reaches"
                         : IsFail(test.zone) ? "misses"
                                             : "may reach or miss";
  return fmt::format("{}: {} {} {}; the probability of conformity is {}", ToText(test.zone), have,
                     relation, least, ConformityText(test));
}

void AddNotes(const UncertaintyOptions& uncertainty, FieldTest* test) {
  if (test->zone != Zone::kDoubtful && test->standard_low_W > test->highest_W) {
    test->notes.push_back(fmt::format(
        "all of the interval lies above the rating with its upper tolerance, {:.1f} W: the light "
        "was brighter than its sensor said, or the rating is that of another module",
        test->highest_W));
  }
  if (uncertainty.light_source == LightSource::kCurve) {
    test->notes.push_back(
        "the light was taken from the curve itself: whatever dims all cells alike, like uniform "
        "soiling, cannot be seen in this power; a clean sensor beside the modules would show it");
  }
}

}  // namespace

std::string ConformityText(const FieldTest& test) {
  const double conforms = test.probability_conforms;
  if (!std::isfinite(conforms)) return "not judged";
  const double step = test.probability_step;
  if (conforms < step) return fmt::format("less than {:.2g} %", 100 * step);
  if (1 - conforms < step) return fmt::format("more than {:.4g} %", 100 * (1 - step));
  return fmt::format("{:.{}f} %", 100 * conforms, conforms < 0.1 || conforms > 0.9 ? 1 : 0);
}

Zone ZoneOf(double low, double high, double limit, double conforms) {
  if (conforms >= kDecided) return low >= limit ? Zone::kPass : Zone::kPassWithin;
  if (conforms > 1 - kDecided) return Zone::kUndecided;
  return high >= limit ? Zone::kFailWithin : Zone::kFail;
}

Expected<FieldTest> JudgeFieldTest(const UncertainOutput& standard,
                                   const FieldMeasurement& measurement,
                                   const FieldTestOptions& options,
                                   const UncertaintyOptions& uncertainty,
                                   const Observer& observer) {
  TRY(CheckFieldTest(standard, options));
  FieldTest test;
  test.tolerance = ToleranceText(options.tolerance) + (options.tolerance.in_W ? "" : " %");
  test.rated_W = WithTolerance(options, 0);
  test.lowest_W = WithTolerance(options, options.tolerance.low);
  test.highest_W = WithTolerance(options, options.tolerance.high);
  const UncertainOutput compared = WithRating(standard, options.rated_percent, test.lowest_W);
  test.standard_W = standard.value;
  test.standard_low_W = standard.low();
  test.standard_high_W = standard.high();
  test.probability_conforms = 1 - compared.ProbabilityBelow(test.lowest_W);
  test.zone = ZoneOf(compared.low(), compared.high(), test.lowest_W, test.probability_conforms);
  test.probability_wrong = std::min(test.probability_conforms, 1 - test.probability_conforms);
  if (!compared.samples.empty()) {
    test.probability_step = 1 / static_cast<double>(compared.samples.size());
  }
  TRY(AddPerformance(measurement, options, uncertainty, observer, &test));
  test.doubt = WhyNotJudged(measurement, options, test);
  if (!test.doubt.empty()) {
    test.zone = Zone::kDoubtful;
    test.probability_conforms = test.probability_wrong = kUnknown;
  }
  test.sentence = ZoneSentence(test);
  AddNotes(uncertainty, &test);
  return test;
}

}  // namespace lyrefit
