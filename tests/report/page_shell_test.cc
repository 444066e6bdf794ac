#include "lyrefit/report/page_shell.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "unpack.h"
#include "well_formed.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(PageShell, HoldsWhatItIsGivenAndFetchesNothing) {
  PageShell shell;
  shell.title = "a < b";
  shell.summary = "<p>first</p>";
  shell.body = "<p>then</p>";
  shell.style = ".own{}";
  shell.scripts = {"one();", "two();"};
  shell.data = {{"numbers", "[1]"}};
  const std::string html = DrawShell(shell);
  EXPECT_THAT(html, StartsWith("<!DOCTYPE html>\n<html lang=\"en\">"));
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
  EXPECT_THAT(html, HasSubstr("<title>a &lt; b</title>"));
  EXPECT_THAT(html, HasSubstr("<h1>a &lt; b</h1>"));
  EXPECT_THAT(html, HasSubstr("<script type=\"application/json\" id=\"numbers\">[1]</script>"));
  std::size_t at = 0;
  for (const char* part : {".own{}", "<a class=\"skip\" href=\"#main\">", "<p>first</p>",
                           "<main id=\"main\"", "<p>then</p>", "one();", "two();"}) {
    const std::size_t next = html.find(part);
    ASSERT_NE(next, std::string::npos) << part;
    EXPECT_GT(next, at) << part;
    at = next;
  }
  EXPECT_THAT(html, Not(HasSubstr("src=")));
  EXPECT_THAT(html, Not(HasSubstr("https://")));
  const std::size_t name = html.find("http://");  // the XML namespace of SVG, which is not fetched
  EXPECT_EQ(name, html.find("http://www.w3.org/2000/svg"));
  EXPECT_EQ(html.find("http://", name + 1), std::string::npos);
}

TEST(PageShell, EmbedsPlotlyWithItsLicenceOnlyWhereItIsWanted) {
  PageShell shell;
  EXPECT_THAT(DrawShell(shell), Not(HasSubstr("id=\"plotly\"")));
  shell.plotly = true;
  const std::string html = DrawShell(shell);
  if (!PlotlyIsEmbedded()) {
    EXPECT_THAT(html, Not(HasSubstr("id=\"plotly\"")));
    GTEST_SKIP() << "this build has no Plotly";
  }
  EXPECT_THAT(html, HasSubstr("<script type=\"application/gzip\" id=\"plotly\">H4sI"));
  EXPECT_THAT(html, HasSubstr("Permission is hereby granted, free of charge"));
  EXPECT_LT(html.size(), 700000);
}

TEST(ScriptSafe, EndsNoScriptAndIsTheSameJson) {
  const std::string json = R"({"</script>":"<!--<script>","n":1})";
  const std::string safe = ScriptSafe(json);
  EXPECT_THAT(safe, Not(HasSubstr("<")));
  EXPECT_EQ(nlohmann::json::parse(safe), nlohmann::json::parse(json));
}

TEST(PackedText, IsUnpackedToTheSameInWhateverPartsItComes) {
  std::string text;
  for (int i = 0; i < 5000; ++i) text += std::to_string(i * i) + "\n";
  const std::string whole = Packed(text);
  EXPECT_LT(whole.size(), text.size() * 2 / 3);
  EXPECT_EQ(unpack::Gunzipped(unpack::FromBase64(whole)), text);
  EXPECT_EQ(Packed(text), whole);
  for (const std::size_t size : {1, 7, 1000}) {
    PackedText packed;
    std::string parts;
    for (std::size_t at = 0; at < text.size(); at += size)
      parts += packed.Add(text.substr(at, size));
    EXPECT_EQ(parts + packed.End(), whole);
  }
  EXPECT_EQ(unpack::Gunzipped(unpack::FromBase64(Packed(""))), "");
}

TEST(Base64, HasTheVectorsOfRfc4648) {
  EXPECT_EQ(Base64(""), "");
  EXPECT_EQ(Base64("f"), "Zg==");
  EXPECT_EQ(Base64("fo"), "Zm8=");
  EXPECT_EQ(Base64("foo"), "Zm9v");
  EXPECT_EQ(Base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(Base64("\xff\xfe\xfd"), "//79");
}

}  // namespace
}  // namespace lyrefit
