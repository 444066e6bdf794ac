#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "file_plan.h"
#include "lyrefit/base/error.h"

namespace lyrefit {

class CommandLine;
class VerbLine;

// Whether a verb is promised within a major version (data/stable).
enum class VerbKind {
  kExperimental,  // works on measurements, and may change in a minor version
  kPromised,      // works on measurements
  kAbout,         // is about lyrefit itself, and promised
};

// A verb, as data.
struct Verb {
  const char* name;
  const char* line;    // its purpose
  const char* footer;  // below the flags in --help
  const char* writes;  // its output; for errors about unsupported output flags
  // Declares its flags. The returned function does the work with their values and returns the exit
  // code.
  std::function<Expected<int>()> (*declare)(VerbLine* line);
  VerbKind kind = VerbKind::kExperimental;
};

// `Verb::declare` for a verb whose flags fill its own `Request`.
template <class Request, void (*kDeclare)(VerbLine*, Request*),
          Expected<int> (*kRun)(VerbLine&, Request&)>
std::function<Expected<int>()> Declare(VerbLine* line) {
  const auto request = std::make_shared<Request>();
  kDeclare(line, request.get());
  return [line, request] { return kRun(*line, *request); };
}

// Interface of the command line for the verbs. Only command_line.cc includes the parser, whose
// header takes most of the compile time of a file.

// Destination of a flag's value. It keeps its previous value if the flag is not given.
using FlagTarget =
    std::variant<int*, std::int64_t*, std::uint64_t*, double*, std::string*, std::optional<int>*,
                 std::optional<double>*, std::vector<std::string>*>;

// Parses the text of a value. Error messages do not contain the flag's name.
using FlagReader = std::function<Expected<void>(const std::string& text)>;

// A declared flag, for setting further properties: AddOption(...).Type("N").Group("Search").
class Flag {
 public:
  Flag& Group(const std::string& heading);  // its heading in --help
  Flag& Type(const std::string& name);      // name of the value in --help
  Flag& Required();
  Flag& Excludes(const std::string& other);  // a flag declared earlier
  Flag& OneEach();                           // a list gets one value each time the flag is given
  // Reads(): the value is an input file or a list of them. ReadsCurves(): one or more measurements,
  // which are read with the files beside them.
  Flag& Reads();
  Flag& ReadsCurves();
  // The value is an output file: a table or report for Writes(), a picture for Draws().
  Flag& Writes();
  Flag& Draws();
  // The value is an output folder. The run checks it itself.
  Flag& WritesFolder();
  // The flag is not promised within a major version (data/stable); --help says so.
  Flag& Experimental();
  // Allowed texts, for completion: "sd, dd, td".
  Flag& OneOf(const std::string& texts);
  // Allowed values, both ends included.
  Flag& Between(int least, int most);
  // Allowed values in the notation of an option table.
  Flag& Within(double lower, double upper);

 private:
  friend class VerbLine;
  struct Impl;
  explicit Flag(Impl* impl) : impl_(impl) {}
  Impl* impl_;  // owned by the verb
};

// Texts on a flag and a verb for manual and completion.
struct FlagText {
  std::string name;  // "--flag", or "CURVE" for a positional argument
  std::string type;  // of its value; empty: it has no value
  std::string doc;
  std::string group;
  bool file = false;                 // its value is a file or folder
  std::vector<std::string> choices;  // allowed values; empty: any
};
struct VerbText {
  std::string name;
  std::string line;
  std::string footer;
  VerbKind kind = VerbKind::kExperimental;
  std::vector<FlagText> flags;
};

// The command line of one verb: its flags and their given values.
class VerbLine {
 public:
  struct Impl;
  explicit VerbLine(std::unique_ptr<Impl> impl);
  ~VerbLine();
  VerbLine(const VerbLine&) = delete;
  VerbLine& operator=(const VerbLine&) = delete;

  // `name` is "--flag", or "CURVE" for a positional argument.
  Flag AddOption(const std::string& name, FlagTarget target, const std::string& doc);
  // `read` is called with the value as soon as the line is parsed.
  Flag AddReader(const std::string& name, FlagReader read, const std::string& doc);
  // AddReader for a flag that may be given several times, with one value each.
  Flag AddListReader(const std::string& name, FlagReader read, const std::string& doc);
  // A flag without a value.
  Flag AddSwitch(const std::string& name, bool* target, const std::string& doc);
  // Calls `set` if the switch is given.
  Flag AddSwitch(const std::string& name, std::function<void()> set, const std::string& doc);

  // A further output file that depends on `flag` and is not named by a flag.
  void AlsoWrites(const std::string& flag, const std::string& path);

  // Whether all output files can be written without replacing an input. Call it before the work.
  // --force, which every verb with outputs has, allows replacing inputs.
  Expected<void> CheckFiles() const;
  // --quiet: no text on standard output, no progress on standard error.
  void AddQuietSwitch();
  // Whether text may be printed: not with --quiet, nor if an output file is standard output.
  bool TextWanted() const;
  bool StandardOutputTaken() const;
  bool Forced() const;
  bool Whole() const;  // --verbose: the whole report

  bool Given(const std::string& name) const;  // whether the flag is on the command line
  bool Has(const std::string& name) const;    // whether the flag was declared

  const CommandLine& line() const;  // the whole command line

 private:
  Flag Declare(void* option, FlagTarget target);

  friend class CommandLine;
  std::vector<FlagText> Texts() const;
  Expected<void> CheckNames() const;
  FilePlan Files() const;
  void AddLast();  // --verbose and --force

  std::unique_ptr<Impl> impl_;
};

// The whole command line: lyrefit [--log] VERB ...
class CommandLine {
 public:
  explicit CommandLine(const std::string& footer);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  void Add(const Verb& verb);

  // Sets all targets. Returns the text of --help or --version; empty if there is a verb to run.
  Expected<std::string> Parse(int argc, char** argv);

  // Runs the verb on the command line; returns its exit code.
  Expected<int> Run() const;

  // Text of `lyrefit VERB --help`.
  Expected<std::string> Help(const std::string& verb) const;
  std::vector<VerbText> Verbs() const;
  int log_level() const;
  bool quiet() const;  // --quiet of the given verb

 private:
  const VerbLine* Chosen() const;  // null if the command line has no verb

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lyrefit
