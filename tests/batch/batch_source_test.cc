#include "lyrefit/stream/batch_source.h"

#include <sys/stat.h>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "cases.h"
#include "read/told.h"
#include "read_batch.h"

namespace lyrefit {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(BatchSource, ReadsRowsListsAndTrees) {
  CheckCases("batch_sources",
             {{"rows", [](const std::string& given) {
                 return OfFiles(given, [](const std::string& path, const ReadOptions&) {
                   std::string told;
                   for (const ReadItem& one : ReadBatch({path})) {
                     told +=
                         (told.empty() ? "" : "\n") + one.item.where + " '" + one.curve.id + "': ";
                     told += ToldOrError(one.curve.curve);
                     for (const auto& [name, text] : one.curve.beside)
                       told += "; beside " + name + "=" + text;
                   }
                   const auto source = OpenBatch({path});
                   for (const std::string& remark : (*source)->Remarks()) told += "\n" + remark;
                   return told;
                 });
               }}});
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

TEST(WholeFile, GivesAllCurvesOfADocumentOrTableOfAnyShape) {
  const std::string data = std::string(LYREFIT_DATA_DIR) + "/formats/";
  const auto items = ReadBatch({data + "nomad.json", data + "records.json", data + "plain.csv",
                                data + "sweeps_of_directions.json", data + "named_lists.json",
                                data + "pixels_names_units.txt", data + "matrix_wide.csv"});
  ASSERT_EQ(items.size(), 14U);
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

TEST(Tree, SaysLoopsDeadLinksAndClosedFolders) {
  const TempFolder folder;
  WriteTree(folder);
  namespace fs = std::filesystem;
  fs::create_directory_symlink(folder.Path("t"), folder.Path("t/inv10/again"));
  fs::create_symlink("nowhere", folder.Path("t/inv10/dead.csv"));
  fs::create_directory(folder.Path("t/zlocked"));
  ::chmod(folder.Path("t/zlocked").c_str(), 0);
  const auto lines = LinesOf(ReadBatch({folder.Path("t")}));
  ::chmod(folder.Path("t/zlocked").c_str(), 0700);
  EXPECT_THAT(lines,
              Contains(HasSubstr("the folder is a link that leads back to " + folder.Path("t"))));
  EXPECT_THAT(lines, Contains(HasSubstr("dead.csv: the link leads nowhere")));
  if (::geteuid() != 0) {
    EXPECT_THAT(lines, Contains(HasSubstr("cannot read the folder: Permission denied")));
  }
}

TEST(Batch, SeveralInputsStandOneBehindTheOther) {
  const TempFolder folder;
  WriteTree(folder);
  const std::string rows = folder.Write("a.jsonl", GoodRow("x") + "\n" + GoodRow("inv10/str1"));
  const auto lines = LinesOf(ReadBatch({rows, folder.Path("t")}));
  ASSERT_EQ(lines.size(), 8U);
  EXPECT_EQ(lines[0], "x: ok");
  EXPECT_THAT(lines[7], HasSubstr("the id 'inv10/str1' was used before, in " + rows + ":2"));
  // The folder name makes the ids of several folders unique.
  folder.Write("u/s.csv", "V,I\n0,1\n1,0\n");
  EXPECT_THAT(IdsOf(ReadBatch({folder.Path("u") + "/", folder.Path("t")})), Contains("u/s"));
}

TEST(Examples, EveryShapeHoldsTheSameCurves) {
  const std::string folder = std::string(LYREFIT_DATA_DIR) + "/formats/batch/";
  const auto rows = ReadBatch({folder + "rows.jsonl"});
  ASSERT_EQ(rows.size(), 3U);
  for (const char* name :
       {"rows.csv", "pairs.csv", "long.csv", "list.json", "ivcurves.json", "tree"}) {
    SCOPED_TRACE(name);
    const auto items = ReadBatch({folder + name});
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
      if (name == std::string("ivcurves.json")) continue;  // holds numbers only
      const std::string id = rows[i].curve.id;
      EXPECT_EQ(items[i].curve.id, name == std::string("tree") ? id.substr(6) : id);
      EXPECT_EQ(items[i].curve.beside.at("date"), "2026-05-01");
    }
  }
}

// The shards together have the same items in the same order as the whole input.
void ExpectSameInShards(const std::vector<std::string>& inputs) {
  const std::vector<std::string> whole = LinesOf(ReadBatch(inputs));
  for (const int of : {1, 3, 8}) {
    std::vector<std::string> parts;
    std::int64_t size = 0;
    for (int k = 1; k <= of; ++k) {
      BatchReadOptions options;
      options.shard = {k, of};
      const auto lines = LinesOf(ReadBatch(inputs, options));
      parts.insert(parts.end(), lines.begin(), lines.end());
      size += (*OpenBatch(inputs, options))->size();
    }
    EXPECT_EQ(parts, whole) << of;
    EXPECT_EQ(size, (*OpenBatch(inputs))->size());
  }
}

TEST(Shards, TogetherGiveWhatOneRunGives) {
  const TempFolder folder;
  WriteTree(folder);
  folder.Write("t/inv3/pixels.csv", "V,I1,I2,I3\n0,9,8,7\n0.4,8,7,6\n0.6,0,0,0\n");
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
    BatchReadOptions options;
    options.shard = shard;
    return (*OpenBatch({path}, options))->Digest().value();
  };
  const std::string file = folder.Write("r.jsonl", GoodRow("a") + "\n" + GoodRow("b") + "\n");
  const std::string before = digest(file, {});
  EXPECT_EQ(digest(file, {}), before);
  const std::string first = digest(file, {1, 2});
  EXPECT_NE(first, before);
  folder.Write("r.jsonl", GoodRow("a") + "\n" + GoodRow("c") + "\n");
  EXPECT_NE(digest(file, {}), before);
  EXPECT_EQ(digest(file, {1, 2}), first);  // the bytes of this shard are unchanged
  const std::string tree = digest(folder.Path("t"), {});
  folder.Write("t/inv2/str9.json", R"({"cells_in_series":72})");
  const std::string other = digest(folder.Path("t"), {});
  EXPECT_NE(other, tree);
  std::filesystem::rename(folder.Path("t/inv2/str9.csv"), folder.Path("t/inv2/str8.csv"));
  EXPECT_NE(digest(folder.Path("t"), {}), other);
}

// A pipe can be read only once, so opening the batch must not consume any of it.
TEST(Pipes, GiveEveryRow) {
  const TempFolder folder;
  const std::string pipe = folder.Path("rows.jsonl");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::string rows;
  for (int i = 0; i < 500; ++i) rows += GoodRow(std::to_string(i)) + "\n";
  std::thread writer([&] {
    std::ofstream(pipe) << rows << R"({"voltage_V":[1]})"
                        << "\n";
  });
  const auto source = OpenBatch({pipe});
  ASSERT_TRUE(source) << MessageOf(source);
  EXPECT_EQ(*(*source)->Digest(), "") << "cannot be known without reading it";
  EXPECT_EQ((*source)->size(), 0);
  std::string last;
  int count = 0;
  for (auto item = (*source)->Next(); item && *item; item = (*source)->Next()) {
    last = (*item)->id;
    ++count;
  }
  writer.join();
  EXPECT_EQ(count, 501);
  EXPECT_EQ(last, "input:501") << "as on standard input";
  BatchReadOptions part;
  part.shard = {1, 2};
  EXPECT_THAT(MessageOf(OpenBatch({pipe}, part)), HasSubstr("cannot be split into shards"));
}

TEST(Pipes, AreBrokenRowsOfAFolder) {
  const TempFolder folder;
  folder.Write("t/b.csv", "V,I\n0,8\n10,8\n20,7.9\n30,6\n36,0\n");
  ASSERT_EQ(mkfifo(folder.Path("t/a.csv").c_str(), 0600), 0);
  ASSERT_EQ(mkfifo(folder.Path("t/b.json").c_str(), 0600), 0);  // a sidecar
  const auto items = ReadBatch({folder.Path("t")});
  ASSERT_THAT(IdsOf(items), ElementsAre("a", "b"));
  for (const ReadItem& one : items)
    EXPECT_EQ(MessageOf(one.curve.curve), "expected a file, found a pipe, a socket or a device");
}

TEST(Inputs, WithoutAnyCurveAreRefused) {
  const TempFolder folder;
  for (const char* text : {"", "\n\n"}) {
    const auto source = OpenBatch({folder.Write("none.jsonl", text)});
    ASSERT_TRUE(source) << MessageOf(source);
    EXPECT_EQ(MessageOf((*source)->Next()), "expected at least one curve, found none");
  }
}

}  // namespace
}  // namespace lyrefit
