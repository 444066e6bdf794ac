#include "lyrefit/read/column.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

TEST(RecogniseColumnTest, KnowsEverySpelling) {
  const struct {
    const char* label;
    ColumnKind kind;
    double factor = 1;
    double offset = 0;
  } kCases[] = {
      {"V", ColumnKind::kVoltage},
      {"v", ColumnKind::kVoltage},
      {"U", ColumnKind::kVoltage},
      {"voltage", ColumnKind::kVoltage},
      {"VOLTAGE", ColumnKind::kVoltage},
      {"Volts", ColumnKind::kVoltage},
      {"voltage_V", ColumnKind::kVoltage},
      {"Voltage (V)", ColumnKind::kVoltage},
      {"Voltage, V", ColumnKind::kVoltage},
      {"Voltage/V", ColumnKind::kVoltage},
      {"  Voltage [ V ] ", ColumnKind::kVoltage},
      {"Voltage in V", ColumnKind::kVoltage},
      {"PV Voltage (V)", ColumnKind::kVoltage},
      {"V_meas", ColumnKind::kVoltage},
      {"Spannung (V)", ColumnKind::kVoltage},
      {"U [V]", ColumnKind::kVoltage},
      {"U [mV]", ColumnKind::kVoltage, 1e-3},
      {"voltage_mV", ColumnKind::kVoltage, 1e-3},
      {"mV", ColumnKind::kVoltage, 1e-3},
      {"V (kV)", ColumnKind::kVoltage, 1e3},
      {"Potential (V)", ColumnKind::kVoltage},
      {"WE(1).Potential (V)", ColumnKind::kVoltage},
      {"Ewe/V vs. SCE", ColumnKind::kVoltage},
      {"Vf [V vs. Ref.]", ColumnKind::kVoltage},
      {"Vmeas", ColumnKind::kVoltage},
      {"Vdc [V]", ColumnKind::kVoltage},
      {"V OPC [V]", ColumnKind::kVoltage},
      {"Tensione [mV]", ColumnKind::kVoltage, 1e-3},
      {"<I>/mA", ColumnKind::kCurrent, 1e-3},
      {"Im [A]", ColumnKind::kCurrent},
      {"Idc [A]", ColumnKind::kCurrent},
      {"WE(1).Current (A)", ColumnKind::kCurrent},
      {"Stromst\u00e4rke (mA)", ColumnKind::kCurrent, 1e-3},
      {"I", ColumnKind::kCurrent},
      {"i", ColumnKind::kCurrent},
      {"current", ColumnKind::kCurrent},
      {"Amps", ColumnKind::kCurrent},
      {"A", ColumnKind::kCurrent},
      {"current_A", ColumnKind::kCurrent},
      {"Module Current (A)", ColumnKind::kCurrent},
      {"I [mA]", ColumnKind::kCurrent, 1e-3},
      {"Current (mA)", ColumnKind::kCurrent, 1e-3},
      {"I/mA", ColumnKind::kCurrent, 1e-3},
      {"Current (\u00b5A)", ColumnKind::kCurrent, 1e-6},
      {"Current (\u03bcA)", ColumnKind::kCurrent, 1e-6},
      {"current_uA", ColumnKind::kCurrent, 1e-6},
      {"I (kA)", ColumnKind::kCurrent, 1e3},
      {"sigma", ColumnKind::kSigma},
      {"sigma_A", ColumnKind::kSigma},
      {"current_sigma", ColumnKind::kSigma},
      {"uncertainty (mA)", ColumnKind::kSigma, 1e-3},
      {"time", ColumnKind::kTime},
      {"time_s", ColumnKind::kTime},
      {"t", ColumnKind::kTime},
      {"Time (ms)", ColumnKind::kTime, 1e-3},
      {"T [s]", ColumnKind::kTime},
      {"sweep", ColumnKind::kSweep},
      {"Sweep number", ColumnKind::kSweep},
      {"curve", ColumnKind::kCurve},
      {"irradiance", ColumnKind::kIrradiance},
      {"irradiance_Wm2", ColumnKind::kIrradiance},
      {"irradiance_W_m2", ColumnKind::kIrradiance},
      {"G", ColumnKind::kIrradiance},
      {"POA (W/m\u00b2)", ColumnKind::kIrradiance},
      {"poa [W/m^2]", ColumnKind::kIrradiance},
      {"Irradiance (W m-2)", ColumnKind::kIrradiance},
      {"Irradiance (W m\u207b\u00b2)", ColumnKind::kIrradiance},
      {"Irradiance (kW/m2)", ColumnKind::kIrradiance, 1e3},
      {"irradiance (suns)", ColumnKind::kIrradiance, 1e3},
      {"temperature", ColumnKind::kTemperature},
      {"temperature_C", ColumnKind::kTemperature},
      {"T", ColumnKind::kTemperature},
      {"t (\u00b0C)", ColumnKind::kTemperature},
      {"cell_temperature_C", ColumnKind::kTemperature},
      {"T_cell (C)", ColumnKind::kTemperature},
      {"temperature_K", ColumnKind::kTemperature, 1, -273.15},
      {"Temperature (K)", ColumnKind::kTemperature, 1, -273.15},
  };
  for (const auto& c : kCases) {
    SCOPED_TRACE(c.label);
    const Column column = RecogniseColumn(c.label);
    EXPECT_EQ(column.kind, c.kind);
    EXPECT_EQ(column.factor, c.factor);
    EXPECT_EQ(column.offset, c.offset);
    EXPECT_EQ(column.refusal, "");
    EXPECT_EQ(column.label, c.label);
  }
}

