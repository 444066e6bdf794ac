#include "lyrefit/batch/pack.h"

#include "read_batch.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

// A packed curve must have equal values in all fields of the curve.
void ExpectSame(const IvCurve& a, const IvCurve& b) {
  EXPECT_EQ(a.voltage_V, b.voltage_V);
  EXPECT_EQ(a.current_A, b.current_A);
  EXPECT_EQ(a.sigma_A, b.sigma_A);
  EXPECT_EQ(a.time_s, b.time_s);
  EXPECT_EQ(a.sweep, b.sweep);
  EXPECT_EQ(a.irradiance_W_m2, b.irradiance_W_m2);
  EXPECT_EQ(a.temperature_C, b.temperature_C);
  EXPECT_EQ(a.conditions.cell_temperature_K, b.conditions.cell_temperature_K);
  EXPECT_EQ(a.conditions.irradiance_W_m2, b.conditions.irradiance_W_m2);
  EXPECT_EQ(a.conditions.cells_in_series, b.conditions.cells_in_series);
  EXPECT_EQ(a.conditions.strings_in_parallel, b.conditions.strings_in_parallel);
  EXPECT_EQ(a.irradiance_known, b.irradiance_known);
  EXPECT_EQ(a.temperature_known, b.temperature_known);
  EXPECT_EQ(a.cells_known, b.cells_known);
  EXPECT_EQ(a.strings_known, b.strings_known);
  EXPECT_EQ(a.voltage_unit_known, b.voltage_unit_known);
  EXPECT_EQ(a.current_unit_known, b.current_unit_known);
  EXPECT_EQ(a.notes.technology, b.notes.technology);
  EXPECT_EQ(a.notes.date, b.notes.date);
  EXPECT_EQ(a.notes.area_cm2, b.notes.area_cm2);
  EXPECT_EQ(a.notes.bypass_diodes, b.notes.bypass_diodes);
  EXPECT_EQ(a.notes.isc_tempco_per_K, b.notes.isc_tempco_per_K);
  EXPECT_EQ(a.notes.current_noise_constant_A, b.notes.current_noise_constant_A);
  EXPECT_EQ(a.notes.current_noise_relative, b.notes.current_noise_relative);
}

std::string Packed(const std::vector<std::string>& inputs, PackFormat format, int threads = 1) {
  std::string text;
  const auto source = OpenBatch(inputs);
  EXPECT_TRUE(source) << MessageOf(source);
  const auto report = PackBatch(source->get(), format, threads, [&](std::string_view more) {
    text += more;
    return Expected<void>();
  });
  EXPECT_TRUE(report) << MessageOf(report);
  return text;
}

// All single files of data/formats, and rows with all fields that a row can have.
std::vector<std::string> Inputs(const TempFolder& folder) {
  const std::string formats = std::string(LYREFIT_DATA_DIR) + "/formats";
  const std::string rows = folder.Write(
      "full.jsonl",
      R"({"id":"a\"b,c/\u00e4","irradiance_W_m2":911.3,"cell_temperature_C":46.7,"cells_in_series":60,"strings_in_parallel":2,)"
      R"("technology":"mono, \"perc\"","date":"2026-05-01","area_cm2":243.36,"bypass_diodes":3,"isc_tempco_per_K":0.0005,)"
      R"("current_noise_constant_A":0.002,"current_noise_relative":0.001,"rated_power_W":320.50,"serial":"007","weather":"clear; calm",)"
      R"("voltage_V":[0,0.1,36.123456789012345],"current_A":[8.1,8.05,1e-17],"sigma_A":[0.01,0.01,0.02],)"
      R"("time_s":[0,0.001,0.002],"irradiance":[911,911.5,911.4],"temperature":[46.7,46.7,46.7]})"
      "\n"
      R"({"id":"units","v":[0,10,20],"i":[8,7,0]})"
      "\n"
      R"({"id":"=1+1","remark":"@SUM","v":[0,10,20],"i":[8,7,0]})"
      "\n"
      R"({"id":"'=1+1","v":[0,10,20],"i":[8,7,0]})"
      "\n"
      R"({"id":"bad","date":"2026","voltage_V":[0],"current_A":[8,7,0]})"
      "\n");
  return {rows, formats};
}

void ExpectSamePacked(PackFormat format, const std::string& name) {
  const TempFolder folder;
  const auto before = ReadBatch(Inputs(folder));
  const std::string text = Packed(Inputs(folder), format);
  EXPECT_TRUE(Packed(Inputs(folder), format, 3) == text);
  const auto after = ReadBatch({folder.Write(name, text)});
  ASSERT_EQ(after.size(), before.size());
  ASSERT_GT(before.size(), 30U);
  int sound = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    SCOPED_TRACE(before[i].item.where);
    EXPECT_EQ(after[i].curve.id, before[i].curve.id);
    EXPECT_EQ(after[i].curve.beside, before[i].curve.beside);
    ASSERT_EQ(after[i].curve.curve.has_value(), before[i].curve.curve.has_value())
        << MessageOf(after[i].curve.curve);
    if (!before[i].curve.curve) {
      EXPECT_THAT(MessageOf(after[i].curve.curve),
                  HasSubstr(before[i].curve.curve.error().ToString()));
      continue;
    }
    ++sound;
    ExpectSame(*after[i].curve.curve, *before[i].curve.curve);
  }
  EXPECT_GT(sound, 25);
  // Packing a packed file gives the same file.
  EXPECT_TRUE(Packed({folder.Path(name)}, format) == text);
}

TEST(Pack, JsonLinesBringBackTheSameCurves) { ExpectSamePacked(PackFormat::kJsonLines, "p.jsonl"); }

TEST(Pack, CsvBringsBackTheSameCurves) { ExpectSamePacked(PackFormat::kCsv, "p.csv"); }

TEST(Pack, EndsWithTheErrorOfTheSinkAndStopsWhenAsked) {
  const TempFolder folder;
  const std::string file = folder.Write("a.jsonl", GoodRow("a") + "\n");
  const auto full = [](std::string_view) -> Expected<void> { return Fail("the disk is full"); };
  EXPECT_EQ(MessageOf(PackBatch(OpenBatch({file})->get(), PackFormat::kJsonLines, 1, full)),
            "the disk is full");
  const auto report = PackBatch(
      OpenBatch({file})->get(), PackFormat::kJsonLines, 1,
      [](std::string_view) { return Expected<void>(); },
      [](const Progress&) { return ObserverAction::kStop; });
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->interrupted);
}

}  // namespace
}  // namespace lyrefit
