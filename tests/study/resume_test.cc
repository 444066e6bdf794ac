#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "../file_limit.h"
#include "json_keys.h"
#include "lyrefit/study/report/documents.h"
#include "small_study.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

nlohmann::json WithoutSeconds(const Comparison& comparison) {
  nlohmann::json json = nlohmann::json::parse(CompareJson(comparison));
  RemoveSeconds(&json);
  return json;
}

class ResumeTest : public testing::Test {
 protected:
  ResumeTest() {
    options_.plain_polish = true;
    options_.journal = folder_.Path("study.jsonl");
  }

  Expected<Comparison> Run(std::int64_t stop_after = 1 << 20) {
    runs_told_ = 0;
    return Compare({RtcFrance()}, SmallAlgorithms(), options_, [&](const Progress& progress) {
      if (runs_told_++ == 0) first_ = progress.iteration;
      return progress.iteration >= stop_after ? ObserverAction::kStop : ObserverAction::kContinue;
    });
  }

  const TempFolder folder_;
  CompareOptions options_ = SmallOptions();
  int runs_told_ = 0;
  std::int64_t first_ = -1;  // number of finished runs in the first report
};

TEST_F(ResumeTest, EndsWithTheBitsOfAStudyThatWasNeverInterrupted) {
  CompareOptions plain = options_;
  plain.journal.clear();
  const auto whole = Compare({RtcFrance()}, SmallAlgorithms(), plain);
  ASSERT_TRUE(whole);
  const auto part = Run(7);
  ASSERT_TRUE(part);
  EXPECT_TRUE(part->interrupted);
  EXPECT_THAT(part->remarks, IsEmpty());
  const auto more = Run(17);
  ASSERT_TRUE(more) << more.error().ToString();
  EXPECT_GE(first_, 7);
  EXPECT_TRUE(more->interrupted);
  const auto rest = Run();
  ASSERT_TRUE(rest) << rest.error().ToString();
  EXPECT_GE(first_, 17);
  EXPECT_THAT(rest->remarks, ElementsAre(HasSubstr("of 24 runs were done before")));
  EXPECT_EQ(WithoutSeconds(*rest), WithoutSeconds(*whole));
  EXPECT_EQ(WithoutSeconds(*Run()), WithoutSeconds(*whole)) << "nothing left to do";
  EXPECT_EQ(first_, 24);
}

TEST_F(ResumeTest, LeavesOutALineThatWasNeverFinished) {
  const auto whole = Run();
  ASSERT_TRUE(whole);
  const std::string text = FileText(options_.journal);
  folder_.Write("study.jsonl", text.substr(0, text.size() - 20));
  const auto again = Run();
  ASSERT_TRUE(again) << again.error().ToString();
  EXPECT_EQ(first_, 23);
  EXPECT_THAT(again->remarks,
              ElementsAre(HasSubstr("23 of 24"), HasSubstr("the last line was never finished")));
  EXPECT_EQ(WithoutSeconds(*again), WithoutSeconds(*whole));
  EXPECT_THAT(Run()->remarks, ElementsAre(HasSubstr("24 of 24"))) << "it was cut off";
}

TEST_F(ResumeTest, GoesOnWithMoreRuns) {
  ASSERT_TRUE(Run());
  options_.runs = 5;
  options_.target_gap = 1e-4;
  const auto more = Run();
  ASSERT_TRUE(more) << more.error().ToString();
  EXPECT_EQ(first_, 24);
  options_.journal.clear();
  EXPECT_EQ(WithoutSeconds(*more), WithoutSeconds(*Run()));
}