TEST(RecogniseColumnTest, LeavesOtherColumnsAlone) {
  for (const char* label : {"", "Watts", "Ohms", "Power (W)", "P", "V_set", "voltage_offset", "Isc",
                            "I_sc", "Voc", "V_2x", "ambient temperature (C)", "illuminance_lux",
                            "timestamp", "date", "index", "x", "(", "%"}) {
    SCOPED_TRACE(label);
    EXPECT_EQ(RecogniseColumn(label).kind, ColumnKind::kUnrecognised);
  }
}

TEST(RecogniseColumnTest, RefusesUnitsItCannotConvert) {
  for (const char* label : {"Voltage (%)", "voltage_percent", "Current (%)", "I [counts]", "U (dB)",
                            "Temperature (F)", "Irradiance (lux)", "sigma (%)"}) {
    SCOPED_TRACE(label);
    const Column column = RecogniseColumn(label);
    EXPECT_NE(column.kind, ColumnKind::kUnrecognised);
    EXPECT_THAT(column.refusal, HasSubstr(label));
    EXPECT_THAT(column.refusal, HasSubstr("expected"));
  }
}

TEST(RecogniseColumnTest, CurrentDensityIsNotCurrent) {
  const struct {
    const char* label;
    double factor;
  } kCases[] = {
      {"J", 1e-3},  // the usual unit, mA/cm2, is assumed
      {"J (mA/cm2)", 1e-3},
      {"Current density (mA/cm\u00b2)", 1e-3},
      {"current_density", 1e-3},
      {"I (mA/cm2)", 1e-3},
      {"Current [A/m^2]", 1e-4},
      {"j_mA_cm2", 1e-3},
      {"J (mA cm-2)", 1e-3},
      {"J [A/cm2]", 1},
      {"J_2 [uA/cm2]", 1e-6},
  };
  for (const auto& c : kCases) {
    SCOPED_TRACE(c.label);
    const Column column = RecogniseColumn(c.label);
    EXPECT_EQ(column.kind, ColumnKind::kCurrentDensity);
    EXPECT_EQ(column.factor, c.factor);
    EXPECT_EQ(column.refusal, "");
  }
  EXPECT_THAT(RecogniseColumn("J (%)").refusal, HasSubstr("expected mA/cm2"));
}

TEST(RecogniseColumnTest, TheNumberOfAPixelStandsApart) {
  const struct {
    const char* label;
    ColumnKind kind;
    const char* number;
  } kCases[] = {
      {"V1", ColumnKind::kVoltage, "1"},
      {"I12", ColumnKind::kCurrent, "12"},
      {"Current1", ColumnKind::kCurrent, "1"},
      {"Current 2 (A)", ColumnKind::kCurrent, "2"},
      {"Ch2 Voltage [V]", ColumnKind::kVoltage, "2"},
      {"SMU-1 Current (1) (1)", ColumnKind::kCurrent, "1.1.1"},
      {"J_3 (mA/cm2)", ColumnKind::kCurrentDensity, "3"},
      {"T1 (C)", ColumnKind::kUnrecognised, ""},
      {"W/m2", ColumnKind::kUnrecognised, ""},
  };
  for (const auto& c : kCases) {
    SCOPED_TRACE(c.label);
    const Column column = RecogniseColumn(c.label);
    EXPECT_EQ(column.kind, c.kind);
    EXPECT_EQ(column.tag.device, c.number);
  }
}

TEST(RecogniseColumnTest, AScaleBesideTheUnitCounts) {
  const struct {
    const char* label;
    ColumnKind kind;
    double factor;
    const char* device;
  } kCases[] = {
      {"PV1 voltage (0.1V)", ColumnKind::kVoltage, 0.1, "1"},
      {"PV1 current [0.01 A]", ColumnKind::kCurrent, 0.01, "1"},
      {"Upv2 x0.1 V", ColumnKind::kVoltage, 0.1, "2"},
      {"Ipv2 (A, gain 100)", ColumnKind::kCurrent, 0.01, "2"},
      {"voltage_scale 0.1", ColumnKind::kVoltage, 0.1, ""},
      {"current (0,1 A)", ColumnKind::kCurrent, 0.1, ""},
      {"current (dA)", ColumnKind::kCurrent, 0.1, ""},
      {"Voltage (cV)", ColumnKind::kVoltage, 0.01, ""},
      {"Vpv1(V)", ColumnKind::kVoltage, 1, "1"},
      {"Ipv1(A)", ColumnKind::kCurrent, 1, "1"},
  };
  for (const auto& c : kCases) {
    SCOPED_TRACE(c.label);
    const Column column = RecogniseColumn(c.label);
    EXPECT_EQ(column.kind, c.kind);
    EXPECT_NEAR(column.factor, c.factor, 1e-15);
    EXPECT_FALSE(column.unit.empty());
    EXPECT_EQ(column.tag.device, c.device);
    EXPECT_EQ(column.label, c.label);
  }
  // Light, scan rates and other numbers are no scales.
  for (const char* label : {"Current 0.1 sun (A)", "Voltage (V) 0.1V/s", "Current 0.05 A"}) {
    EXPECT_TRUE(RecogniseColumn(label).factor == 1) << label;
  }
}

