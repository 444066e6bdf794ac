#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <algorithm>
#include <regex>

#include "error_of.h"
#include "lyrefit/report/json.h"
#include "lyrefit/trend/read_trend.h"
#include "lyrefit/trend/trend.h"
#include "lyrefit/trend/trend_documents.h"
#include "temp_folder.h"
#include "trend/sweeps_text.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

TrendSeries ThirtyDays() {
  MadeYear year;
  year.days = 30;
  year.points = 20;
  TrendSeries series = ReducedBy(MadeDevice(), MakeSweeps(MadeDevice(), year));
  AppendOperatingPoint(kMadeStart_s + 31 * kDay_s, kUnknown, 40, 30, 8, &series);
  return series;
}

// The text of a state as of lines without checksums, which anybody may write.
// A state as format 1, which has no checksums.
std::string WithoutSums(const std::string& text) {
  const std::regex sum(",(\"crc\":)?\"[0-9a-f]{8}\"([\\]}]\n)"), format("_trend\":2");
  return std::regex_replace(std::regex_replace(text, sum, "$2"), format, "_trend\":1");
}

int LinesIn(const std::string& path) {
  const std::string text = FileText(path);
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

TEST(TrendState, KeepsTheLawAndTheRows) {
  const TempFolder folder;
  const std::string path = folder.Path("a.state");
  const TrendSeries series = ThirtyDays();
  const auto written = AppendTrendState(path, series);
  ASSERT_TRUE(written) << written.error().ToString();
  EXPECT_EQ(*written, static_cast<std::int64_t>(series.rows.size()));
  EXPECT_TRUE(IsTrendState(path));
  const auto read = ReadTrendState(path);
  ASSERT_TRUE(read) << read.error().ToString();
  EXPECT_EQ(read->name, series.name);
  EXPECT_EQ(read->law, series.law);
  EXPECT_EQ(read->source, series.source);
  EXPECT_EQ(read->device->cells_in_series, 60);
  EXPECT_EQ(read->device->substrings, 3);
  EXPECT_EQ(read->device->saturation_current_2_A, series.device->saturation_current_2_A);
  EXPECT_EQ(read->device->isc_tempco_per_K, series.device->isc_tempco_per_K);
  ASSERT_EQ(read->rows.size(), series.rows.size());
  for (std::size_t i = 0; i + 1 < series.rows.size(); ++i) {
    EXPECT_EQ(read->rows[i].time_s, series.rows[i].time_s);
    EXPECT_EQ(read->rows[i].parameters, series.rows[i].parameters);
    EXPECT_EQ(read->rows[i].misfit, series.rows[i].misfit);
    EXPECT_EQ(read->rows[i].power_W(), series.rows[i].power_W());
  }
  EXPECT_TRUE(std::isnan(read->rows.back().irradiance_W_m2));
  EXPECT_EQ(read->rows.back().reason, "a value is missing");
  const auto head = ReadTrendStateHead(path);
  ASSERT_TRUE(head && *head);
  EXPECT_TRUE((*head)->rows.empty());
  EXPECT_EQ((*head)->device->photocurrent_A, series.device->photocurrent_A);
}

TEST(TrendState, GivesTheReportOfTheSweepsToTheLastBit) {
  const TempFolder folder;
  const TrendSeries series = ThirtyDays();
  ASSERT_TRUE(AppendTrendState(folder.Path("a.state"), series));
  const auto read = ReadTrendState(folder.Path("a.state"));
  ASSERT_TRUE(read);
  const auto of_sweeps = FindTrend(series), of_state = FindTrend(*read);
  ASSERT_TRUE(of_sweeps) << of_sweeps.error().ToString();
  ASSERT_TRUE(of_state);
  EXPECT_EQ(TrendJson(*of_sweeps), TrendJson(*of_state));
}

TEST(TrendState, TakesAMeasurementOnce) {
  const TempFolder folder;
  const std::string path = folder.Path("a.state");
  const TrendSeries series = ThirtyDays();
  ASSERT_TRUE(AppendTrendState(path, series));
  const std::string before = FileText(path);
  EXPECT_EQ(*AppendTrendState(path, series), 0);
  EXPECT_EQ(FileText(path), before);
  TrendSeries twice = ReducedBy(*series.device, {});
  twice.rows = {series.rows[0], series.rows[1], series.rows[1]};
  twice.rows[1].time_s += 1;
  twice.rows[2].time_s += 1;
  EXPECT_EQ(*AppendTrendState(path, twice), 1);
  EXPECT_EQ(LinesIn(path), static_cast<int>(series.rows.size()) + 2);
}

TEST(TrendState, SweepBySweepIsTheSameFile) {
  const TempFolder folder;
  const TrendSeries series = ThirtyDays();
  ASSERT_TRUE(AppendTrendState(folder.Path("whole.state"), series));
  for (std::size_t i = 0; i < series.rows.size(); i += 20) {
    TrendSeries part = series;
    part.rows.assign(
        series.rows.begin() + static_cast<std::ptrdiff_t>(i),
        series.rows.begin() + static_cast<std::ptrdiff_t>(std::min(i + 20, series.rows.size())));
    ASSERT_TRUE(AppendTrendState(folder.Path("parts.state"), part));
  }
  EXPECT_EQ(FileText(folder.Path("parts.state")), FileText(folder.Path("whole.state")));
}

TEST(TrendState, OfASweepThatWasBeingWrittenIsWrittenAgain) {
  const TempFolder folder;
  const std::string path = folder.Path("a.state");
  const TrendSeries series = ThirtyDays();
  ASSERT_TRUE(AppendTrendState(path, series));
  const std::string whole = FileText(path);
  folder.Write("a.state", whole.substr(0, whole.size() - 20));
  const auto torn = ReadTrendState(path);
  ASSERT_TRUE(torn) << torn.error().ToString();
  EXPECT_EQ(torn->rows.size(), series.rows.size() - 1);
  EXPECT_EQ(*AppendTrendState(path, series), 1);
  EXPECT_EQ(FileText(path), whole);
}

TEST(TrendState, PointsAtADamagedLine) {
  const TempFolder folder;
  const TrendSeries series = ThirtyDays();
  ASSERT_TRUE(AppendTrendState(folder.Path("a.state"), series));
  const std::string whole = WithoutSums(FileText(folder.Path("a.state")));
  const std::size_t third = whole.find('\n', whole.find('\n') + 1) + 1;
  const std::size_t fourth = whole.find('\n', third) + 1;
  for (const char* line :
       {"[]\n", "\n", "{}\n", "noise\n", "[1,2,3]\n", "[1,2,3,4,5,6,7,8,9,10,11,12,13,0,9,\"\"]\n",
        "[1,2,3,4,5,6,7,8,9,10,11,12,13,0,-1,\"\"]\n", "[1,2,3,4,5,6,7,8,9,10,11,12,13,0,0,0]\n"}) {
    const std::string path =
        folder.Write("b.state", whole.substr(0, third) + line + whole.substr(fourth));
    ExpectErrorAt(ReadTrendState(path), path, 3, 0, "this line is no row of a trend");
  }
  const std::string path =
      folder.Write("b.state", whole.substr(0, third) + "noise\n" + whole.substr(fourth));
  ExpectErrorAt(AppendTrendState(path, series), path, 3, 0, "this line is no row of a trend");
}

TEST(TrendState, RefusesARowThatCountsWithoutItsConditions) {
  const TempFolder folder;
  const TrendSeries series = ThirtyDays();
  ASSERT_TRUE(AppendTrendState(folder.Path("a.state"), series));
  const std::string whole = WithoutSums(FileText(folder.Path("a.state")));
  const std::size_t second = whole.find('\n') + 1;
  for (const char* conditions :
       {"null,800,25", "1741775400,null,25", "1741775400,800,null", "1741775400,800,-274"}) {
    for (const int state : {0, 1}) {
      const std::string row =
          fmt::format("[{},30,7,8,37,0,0,0,0,0,0.001,0,{},\"\"]\n", conditions, state);
      const std::string path =
          folder.Write("b.state", whole.substr(0, second) + row + whole.substr(second));
      ExpectErrorAt(ReadTrendState(path), path, 2, 0, "expected a time, an irradiance and a");
    }
    const std::string left_out =
        fmt::format("[{},30,7,8,37,0,0,0,0,0,0.001,0,5,\"\"]\n", conditions);
    EXPECT_TRUE(ReadTrendState(
        folder.Write("b.state", whole.substr(0, second) + left_out + whole.substr(second))));
  }
}

TEST(TrendState, RefusesADamagedHead) {
  const TempFolder folder;
  ASSERT_TRUE(AppendTrendState(folder.Path("a.state"), ThirtyDays()));
  const std::string whole = WithoutSums(FileText(folder.Path("a.state")));
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    text.replace(text.find(from), from.size(), to);
    return folder.Write("b.state", text);
  };
  for (const auto& [from, to] :
       {std::pair<const char*, const char*>{"{\"lyrefit_trend\":1", "{\"lyrefit_trend\":3"},
        {"{\"lyrefit_trend\":1", "{\"lyrefit_trend\":1.5"},
        {"{\"lyrefit_trend\":1", "{\"lyrefit_trend\":\"1\""},
        {"{\"lyrefit_trend\":1", "{\"lyrefit_trend\""},
        {"\"n\":1.0", "\"n\":\"one\""},
        {"\"n\":1.0", "\"n\":null"},
        {"\"cells_in_series\":60", "\"cells_in_series\":\"60\""},
        {"\"cells_in_series\":60", "\"cells_in_series\":0"},
        {"\"name\":\"made\"", "\"name\":7"},
        {"\"source\":\"sweeps\"", "\"source\":\"dreams\""}}) {
    const std::string path = with(from, to);
    const auto read = ReadTrendState(path);
    ASSERT_FALSE(read) << to;
    EXPECT_EQ(read.error().file, path) << to;
    EXPECT_EQ(read.error().line, 1) << to;
  }
}

