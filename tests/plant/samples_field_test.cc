// Pixels of real substrates. Built only if LYREFIT_FIELD_DATA is set to the folder of the
// measurements.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "../error_of.h"
#include "plant/plant_runs.h"

namespace lyrefit {
namespace {

const std::string kLab = std::string(LYREFIT_FIELD_DATA_DIR) + "/lab";
const std::string kTracers = std::string(LYREFIT_FIELD_DATA_DIR) + "/../tracers/lab/";

std::map<std::string, SampleSummary> SamplesOf(const std::vector<std::string>& inputs,
                                               std::optional<double> area_cm2 = {}) {
  const TempFolder folder;
  BatchReadOptions reading;
  reading.reading.whole_cells = true;
  reading.reading.area_cm2 = area_cm2;
  auto source = OpenBatch(inputs, reading);
  EXPECT_TRUE(source) << MessageOf(source);
  CellOptions cell;
  cell.fit = false;
  PlantResults found;
  const auto done =
      RunBatch(source->get(), CellTask(cell), IntoPlant(folder.Path("out"), 2, {}, &found));
  EXPECT_TRUE(done) << MessageOf(done);
  std::map<std::string, SampleSummary> samples;
  if (!done) return samples;
  for (const SampleSummary& one : found.samples) {
    samples[one.name.substr(one.name.rfind('/') + 1)] = one;
  }
  return samples;
}

TEST(SamplesField, EveryPixelOfATracersFileIsCounted) {
  if (!std::filesystem::exists(kTracers)) GTEST_SKIP() << "no " << kTracers;
  const auto samples =
      SamplesOf({kTracers + "hydiris_six_pixels.jv.txt", kTracers + "hzb_names_then_units.txt",
                 kTracers + "pers_two_directions.jv.txt", kTracers + "hzb_json_in_txt.jv.txt"});
  ASSERT_EQ(samples.size(), 4U);
  const SampleSummary& six = samples.at("hydiris_six_pixels.jv");
  EXPECT_EQ(six.pixels, 6);
  EXPECT_EQ(six.not_working, std::vector<std::string>{"e: shorted"});
  EXPECT_EQ(six.senses.at("normal"), 5);
  const SampleSummary& three = samples.at("hzb_names_then_units");
  EXPECT_EQ(three.working(), 3);
  // The head of the file states 21.322, 21.030 and 21.426 % in reverse.
  EXPECT_NEAR(three.directions[1].quantities[0].median, 0.21322, 2e-4);
  EXPECT_EQ(three.directions[1].champion.substr(three.directions[1].champion.rfind('/')), "/f");
  EXPECT_EQ(samples.at("pers_two_directions.jv").senses.at("inverted"), 6);
  EXPECT_EQ(samples.at("Sample 1").pixels, 6);
  EXPECT_EQ(samples.at("Sample 1").states.at("shorted"), 6);
}

TEST(SamplesField, DeadPixelsAreDead) {
  if (!std::filesystem::exists(kTracers)) GTEST_SKIP() << "no " << kTracers;
  const auto samples = SamplesOf({kTracers + "four_pixels_side_by_side.jv.csv"}, 0.16);
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_EQ(samples.begin()->second.pixels, 4);
  EXPECT_EQ(samples.begin()->second.states.at("dead"), 4);
}

TEST(SamplesField, FilesOfOnePixelAreGroupedByTheirNames) {
  const auto samples = SamplesOf({kLab});
  EXPECT_EQ(samples.at("pers1").working(), 4);
  EXPECT_EQ(samples.at("opv_og1").working(), 4);
  EXPECT_EQ(samples.at("vp114_short").states.at("shorted"), 1);
  EXPECT_EQ(samples.at("kit_tandem").states.at("doubtful"), 1);
}

}  // namespace
}  // namespace lyrefit
