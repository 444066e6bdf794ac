#include "flags.h"
#include "lyrefit/base/file.h"
#include "lyrefit/base/try.h"
#include "lyrefit/cite/cite.h"
#include "output.h"
#include "verbs.h"

namespace lyrefit {
namespace {

constexpr char kCiteFooter[] =
    "Examples:\n"
    "  lyrefit cite > lyrefit.bib\n"
    "  lyrefit cite report.json > methods.bib\n"
    "\n"
    "lyrefit --cite says the same. REPORT.json is what --json of any verb wrote. A line\n"
    "\"% missing: ...\" names fields that no source at hand states; nothing is made up.";

struct CiteRequest {
  std::string report_file;
};

void DeclareCite(VerbLine* verb, CiteRequest* request) {
  verb->AddOption("REPORT.json", &request->report_file,
                  "a report's JSON: all that this report used; without it what nearly every fit "
                  "uses")
      .Reads();
}

Expected<int> RunCite(VerbLine& verb, CiteRequest& request) {
  TRY(verb.CheckFiles());
  std::string text = CiteMethods();
  if (!request.report_file.empty()) {
    constexpr std::uintmax_t kLargest = 1 << 30;
    TRY(const std::string json, ReadTextFile(request.report_file, kLargest));
    TRY(text, CiteReport(json, request.report_file));
  }
  TRY(WriteOutput("-", text));
  return kExitFine;
}

}  // namespace

const Verb kCiteVerb = {"cite", "Print BibTeX of what a report used", kCiteFooter, "BibTeX alone",
                        Declare<CiteRequest, DeclareCite, RunCite>};

}  // namespace lyrefit
