#include "lyrefit/diagnose/device_findings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnose/synthetic_data.h"
#include "diagnose/synthetic_diagnosis.h"
#include "lyrefit/model/kernel.h"
#include "repeats.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// A sweep of a module of 60 cells, with another leak (part of Isc at Voc), n or Rs (part of Voc at
// Isc) than a healthy one, where they are above 0.
struct Ill {
  double leak = 0.004;
  double n = 1.1;
  double drop = 0.07;
  double suns = 1;
  double last_V = 40;
};

IvCurve SweepOf(const Ill& ill) {
  constexpr double kVoc_V = 38, kIsc_A = 9;
  IvCurve curve;
  curve.name = "ill";
  curve.conditions.cells_in_series = 60;
  curve.conditions.irradiance_W_m2 = 1000 * ill.suns;
  curve.notes.bypass_diodes = 3;
  const Device device = MakeDevice(Model::kSingleDiode, curve.conditions);
  const double thermal_V = 60 * ThermalVoltage(curve.conditions.cell_temperature_K);
  const std::vector<double> p = {kIsc_A * ill.suns,
                                 kIsc_A * std::exp(-kVoc_V / (ill.n * thermal_V)), ill.n,
                                 ill.drop * kVoc_V / kIsc_A, kVoc_V / (ill.leak * kIsc_A)};
  for (int k = 0; k <= 100; ++k) curve.voltage_V.push_back(ill.last_V * k / 100);
  curve.current_A = SolveCurrents(device, p.data(), curve.voltage_V);
  RandomStream random(5);
  for (double& current : curve.current_A) current += 1e-3 * kIsc_A * ill.suns * random.Normal();
  return curve;
}

Diagnosis DiagnosisOf(const Ill& ill) { return DiagnoseOrFail(SweepOf(ill)); }

TEST(DeviceFindings, AreNoneOfAHealthyModule) {
  const Diagnosis d = DiagnosisOf({});
  EXPECT_THAT(d.device_findings, IsEmpty());
  EXPECT_THAT(d.verdict.sentence, HasSubstr("Nothing to act on"));
  EXPECT_THAT(d.verdict.sentence, HasSubstr("One sweep cannot show dirt or slight ageing"));
}

// The n of a cell whose directions differ is no ideality, although it is above that of junctions.
TEST(DeviceFindings, OfHystereticDevicesHaveNoIdeality) {
  SKIP_IF_SANITIZED();
  Ill ill;
  ill.n = 1.6;
  EXPECT_THAT(DiagnosisOf(ill).verdict.sentence, HasSubstr("n = 1.6"));
  IvCurve curve = SweepOf(ill);
  ill.n = 1.5;
  ill.drop = 0.12;
  const IvCurve down = SweepOf(ill);
  const std::size_t up = curve.size();
  curve.voltage_V.insert(curve.voltage_V.end(), down.voltage_V.rbegin(), down.voltage_V.rend());
  curve.current_A.insert(curve.current_A.end(), down.current_A.rbegin(), down.current_A.rend());
  for (std::size_t k = 0; k < curve.size(); ++k) curve.sweep.push_back(k < up ? 0 : 1);
  const Diagnosis d = DiagnoseOrFail(curve);
  ASSERT_FALSE(d.verdict.causes.empty());
  EXPECT_EQ(d.verdict.causes.front().effect, "hysteresis");
  for (const DeviceFinding& finding : d.device_findings) EXPECT_NE(finding.id, "ideality");
}

TEST(DeviceFindings, ALeakHasItsSizeItsPowerAndItsCauses) {
  Ill ill;
  ill.leak = 0.06;
  const Diagnosis d = DiagnosisOf(ill);
  ASSERT_EQ(d.device_findings.size(), 1U) << d.verdict.sentence;
  const DeviceFinding& leak = d.device_findings.front();
  EXPECT_EQ(leak.id, "leak");
  EXPECT_NEAR(leak.value.value, 0.06, 0.003);
  EXPECT_LT(leak.value.low_95, 0.06);
  EXPECT_GT(leak.value.high_95, 0.06);
  EXPECT_EQ(leak.healthy_limit, 0.016);
  EXPECT_NEAR(leak.power_loss, 0.04, 0.01);  // at Vmp, 0.8 of Voc, of Imp, 0.93 of Isc
  EXPECT_THAT(leak.sentence,
              HasSubstr("times what healthy modules do (at most 1.6 %), which takes "));
  EXPECT_THAT(leak.sentence, HasSubstr("potential-induced degradation"));
  EXPECT_THAT(d.verdict.sentence, HasSubstr("not as healthy ones are: a leak of 5.9 %"));
  EXPECT_THAT(d.verdict.sentence, Not(HasSubstr("Nothing to act on")));
  EXPECT_FALSE(d.verdict.found);
}

