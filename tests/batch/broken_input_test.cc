#include <algorithm>

#include "lyrefit/stream/batch_source.h"
#include "read_batch.h"

// Malformed rows, files and bytes: each row keeps its place and gets a reason.

namespace lyrefit {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

TEST(BrokenRows, EachHasItsReasonAndItsPlace) {
  const TempFolder folder;
  const auto with = [](const std::string& voltage, const std::string& current) {
    return R"({"id":"x","voltage_V":)" + voltage + R"(,"current_A":)" + current + "}";
  };
  const std::pair<std::string, std::string> cases[] = {
      {with("[0,10,20]", "[8,NaN,0]"),
       ":1:48: expected a finite number in \"current_A\"[1], found 'NaN': if "},
      {with("[0,10,20]", "[8,null,0]"), "found 'null': if readings are missing"},
      {with("[0,10,20]", "[8,1e999,0]"), "found '1e999'"},
      {with("[0,10,20]", "[8,9.91e37,0]"), "found '9.91e37'"},
      {with("[]", "[]"), "expected at least two points, found 0"},
      {with("[1]", "[2]"), "expected at least two points, found 1"},
      {with("[1,1]", "[2,3]"), "expected at least two different voltages"},
      {with("[0,10,20]", R"([8,"abc",0])"),
       ":1:48: expected a finite number in \"current_A\"[1], found 'abc'"},
      {with("[0,10,20]", "[8,7..1,0]"), "expected a number in \"current_A\"[1], found '7..1'"},
      {with("[0,10,20]", "[8,7]"),
       ":1:45: expected as many values in \"current_A\" as in \"voltage_V\", found 2 and 3"},
      {R"({"id":"x","voltage_V":[0,1,2]})", "found no current among 'voltage_V', 'id'"},
      {R"({"id":"x"})", "found neither among 'id'"},
      {"{}", "found neither among nothing"},
      {R"({"id":"x","voltage_percent":[0,1,2],"current_A":[1,1,0]})",
       "column 'voltage_percent' is in 'percent'"},
      {R"({"id":"x","T":320,"voltage_V":[0,1,2],"current_A":[1,1,0]})", "(it looks like kelvin"},
      {R"({"id":"x","cells_in_series":"many","voltage_V":[0,1,2],"current_A":[1,1,0]})",
       "expected a number in \"cells_in_series\""},
      {with("[0,10,20]", "[8,7,0]").substr(0, 29),
       ":1:30: expected ',' or ']', found the end of the row"},
      {with("[0,10,20]", "[8,7,0]") + " x", "expected the end of the row, found 'x'"},
      {"hello", ":1:1: expected a JSON object that begins with '{', found 'h'"},
      {std::string("{\"id\":\"x\0\"}", 11), ":1:9: expected text, found a zero byte"},
      {"{\"id\":\"\xff\",\"v\":[1,2]}", "expected a text in UTF-8"},
  };
  for (const auto& [row, reason] : cases) {
    const auto items = ReadBatch({folder.Write("b.jsonl", row + "\n" + GoodRow("good"))});
    ASSERT_EQ(items.size(), 2U) << row;
    ASSERT_FALSE(items[0].curve.curve) << row;
    EXPECT_THAT(items[0].curve.curve.error().ToString(), HasSubstr(reason)) << row;
    EXPECT_THAT(items[0].curve.curve.error().ToString(), HasSubstr("b.jsonl:1")) << row;
    ExpectGood(items[1].curve, "good");
  }
}

TEST(BrokenRows, MissingReadingsCanBeLeftOut) {
  const TempFolder folder;
  const std::string file = folder.Write(
      "b.jsonl",
      R"({"id":"x","voltage_V":[0,5,10,20,30,36],"current_A":[8.5,NaN,8.49,8.4,6,0.1]})");
  BatchReadOptions options;
  options.reading.skip_missing = true;
  const auto items = ReadBatch({file}, options);
  ASSERT_TRUE(items.at(0).curve.curve);
  EXPECT_EQ(items[0].curve.curve->voltage_V, kVoltage);
  EXPECT_THAT(SentencesOf(items[0].curve.curve->assumptions),
              Contains("1 of 6 rows without a reading left out"));
}

TEST(BrokenRows, UnsortedReadingsAreKeptAndTurnedOnesSaid) {
  const TempFolder folder;
  const auto items = ReadBatch({folder.Write(
      "b.jsonl",
      R"({"id":"u","voltage_V":[20,0,36,10,30],"current_A":[8.4,8.5,0.1,8.49,6]})"
      "\n"
      R"({"id":"t","voltage_V":[36,30,20,10,0],"current_A":[-0.1,-6,-8.4,-8.49,-8.5]})")});
  ASSERT_EQ(items.size(), 2U);
  ASSERT_TRUE(items[0].curve.curve);
  EXPECT_EQ(items[0].curve.curve->voltage_V, (std::vector<double>{20, 0, 36, 10, 30}));
  ASSERT_TRUE(items[1].curve.curve);
  EXPECT_THAT(SentencesOf(items[1].curve.curve->assumptions),
              Contains(HasSubstr("their sign was turned")));
}

TEST(BrokenRows, ARowBeyondTheLimitIsPassedBy) {
  const TempFolder folder;
  std::string huge = GoodRow("huge");
  huge.insert(huge.size() - 1, ",\"note\":\"" + std::string(3 << 20, 'x') + "\"");
  BatchReadOptions options;
  options.reading.largest_file_bytes = 1 << 20;
  const std::string text = GoodRow("a") + "\n" + huge + "\n" + GoodRow("b") + "\n" + huge;
  EXPECT_THAT(
      LinesOf(ReadBatch({folder.Write("h.jsonl", text)}, options)),
      ElementsAre("a: ok", HasSubstr(":2: the row is longer than the limit of 1048576 bytes"),
                  "b: ok", HasSubstr(":4: the row is longer")));
}

TEST(BrokenRows, ARepeatedIdNamesTheFirstPlaceInAnyShard) {
  const TempFolder folder;
  std::string text;
  for (int i = 0; i < 40; ++i) text += GoodRow(std::to_string(i % 37)) + "\n";
  const std::string file = folder.Write("r.jsonl", text);
  BatchReadOptions last;
  last.shard = {4, 4};
  const auto lines = LinesOf(ReadBatch({file}, last));
  EXPECT_THAT(lines.back(),
              HasSubstr("r.jsonl:40: the id '2' was used before, in " + file + ":3: every curve"));
}

TEST(BrokenInput, IsAnErrorOfItsOwn) {
  const TempFolder folder;
  const auto refusal = [](const std::string& path) { return MessageOf(OpenBatch({path})); };
  EXPECT_THAT(refusal(folder.Path("none")), HasSubstr("does not exist"));
  EXPECT_THAT(refusal(folder.Write("u.jsonl", std::string("\xff\xfe{\0\n\0", 6))),
              HasSubstr("UTF-16"));
  EXPECT_THAT(refusal(folder.Write("n.csv", "a,0 1 2,3 2 1\nb,0 1 2,3 2 1\n")),
              HasSubstr("expected a header that names the columns"));
  folder.Write("e/photo.jpg", "x");
  EXPECT_THAT(refusal(folder.Path("e")), HasSubstr("found none"));
  EXPECT_EQ(MessageOf(OpenBatch({})), "no input");
  BatchReadOptions options;
  options.shard = {3, 2};
  EXPECT_THAT(MessageOf(OpenBatch({folder.Path("e")}, options)), HasSubstr("found 3/2"));
  const auto empty = OpenBatch({folder.Write("empty.jsonl", "\n\n")});
  ASSERT_TRUE(empty);
  EXPECT_EQ(MessageOf((*empty)->Next()), "expected at least one curve, found none");
}

// A truncated file gives all complete rows, and an error for the incomplete one.
TEST(Hostile, AFileCutAnywhereLosesNoRow) {
  const TempFolder folder;
  const std::string rows = GoodRow("a") + "\n" + GoodRow("b") + "\n" + GoodRow("c") + "\n";
  const std::string head = "id,voltage_V,current_A\n";
  const std::string csv = head + "a,0 10 20,3 2 0\nb,0 10 20,3 2 0\nc,\"0 10 20\",3 2 0\n";
  const std::string list = "{\"IV Curves\": [" + GoodRow("a") + "," + GoodRow("b") + "]}";
  const std::string table = "string,V,I\n1,0,3\n1,9,0\n2,0,3\n2,9,0\n";
  for (const auto& [name, text] : {std::pair("r.jsonl", rows), std::pair("r.csv", csv),
                                   std::pair("l.json", list), std::pair("t.csv", table)}) {
    for (std::size_t size = 0; size <= text.size(); ++size) {
      const std::string cut = text.substr(0, size);
      const std::string file = folder.Write(name, cut);
      const auto source = OpenBatch({file});
      if (!source) continue;  // refused with an error
      const auto items = ReadBatch({file});
      if (name != std::string("r.jsonl")) continue;
      const auto whole = std::count(cut.begin(), cut.end(), '\n');
      const bool half = !cut.empty() && cut.back() != '\n';
      ASSERT_EQ(items.size(), static_cast<std::size_t>(whole + (half ? 1 : 0))) << size;
      for (int i = 0; i < whole; ++i) ASSERT_TRUE(items[i].curve.curve) << size;
    }
  }
}

TEST(Hostile, AnyByteAnywhereLosesNoRow) {
  const TempFolder folder;
  const std::string rows = GoodRow("a") + "\n" + GoodRow("b") + "\n";
  for (const char c : {'\0', '"', '\\', '{', ']', '\xff', ',', '-'}) {
    for (std::size_t at = 0; at + 1 < rows.size(); at += 3) {
      std::string text = rows;
      if (text[at] == '\n') continue;
      text[at] = c;
      const auto items = ReadBatch({folder.Write("r.jsonl", text)});
      ASSERT_EQ(items.size(), 2U) << at << " " << static_cast<int>(c);
    }
  }
}

}  // namespace
}  // namespace lyrefit
