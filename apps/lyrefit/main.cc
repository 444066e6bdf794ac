#include <glog/logging.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <string>

#include "fit_command.h"
#include "lyrefit/base/version.h"
#include "output.h"
#include "simulate_command.h"

namespace lyrefit {
namespace {

constexpr char kFooter[] =
    "Examples:\n"
    "  lyrefit fit data/rtc_france\n"
    "  lyrefit fit module.csv --cells 36 --temperature-C 45 --model auto --plot module.svg\n"
    "  lyrefit simulate --from fit.json --out curve.csv\n"
    "\n"
    "lyrefit fit --help and lyrefit simulate --help list every flag.";

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
  FitCommand fit(&app);
  SimulateCommand simulate(&app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    return Refuse(CommandLineError(error));
  }
  StartLogging(argv[0], verbosity);
  return fit.Chosen() ? fit.Run() : simulate.Run();
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
