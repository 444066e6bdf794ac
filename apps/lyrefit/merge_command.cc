#include "flags.h"
#include "lyrefit/base/try.h"
#include "lyrefit/batch.h"
#include "plant/additions.h"
#include "plant/plant_page.h"
#include "verbs.h"

namespace lyrefit {
namespace {

constexpr char kMergeFooter[] =
    "Examples:\n"
    "  lyrefit merge shards --out results\n"
    "  lyrefit merge machine1 machine2 --out results --html plant.html\n"
    "\n"
    "The results have the same bytes as those of one run. Shards that are missing or have not\n"
    "finished are listed by their numbers, as schedulers take them: 2,5-7. The shards stay.\n"
    "\n"
    "Exit codes: 0 fine; 1 shards that are missing, unfinished, or not of one run.";

struct MergeRequest {
  std::vector<std::string> folders;
  MergeOptions options;
  std::string html_file;
  std::string plant;
};

void DeclareMerge(VerbLine* verb, MergeRequest* request) {
  verb->AddOption("DIR", &request->folders, "folders with the shards that batch --shard K/N wrote")
      .Required();
  verb->AddOption("--html", &request->html_file, "the plant on one page, HTML").Writes();
  verb->AddOption("--plant", &request->plant, "its name on that page").Type("NAME");
  verb->AddOption("--out", &request->options.folder, "where the results go").WritesFolder();
  verb->AddQuietSwitch();
}

Expected<int> RunMerge(VerbLine& verb, MergeRequest& request) {
  if (request.options.folder.empty()) return Fail("--out is required: a folder for the results");
  request.options.replace = verb.Forced();
  request.options.additions = PlantAdditions();
  TRY(verb.CheckFiles());
  TRY(const BatchSummary summary, MergeShards(request.folders, request.options));
  if (!request.html_file.empty()) {
    TRY(WritePlantPage(request.options.folder, request.html_file,
                       request.plant.empty() ? "Plant" : request.plant));
  }
  TRY(WriteText(verb, [&] { return BatchText(summary); }));
  return kExitFine;
}

}  // namespace

const Verb kMergeVerb = {"merge", "Put the shards of a batch together", kMergeFooter,
                         "results.csv, results.jsonl and results.schema.json into the folder --out",
                         Declare<MergeRequest, DeclareMerge, RunMerge>};

}  // namespace lyrefit
