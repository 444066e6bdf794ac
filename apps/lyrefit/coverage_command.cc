#include "coverage_command.h"

#include "flags.h"
#include "interrupt.h"
#include "lyrefit/family/fit_family.h"
#include "lyrefit/study/report/coverage_json.h"
#include "lyrefit/study/report/documents.h"
#include "output.h"

namespace lyrefit {
namespace {

constexpr char kCoverageFooter[] =
    "Examples:\n"
    "  lyrefit coverage --sets 500\n"
    "  lyrefit coverage --law pvsyst --model dd --sets 200 --json coverage.json\n"
    "  lyrefit coverage --temperature-error 2 --temperature-offset\n"
    "  lyrefit coverage --cells 36 --set Iph=4.715 --set Is1=6.35e-10 --set n1=1.03\n"
    "      --set Rs=0.282 --set Rsh=85.8 --set alpha=0.002 --set Eg=1.0386\n"
    "\n"
    "Every set is simulated from known parameters on the irradiances and temperatures of IEC\n"
    "61853-1, with noise, and fitted jointly. Same seed, same answer on any number of threads.";

}  // namespace

CoverageCommand::CoverageCommand(CommandLine* line)
    : verb_(line->AddVerb("coverage",
                          "Count how often the 95 % intervals of joint fits hold the truth")) {
  AddEnumFlag(verb_, "--law", "how parameters follow irradiance and temperature",
              &options_.family.law)
      .Group("Device");
  AddEnumFlag(verb_, "--model", "number of diodes; td cannot be fitted jointly",
              &options_.family.model)
      .Group("Device");
  AddListFlag(verb_, "--set",
              "value of a shared parameter, Iph=8; once for each; default: "
              "a module drawn for every set",
              &set_list_)
      .Type("P=VALUE")
      .Group("Device");
  verb_->AddOption("--cells", &options_.cells_in_series, "cells in series, with --set (72)")
      .Type("N")
      .Group("Device");
  AddTableFlags(verb_, kCoverageOptionTable, "Sets", &options_);
  verb_
      ->AddOption("--threads", &options_.threads,
                  "0: all cores; never changes a result but the seconds (default 0)")
      .Between(0, 1024)
      .Type("N")
      .Group("Sets");
  AddResumeFlag(verb_, "set", &options_.journal);
  verb_
      ->AddSwitch("--temperature-offset", &options_.family.temperature_offset,
                  "fit one common error of the temperatures")
      .Group("Fit");
  verb_
      ->AddSwitch("--irradiance-offset", &options_.family.irradiance_offset,
                  "fit one common error of the irradiances")
      .Group("Fit");
  verb_->AddOption("--json", &json_file_, "everything as JSON; - for standard output, alone")
      .Writes();
  verb_->AddQuietSwitch();
  verb_->Footer(kCoverageFooter);
}

int CoverageCommand::Run() {
  for (const std::string& text : set_list_) {
    const auto assignment = ParseAssignment("--set", text);
    if (!assignment) return Refuse(assignment.error());
    options_.module[assignment->first] = assignment->second;
  }
  if (auto checked = verb_->CheckFiles(); !checked) return Refuse(checked.error());
  const InterruptGuard guard;
  const auto report = Coverage(options_, FitFamily, TerminalObserver({"coverage"}));
  if (!report) return Refuse(report.error());
  PrintRemarks(report->remarks);
  if (!json_file_.empty()) {
    auto written = WriteOutput(json_file_, CoverageJson(*report));
    if (!written) return Refuse(written.error());
  }
  if (verb_->TextWanted()) {
    auto written = WriteOutput("-", CoverageText(*report));
    if (!written) return Refuse(written.error());
  }
  if (report->interrupted) return kExitInterrupted;
  return report->failed < static_cast<int>(report->sets.size()) ? kExitFine : kExitNotUsable;
}

}  // namespace lyrefit
