#include <glog/logging.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <functional>
#include <memory>
#include <string>

#include "audit_command.h"
#include "budget_command.h"
#include "certify_command.h"
#include "compare_command.h"
#include "coverage_command.h"
#include "data_sheet_command.h"
#include "diagnose_command.h"
#include "fit_command.h"
#include "lyrefit/base/version.h"
#include "output.h"
#include "reproduce_command.h"
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

// A verb of the command line, whatever its class.
struct Verb {
  std::function<bool()> chosen;
  std::function<int()> run;
};

template <class Command>
Verb MakeVerb(CLI::App* app) {
  const auto command = std::make_shared<Command>(app);
  return {[command] { return command->Chosen(); }, [command] { return command->Run(); }};
}

void StartLogging(const char* program, int verbosity) {
  FLAGS_logtostderr = true;
  // The solver logs every step it had to take back as an error; the report says what came of it.
  FLAGS_minloglevel = verbosity > 0 ? google::GLOG_INFO : google::GLOG_FATAL;
  FLAGS_v = verbosity;
  google::InitGoogleLogging(program);
}

// What CLI11 found wrong, in our words where its own say little.
Error CommandLineError(const CLI::ParseError& error) {
  std::string message = error.what();
  const bool extra = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  if (extra && message.find('=') != std::string::npos) {
    message += " (repeat --bound, --fix or --set before each value)";
  }
  const std::size_t repeated = message.find(": At Most 1 required");
  if (repeated != std::string::npos)
    message = message.substr(0, repeated) + ": given more than once";
  return {message, {}};
}

int Main(int argc, char** argv) {
  CLI::App app("lyrefit: diode-model parameters from measured photovoltaic I-V curves", "lyrefit");
  app.set_version_flag("--version", std::string("lyrefit ") + Version());
  app.footer(kFooter);
  app.require_subcommand(1);
  app.fallthrough();
  int verbosity = 0;
  app.add_flag("-v,--v,--verbose", verbosity, "log what happens inside; twice for more");
  const Verb verbs[] = {
      MakeVerb<FitCommand>(&app),       MakeVerb<SimulateCommand>(&app),
      MakeVerb<CertifyCommand>(&app),   MakeVerb<CompareCommand>(&app),
      MakeVerb<BudgetCommand>(&app),    MakeVerb<SensitivityCommand>(&app),
      MakeVerb<DataSheetCommand>(&app), MakeVerb<AuditCommand>(&app),
      MakeVerb<ReproduceCommand>(&app), MakeVerb<CoverageCommand>(&app),
      MakeVerb<DiagnoseCommand>(&app),
  };
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    return Refuse(CommandLineError(error));
  }
  StartLogging(argv[0], verbosity);
  for (const Verb& verb : verbs) {
    if (verb.chosen()) return verb.run();
  }
  return kExitBadInput;  // CLI11 has asked for a verb
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
