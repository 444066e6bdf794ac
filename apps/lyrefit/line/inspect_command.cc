#include "flags.h"
#include "lyrefit/base/try.h"
#include "lyrefit/inspect/inspect.h"
#include "output.h"
#include "verbs.h"

namespace lyrefit {
namespace {

constexpr char kInspectFooter[] =
    "Examples:\n"
    "  lyrefit inspect module.csv\n"
    "  lyrefit inspect roof/*.csv --json roof.json\n"
    "  lyrefit inspect table.txt --voltage-column 2 --current-column 4\n"
    "\n"
    "It answers also where other verbs refuse a file: with the reason, and with the flags under\n"
    "which the file would be read.\n"
    "\n"
    "Exit codes: 0 fine; 1 a file that does not exist or is no text.";

struct InspectRequest {
  std::vector<std::string> files;
  ReadOptions reading;
  std::string json_file;
};

void DeclareInspect(VerbLine* verb, InspectRequest* request) {
  verb->AddOption("FILE", &request->files,
                  "tables, JSON, module files of other programs, folders, or - for standard input")
      .Required()
      .ReadsCurves();
  AddTableFlags(verb, kReadOptionTable, &request->reading);
  verb->AddOption("--json", &request->json_file, "the same as JSON; - for standard output, alone")
      .Writes();
  verb->AddQuietSwitch();
}

Expected<int> RunInspect(VerbLine& verb, InspectRequest& request) {
  TRY(verb.CheckFiles());
  std::vector<Inspection> found;
  int exit_code = kExitFine;
  for (const std::string& file : request.files) {
    Expected<Inspection> one = Inspect(file, request.reading);
    if (one) found.push_back(std::move(*one));
    if (!one) exit_code = Refuse(one.error());
  }
  if (found.empty()) return exit_code;
  TRY(WriteWanted(request.json_file, [&] { return InspectionJson(found); }));
  TRY(WriteText(verb, [&] {
    std::string text;
    for (const Inspection& one : found) text += (text.empty() ? "" : "\n") + InspectionText(one);
    return text;
  }));
  return exit_code;
}

}  // namespace

const Verb kInspectVerb = {
    "inspect", "Say what a file holds and how it is understood, before any number", kInspectFooter,
    "the answer as text and --json", Declare<InspectRequest, DeclareInspect, RunInspect>};

}  // namespace lyrefit
