#include "lyrefit/translate/field_inputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

SettledInputs Settled() {
  SettledInputs settled;
  settled.values.irradiance_W_m2 = 800;
  settled.values.temperature_C = 45;
  settled.values.voltage_gain = settled.values.current_gain = 1;
  settled.values.alpha_sc_A_K = 0.005;
  settled.values.beta_oc_V_K = -0.12;
  return settled;
}

const UncertainInput* Find(const std::vector<UncertainInput>& inputs, const std::string& name) {
  for (const UncertainInput& input : inputs) {
    if (input.name == name) return &input;
  }
  return nullptr;
}

double Size(const std::vector<UncertainInput>& inputs, const std::string& name) {
  const UncertainInput* input = Find(inputs, name);
  return input == nullptr ? 0 : input->standard_uncertainty;
}

TEST(FieldInputs, HalveTheExpandedSizesOfTheirClass) {
  UncertaintyOptions options;
  options.light_source = LightSource::kReferenceCell;
  const std::vector<UncertainInput> inputs = FieldInputs(Settled(), options);
  EXPECT_DOUBLE_EQ(Size(inputs, "irradiance_W_m2"), 800 * 0.03 / 2);
  EXPECT_DOUBLE_EQ(Size(inputs, "temperature_C"), 0.5);
  EXPECT_DOUBLE_EQ(Size(inputs, "cell_offset_K"), 2.5 * 0.8 / 2);
  EXPECT_DOUBLE_EQ(Size(inputs, "voltage_gain"), 0.005);
  EXPECT_DOUBLE_EQ(Size(inputs, "alpha_sc_A_K"), 0.005 * 0.2 / 2);
  EXPECT_DOUBLE_EQ(Size(inputs, "beta_oc_V_K"), 0.12 * 0.05 / 2);
  for (const UncertainInput& input : inputs) EXPECT_FALSE(input.source.empty()) << input.name;
  EXPECT_EQ(Find(inputs, "lead_resistance_ohm"), nullptr) << "there is none";
}

TEST(CellCorrection, IsThatOfASensorOnTheBackOrAsStated) {
  UncertaintyOptions options;
  EXPECT_EQ(CellCorrection_K(options, 800), 0) << "nobody said what it was read from";
  EXPECT_DOUBLE_EQ(CellOffsetSize_K(options, 800), 2);
  options.temperature_source = TemperatureSource::kBackOfModule;
  EXPECT_DOUBLE_EQ(CellCorrection_K(options, 1000), 2.5);
  EXPECT_DOUBLE_EQ(CellCorrection_K(options, 400), 1);
  EXPECT_DOUBLE_EQ(CellOffsetSize_K(options, 1000), 1.5);
  options.cell_correction_K = 1;
  EXPECT_DOUBLE_EQ(CellCorrection_K(options, 500), 0.5);
  EXPECT_DOUBLE_EQ(CellOffsetSize_K(options, 1000), 1.5);
  options.cell_correction_K = 0;
  EXPECT_EQ(CellCorrection_K(options, 1000), 0);
  EXPECT_EQ(CellOffsetSize_K(options, 1000), 0) << "a sensor of the cells";
  options.cell_offset_K = 0.7;
  EXPECT_DOUBLE_EQ(CellOffsetSize_K(options, 1000), 0.7);
  for (const TemperatureSource source : {TemperatureSource::kVoc, TemperatureSource::kLaboratory}) {
    UncertaintyOptions other;
    other.temperature_source = source;
    EXPECT_EQ(CellCorrection_K(other, 1000), 0);
    EXPECT_EQ(CellOffsetSize_K(other, 1000), 0);
  }
}

// The budget's line holds the correction as its value, and the uncertainty of the correction.
TEST(FieldInputs, KeepTheDoubtOfTheCorrection) {
  UncertaintyOptions options;
  options.temperature_source = TemperatureSource::kBackOfModule;
  const std::vector<UncertainInput> inputs = FieldInputs(Settled(), options);
  ASSERT_NE(Find(inputs, "cell_offset_K"), nullptr);
  EXPECT_DOUBLE_EQ(Find(inputs, "cell_offset_K")->value, 2);
  EXPECT_DOUBLE_EQ(Size(inputs, "cell_offset_K"), 1.5 * 0.8 / 2);
  EXPECT_THAT(Find(inputs, "cell_offset_K")->source, HasSubstr("corrected for"));
}

TEST(FieldInputs, StatedSizesGoFirst) {
  UncertaintyOptions options;
  options.light_source = LightSource::kPyranometer;
  options.irradiance_percent = 2;
  options.temperature_K = 0.4;
  options.cell_offset_K = 0;
  options.voltage_percent = 0.1;
  options.beta_percent = 1;
  const std::vector<UncertainInput> inputs = FieldInputs(Settled(), options);
  EXPECT_DOUBLE_EQ(Size(inputs, "irradiance_W_m2"), 8);
  EXPECT_EQ(Find(inputs, "irradiance_W_m2")->source, "stated");
  EXPECT_DOUBLE_EQ(Size(inputs, "temperature_C"), 0.2);
  EXPECT_EQ(Find(inputs, "cell_offset_K"), nullptr);
  EXPECT_DOUBLE_EQ(Size(inputs, "voltage_gain"), 0.0005);
  EXPECT_DOUBLE_EQ(Size(inputs, "beta_oc_V_K"), 0.0006);
}

TEST(FieldInputs, AssumedCoefficientsScatterAsTheirTechnology) {
  SettledInputs settled = Settled();
  settled.beta_scatter = 0.08;
  const std::vector<UncertainInput> inputs = FieldInputs(settled, {});
  EXPECT_DOUBLE_EQ(Size(inputs, "beta_oc_V_K"), 0.12 * 0.08);
  EXPECT_THAT(Find(inputs, "beta_oc_V_K")->source, HasSubstr("technology"));
}

TEST(FieldInputs, LaboratoriesAreSurer) {
  UncertaintyOptions field, laboratory;
  laboratory.light_source = LightSource::kLaboratory;
  laboratory.temperature_source = TemperatureSource::kLaboratory;
  laboratory.instrument = InstrumentClass::kLaboratory;
  const auto surer = FieldInputs(Settled(), laboratory), usual = FieldInputs(Settled(), field);
  for (const char* name : {"irradiance_W_m2", "temperature_C", "voltage_gain", "current_gain"}) {
    EXPECT_LT(Size(surer, name), Size(usual, name)) << name;
  }
  EXPECT_EQ(Find(surer, "cell_offset_K"), nullptr);
}

TEST(WithInputs, AddsEveryInputToItsQuantity) {
  const SettledInputs settled = Settled();
  const std::vector<UncertainInput> inputs = FieldInputs(settled, {});
  std::vector<double> drawn;
  for (const UncertainInput& input : inputs) drawn.push_back(input.value);
  const TranslationInputs same = WithInputs(settled.values, inputs, FieldsOf(inputs), drawn);
  for (const TranslationInput& each : kTranslationInputs) {
    EXPECT_EQ(same.*each.field, settled.values.*each.field) << each.name;
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (inputs[i].quantity == "temperature_C") drawn[i] += 1.5;
  }
  EXPECT_DOUBLE_EQ(WithInputs(settled.values, inputs, FieldsOf(inputs), drawn).temperature_C, 48)
      << "sensor and offset both";
}

}  // namespace
}  // namespace lyrefit