TEST(DeviceFindings, ALeakIsThatUnderStandardLight) {
  Ill ill;  // of a fifth of the current, five times as much, but the same shunt
  ill.suns = 0.2;
  ill.leak = 0.008;
  EXPECT_THAT(DiagnosisOf(ill).device_findings, IsEmpty());
}

TEST(DeviceFindings, AgedCellsAndContactsAreSaid) {
  Ill ill;
  ill.n = 1.6;
  const Diagnosis aged = DiagnosisOf(ill);
  ASSERT_EQ(aged.device_findings.size(), 1U) << aged.verdict.sentence;
  EXPECT_EQ(aged.device_findings.front().id, "ideality");
  EXPECT_NEAR(aged.device_findings.front().value.value, 1.6, 0.05);
  EXPECT_GT(aged.device_findings.front().power_loss, 0.02);
  ill = {};
  ill.drop = 0.2;
  const Diagnosis contacts = DiagnosisOf(ill);
  ASSERT_EQ(contacts.device_findings.size(), 1U) << contacts.verdict.sentence;
  EXPECT_EQ(contacts.device_findings.front().id, "series_resistance");
  EXPECT_NEAR(contacts.device_findings.front().value.value, 0.2, 0.01);
  EXPECT_NEAR(contacts.device_findings.front().power_loss, 0.11, 0.01);
}

// Without a technology n of 1.9 may be that of a sound thin film of the same voltage a cell.
TEST(DeviceFindings, AnIdealityThatThinFilmsHaveAsksForTheTechnology) {
  Ill ill;
  ill.n = 1.9;
  IvCurve curve = SweepOf(ill);
  const Diagnosis d = DiagnoseOrFail(curve);
  ASSERT_EQ(d.device_findings.size(), 1U) << d.verdict.sentence;
  EXPECT_TRUE(d.device_findings.front().if_silicon);
  EXPECT_THAT(d.device_findings.front().sentence, HasSubstr("--technology"));
  EXPECT_THAT(d.verdict.sentence, HasSubstr("depends on its technology"));
  curve.notes.technology = "c-Si";
  EXPECT_THAT(DiagnoseOrFail(curve).verdict.sentence,
              HasSubstr("not as healthy ones are: n = 1.9"));
}

TEST(DeviceFindings, AreNoneOfASweepThatEndsBeforeItsKnee) {
  Ill ill;
  ill.n = 1.8;
  ill.last_V = 31;
  const Diagnosis d = DiagnosisOf(ill);
  EXPECT_THAT(d.device_findings, IsEmpty());
  EXPECT_THAT(Ids(d), IsEmpty());
}

TEST(DeviceFindings, ThinFilmsHaveWiderLimits) {
  Ill ill;
  ill.leak = 0.06;
  ill.n = 1.6;
  IvCurve curve = SweepOf(ill);
  curve.notes.technology = "CdTe";
  EXPECT_THAT(DiagnoseOrFail(curve).device_findings, IsEmpty());
  curve.notes.technology = "mono-Si";
  EXPECT_EQ(DiagnoseOrFail(curve).device_findings.size(), 2U);
}

TEST(ReachesPastKneeTest, NeedsSmallCurrentsNearOpenCircuit) {
  Ill ill;
  EXPECT_TRUE(ReachesPastKnee(OnTheData(SweepOf(ill)).measurement.readings));
  ill.last_V = 31;
  EXPECT_FALSE(ReachesPastKnee(OnTheData(SweepOf(ill)).measurement.readings));
}