TEST_F(ResumeTest, NamesTheOptionThatDiffers) {
  ASSERT_TRUE(Run(3));
  const auto refusal = [this](const auto& change) {
    CompareOptions options = options_;
    std::vector<CompareCurve> curves = {RtcFrance()};
    std::vector<ComparedAlgorithm> algorithms = SmallAlgorithms();
    change(&options, &curves[0], &algorithms);
    const auto comparison = Compare(curves, algorithms, options);
    return comparison ? "not refused" : comparison.error().ToString();
  };
  using C = std::vector<ComparedAlgorithm>;
  EXPECT_THAT(refusal([](CompareOptions* o, CompareCurve*, C*) { o->seed = 4; }),
              HasSubstr("study.jsonl:1: this study was begun with seed: 3; now it is 4"));
  EXPECT_THAT(refusal([](CompareOptions* o, CompareCurve*, C*) { o->polish = false; }),
              HasSubstr("begun with polish: true"));
  EXPECT_THAT(refusal([](CompareOptions* o, CompareCurve*, C*) { o->models.pop_back(); }),
              HasSubstr("begun with models: sd,dd; now it is sd"));
  EXPECT_THAT(refusal([](CompareOptions*, CompareCurve* c, C*) { c->curve.current_A[3] *= 1.01; }),
              HasSubstr("begun with curve 1 rtc_france: 26 points"));
  EXPECT_THAT(refusal([](CompareOptions*, CompareCurve* c, C*) { c->bounds.name = "wide"; }),
              HasSubstr("begun with bounds of curve 1 rtc_france: physical"));
  EXPECT_THAT(refusal([](CompareOptions*, CompareCurve*, C* c) { (*c)[1].search.de_scale = 0.6; }),
              HasSubstr("begun with algorithm de: de, population 10; now it is de, population 10, "
                        "de-scale 0.6"));
  EXPECT_THAT(refusal([](CompareOptions*, CompareCurve*, C* c) { c->pop_back(); }),
              HasSubstr("begun with algorithms: mlo,de,random; now it is mlo,de"));
}

TEST_F(ResumeTest, NeverTouchesAFileThatIsNoJournal) {
  for (const char* text : {"V,I\n0,1\n", "{\"a\": 1}", "{\"journal\": 3}\n", "x"}) {
    folder_.Write("study.jsonl", text);
    const auto comparison = Run();
    ASSERT_FALSE(comparison) << text;
    EXPECT_THAT(comparison.error().ToString(), HasSubstr("study.jsonl:1: expected a journal"));
    EXPECT_EQ(FileText(options_.journal), text);
  }
  options_.journal = folder_.Path("");
  EXPECT_THAT(Run().error().ToString(), HasSubstr("expected a journal, or a file"));
}

TEST_F(ResumeTest, SaysWhichLineIsDamaged) {
  ASSERT_TRUE(Run(3));
  std::string text = FileText(options_.journal);
  const std::size_t place = text.find("\"refined_A\":");
  text = text.substr(0, place) + "\"refined_A\":\"\",\"x\":" + text.substr(place + 12);
  folder_.Write("study.jsonl", text);
  EXPECT_THAT(Run().error().ToString(), HasSubstr("study.jsonl:2: the checksum of this line"));
  // As of lyrefit 1.0.0, whose lines have no checksums.
  folder_.Write("study.jsonl",
                std::regex_replace(text, std::regex(",\"crc\":\"[0-9a-f]{8}\"\\}\n"), "}\n"));
  EXPECT_THAT(Run().error().ToString(),
              HasSubstr("study.jsonl:2: expected a number as refined_A of this record"));
}

TEST_F(ResumeTest, SaysWhatCannotBeWritten) {
  ASSERT_TRUE(Run(2));
  const FileLimit limit(FileText(options_.journal).size() + 10);
  const auto study = Run();
  ASSERT_TRUE(study) << study.error().ToString();
  EXPECT_TRUE(study->journal_lacks_runs);
  EXPECT_EQ(study->remarks.back(),
            options_.journal +
                ": cannot write the journal: File too large; the runs since then are "
                "in the report alone");
  EXPECT_EQ(FileText(options_.journal).back(), '\n');
}

TEST_F(ResumeTest, KeepsSeveralStudiesInOneFile) {
  options_.journal_section = "first";
  ASSERT_TRUE(Run(5));
  options_.journal_section = "second";
  options_.seed = 9;
  ASSERT_TRUE(Run(4));
  EXPECT_EQ(first_, 0);
  options_.journal_section = "first";
  options_.seed = 3;
  ASSERT_TRUE(Run());
  EXPECT_GE(first_, 5);
}

TEST_F(ResumeTest, IsWrittenByOneProcessAtATime) {
  bool asked = false;
  std::string refusal;
  const auto outer = Compare({RtcFrance()}, SmallAlgorithms(), options_, [&](const Progress&) {
    if (!asked) {
      asked = true;
      const auto inner = Compare({RtcFrance()}, SmallAlgorithms(), options_);
      if (!inner) refusal = inner.error().message;
    }
    return ObserverAction::kContinue;
  });
  ASSERT_TRUE(outer);
  EXPECT_EQ(refusal, "another process is writing this journal");
}

}  // namespace
}  // namespace lyrefit
