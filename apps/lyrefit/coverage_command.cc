#include "coverage_command.h"

#include "flags.h"
#include "interrupt.h"
#include "lyrefit/family/fit_family.h"
#include "lyrefit/report/coverage_text.h"
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

CoverageCommand::CoverageCommand(CLI::App* app)
    : command_(app->add_subcommand(
          "coverage", "Count how often the 95 % intervals of joint fits hold the truth")) {
  AddEnumFlag(command_, "--law", "how parameters follow irradiance and temperature",
              &options_.family.law)
      ->group("Device");
  AddEnumFlag(command_, "--model", "number of diodes; td cannot be fitted jointly",
              &options_.family.model)
      ->group("Device");
  AddListFlag(command_, "--set",
              "value of a shared parameter, Iph=8; once for each; default: "
              "a module drawn for every set",
              &set_list_)
      ->type_name("P=VALUE")
      ->group("Device");
  command_->add_option("--cells", options_.cells_in_series, "cells in series, with --set (72)")
      ->type_name("N")
      ->group("Device");
  AddTableFlags(command_, kCoverageOptionTable, "Sets", &options_);
  command_
      ->add_option("--threads", options_.threads,
                   "0: all cores; never changes a result but the seconds (default 0)")
      ->check(CLI::Range(0, 1024).description(""))
      ->type_name("N")
      ->group("Sets");
  command_
      ->add_flag("--temperature-offset", options_.family.temperature_offset,
                 "fit one common error of the temperatures")
      ->group("Fit");
  command_
      ->add_flag("--irradiance-offset", options_.family.irradiance_offset,
                 "fit one common error of the irradiances")
      ->group("Fit");
  command_->add_option("--json", json_file_, "everything as JSON; - for standard output, alone")
      ->type_name("FILE")
      ->group("Output");
  command_->footer(kCoverageFooter);
}

int CoverageCommand::Run() {
  for (const std::string& text : set_list_) {
    const auto assignment = ParseAssignment("--set", text);
    if (!assignment) return Refuse(assignment.error());
    options_.module[assignment->first] = assignment->second;
  }
  if (auto writable = CheckWritable(json_file_); !writable) return Refuse(writable.error());
  const InterruptGuard guard;
  const auto report = Coverage(options_, FitFamily, TerminalObserver());
  ClearProgressLine();
  if (!report) return Refuse(report.error());
  if (!json_file_.empty()) {
    auto written = WriteOutput(json_file_, CoverageJson(*report));
    if (!written) return Refuse(written.error());
  }
  if (json_file_ != "-") {
    auto written = WriteOutput("-", CoverageText(*report));
    if (!written) return Refuse(written.error());
  }
  return report->failed < static_cast<int>(report->sets.size()) ? kExitFine : kExitNotUsable;
}

}  // namespace lyrefit