TEST(RecogniseColumnTest, DirectionAndLightStandApart) {
  const struct {
    const char* label;
    ColumnKind kind;
    const char* device;
    SweepDirection direction;
    SweepLight light;
    double factor;
  } kCases[] = {
      {"Voltage (V)_a_Forward_Dark", ColumnKind::kVoltage, "a", SweepDirection::kForward,
       SweepLight::kDark, 1},
      {"Current Density(mA/cm^2)_a_Reverse_Light", ColumnKind::kCurrentDensity, "a",
       SweepDirection::kReverse, SweepLight::kLight, 1e-3},
      {"b_rev [mA/cm2]", ColumnKind::kCurrentDensity, "b", SweepDirection::kReverse,
       SweepLight::kUnknown, 1e-3},
      {"Vdark", ColumnKind::kVoltage, "", SweepDirection::kUnknown, SweepLight::kDark, 1},
      {"Jlight", ColumnKind::kCurrentDensity, "", SweepDirection::kUnknown, SweepLight::kLight,
       1e-3},
      {"I_up (mA)", ColumnKind::kCurrent, "", SweepDirection::kForward, SweepLight::kUnknown, 1e-3},
      {"SunsVoc_Voltage_(V)", ColumnKind::kVoltage, "", SweepDirection::kUnknown,
       SweepLight::kSunsVoc, 1},
      {"Suns-Voc Current (mA)", ColumnKind::kCurrent, "", SweepDirection::kUnknown,
       SweepLight::kSunsVoc, 1e-3},
      {"Pseudo current (A)", ColumnKind::kCurrent, "", SweepDirection::kUnknown,
       SweepLight::kSunsVoc, 1},
      {"SunsVoc_Suns_(suns)", ColumnKind::kCurrent, "", SweepDirection::kUnknown,
       SweepLight::kSunsVoc, 1},
      {"SunsVoc Intensity (W/m2)", ColumnKind::kCurrent, "", SweepDirection::kUnknown,
       SweepLight::kSunsVoc, 1e-3},
  };
  for (const auto& c : kCases) {
    SCOPED_TRACE(c.label);
    const Column column = RecogniseColumn(c.label);
    EXPECT_EQ(column.kind, c.kind);
    EXPECT_EQ(column.tag.device, c.device);
    EXPECT_EQ(column.tag.direction, c.direction);
    EXPECT_EQ(column.tag.light, c.light);
    EXPECT_EQ(column.factor, c.factor);
  }
  EXPECT_TRUE(RecogniseColumn("Average current density (mA/cm2)").tag.average);
  for (const char* other : {"Light intensity", "Forward", "dark", "for (V)", "Reverse time"}) {
    const ColumnKind kind = RecogniseColumn(other).kind;
    EXPECT_TRUE(kind != ColumnKind::kCurrent && kind != ColumnKind::kCurrentDensity) << other;
  }
}

TEST(ReadTagTest, WhatIsNoDirectionAndNoLightIsTheDevice) {
  const ColumnTag tag = ReadTag("958.1a_substr1_pix1_forward.txt");
  EXPECT_EQ(tag.device, "958 1a substr1 pix1");
  EXPECT_EQ(tag.direction, SweepDirection::kForward);
  EXPECT_EQ(ReadTag("QI_C_revD").light, SweepLight::kDark);
  EXPECT_EQ(ReadTag("QI_C_revD").device, "QI C");
  EXPECT_EQ(ReadTag("Pixel 1").device, "Pixel 1");
}

TEST(ColumnSaidToBeTest, TheNameDoesNotMatterTheUnitDoes) {
  EXPECT_EQ(ColumnSaidToBe(ColumnKind::kVoltage, "Bias").kind, ColumnKind::kVoltage);
  EXPECT_EQ(ColumnSaidToBe(ColumnKind::kVoltage, "Bias [mV]").factor, 1e-3);
  EXPECT_EQ(ColumnSaidToBe(ColumnKind::kCurrent, "smu_a_mA").factor, 1e-3);
  const Column density = ColumnSaidToBe(ColumnKind::kCurrent, "pixel (mA/cm2)");
  EXPECT_EQ(density.kind, ColumnKind::kCurrentDensity);
  EXPECT_EQ(density.factor, 1e-3);
  EXPECT_EQ(ColumnSaidToBe(ColumnKind::kCurrent, "A").factor, 1);
}

}  // namespace
}  // namespace lyrefit