TEST(TrendState, RefusesAnotherLawAndAnotherFile) {
  const TempFolder folder;
  const std::string path = folder.Path("a.state");
  TrendSeries series = ThirtyDays();
  ASSERT_TRUE(AppendTrendState(path, series));
  const std::string before = FileText(path);
  TrendDevice other = *series.device;
  other.resistance_series_ohm += 1e-6;
  series.device = std::make_shared<const TrendDevice>(other);
  ExpectErrorAt(AppendTrendState(path, series), path, 1, 0, "another law");
  EXPECT_EQ(FileText(path), before);
  const std::string table = folder.Write("b.csv", "voltage_V,current_A\n0,1\n");
  EXPECT_FALSE(IsTrendState(table));
  ExpectErrorAt(ReadTrendState(table), table, 1, 0, "expected the state of a trend");
  ExpectErrorAt(AppendTrendState(table, series), table, 1, 0, "expected the state of a trend");
  EXPECT_EQ(FileText(table), "voltage_V,current_A\n0,1\n");
  EXPECT_FALSE(IsTrendState(folder.Path("missing.state")));
  EXPECT_FALSE(ReadTrendState(folder.Path("missing.state")));
  EXPECT_THAT(MessageOf(ReadTrendState(folder.Write("empty.state", ""))),
              HasSubstr("found an empty file"));
}

