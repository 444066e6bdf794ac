#include <algorithm>
#include <filesystem>

#include "../batch/strings.h"
#include "../file_limit.h"
#include "run_app.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// Verbs whose output exceeds the file size limit or cannot be written.
class FullDisk : public testing::Test {
 protected:
  std::string In(const std::string& name) const { return "'" + folder_.Path(name) + "'"; }

  static AppResult RunWithin(rlim_t bytes, const std::string& arguments) {
    const FileLimit limit(bytes);
    return RunApp(arguments);
  }

  // Expects one sentence with the reason and exit code 1.
  static void ExpectComplaint(const AppResult& result, const std::string& arguments,
                              const std::string& reason) {
    EXPECT_EQ(result.exit_code, 1) << arguments << "\n" << result.err;
    EXPECT_THAT(result.err, StartsWith("lyrefit: ")) << arguments;
    EXPECT_THAT(result.err, HasSubstr(reason)) << arguments;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }

  // Expects no files besides these.
  void ExpectFiles(const std::vector<std::string>& names) const {
    for (const auto& entry : fs::directory_iterator(folder_.Path(""))) {
      EXPECT_NE(std::find(names.begin(), names.end(), entry.path().filename().string()),
                names.end())
          << entry.path();
    }
  }

  const TempFolder folder_;
  const std::string rows_ = folder_.Write("rows.jsonl", ManyRows(3));
  const std::string fit_ = "fit '" + kRtc + "' --quiet ";
  const std::string compare_ =
      "compare '" + kRtc + "' --algorithms lo --runs 3 --population 10 --iterations 5 --quiet ";
};

TEST_F(FullDisk, EndsEveryWriterWithASentence) {
  const std::string device =
      "simulate --set Iph=0.76 --set Is1=3e-7 --set n1=1.48 --set Rs=0.036 --set Rsh=54 ";
  for (const std::string& arguments : {
           fit_ + "--json " + In("x.json"),
           fit_ + "--csv " + In("x.csv"),
           fit_ + "--html " + In("x.html"),
           fit_ + "--plot " + In("x.svg"),
           fit_ + "--json -",
           "fit '" + kRtc + "'",
           device + "--out " + In("x.csv"),
           device,
           compare_ + "--json " + In("x.json"),
           compare_ + "--csv " + In("x.csv"),
           compare_ + "--html " + In("x.html"),
           compare_ + "--resume " + In("x.jsonl"),
           "pack '" + rows_ + "' --out " + In("x.jsonl"),
           "pack '" + rows_ + "' --out " + In("x.csv"),
           "pack '" + rows_ + "' --out -",
           "audit '" + DataFolder("paper/rows.csv") + "' --quiet --json " + In("x.json"),
           std::string("man"),
           std::string("fit --help"),
       }) {
    ExpectComplaint(RunWithin(300, arguments), arguments, "File too large");
    fs::remove(folder_.Path("x.jsonl"));  // a journal without rows
  }
  ExpectFiles({"rows.jsonl"});
}

// The SVG has about 40 kB, the gnuplot script behind it a few kB.
TEST_F(FullDisk, LeavesNoHalfPicture) {
  const std::string arguments = fit_ + "--plot " + In("x.svg");
  for (const rlim_t bytes : {8000, 20000}) {
    ExpectComplaint(RunWithin(bytes, arguments), arguments, "File too large");
  }
  ExpectFiles({"rows.jsonl"});
  EXPECT_EQ(RunApp(arguments).exit_code, 0);
  EXPECT_GT(fs::file_size(folder_.Path("x.svg")), 20000U);
}

