#include <fmt/format.h>
#include <glog/logging.h>

#include <exception>
#include <functional>
#include <memory>
#include <string>

#include "audit_command.h"
#include "budget_command.h"
#include "certify_command.h"
#include "command_line.h"
#include "compare_command.h"
#include "coverage_command.h"
#include "data_sheet_command.h"
#include "diagnose_command.h"
#include "fit_command.h"
#include "interrupt.h"
#include "output.h"
#include "sensitivity_command.h"
#include "simulate_command.h"

namespace lyrefit {
namespace {

constexpr char kFooter[] =
    "Examples:\n"
    "  lyrefit fit data/rtc_france\n"
    "  lyrefit fit module.csv --cells 36 --temperature-C 45 --model auto --plot module.svg\n"
    "  lyrefit fit folder_of_curves --family desoto\n"
    "  lyrefit simulate --from fit.json --out curve.csv\n"
    "  lyrefit diagnose sweep.csv --plot diagnosis.svg\n"
    "  lyrefit compare data/rtc_france --algorithms lo,mlo,de,random\n"
    "\n"
    "lyrefit VERB --help lists every flag of a verb.";

// What runs when its verb is on the line.
struct Command {
  std::function<bool()> chosen;
  std::function<int()> run;
};

template <class T>
Command MakeCommand(CommandLine* line) {
  const auto command = std::make_shared<T>(line);
  return {[command] { return command->Chosen(); }, [command] { return command->Run(); }};
}

void StartLogging(const char* program, int verbosity) {
  FLAGS_logtostderr = true;
  // The solver logs every step it had to take back as an error; the report says what came of it.
  FLAGS_minloglevel = verbosity > 0 ? google::GLOG_INFO : google::GLOG_FATAL;
  FLAGS_v = verbosity;
  google::InitGoogleLogging(program);
}

int Main(int argc, char** argv) {
  CommandLine line(kFooter);
  const Command commands[] = {
      MakeCommand<FitCommand>(&line),       MakeCommand<SimulateCommand>(&line),
      MakeCommand<CertifyCommand>(&line),   MakeCommand<CompareCommand>(&line),
      MakeCommand<BudgetCommand>(&line),    MakeCommand<SensitivityCommand>(&line),
      MakeCommand<DataSheetCommand>(&line), MakeCommand<AuditCommand>(&line),
      MakeCommand<CoverageCommand>(&line),  MakeCommand<DiagnoseCommand>(&line),
  };
  const Expected<std::string> asked = line.Parse(argc, argv);
  if (!asked) {
    if (argc == 1) fmt::print(stderr, "{}\n", line.Help());
    return Refuse(asked.error());
  }
  if (!asked->empty()) {
    const auto written = WriteOutput("-", *asked);
    return written ? kExitFine : Refuse(written.error());
  }
  StartLogging(argv[0], line.verbosity());
  if (line.quiet()) SilenceProgress();
  for (const Command& command : commands) {
    if (command.chosen()) return command.run();
  }
  return kExitBadInput;  // the parser has asked for a verb
}

}  // namespace
}  // namespace lyrefit

int main(int argc, char** argv) {
  try {
    return lyrefit::Main(argc, argv);
  } catch (const std::exception& error) {  // out of memory, and the like
    return lyrefit::Refuse({error.what(), {}});
  }
}