TEST(TrendState, SaysWhatItIsOf) {
  const TempFolder folder;
  const std::string path = folder.Path("a.state");
  TrendSeries series = ThirtyDays();
  ASSERT_TRUE(AppendTrendState(path, series));
  const std::string before = FileText(path);
  TrendSeries points = series;
  points.source = TrendSource::kOperatingPoints;
  ExpectErrorAt(AppendTrendState(path, points), path, 1, 0,
                "this state is of sweeps, these measurements are operating points");
  TrendDevice other = *series.device;
  other.cells_in_series = 72;
  series.device = std::make_shared<const TrendDevice>(other);
  ExpectErrorAt(AppendTrendState(path, series), path, 1, 0,
                "60 cells and 3 substrings, not 72 cells and 3 substrings");
  EXPECT_EQ(FileText(path), before);
}

TEST(TrendState, SeesARowThatWasChanged) {
  const TempFolder folder;
  const TrendSeries series = ThirtyDays();
  ASSERT_TRUE(AppendTrendState(folder.Path("a.state"), series));
  std::string text = FileText(folder.Path("a.state"));
  const std::size_t third = text.find('\n', text.find('\n') + 1) + 1;
  text[third + 15] = text[third + 15] == '1' ? '2' : '1';
  const std::string path = folder.Write("b.state", text);
  ExpectErrorAt(ReadTrendState(path), path, 3, 0, "a line was changed, moved or lost");
  ExpectErrorAt(AppendTrendState(path, series), path, 3, 0, "a line was changed, moved or lost");
  EXPECT_EQ(FileText(path), text);
}