// A wrong temperature explains n of 0.85; no temperature explains n of 0.5, and that is said of the
// device without a number.
TEST(CheckTemperatureAndCellsTest, SaysOnlyWhatIsPossible) {
  SKIP_IF_SANITIZED();
  Ill ill;
  IvCurve curve = SweepOf(ill);
  curve.notes.bypass_diodes.reset();
  curve.conditions.cell_temperature_K = 273.15 + 110;
  const Diagnosis wrong = DiagnoseOrFail(curve);
  ASSERT_THAT(Ids(wrong), testing::ElementsAre("temperature_or_cells"));
  const Cause& cause = wrong.verdict.causes.front();
  EXPECT_THAT(cause.in_words.front(), HasSubstr("C instead of 110.0"));
  EXPECT_THAT(cause.in_words.front(), Not(HasSubstr("-4")));
  // The number of bypass diodes is assumed: a shorted group stands behind.
  ASSERT_FALSE(cause.alternatives.empty());
  EXPECT_EQ(cause.alternatives.front().id, "bypass_short");
  EXPECT_NEAR(cause.alternatives.front().probability / cause.probability, 0.4 / 0.6, 1e-9);
  EXPECT_THAT(cause.sentence, HasSubstr("a group of cells is shorted, or"));
  EXPECT_NEAR(wrong.verdict.probability_none, 1 - cause.probability / 0.6, 0.05);
  curve.conditions.cells_in_series = 150;
  curve.conditions.cell_temperature_K = 298.15;
  const Diagnosis impossible = DiagnoseOrFail(curve);
  EXPECT_THAT(Ids(impossible), Not(testing::Contains("temperature_or_cells")));
  ASSERT_EQ(impossible.device_findings.size(), 1U);
  EXPECT_THAT(impossible.device_findings.front().sentence, HasSubstr("less than any junction has"));
}

TEST(MainCause, IsOfTheDeviceBeforeTheMeasurement) {
  Diagnosis diagnosis;
  EXPECT_EQ(MainCause(diagnosis).id, "");
  DeviceFinding finding;
  finding.id = "series_resistance";
  finding.value.value = 0.28;
  finding.healthy_limit = 0.14;
  finding.power_loss = 0.12;
  finding.sentence = "drops 28.1 % of Voc in its series resistance";
  diagnosis.device_findings = {finding};
  const Cause out_of_range = MainCause(diagnosis);
  EXPECT_EQ(out_of_range.id, "series_resistance");
  EXPECT_EQ(out_of_range.title, "series resistance above that of healthy devices");
  EXPECT_EQ(out_of_range.group, "device");
  EXPECT_EQ(out_of_range.sentence, "it drops 28.1 % of Voc in its series resistance");
  EXPECT_EQ(out_of_range.power_effect.value, 0.12);

  finding.id = "ideality";
  finding.value.value = 0.7;
  finding.healthy_limit = 1;
  diagnosis.device_findings = {finding};
  EXPECT_EQ(MainCause(diagnosis).id, "low_ideality");
  EXPECT_EQ(MainCause(diagnosis).group, "conditions");

  Cause cause;
  cause.id = "shading";
  diagnosis.verdict.causes = {cause};
  EXPECT_EQ(MainCause(diagnosis).id, "shading");
  EXPECT_EQ(MainCause(diagnosis).group, "device");

  // A reading left out does not hide a device that is out of range; moved light does, and a fault of
  // the device comes before both.
  finding.id = "leak";
  finding.value.value = 0.05;
  finding.healthy_limit = 0.016;
  diagnosis.device_findings = {finding};
  cause.id = "outliers";
  diagnosis.verdict.causes = {cause};
  EXPECT_EQ(MainCause(diagnosis).id, "leak");
  EXPECT_NE(MainCause(diagnosis).action, "");
  cause.id = "irr_step";
  diagnosis.verdict.causes = {cause};
  EXPECT_EQ(MainCause(diagnosis).id, "irr_step");
  EXPECT_EQ(MainCause(diagnosis).group, "sweep");
  Cause fault;
  fault.id = "weak_cell";
  diagnosis.verdict.causes.push_back(fault);
  EXPECT_EQ(MainCause(diagnosis).id, "weak_cell");
}

}  // namespace
}  // namespace lyrefit
