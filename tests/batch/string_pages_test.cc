#include "lyrefit/batch/string_pages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "strings.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

// A task with a page that shows the seed. A curve fails if its seed is divisible by three.
BatchTaskType PagedTask() {
  BatchTaskType task = CountTask();
  task.run = [run = task.run](const BatchCurve& curve, std::uint64_t seed,
                              const Observer& observer) {
    TaskResult result = run(curve, seed, observer);
    result.failed = seed % 3 == 0;
    result.page = [seed](const PageOptions&) { return "<p>" + std::to_string(seed) + "</p>"; };
    return result;
  };
  return task;
}

// Paths and contents of all pages in a folder.
std::string PagesIn(const std::string& folder) {
  std::set<std::string> all;
  std::error_code error;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(folder + "/pages", error)) {
    if (!entry.is_regular_file()) continue;
    all.insert(entry.path().lexically_relative(folder).string() + FileText(entry.path().string()));
  }
  std::string text;
  for (const std::string& page : all) text += page;
  return text;
}

std::size_t Count(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(StringPagePath, IsReadable) {
  EXPECT_EQ(StringPagePath("elm/inv01/str07"), "pages/elm/inv01/str07.html");
  EXPECT_EQ(StringPagePath("INV01/a b"), "pages/INV01~.7/a~20b.html");
  EXPECT_EQ(StringPagePath("../.."), "pages/~2e~2e/~2e~2e.html");
}

TEST(StringPagePath, IsThatOfNoOtherIdEvenWhereCapitalsDoNotCount) {
  const std::vector<std::string> ids = {"",
                                        "/",
                                        "a",
                                        "A",
                                        "a/b",
                                        "A/b",
                                        "a/B",
                                        "a~2fb",
                                        "a.b",
                                        "a.html",
                                        "a.html/b",
                                        "a/",
                                        "/a",
                                        ".",
                                        "..",
                                        "a~.1",
                                        "aB",
                                        "Ab",
                                        "AB",
                                        "a b",
                                        "a%20b",
                                        "a\\b",
                                        "\xc3\xa9",
                                        "e",
                                        std::string(120, 'a'),
                                        std::string(121, 'a'),
                                        std::string(122, 'a'),
                                        std::string(120, 'a') + "/a",
                                        std::string(121, 'a') + "/a",
                                        std::string(60, 'A'),
                                        std::string(120, 'A'),
                                        StringPagePath(std::string(121, 'a')).substr(6, 38)};
  std::set<std::string> paths, folders;
  for (const std::string& id : ids) {
    std::string path = StringPagePath(id);
    EXPECT_TRUE(std::all_of(path.begin(), path.end(), [](unsigned char c) {
      return std::isalnum(c) || c == '/' || c == '.' || c == '_' || c == '-' || c == '~';
    })) << path;
    EXPECT_EQ(path.find("/."), std::string::npos) << path;
    EXPECT_EQ(path.find("//"), std::string::npos) << path;
    std::transform(path.begin(), path.end(), path.begin(), ::tolower);
    EXPECT_TRUE(paths.insert(path).second) << id << " " << path;
    for (auto at = path.find('/'); at != std::string::npos; at = path.find('/', at + 1)) {
      folders.insert(path.substr(0, at));
    }
  }
  for (const std::string& path : paths) EXPECT_EQ(folders.count(path), 0U) << path;
}

TEST(StringPages, AreThoseThatWereAskedForWhateverTheThreads) {
  const TempFolder folder;
  const std::string file = folder.Write("s.jsonl", ManyRows(40));
  std::string pages[3];
  for (const PagesOf which : {PagesOf::kNone, PagesOf::kFailed, PagesOf::kAll}) {
    for (const int threads : {1, 4}) {
      const std::string out = folder.Path(ToText(which) + std::to_string(threads));
      BatchOptions options = Into(out, threads);
      options.pages = which;
      ASSERT_TRUE(RunOn(file, PagedTask(), options));
      std::string& there = pages[static_cast<int>(which)];
      if (threads == 1) there = PagesIn(out);
      EXPECT_EQ(PagesIn(out), there);
      EXPECT_EQ(Count(FileText(out + "/results.jsonl"), "\"page\":\"pages/"), Count(there, "<p>"));
    }
  }
  EXPECT_EQ(pages[0], "");
  EXPECT_GT(Count(pages[1], "<p>"), 0U);
  EXPECT_LT(Count(pages[1], "<p>"), Count(pages[2], "<p>"));
  EXPECT_EQ(Count(pages[2], "<p>"), 36U);  // every ninth row is broken and has no page
}

TEST(StringPages, StandAfterAStopAndInMergedShards) {
  const TempFolder folder;
  const std::string file = folder.Write("s.jsonl", ManyRows(100));
  BatchOptions whole = Into(folder.Path("whole"));
  whole.pages = PagesOf::kAll;
  ASSERT_TRUE(RunOn(file, PagedTask(), whole));
  BatchOptions stopped = Into(folder.Path("stopped"));
  stopped.pages = PagesOf::kAll;
  ASSERT_TRUE(RunOn(file, PagedTask(), stopped, StopAfter(30)));
  stopped.start = BatchStart::kResume;
  ASSERT_TRUE(RunOn(file, PagedTask(), stopped));
  EXPECT_EQ(PagesIn(folder.Path("stopped")), PagesIn(folder.Path("whole")));
  EXPECT_EQ(ResultsIn(folder.Path("stopped")), ResultsIn(folder.Path("whole")));

  for (int k = 1; k <= 3; ++k) {
    BatchOptions shard = Into(folder.Path("shard" + std::to_string(k % 2)));
    shard.pages = PagesOf::kAll;
    shard.shard = {k, 3};
    ASSERT_TRUE(RunOn(file, PagedTask(), shard));
  }
  const auto merged =
      MergeShards({folder.Path("shard0"), folder.Path("shard1")}, {folder.Path("merged"), false});
  ASSERT_TRUE(merged) << merged.error().ToString();
  EXPECT_EQ(PagesIn(folder.Path("merged")), PagesIn(folder.Path("whole")));
  EXPECT_EQ(ResultsIn(folder.Path("merged")), ResultsIn(folder.Path("whole")));
}

TEST(StringPages, ThatCannotBeWrittenAreARemarkOnTheirRow) {
  const TempFolder folder;
  const std::string file = folder.Write("s.jsonl", ManyRows(9));
  std::filesystem::create_directory(folder.Path("out"));
  folder.Write("out/pages/site/comb0/str2.html/in", "the way");
  BatchOptions options = Into(folder.Path("out"));
  options.pages = PagesOf::kAll;
  const auto done = RunOn(file, PagedTask(), options);
  ASSERT_TRUE(done) << done.error().ToString();
  EXPECT_EQ(done->rows, 9);
  const std::string lines = FileText(folder.Path("out") + "/results.jsonl");
  EXPECT_EQ(Count(lines, "\"remark\":\"no page: expected a file, found a folder\""), 1U);
  EXPECT_EQ(Count(lines, "\"page\":\"pages/"), 7U);  // all but the blocked and the broken row
}

// Ids longer than a file name may be after encoding, or than a path may be.
TEST(StringPages, OfLongIdsHaveNamesThatFit) {
  const TempFolder folder;
  std::vector<std::string> ids;
  const auto repeated = [](const std::string& part, int times) {
    std::string text;
    for (int i = 0; i < times; ++i) text += part;
    return text;
  };
  for (const char* last : {"a", "b"}) {
    ids.push_back(repeated("\xe4\xb8\xad", 28) + last);
    ids.push_back(repeated("\xce\xb1", 42) + last);
    ids.push_back(repeated("x", 5000) + last);
    ids.push_back(repeated("lvl/", 1500) + last);
  }
  std::string rows;
  for (const std::string& id : ids) rows += RowOf({id});
  const std::string file = folder.Write("s.jsonl", rows);
  BatchOptions options = Into(folder.Path("out"));
  options.pages = PagesOf::kAll;
  const auto done = RunOn(file, PagedTask(), options);
  ASSERT_TRUE(done) << done.error().ToString();
  std::set<std::string> pages;
  for (const std::string& id : ids) {
    const std::string path = StringPagePath(id);
    EXPECT_TRUE(std::filesystem::is_regular_file(folder.Path("out") + "/" + path)) << path;
    EXPECT_THAT(FileText(folder.Path("out") + "/results.csv"), HasSubstr("," + path));
    EXPECT_TRUE(pages.insert(path).second) << path;
  }
  EXPECT_EQ(StringPagePath("site/" + ids[0]), "pages/site/" + StringPagePath(ids[0]).substr(6))
      << "a level alone";
  // Links refer to page names, so the name of an id must never change.
  EXPECT_EQ(StringPagePath(std::string(121, 'a')),
            "pages/~_169595bf-162f-50ba-ae22-331caa48fc1c.html");
}

}  // namespace
}  // namespace lyrefit