TEST(TrendState, OfAnotherVersionIsOfTheSameLaw) {
  const TempFolder folder;
  const TrendSeries series = ThirtyDays();
  ASSERT_TRUE(AppendTrendState(folder.Path("a.state"), series));
  std::string text = WithoutSums(FileText(folder.Path("a.state")));
  const std::string version = "\"version\":\"";
  text.insert(text.find(version) + version.size(), "9.");
  const auto written = AppendTrendState(folder.Write("b.state", text), series);
  ASSERT_TRUE(written) << written.error().ToString();
  EXPECT_EQ(*written, 0);
}

TEST(TrendState, OfFormat2HasChecksums) {
  const TempFolder folder;
  ASSERT_TRUE(AppendTrendState(folder.Path("a.state"), ThirtyDays()));
  std::string text = FileText(folder.Path("a.state"));
  const std::string crlf = std::regex_replace(text, std::regex("\n"), "\r\n");
  for (const std::string& other : {WithoutSums(text).replace(17, 1, "2"), crlf}) {
    const std::string path = folder.Write("b.state", other);
    ExpectErrorAt(ReadTrendState(path), path, 1, 0, "this line has lost its checksum");
    ExpectErrorAt(AppendTrendState(path, ThirtyDays()), path, 1, 0,
                  "this line has lost its checksum");
    EXPECT_EQ(FileText(path), other);
  }
}

TEST(TrendState, ARowWithoutAnAnswerGivesWay) {
  const TempFolder folder;
  const std::string path = folder.Path("a.state");
  TrendSeries series = ThirtyDays();
  const TrendRow right = series.rows[5];
  series.rows[5] = TrendRow();
  series.rows[5].time_s = right.time_s;
  series.rows[5].reason = "cut";
  TrendRow untimed;
  untimed.reason = "no date";
  series.rows.push_back(untimed);
  ASSERT_TRUE(AppendTrendState(path, series));
  EXPECT_EQ(*AppendTrendState(path, series), 0);
  TrendSeries one = series;
  one.rows = {right};
  EXPECT_EQ(*AppendTrendState(path, one), 1);
  EXPECT_EQ(*AppendTrendState(path, one), 0);
  one.rows[0].voltage_V += 1;  // an answer stays
  EXPECT_EQ(*AppendTrendState(path, one), 0);
  const auto read = ReadTrendState(path);
  ASSERT_TRUE(read) << read.error().ToString();
  ASSERT_EQ(read->rows.size(), series.rows.size());
  EXPECT_EQ(read->rows[5].voltage_V, right.voltage_V);
  EXPECT_EQ(read->rows[5].reason, "");
}

