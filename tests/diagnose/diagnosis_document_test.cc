#include "lyrefit/report/documents.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "golden.h"
#include "sample_diagnosis.h"

#include "lyrefit/diagnose/diagnosis_documents.h"

namespace lyrefit {
namespace {

TEST(DiagnosisText, SaysWhatATechnicianNeedsInAFewLines) {
  Golden golden("diagnosis_short");
  Diagnosis step = SampleDiagnosis();
  golden.Add("a step of the light", DiagnosisText(step, Length::kShort));
  Diagnosis shaded = step;
  shaded.verdict.causes = {SampleShadingCause()};
  shaded.verdict.sentence = "The data show partial shading (86 %).";
  golden.Add("a cause with probabilities and power", DiagnosisText(shaded, Length::kShort));
  const auto add = [&](const std::string& title, const auto& change) {
    Diagnosis diagnosis = shaded;
    change(&diagnosis);
    golden.AddChanges(title, DiagnosisText(diagnosis, Length::kShort));
  };
  add("a lower limit of the power", [](Diagnosis* diagnosis) {
    diagnosis->verdict.causes[0].at_least = true;
    diagnosis->verdict.causes[0].recoverable_power_W = {kUnknown, 12, kUnknown};
  });
  add("two causes with power", [](Diagnosis* diagnosis) {
    diagnosis->verdict.causes.push_back(SampleShadingCause());
    diagnosis->verdict.recoverable_power_W = {29, 26, 32};
  });
  add("a leaking device, too", [](Diagnosis* diagnosis) {
    diagnosis->device_findings = {SampleLeak(), SampleLeak()};
  });
  add("doubts and assumptions", [](Diagnosis* diagnosis) {
    diagnosis->doubts = {"the current rises"};
    diagnosis->warnings = {"the current rises", "the noise was guessed"};
    diagnosis->assumptions = {"nobody stated the temperature: 25 C was assumed"};
  });
  golden.Add("none of the known causes", DiagnosisText(SampleLitAndDark(), Length::kShort));
  golden.Check();
}

TEST(DiagnosisText, IsShort) {
  for (const Diagnosis& diagnosis : {SampleDiagnosis(), SampleLitAndDark()}) {
    const std::string text = DiagnosisText(diagnosis, Length::kShort);
    const std::vector<std::string> lines = LinesOf(text);
    EXPECT_LE(lines.size() - std::count(lines.begin(), lines.end(), ""), 15U) << text;
    EXPECT_EQ(text.find("e-0"), std::string::npos) << text;
    EXPECT_EQ(text.find("bound"), std::string::npos) << text;
  }
}

TEST(DiagnosisText, SaysAllIfItIsAsked) {
  Golden golden("diagnosis");
  const auto add = [&](const std::string& title, const auto& change) {
    Diagnosis diagnosis = SampleDiagnosis();
    change(&diagnosis);
    golden.AddChanges(title, DiagnosisText(diagnosis, Length::kWhole));
  };
  golden.Add("a step of the light", DiagnosisText(SampleDiagnosis(), Length::kWhole));
  golden.Add("up and down", DiagnosisText(SampleUpDown(), Length::kWhole));
  golden.Add("a family", DiagnosisText(SampleDiagnosisOfFamily(5), Length::kWhole));
  golden.Add("lit and dark, none of the known causes",
             DiagnosisText(SampleLitAndDark(), Length::kWhole));
  add("with floors", [](Diagnosis* diagnosis) {
    diagnosis->floor_current = 0.0025;
    diagnosis->floor_power = 0.005;
  });
  add("two causes below the floor", [](Diagnosis* diagnosis) {
    diagnosis->verdict.below_floor = {SampleStepCause(), SampleStepCause()};
  });
  // Such a cause has no p-value and no strength.
  add("a cause seen in the values", [](Diagnosis* diagnosis) {
    Cause& cause = diagnosis->verdict.causes[0];
    cause.evidence = "values";
    cause.strength.clear();
    diagnosis->evidence.clipped_points = 3;
    diagnosis->evidence.clip_level_A = 5.02;
  });
  add("interrupted, not usable, with a warning", [](Diagnosis* diagnosis) {
    diagnosis->interrupted = true;
    diagnosis->extended.usable = false;
    diagnosis->warnings = {"the noise was guessed"};
  });
  golden.Check();
}

TEST(BriefDiagnosis, IsOneLine) {
  Golden golden("diagnosis_brief");
  golden.AddLong("a step of the light", BriefDiagnosis(SampleDiagnosis()));
  golden.AddLong("none of the known causes", BriefDiagnosis(SampleLitAndDark()));
  Diagnosis diagnosis = SampleDiagnosis();
  diagnosis.interrupted = true;
  diagnosis.extended.usable = false;
  diagnosis.warnings = {"the noise was guessed"};
  golden.AddLong("interrupted, not usable, with a warning", BriefDiagnosis(diagnosis));
  golden.Check();
}

}  // namespace
}  // namespace lyrefit
