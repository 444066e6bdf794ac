#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include "flags.h"
#include "interrupt.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/try.h"
#include "lyrefit/fleet/fleet_source.h"
#include "lyrefit/fleet/pack.h"
#include "verbs.h"

namespace lyrefit {
namespace {

constexpr char kPackFooter[] =
    "Examples:\n"
    "  lyrefit pack plant/ --out plant.jsonl\n"
    "  lyrefit pack long_table.csv --out curves.csv\n"
    "  lyrefit pack monday.jsonl tuesday.jsonl --out - | gzip > week.jsonl.gz\n"
    "\n"
    "A folder is read with all below it: the paths are the ids. A curve that cannot be read keeps\n"
    "its row, with the reason.\n"
    "\n"
    "Exit codes: 0 fine; 1 bad input or options, nothing is written; 2 some curves could not be\n"
    "read.";

struct PackRequest {
  std::vector<std::string> inputs;
  FleetReadOptions options;
  std::string out_file;
  int threads = 0;
};

void DeclarePack(VerbLine* verb, PackRequest* request) {
  verb->AddOption("INPUT", &request->inputs,
                  "JSON Lines, CSV of one curve a row, long tables, ivcurves JSON, folder trees; - "
                  "for standard input")
      .Required()
      .ReadsCurves();
  verb->AddOption("--out", &request->out_file,
                  "FILE.jsonl or FILE.csv; - for JSON Lines on standard output")
      .Type("FILE")
      .Required()
      .Writes();
  AddTableFlags(verb, kReadOptionTable, &request->options.reading);
  verb->AddOption("--threads", &request->threads, "0: all cores (default 0)")
      .Type("N")
      .Between(0, kMostThreads);
  verb->AddQuietSwitch();
}

// A file that stands under its name when it is complete, and is gone otherwise.
class WholeFile {
 public:
  explicit WholeFile(std::string path) : path_(std::move(path)) {
    if (path_ == "-") return;
    part_ = path_ + ".part";
    descriptor_ = ::open(part_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor_ < 0) part_.clear();
  }
  ~WholeFile() {
    if (descriptor_ > STDOUT_FILENO) ::close(descriptor_);
    if (!part_.empty()) ::unlink(part_.c_str());
  }
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  Expected<void> Write(std::string_view text) {
    while (!text.empty()) {
      const ssize_t taken = ::write(descriptor_, text.data(), text.size());
      if (taken < 0 && errno == EINTR) continue;
      if (taken < 0) return CannotWrite();
      text.remove_prefix(static_cast<std::size_t>(taken));
    }
    return {};
  }

  Expected<void> Finish() {
    if (part_.empty()) return {};
    const int closed = ::close(std::exchange(descriptor_, -1));
    if (closed != 0 || std::rename(part_.c_str(), path_.c_str()) != 0) return CannotWrite();
    part_.clear();
    return {};
  }

 private:
  tl::unexpected<Error> CannotWrite() const {
    return Fail("cannot write the file: " + std::generic_category().message(errno),
                path_ == "-" ? "standard output" : path_);
  }

  std::string path_;
  std::string part_;
  int descriptor_ = STDOUT_FILENO;
};

Expected<PackFormat> FormatOf(const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension().string();
  if (file == "-" || ending == ".jsonl" || ending == ".ndjson") return PackFormat::kJsonLines;
  if (ending == ".csv") return PackFormat::kCsv;
  return Fail("--out: expected FILE.jsonl, FILE.csv or -", file);
}

std::string Summary(const PackReport& report, const std::string& file) {
  const std::string count = std::to_string(report.curves);
  std::string text =
      fmt::format("{} {} in {}", count, report.curves == 1 ? "curve" : "curves", file);
  if (report.broken == 0) return text + "\n";
  return text + fmt::format(", {} of them could not be read; the first:\n  {}\n", report.broken,
                            report.first_error);
}

Expected<int> RunPack(VerbLine& verb, PackRequest& request) {
  TRY(const PackFormat format, FormatOf(request.out_file));
  TRY(verb.CheckFiles());
  const InterruptGuard guard;
  TRY(const auto source, OpenFleet(request.inputs, request.options));
  PrintRemarks(source->Remarks());
  WholeFile file(request.out_file);
  const Observer observer = TerminalObserver({"pack", "Ctrl-C ends it, and nothing is written"});
  TRY(const PackReport report,
      PackFleet(
          source.get(), format, request.threads,
          [&file](std::string_view text) { return file.Write(text); }, observer));
  if (report.interrupted) return kExitInterrupted;
  TRY(file.Finish());
  if (verb.TextWanted()) TRY(WriteOutput("-", Summary(report, request.out_file)));
  return report.broken == 0 ? kExitFine : kExitNotUsable;
}

}  // namespace

const Verb kPackVerb = {"pack", "Write many curves, in whatever shape, as one curve a row",
                        kPackFooter, "one curve a row: --out FILE.jsonl or FILE.csv",
                        Declare<PackRequest, DeclarePack, RunPack>};

}  // namespace lyrefit
