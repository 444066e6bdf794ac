#include "lyrefit/report/documents.h"

#include <gtest/gtest.h>

#include "golden.h"
#include "sample_family.h"

#include "lyrefit/family/family_documents.h"

namespace lyrefit {
namespace {

TEST(FamilyText, SaysWhatTheGoldenFileHas) {
  Golden golden("family");
  const FamilyReport sample = MakeSampleFamily(8).report;
  golden.Add("eight curves", FamilyText(sample));
  FamilyReport report = sample;
  report.interrupted = true;
  report.usable = false;
  golden.AddChanges("interrupted, not usable", FamilyText(report));
  report = sample;
  report.in_sample = report.held_out;
  report.held_out.reset();
  report.against[0].name = "a very long name of a file that nobody would type.json";
  report.in_sample->largest_id = "a very long name of a curve";
  golden.AddChanges("other parameters on the curves fitted", FamilyText(report));
  golden.AddChanges("two hundred curves: the worst ten", FamilyText(MakeSampleFamily(200).report));
  golden.Check();
}

TEST(FamilyText, OfCurvesFittedOneByOneSaysWhatTheGoldenFileHas) {
  Golden golden("individual_fits");
  SampleFamily sample = MakeFreeSample(8);
  golden.Add("eight curves", FamilyText(sample.report));
  sample.report.curves[3].id = "a very long name of a curve that nobody would type";
  golden.AddChanges("a long name", FamilyText(sample.report));
  sample.report.translation.spec.model = Model::kDoubleDiode;
  for (FamilyCurve& curve : sample.report.curves) {
    curve.individual_parameters.insert(curve.individual_parameters.end(), {1.2e-7, 2});
  }
  golden.AddChanges("two diodes", FamilyText(sample.report));
  golden.Check();
}

TEST(BriefFamily, IsOneLine) {
  Golden golden("family_brief");
  golden.AddLong("eight curves", BriefFamily(MakeSampleFamily(8).report));
  golden.Check();
}

}  // namespace
}  // namespace lyrefit
