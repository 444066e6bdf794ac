#include "lyrefit/report/documents.h"

#include <gtest/gtest.h>

#include "golden.h"
#include "sample_diagnosis.h"

namespace lyrefit {
namespace {

TEST(DiagnosisText, SaysWhatTheGoldenFileHas) {
  Golden golden("diagnosis");
  const auto add = [&](const std::string& title, const auto& change) {
    Diagnosis diagnosis = SampleDiagnosis();
    change(&diagnosis);
    golden.AddChanges(title, DiagnosisText(diagnosis));
  };
  golden.Add("a step of the light", DiagnosisText(SampleDiagnosis()));
  golden.Add("up and down", DiagnosisText(SampleUpDown()));
  golden.Add("a family", DiagnosisText(SampleDiagnosisOfFamily(5)));
  golden.Add("lit and dark, none of the known causes", DiagnosisText(SampleLitAndDark()));
  add("with floors", [](Diagnosis* diagnosis) {
    diagnosis->floor_current = 0.0025;
    diagnosis->floor_power = 0.005;
  });
  add("two causes below the floor", [](Diagnosis* diagnosis) {
    diagnosis->verdict.below_floor = {SampleStepCause(), SampleStepCause()};
  });
  add("with a plan", [](Diagnosis* diagnosis) { diagnosis->plan = SamplePlan(); });
  add("with a plan without measurements", [](Diagnosis* diagnosis) {
    diagnosis->plan = SamplePlan();
    diagnosis->plan->measurements.clear();
  });
  // Such a cause has no p-value and no strength.
  add("a cause seen in the values", [](Diagnosis* diagnosis) {
    Cause& cause = diagnosis->verdict.causes[0];
    cause.evidence = "values";
    cause.corrected_p = kUnknown;
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