TEST(TrendState, RefusesWhatIsOlderThanTheSweepsOfItsLaw) {
  const TempFolder folder;
  const std::string path = folder.Path("a.state");
  MadeYear year;
  year.days = 40;
  year.points = 20;
  const std::vector<TimedSweep> sweeps = MakeSweeps(MadeDevice(), year);
  auto series = SeriesOfSweeps(sweeps, TrendOptions());
  ASSERT_TRUE(series) << series.error().ToString();
  AppendSweeps(sweeps, 1, &*series);
  ASSERT_TRUE(AppendTrendState(path, *series));
  const std::string before = FileText(path);
  TrendSeries older = *series;
  older.rows = {series->rows[0]};
  older.rows[0].time_s = std::floor(series->law_from_s / kDay_s) * kDay_s - 60;
  EXPECT_THAT(MessageOf(AppendTrendState(path, older)),
              HasSubstr("a measurement of 2025-03-11 is older than the sweeps that the law of this "
                        "state is of, from 2025-03-12 on"));
  EXPECT_EQ(FileText(path), before);
  older.rows[0].time_s += 120;  // of the first day
  EXPECT_EQ(*AppendTrendState(path, older), 1);
  TrendSeries of_module = ThirtyDays();
  ASSERT_TRUE(AppendTrendState(folder.Path("b.state"), of_module));
  of_module.rows.resize(1);
  of_module.rows[0].time_s -= 100 * kDay_s;
  EXPECT_EQ(*AppendTrendState(folder.Path("b.state"), of_module), 1);
}

TEST(TrendState, CutWithinItsFirstLineIsBegunAnew) {
  const TempFolder folder;
  const TrendSeries series = ThirtyDays();
  ASSERT_TRUE(AppendTrendState(folder.Path("a.state"), series));
  const std::string whole = FileText(folder.Path("a.state"));
  const std::string path = folder.Write("b.state", whole.substr(0, 200));
  EXPECT_THAT(MessageOf(ReadTrendState(path)), HasSubstr("cut within its first line"));
  const auto head = ReadTrendStateHead(path);
  ASSERT_TRUE(head);
  EXPECT_FALSE(*head);
  ASSERT_TRUE(AppendTrendState(path, series));
  EXPECT_EQ(FileText(path), whole);
}

TEST(TrendState, IsNoPipe) {
  const TempFolder folder;
  const std::string pipe = folder.Path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_FALSE(IsTrendState(pipe));
  EXPECT_THAT(MessageOf(ReadTrendStateHead(pipe)), HasSubstr("found a pipe"));
}

// States that were written by lyrefit 1.0.0 (format 1) and by the first program of format 2.
TEST(TrendState, OfEveryFormatIsReadAndGoesOn) {
  for (const char* name : {"format_1.state", "format_2.state"}) {
    const TempFolder folder;
    const std::string path = folder.Write(
        "a.state", FileText(std::string(LYREFIT_DATA_DIR) + "/../tests/trend/states/" + name));
    const auto state = ReadTrendState(path);
    ASSERT_TRUE(state) << name << ": " << state.error().ToString();
    EXPECT_EQ(state->law, "3 sweeps of the reference days");
    EXPECT_EQ(state->device->cells_in_series, 60);
    EXPECT_NEAR(state->device->resistance_series_ohm, 0.279, 1e-3);
    EXPECT_EQ(DateText(state->law_from_s), "2025-01-01");
    ASSERT_EQ(state->rows.size(), 6U);
    EXPECT_EQ(state->rows[4].state, TrendRowState::kUsed);
    EXPECT_NEAR(state->rows[4].power_W(), 59.87, 0.01);
    EXPECT_EQ(state->rows[5].state, TrendRowState::kUnusable);
    EXPECT_THAT(state->rows[5].reason, HasSubstr("as many values"));
    TrendSeries next = *state;
    next.rows = {state->rows[4], state->rows[4]};
    next.rows[1].time_s += kDay_s;
    const auto written = AppendTrendState(path, next);
    ASSERT_TRUE(written) << written.error().ToString();
    EXPECT_EQ(*written, 1);
    EXPECT_EQ(ReadTrendState(path)->rows.size(), 7U);
  }
}

}  // namespace
}  // namespace lyrefit
