#include <glog/logging.h>

#include <csignal>
#include <exception>
#include <iostream>
#include <string>
#include <string_view>

#include "about.h"
#include "command_line.h"
#include "interrupt.h"
#include "output.h"
#include "program.h"
#include "verbs.h"

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
    "lyrefit VERB --help lists every flag of a verb.\n"
    "lyrefit --cite prints BibTeX of the software and its methods.";

void StartLogging(const char* program, int log_level) {
  FLAGS_logtostderr = true;
  // The solver logs every rejected step as an error; the report states the outcome.
  FLAGS_minloglevel = log_level > 0 ? google::GLOG_INFO : google::GLOG_FATAL;
  FLAGS_v = log_level;
  google::InitGoogleLogging(program);
}

// Prints a text to standard output.
int Print(const std::string& text) {
  const auto written = WriteOutput("-", text);
  return written ? kExitFine : Refuse(written.error());
}

int Main(int argc, char** argv) {
  EndOnSignals();
  if (argc == 1) return Print(FirstPage());
  char topic_follows[] = "help";  // topic of `lyrefit --help terms`
  char cite[] = "cite";           // `lyrefit --cite`
  if (argc == 3 && std::string_view(argv[1]) == "--help") argv[1] = topic_follows;
  if (std::string_view(argv[1]) == "--cite") argv[1] = cite;
  CommandLine line(kFooter + ("\n" + Whereabouts()));
  for (const Verb* verb : ProgramVerbs()) line.Add(*verb);
  const Expected<std::string> asked = line.Parse(argc, argv);
  if (!asked) {
    const int code = Refuse(asked.error());
    std::cerr << kLeftOut;
    return code;
  }
  if (!asked->empty()) return Print(*asked);
  StartLogging(argv[0], line.log_level());
  if (line.quiet()) SilenceProgress();
  const Expected<int> exit_code = line.Run();
  if (exit_code) return *exit_code;
  const int refused = Refuse(exit_code.error());
  return Interrupted() ? kExitInterrupted : refused;
}

}  // namespace

int RunProgram(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // exceeding the file-size limit becomes a write error
  try {
    return Main(argc, argv);
  } catch (const std::exception& error) {  // such as out of memory
    return Refuse({error.what(), {}});
  }
}

}  // namespace lyrefit

int main(int argc, char** argv) { return lyrefit::RunProgram(argc, argv); }
