#include "lyrefit/report/json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "certify/sample_certificate.h"
#include "devices/sample_data_sheet.h"
#include "diagnose/sample_diagnosis.h"
#include "diagnose/sample_reference.h"
#include "family/sample_family.h"
#include "golden.h"
#include "json_keys.h"
#include "lyrefit/certify/certificate_documents.h"
#include "lyrefit/devices/device_documents.h"
#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/family/family_documents.h"
#include "sample_fits.h"

namespace lyrefit {
namespace {

using nlohmann::json;

json Parsed(const FitReport& report) { return json::parse(JsonReport(report)); }

std::string OutlineOf(const std::string& text, bool values = true) {
  return Outline(json::parse(text), values);
}

// A fit with what only some fits have.
FitReport FullReport() {
  FitReport report = SampleReport();
  report.floor = {Objective::kSolvedCurrent, 9.8e-4, 9.7e-4, 1e-2, 1, 2, 0.01, false};
  report.refine.starts.resize(49);
  report.refine.local_optima = OptimumCount{14, 5, 6, {12, 4, 5, 3, 1}, 1.5};
  report.variants = {{"d, Vb free; a = 0", 2, 1.2e-3, 87.5, false, false},
                     {"d, Vb, m, A free", 4, 7.73e-4, 0, true, true}};
  report.estimates[2].bounds.whole = 0.25;
  report.estimates[2].at_bound = BoundSide::kUpper;
  Estimate depth;
  depth.info = {"shading.d", "shading_shading_depth", "", "light that is missing"};
  depth.refined = 0.25;
  report.estimates.push_back(depth);
  report.choice = ModelChoice{
      Model::kDoubleDiode, {{Model::kSingleDiode, 1e-3, 2e-3, -10, kUnknown, true}}, "Two diodes."};
  return report;
}

TEST(JsonReport, HoldsWhatTheReportHolds) {
  Golden golden("json_fit");
  golden.AddLong("a fit", OutlineOf(JsonReport(SampleReport())));
  golden.AddLongChanges("what only some have", OutlineOf(JsonReport(FullReport())));
  FitReport report = SampleReport();
  report.estimates[4].high_95 = kInfinity;
  report.simulated.open_circuit_voltage_V = kUnknown;
  report.no_intervals_because = "the fit is not usable";
  golden.AddLongChanges("what is not finite, and no intervals", OutlineOf(JsonReport(report)));
  report = SampleReport();
  report.polished = false;
  golden.AddLongChanges("without a polish", OutlineOf(JsonReport(report)));
  report = SampleReport();
  report.model = Model::kTripleDiode;
  report.estimates.clear();
  for (const ParameterInfo& info : MakeDevice(report.model, report.curve.conditions).parameters) {
    Estimate e;
    e.info = info;
    report.estimates.push_back(e);
  }
  golden.AddLongChanges("three diodes", OutlineOf(JsonReport(report)));
  golden.Check();
}

TEST(JsonDocuments, HoldWhatTheirReportsHold) {
  Golden golden("json_documents");
  golden.AddLong("family", OutlineOf(FamilyJson(MakeSampleFamily(60).report)));
  golden.AddLong("family: curves one by one", OutlineOf(FamilyJson(MakeFreeSample(8).report)));
  golden.AddLong("diagnosis", OutlineOf(DiagnosisJson(SampleDiagnosis())));
  Diagnosis diagnosis = SampleDiagnosis();
  diagnosis.verdict.causes = {SampleShadingCause()};
  diagnosis.device_findings = {SampleLeak()};
  const json full = json::parse(DiagnosisJson(diagnosis));
  golden.AddLong("diagnosis: shading", Outline(full["verdict"]["causes"][0]));
  golden.AddLong("diagnosis: a leak", Outline(full["device_findings"]));
  golden.AddLong("diagnosis: an effect that was not tried",
                 Outline(json::parse(DiagnosisJson(SampleDiagnosis()))["trials"][3]));
  const json several = json::parse(DiagnosisJson({SampleDiagnosis(), SampleUpDown()}));
  golden.AddLong("diagnoses", several[0]["name"].dump() + several[1]["name"].dump() + "\n");
  golden.AddLong("answers",
                 OutlineOf(AnswersJson({"a", "b", "c"},
                                       {SampleDiagnosis(), SampleLitAndDark(), SampleUpDown()})));
  const json reference = json::parse(ReferenceJson(SampleReference(), SampleDiagnosis()));
  golden.AddLong("reference", Outline(reference["comparison"]));
  golden.AddLong("reference: diagnosis", Outline(reference["diagnosis"]["name"], true, "name"));
  golden.AddLong("outlier sweeps", OutlineOf(OutlierSweepsJson(SampleOutlierSweeps())));
  golden.AddLong("certificate", OutlineOf(CertificateJson(RtcCertificate()), false));
  golden.AddLong("data sheet", OutlineOf(DataSheetJson(SampleDataSheetFit())));
  golden.AddLong("data sheet: family",
                 OutlineOf(DataSheetJson(*FitDataSheet(SampleSheet())), false));
  golden.Check();
}

TEST(JsonDocuments, TakeNamesThatAreNotUtf8) {
  FitReport fit = SampleReport();
  Certificate certificate = RtcCertificate();
  Diagnosis diagnosis = SampleDiagnosis();
  FamilyReport family = MakeSampleFamily(8).report;
  fit.curve.name = certificate.curve.name = diagnosis.name = family.curves[3].id = "caf\xe9";
  EXPECT_EQ(Parsed(fit)["curve"]["name"], "caf\xef\xbf\xbd");
  for (const std::string& text :
       {CertificateJson(certificate), DiagnosisJson(diagnosis), FamilyJson(family)}) {
    EXPECT_TRUE(json::accept(text));
  }
}

TEST(JsonReport, BringsBackTheSameBits) {
  const FitReport report = SampleReport();
  const json j = Parsed(report);
  EXPECT_EQ(j["parameters"]["saturation_current"]["refined"].get<double>(), report.refined[1]);
  EXPECT_EQ(j["rmse"]["refined"]["solved_current_A"].get<double>(),
            report.rmse.refined.solved_current_A);
  EXPECT_EQ(j["singlediode"]["nNsVth"].get<double>(), report.nNsVth);
  EXPECT_EQ(j["data"]["current_A"].get<std::vector<double>>(), report.curve.current_A);
}

TEST(JsonReport, KeepsWallClockTimesUnderSecondsOnly) {
  FitReport report = SampleReport();
  json first = Parsed(report);
  report.search.seconds = 77;
  report.refine.seconds = 77;
  report.interval_seconds = 77;
  json second = Parsed(report);
  EXPECT_NE(first, second);
  RemoveSeconds(&first);
  RemoveSeconds(&second);
  EXPECT_EQ(first, second);
}

TEST(FitsJson, HoldsEveryReportUnderItsFile) {
  const json list = json::parse(FitsJson(SampleFits()));
  ASSERT_EQ(list.size(), 3U);
  EXPECT_EQ(list[0]["file"], "a.csv");
  json report = list[0];
  report.erase("file");
  EXPECT_EQ(report, json::parse(JsonReport(*SampleFits()[0].report)));
  EXPECT_EQ(list[1]["file"], "b, c.csv");
  EXPECT_EQ(list[1]["error"], "b, c.csv:2:3: expected a number, found 'x'");
  EXPECT_EQ(list[1].size(), 2U);
}

TEST(CertificateJson, WritesNullForWhatIsNotFinite) {
  Certificate certificate = RtcCertificate();
  certificate.floor.duality_gap = std::nan("");
  EXPECT_TRUE(json::parse(CertificateJson(certificate))["floor"]["duality_gap"].is_null());
}

}  // namespace
}  // namespace lyrefit
