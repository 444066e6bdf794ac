#include "lyrefit/fleet/fleet_source.h"

#include <sys/stat.h>

#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "read_fleet.h"

namespace lyrefit {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::vector<double> kVoltage = {0, 10, 20, 30, 36};
const std::vector<double> kCurrent = {8.5, 8.49, 8.4, 6, 0.1};

// The one curve that GoodRow says, in whatever shape.
void ExpectGood(const FleetCurve& one, const std::string& id) {
  EXPECT_EQ(one.id, id);
  ASSERT_TRUE(one.curve) << MessageOf(one.curve);
  EXPECT_EQ(one.curve->voltage_V, kVoltage);
  EXPECT_EQ(one.curve->current_A, kCurrent);
  EXPECT_EQ(one.curve->conditions.irradiance_W_m2, 912);
  EXPECT_EQ(one.curve->conditions.cell_temperature_K, 47 + 273.15);
  EXPECT_EQ(one.curve->conditions.cells_in_series, 60);
  EXPECT_TRUE(one.curve->irradiance_known && one.curve->temperature_known);
  EXPECT_EQ(one.curve->name, id);
}

TEST(JsonRows, HoldACurveEachWithWhatStandsBeside) {
  const TempFolder folder;
  const std::string row = GoodRow("a/b/c");
  const std::string file =
      folder.Write("s.jsonl", row.substr(0, row.size() - 1) +
                                  R"(,"date":"2026-05-01","rated_power_W":320,"technology":"mono"})"
                                  "\n\n" +
                                  GoodRow("d"));
  const auto items = ReadFleet({file});
  ASSERT_EQ(items.size(), 2U);
  ExpectGood(items[0].curve, "a/b/c");
  ExpectGood(items[1].curve, "d");
  EXPECT_EQ(items[0].curve.curve->notes.technology, "mono");
  EXPECT_EQ(items[0].curve.beside.at("date"), "2026-05-01");
  EXPECT_EQ(items[0].curve.beside.at("rated_power_W"), "320");
  EXPECT_EQ(items[0].curve.beside.size(), 2U);
  EXPECT_EQ(items[1].item.where, file + ":3");
  EXPECT_EQ(items[0].curve.curve->source, file);
}

TEST(JsonRows, TakeOtherNamesUnitsAndNesting) {
  const TempFolder folder;
  const std::string file = folder.Write(
      "s.jsonl",
      R"x({"site":"p","string":7,"inverter":"i1","G":912,"T (K)":320.15,"cells":60,"V (mV)":[0,10000,20000,30000,36000],"I":["8.5","8.49","8.4",6,0.1]})x"
      "\n"
      R"({"name":"x","poa":912,"t_cell":47,"ns":60,"iv":{"voltage_V":[0,10,20,30,36],"current_A":[8.5,8.49,8.4,6,0.1]}})"
      "\n"
      R"({"voltage_V":[0,10,20,30,36],"current_A":[-8.5,-8.49,-8.4,-6,-0.1]})"
      "\n");
  const auto items = ReadFleet({file});
  ASSERT_EQ(items.size(), 3U);
  ExpectGood(items[0].curve, "p/i1/7");
  EXPECT_FALSE(items[0].curve.curve->current_unit_known);
  EXPECT_TRUE(items[0].curve.curve->voltage_unit_known);
  ASSERT_TRUE(items[1].curve.curve) << MessageOf(items[1].curve.curve);
  EXPECT_EQ(items[1].curve.id, "x");
  EXPECT_EQ(items[1].curve.curve->current_A, kCurrent);
  EXPECT_EQ(items[2].curve.id, "s:3");
  ASSERT_TRUE(items[2].curve.curve);
  EXPECT_EQ(items[2].curve.curve->current_A, kCurrent);  // load sign turned
  EXPECT_FALSE(items[2].curve.curve->irradiance_known);
}

TEST(CsvRows, HoldListsInManyWays) {
  const TempFolder folder;
  const std::string conditions = "912,47,60";
  const std::string file =
      folder.Write("rows.csv",
                   "\xef\xbb\xbfid,irradiance_W_m2,cell_temperature_C,cells_in_series,voltage_V,"
                   "current_A,note\r\n"
                   "a," +
                       conditions +
                       ",0 10 20 30 36,8.5 8.49 8.4 6 0.1,x\r\n"
                       "b," +
                       conditions +
                       ",0;10;20;30;36,8.5;8.49;8.4;6;0.1,\r\n"
                       "c," +
                       conditions +
                       ",0|10|20|30|36|,8.5|8.49|8.4|6|0.1|,\r\n"
                       "d," +
                       conditions +
                       ",\"[0, 10, 20, 30, 36]\",\"[8.5, 8.49, 8.4, 6, 0.1]\",\"a \"\"b\"\"\"\r\n"
                       "e," +
                       conditions +
                       ",\"8.5\",\r\n"
                       "f," +
                       conditions + ",[0. 10. 20. 30. 36.],[8.5 8.49 8.4 6. 0.1],y");
  const auto items = ReadFleet({file});
  ASSERT_EQ(items.size(), 6U);
  for (const int i : {0, 1, 2, 3, 5}) ExpectGood(items[i].curve, std::string(1, "abcdef"[i]));
  EXPECT_EQ(items[3].curve.beside.at("note"), "a \"b\"");
  EXPECT_THAT(items[4].curve.curve.error().ToString(),
              HasSubstr("rows.csv:6:1: expected 7 fields as in the header, found 6"));
}

TEST(CsvRows, HoldPairsInOneColumnAsSunsVocDoes) {
  const TempFolder folder;
  const std::string file =
      folder.Write("wbw.csv",
                   "tmst,ivdf,modt,poa\n"
                   "2016-05-01 10:00:00,V*I#0*8.5#10*8.49#20*8.4#30*6#36*0.1#,47,912\n"
                   "2016-05-01 10:05:00,I*V#8.5*0#8.49*10#8.4*20#6*30#0.1*36#,47,912\n"
                   "2016-05-01 10:10:00,NA,47,912\n");
  const auto items = ReadFleet({file});
  ASSERT_EQ(items.size(), 3U);
  for (const int i : {0, 1}) {
    ASSERT_TRUE(items[i].curve.curve) << MessageOf(items[i].curve.curve);
    EXPECT_EQ(items[i].curve.curve->voltage_V, kVoltage);
    EXPECT_EQ(items[i].curve.curve->current_A, kCurrent);
    EXPECT_EQ(items[i].curve.curve->conditions.irradiance_W_m2, 912);
    EXPECT_EQ(items[i].curve.curve->conditions.cell_temperature_K, 320.15);
  }
  EXPECT_EQ(items[0].curve.id, "wbw:2");
  EXPECT_EQ(items[0].curve.beside.at("tmst"), "2016-05-01 10:00:00");
  EXPECT_THAT(MessageOf(items[2].curve.curve), HasSubstr("found neither among"));
}

std::string LongRows(const std::string& ids) {
  std::string text;
  for (std::size_t i = 0; i < kVoltage.size(); ++i) {
    text += ids + ";912;47;60;" + std::to_string(kVoltage[i]) + ";" + std::to_string(kCurrent[i]) +
            ";2026-05-01\n";
  }
  return text;
}

constexpr char kLongHead[] = "site;inverter;string;irradiance;temperature_C;cells;V;I;date\n";

TEST(LongTable, HoldsCurvesWhoseRowsStandTogether) {
  const TempFolder folder;
  const std::string file =
      folder.Write("long.csv", "# exported\n" + (kLongHead + LongRows("p;1;1")) +
                                   LongRows("p;1;2") + "\n" + LongRows("p;2;1"));
  const auto items = ReadFleet({file});
  ASSERT_EQ(items.size(), 3U);
  ExpectGood(items[0].curve, "p/1/1");
  ExpectGood(items[1].curve, "p/1/2");
  ExpectGood(items[2].curve, "p/2/1");
  EXPECT_EQ(items[1].item.where, file + ":8");
  EXPECT_EQ(items[2].curve.beside.at("date"), "2026-05-01");
}

TEST(LongTable, RefusesWhatComesAgainAndSaysTheLineOfABadReading) {
  const TempFolder folder;
  const std::string file =
      folder.Write("long.csv", kLongHead + LongRows("p;1;1") +
                                   "p;1;2;912;47;60;0;8.5;\n\np;1;2;912;47;60;x;8.4;\n" +
                                   LongRows("p;1;1") + "p;1;3;912;47;60;0;8.5;\n");
  EXPECT_THAT(
      LinesOf(ReadFleet({file})),
      ElementsAre("p/1/1: ok",
                  "p/1/2: " + file + ":9:17: expected a finite number in \"V\"[1], found 'x'",
                  HasSubstr(":10: the id 'p/1/1' was used before, in " + file + ":2"),
                  HasSubstr(":15: expected at least two points, found 1")));
}

TEST(JsonList, GivesTheEntriesOfIvcurvesWithTheBrokenOnes) {
  const TempFolder folder;
  const std::string entry =
      R"(,"Temperature":320.15,"Irradiance":912,"Voltages":["0","10","20","30","36"],"Currents":[8.5,8.49,8.4,6,0.1]})";
  const std::string file = folder.Write(
      "case.json", "{\"Manufacturer\":\"x\",\n \"IV Curves\": [\n{\"Index\":1" + entry +
                       ",\n {\"Index\":2,\"Voltages\":[1],\n\"Currents\":[]}, 7,\n{\"Index\":4" +
                       entry + "], \"cells_in_series\": 60}");
  const auto items = ReadFleet({file});
  ASSERT_EQ(items.size(), 4U);
  const std::string stem = items[0].curve.id.substr(0, items[0].curve.id.size() - 2);
  ExpectGood(items[0].curve, stem + "_1");
  EXPECT_EQ(stem.substr(stem.size() - 5), "/case");
  EXPECT_THAT(items[1].curve.curve.error().ToString(),
              HasSubstr(":4: expected as many Currents as Voltages in \"IV Curves\"[1]"));
  EXPECT_THAT(MessageOf(items[2].curve.curve), HasSubstr("expected a curve that begins with '{'"));
  ExpectGood(items[3].curve, stem + "_4");
}

TEST(JsonList, GivesObjectsOfAListAndSaysWhereItIsCut) {
  const TempFolder folder;
  const std::string whole = "[" + GoodRow("a") + ",\n" + GoodRow("b") + "]";
  EXPECT_THAT(LinesOf(ReadFleet({folder.Write("l.json", whole)})), ElementsAre("a: ok", "b: ok"));
  const std::string around = R"({"irradiance_W_m2":912,"strings":[)" + GoodRow("a") + "]}";
  EXPECT_THAT(LinesOf(ReadFleet({folder.Write("m.json", around)})), ElementsAre("a: ok"));
  EXPECT_THAT(
      LinesOf(ReadFleet({folder.Write("n.json", whole.substr(0, whole.size() - 9))})),
      ElementsAre("a: ok", HasSubstr("it is cut off"), HasSubstr("the list of curves is cut off")));
}

TEST(JsonWhole, GivesAllCurvesOfADocumentOfAnyShape) {
  const std::string data = std::string(LYREFIT_DATA_DIR) + "/formats/";
  const auto items = ReadFleet({data + "nomad.json", data + "records.json", data + "plain.csv"});
  ASSERT_EQ(items.size(), 4U);
  for (const ReadItem& one : items) EXPECT_TRUE(one.curve.curve) << MessageOf(one.curve.curve);
}

void WriteTree(const TempFolder& folder) {
  const std::string table = "voltage_V,current_A\n0,8.5\n10,8.49\n20,8.4\n30,6\n36,0.1\n";
  const std::string sidecar =
      R"({"cells_in_series":60,"nominal_temperature_C":47,"nominal_irradiance_Wm2":912})";
  for (const char* name : {"t/inv10/str1", "t/inv2/str10", "t/inv2/str9"}) {
    folder.Write(std::string(name) + ".csv", table);
    folder.Write(std::string(name) + ".json", sidecar);
  }
  folder.Write("t/inv2/str11/curve.csv", table);
  folder.Write("t/inv2/broken.txt", "nothing\n");
  folder.Write("t/inv2/.hidden.csv", table);
  folder.Write("t/inv2/index.csv", "a,b\n");
  folder.Write("t/inv2/photo.jpg", "x");
  folder.Write("t/inv2/empty.csv", "");
}

TEST(Tree, PathsAreTheIdsInNaturalOrder) {
  const TempFolder folder;
  WriteTree(folder);
  const auto items = ReadFleet({folder.Path("t")});
  EXPECT_THAT(IdsOf(items), ElementsAre("inv2/broken", "inv2/empty", "inv2/str9", "inv2/str10",
                                        "inv2/str11", "inv10/str1"));
  ASSERT_TRUE(items[2].curve.curve);
  EXPECT_EQ(items[2].curve.curve->conditions.cells_in_series, 60);
  EXPECT_EQ(items[2].curve.curve->voltage_V, kVoltage);
  EXPECT_THAT(MessageOf(items[0].curve.curve), HasSubstr("expected a header"));
  EXPECT_THAT(MessageOf(items[1].curve.curve), HasSubstr("the file is empty"));
  const auto source = OpenFleet({folder.Path("t")});
  EXPECT_THAT((*source)->Remarks(),
              ElementsAre(HasSubstr("1 file of other kinds left aside (1 .jpg)")));
}

TEST(Tree, SaysLoopsDeadLinksAndClosedFolders) {
  const TempFolder folder;
  WriteTree(folder);
  namespace fs = std::filesystem;
  fs::create_directory_symlink(folder.Path("t"), folder.Path("t/inv10/again"));
  fs::create_symlink("nowhere", folder.Path("t/inv10/dead.csv"));
  fs::create_directory(folder.Path("t/zlocked"));
  ::chmod(folder.Path("t/zlocked").c_str(), 0);
  const auto lines = LinesOf(ReadFleet({folder.Path("t")}));
  ::chmod(folder.Path("t/zlocked").c_str(), 0700);
  EXPECT_THAT(lines,
              Contains(HasSubstr("the folder is a link that leads back to " + folder.Path("t"))));
  EXPECT_THAT(lines, Contains(HasSubstr("dead.csv: the link leads nowhere")));
  if (::geteuid() != 0) {
    EXPECT_THAT(lines, Contains(HasSubstr("cannot read the folder: Permission denied")));
  }
}

TEST(Fleet, SeveralInputsStandOneBehindTheOther) {
  const TempFolder folder;
  WriteTree(folder);
  const std::string rows = folder.Write("a.jsonl", GoodRow("x") + "\n" + GoodRow("inv10/str1"));
  const auto lines = LinesOf(ReadFleet({rows, folder.Path("t")}));
  ASSERT_EQ(lines.size(), 8U);
  EXPECT_EQ(lines[0], "x: ok");
  EXPECT_THAT(lines[7], HasSubstr("the id 'inv10/str1' was used before, in " + rows + ":2"));
  // Their names tell folders apart.
  folder.Write("u/s.csv", "V,I\n0,1\n1,0\n");
  EXPECT_THAT(IdsOf(ReadFleet({folder.Path("u") + "/", folder.Path("t")})), Contains("u/s"));
}

TEST(Examples, EveryShapeHoldsTheSameCurves) {
  const std::string folder = std::string(LYREFIT_DATA_DIR) + "/formats/fleet/";
  const auto rows = ReadFleet({folder + "rows.jsonl"});
  ASSERT_EQ(rows.size(), 3U);
  for (const char* name :
       {"rows.csv", "pairs.csv", "long.csv", "list.json", "ivcurves.json", "tree"}) {
    SCOPED_TRACE(name);
    const auto items = ReadFleet({folder + name});
    ASSERT_EQ(items.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_TRUE(items[i].curve.curve) << MessageOf(items[i].curve.curve);
      ASSERT_TRUE(rows[i].curve.curve);
      const IvCurve& curve = *items[i].curve.curve;
      const IvCurve& same = *rows[i].curve.curve;
      EXPECT_EQ(curve.voltage_V, same.voltage_V);
      EXPECT_EQ(curve.current_A, same.current_A);
      EXPECT_EQ(curve.conditions.irradiance_W_m2, same.conditions.irradiance_W_m2);
      EXPECT_NEAR(curve.conditions.cell_temperature_K, same.conditions.cell_temperature_K, 1e-9);
      EXPECT_EQ(curve.conditions.cells_in_series, 60);
      if (name == std::string("ivcurves.json")) continue;  // has but numbers
      const std::string id = rows[i].curve.id;
      EXPECT_EQ(items[i].curve.id, name == std::string("tree") ? id.substr(6) : id);
      EXPECT_EQ(items[i].curve.beside.at("date"), "2026-05-01");
    }
  }
}

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
    const auto items = ReadFleet({folder.Write("b.jsonl", row + "\n" + GoodRow("good"))});
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
  FleetReadOptions options;
  options.reading.skip_missing = true;
  const auto items = ReadFleet({file}, options);
  ASSERT_TRUE(items.at(0).curve.curve);
  EXPECT_EQ(items[0].curve.curve->voltage_V, kVoltage);
  EXPECT_THAT(SentencesOf(items[0].curve.curve->assumptions),
              Contains("1 of 6 rows without a reading left out"));
}

