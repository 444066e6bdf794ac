#include <fmt/format.h>

#include <filesystem>
#include <string_view>
#include <utility>

#include "flags.h"
#include "interrupt.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/try.h"
#include "lyrefit/batch/pack.h"
#include "lyrefit/stream/batch_source.h"
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
  BatchReadOptions options;
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
  TRY(const auto source, OpenBatch(request.inputs, request.options));
  PrintRemarks(source->Remarks());
  const Observer observer = TerminalObserver({"pack", "Ctrl-C ends it, and nothing is written"});
  const PackSink to_output = [](std::string_view text) {
    return WriteOutput("-", std::string(text));
  };
  auto packed =
      request.out_file == "-"
          ? PackBatch(source.get(), format, request.threads, to_output, observer)
          : PackBatchInto(request.out_file, source.get(), format, request.threads, observer);
  TRY(const PackReport report, std::move(packed));
  if (report.interrupted) return kExitInterrupted;
  if (verb.TextWanted()) TRY(WriteOutput("-", Summary(report, request.out_file)));
  return report.broken == 0 ? kExitFine : kExitNotUsable;
}

}  // namespace

const Verb kPackVerb = {"pack", "Write many curves, in whatever shape, as one curve a row",
                        kPackFooter, "one curve a row: --out FILE.jsonl or FILE.csv",
                        Declare<PackRequest, DeclarePack, RunPack>};

}  // namespace lyrefit