TEST_F(FullDisk, LeavesAJournalOfWholeLinesThatIsGoneOnWith) {
  const std::string study = compare_ + "--csv /dev/null --resume " + In("j.jsonl");
  ASSERT_EQ(RunApp(study).exit_code, 0);
  const std::string whole = FileText(folder_.Path("j.jsonl"));
  const std::size_t head = whole.find('\n') + 1;
  fs::remove(folder_.Path("j.jsonl"));
  // The limit leaves space for some of the nine runs.
  const std::size_t room = head + (whole.size() - head) / 2;
  const AppResult full = RunWithin(room, study);
  ExpectComplaint(full, study,
                  "j.jsonl: cannot write the journal: File too large; the runs since "
                  "then are in the report alone");
  const std::string kept = FileText(folder_.Path("j.jsonl"));
  EXPECT_GT(kept.size(), head);
  EXPECT_LT(kept.size(), room);
  EXPECT_EQ(kept.back(), '\n');
  const AppResult rest = RunApp(study);
  EXPECT_EQ(rest.exit_code, 0);
  EXPECT_THAT(rest.err, HasSubstr("of 9 runs were done before"));
}

TEST_F(FullDisk, KeepsTheRowsOfABatch) {
  const std::string batch = "batch '" + rows_ + "' --quiet --out " + In("o") + " ";
  ExpectComplaint(RunWithin(300, batch), batch, "cannot write the rows: File too large");
  const std::string page = batch + "--resume --html " + In("x.html");
  ExpectComplaint(RunWithin(20000, page), page, "x.html: cannot write the file: File too large");
  ExpectFiles({"rows.jsonl", "o"});
  EXPECT_EQ(RunApp(page).exit_code, 0) << "the results are there";
  for (const char* k : {"1", "2"}) {
    ASSERT_EQ(
        RunApp("batch '" + rows_ + "' --quiet --out " + In("s") + " --shard " + k + "/2").exit_code,
        0);
  }
  const std::string merge = "merge " + In("s") + " --out " + In("m");
  ExpectComplaint(RunWithin(300, merge), merge, "File too large");
  EXPECT_TRUE(fs::is_empty(folder_.Path("m")));
}

TEST_F(FullDisk, MakesAPageThatDoesNotFitARemark) {
  const std::string batch = "batch '" + rows_ + "' --quiet --pages all --out " + In("o");
  const AppResult result = RunWithin(8000, batch);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(FileText(folder_.Path("o") + "/results.csv"),
              HasSubstr("no page: cannot write the file: File too large"));
}

TEST_F(FullDisk, IsDevFullToo) {
  for (const std::string& arguments : {
           fit_ + "--json /dev/full",
           fit_ + "--csv /dev/full",
           fit_ + "--html /dev/full",
           "batch '" + rows_ + "' --quiet --out " + In("o") + " --html /dev/full",
       }) {
    ExpectComplaint(RunApp(arguments), arguments,
                    "/dev/full: cannot write the file: No space left");
  }
  const std::string command = std::string("'") + LYREFIT_APP + "' ";
  const auto code_of = [](const std::string& line) {
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  EXPECT_EQ(code_of(command + "fit '" + kRtc + "' >/dev/full 2>" + In("err")), 1);
  EXPECT_EQ(FileText(folder_.Path("err")),
            "lyrefit: standard output: cannot write the file: No space left on device\n");
  EXPECT_EQ(code_of(command + "fit '" + kRtc + "' --quiet >/dev/full 2>/dev/full"), 0);
  EXPECT_EQ(code_of(command + "fit nowhere.csv 2>/dev/full"), 1) << "it has nobody to tell";
  ASSERT_TRUE(fs::is_character_file("/dev/full"));
}

// Nobody can write into /proc, not even root.
TEST_F(FullDisk, IsAFolderThatCannotBeWritten) {
  for (const std::string& arguments : {
           fit_ + "--json /proc/x.json",
           fit_ + "--html /proc/x.html",
           fit_ + "--plot /proc/x.svg",
           compare_ + "--resume /proc/x.jsonl",
           "pack '" + rows_ + "' --out /proc/x.jsonl",
           "batch '" + rows_ + "' --out /proc/o",
           "batch '" + rows_ + "' --out " + In("o") + " --html /proc/x.html",
           std::string("simulate --set Iph=1 --set Is1=3e-7 --set n1=1.4 --set Rs=0.03 "
                       "--set Rsh=50 --out /proc/x.csv"),
       }) {
    ExpectComplaint(RunApp(arguments), arguments, "/proc/");
  }
  ExpectFiles({"rows.jsonl"});
}

}  // namespace
}  // namespace lyrefit
