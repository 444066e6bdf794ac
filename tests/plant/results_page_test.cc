#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plant/plant_page.h"
#include "plant/plant_runs.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

TEST(UrlFrom, LeadsFromAPageToAFolder) {
  const TempFolder folder;
  EXPECT_EQ(UrlFrom(folder.Path("plant.html"), folder.Path("results")), "results/");
  EXPECT_EQ(UrlFrom(folder.Path("results/plant.html"), folder.Path("results")), "");
  EXPECT_EQ(UrlFrom(folder.Path("here/plant.html"), folder.Path("my results#1")),
            "../my%20results%231/");
}

TEST(WritePlantPage, SaysWhatTheRunWasAndHowToReachThePages) {
  const TempFolder folder;
  BatchOptions options = IntoPlant(folder.Path("out"));
  options.seed = 4242;
  options.pages = PagesOf::kAll;
  BatchTaskType task = CountTask();
  task.options = {{"tracer", "PVA-1500", ""}, {"modules", "20", "1"}};
  ASSERT_TRUE(RunOn(folder.Write("s.jsonl", ManyRows(9)), task, options));
  const auto rows = WritePlantPage(folder.Path("out"), folder.Path("elm.html"), "Elm & Son");
  ASSERT_TRUE(rows) << rows.error().ToString();
  EXPECT_EQ(*rows, 9);
  const std::string html = FileText(folder.Path("elm.html"));
  EXPECT_THAT(html, HasSubstr("<h1>Elm &amp; Son</h1>"));
  EXPECT_THAT(html, HasSubstr("<dt>Instrument</dt><dd>PVA-1500</dd>"));
  EXPECT_THAT(html, HasSubstr("<dt>Options</dt><dd>pages = all, modules = 20</dd>"));
  EXPECT_THAT(html, HasSubstr("<dt>Seed</dt><dd>4242</dd>"));
  EXPECT_THAT(html, HasSubstr("\"links\":\"out/\""));
}

}  // namespace
}  // namespace lyrefit