TEST(BrokenRows, UnsortedReadingsAreKeptAndTurnedOnesSaid) {
  const TempFolder folder;
  const auto items = ReadFleet({folder.Write(
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
  FleetReadOptions options;
  options.reading.largest_file_bytes = 1 << 20;
  const std::string text = GoodRow("a") + "\n" + huge + "\n" + GoodRow("b") + "\n" + huge;
  EXPECT_THAT(
      LinesOf(ReadFleet({folder.Write("h.jsonl", text)}, options)),
      ElementsAre("a: ok", HasSubstr(":2: the row is longer than the limit of 1048576 bytes"),
                  "b: ok", HasSubstr(":4: the row is longer")));
}

TEST(BrokenRows, ARepeatedIdNamesTheFirstPlaceInAnyShard) {
  const TempFolder folder;
  std::string text;
  for (int i = 0; i < 40; ++i) text += GoodRow(std::to_string(i % 37)) + "\n";
  const std::string file = folder.Write("r.jsonl", text);
  FleetReadOptions last;
  last.shard = {4, 4};
  const auto lines = LinesOf(ReadFleet({file}, last));
  EXPECT_THAT(lines.back(),
              HasSubstr("r.jsonl:40: the id '2' was used before, in " + file + ":3: every curve"));
}

TEST(BrokenInput, IsAnErrorOfItsOwn) {
  const TempFolder folder;
  const auto refusal = [](const std::string& path) { return MessageOf(OpenFleet({path})); };
  EXPECT_THAT(refusal(folder.Path("none")), HasSubstr("does not exist"));
  EXPECT_THAT(refusal(folder.Write("u.jsonl", std::string("\xff\xfe{\0\n\0", 6))),
              HasSubstr("UTF-16"));
  EXPECT_THAT(refusal(folder.Write("n.csv", "a,0 1 2,3 2 1\nb,0 1 2,3 2 1\n")),
              HasSubstr("expected a header that names the columns"));
  folder.Write("e/photo.jpg", "x");
  EXPECT_THAT(refusal(folder.Path("e")), HasSubstr("found none"));
  EXPECT_EQ(MessageOf(OpenFleet({})), "no input");
  FleetReadOptions options;
  options.shard = {3, 2};
  EXPECT_THAT(MessageOf(OpenFleet({folder.Path("e")}, options)), HasSubstr("found 3/2"));
  EXPECT_THAT(ReadFleet({folder.Write("empty.jsonl", "\n\n")}), ::testing::IsEmpty());
}

// The same items in the same order, however many shards.
void ExpectSameInShards(const std::vector<std::string>& inputs) {
  const std::vector<std::string> whole = LinesOf(ReadFleet(inputs));
  for (const int of : {1, 3, 8}) {
    std::vector<std::string> parts;
    std::int64_t size = 0;
    for (int k = 1; k <= of; ++k) {
      FleetReadOptions options;
      options.shard = {k, of};
      const auto lines = LinesOf(ReadFleet(inputs, options));
      parts.insert(parts.end(), lines.begin(), lines.end());
      size += (*OpenFleet(inputs, options))->size();
    }
    EXPECT_EQ(parts, whole) << of;
    EXPECT_EQ(size, (*OpenFleet(inputs))->size());
  }
}

TEST(Shards, TogetherGiveWhatOneRunGives) {
  const TempFolder folder;
  WriteTree(folder);
  std::string rows;
  std::string table = kLongHead;
  std::string list = "[";
  for (int i = 0; i < 30; ++i) {
    const std::string id = std::to_string(i % 28);
    rows += i % 7 == 3 ? "{broken\n" : GoodRow(id) + "\n";
    table += LongRows("p;" + id + ";1");
    list += (i == 0 ? "\n" : ",\n") + GoodRow(id);
  }
  const std::string jsonl = folder.Write("r.jsonl", rows);
  const std::string csv = folder.Write("l.csv", table);
  const std::string json = folder.Write("l.json", list + "]");
  ExpectSameInShards({jsonl});
  ExpectSameInShards({csv});
  ExpectSameInShards({json});
  ExpectSameInShards({folder.Path("t")});
  ExpectSameInShards({folder.Path("t"), csv, jsonl, json});
}

TEST(Digest, ChangesWithTheBytesAndNamesOfTheShard) {
  const TempFolder folder;
  WriteTree(folder);
  const auto digest = [](const std::string& path, Shard shard) {
    FleetReadOptions options;
    options.shard = shard;
    return (*OpenFleet({path}, options))->Digest().value();
  };
  const std::string file = folder.Write("r.jsonl", GoodRow("a") + "\n" + GoodRow("b") + "\n");
  const std::string before = digest(file, {});
  EXPECT_EQ(digest(file, {}), before);
  const std::string first = digest(file, {1, 2});
  EXPECT_NE(first, before);
  folder.Write("r.jsonl", GoodRow("a") + "\n" + GoodRow("c") + "\n");
  EXPECT_NE(digest(file, {}), before);
  EXPECT_EQ(digest(file, {1, 2}), first);  // its bytes are the same
  const std::string tree = digest(folder.Path("t"), {});
  folder.Write("t/inv2/str9.json", R"({"cells_in_series":72})");
  const std::string other = digest(folder.Path("t"), {});
  EXPECT_NE(other, tree);
  std::filesystem::rename(folder.Path("t/inv2/str9.csv"), folder.Path("t/inv2/str8.csv"));
  EXPECT_NE(digest(folder.Path("t"), {}), other);
}

// Cut anywhere, a file gives what is whole and says what is not.
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
      const auto source = OpenFleet({file});
      if (!source) continue;  // said as such
      const auto items = ReadFleet({file});
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
      const auto items = ReadFleet({folder.Write("r.jsonl", text)});
      ASSERT_EQ(items.size(), 2U) << at << " " << static_cast<int>(c);
    }
  }
}

}  // namespace
}  // namespace lyrefit
