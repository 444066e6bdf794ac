#include "lyrefit/report/page_shell.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <nlohmann/json.hpp>

#include "well_formed.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::string Unpacked(const std::string& packed, std::size_t size) {
  std::string text(size + 1, '\0');
  z_stream stream = {};
  EXPECT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(text.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  text.resize(stream.total_out);
  inflateEnd(&stream);
  return text;
}

std::string FromBase64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int have = 0;
  for (const char c : text) {
    const std::size_t digit = digits.find(c);
    if (digit == std::string::npos) break;
    bits = bits << 6 | static_cast<unsigned>(digit);
    have += 6;
    if (have >= 8) bytes += static_cast<char>(bits >> (have -= 8) & 0xff);
  }
  return bytes;
}

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
  EXPECT_EQ(Unpacked(FromBase64(whole), text.size()), text);
  EXPECT_EQ(Packed(text), whole);
  for (const std::size_t size : {1, 7, 1000}) {
    PackedText packed;
    std::string parts;
    for (std::size_t at = 0; at < text.size(); at += size)
      parts += packed.Add(text.substr(at, size));
    EXPECT_EQ(parts + packed.End(), whole);
  }
  EXPECT_EQ(Unpacked(FromBase64(Packed("")), 0), "");
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
