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

// A verb, as data.
struct Verb {
  const char* name;
  const char* line;    // what it does
  const char* footer;  // below the flags in --help
  const char* writes;  // what comes of it, for who asks for something else
  // Declares its flags; what comes back does the work with what they hold, and says the exit code.
  std::function<Expected<int>()> (*declare)(VerbLine* line);
  bool work = true;  // on measurements; false: about lyrefit itself
};

// The `declare` of a verb whose flags fill a struct of its own.
template <class Request, void (*kDeclare)(VerbLine*, Request*),
          Expected<int> (*kRun)(VerbLine&, Request&)>
std::function<Expected<int>()> Declare(VerbLine* line) {
  const auto request = std::make_shared<Request>();
  kDeclare(line, request.get());
  return [line, request] { return kRun(*line, *request); };
}

// The command line as the verbs see it. The parser itself is known to command_line.cc alone: its
// header is most of what a file that includes it costs to compile.

// Where the value of a flag goes. What it holds before stays if the flag is not given.
using FlagTarget =
    std::variant<int*, std::int64_t*, std::uint64_t*, double*, std::string*, std::optional<int>*,
                 std::optional<double>*, std::vector<std::string>*>;

// What a value of text means; an error is a sentence without the flag's name.
using FlagReader = std::function<Expected<void>(const std::string& text)>;

// A flag just declared, to say more of it: AddOption(...).Type("N").Group("Search").
class Flag {
 public:
  Flag& Group(const std::string& heading);  // under which --help lists it
  Flag& Type(const std::string& name);      // what --help shows for the value
  Flag& Required();
  Flag& Excludes(const std::string& other);  // a flag declared before
  Flag& OneEach();                           // a list gets one value each time the flag is given
  // Its value is a file that the run reads, or a list of them; or one or more measurements, which
  // are read with what lies beside them.
  Flag& Reads();
  Flag& ReadsCurves();
  // Its value is a file that the run writes: a table, a report, a picture.
  Flag& Writes();
  Flag& Draws();
  // Its value is a folder that the run writes into, which it looks after itself.
  Flag& WritesFolder();
  // The texts that it takes, for completion: "sd, dd, td".
  Flag& OneOf(const std::string& texts);
  // Values allowed, both ends included.
  Flag& Between(int least, int most);
  Flag& Between(double least, double most);
  // The same in the words of an option table.
  Flag& Within(double lower, double upper);

 private:
  friend class VerbLine;
  struct Impl;
  explicit Flag(Impl* impl) : impl_(impl) {}
  Impl* impl_;  // owned by the verb
};

// What stands about a flag and a verb in manual and completion.
struct FlagText {
  std::string name;  // "--flag", or "CURVE" for what stands without a flag
  std::string type;  // of its value; empty: takes none
  std::string doc;
  std::string group;
  bool file = false;                 // its value is a file or folder
  std::vector<std::string> choices;  // or one of these; empty: anything
};
struct VerbText {
  std::string name;
  std::string line;
  std::string footer;
  bool work = true;  // a verb on measurements, not one about lyrefit
  std::vector<FlagText> flags;
};

// A verb's part of the command line: its flags, and what was said of them.
class VerbLine {
 public:
  struct Impl;
  explicit VerbLine(std::unique_ptr<Impl> impl);
  ~VerbLine();
  VerbLine(const VerbLine&) = delete;
  VerbLine& operator=(const VerbLine&) = delete;

  // `name` is "--flag", or "CURVE" for what stands without a flag.
  Flag AddOption(const std::string& name, FlagTarget target, const std::string& doc);
  // `read` is called with the value as soon as the line is parsed.
  Flag AddReader(const std::string& name, FlagReader read, const std::string& doc);
  // The same for a flag that may be given several times, one value each.
  Flag AddListReader(const std::string& name, FlagReader read, const std::string& doc);
  // A flag without a value.
  Flag AddSwitch(const std::string& name, bool* target, const std::string& doc);
  // The same where `set` is called if it is given.
  Flag AddSwitch(const std::string& name, std::function<void()> set, const std::string& doc);

  // A file that is written too, because of that flag, though no flag names it.
  void AlsoWrites(const std::string& flag, const std::string& path);

  // Whether the files of this run can be written and nothing that is read would be lost; to be
  // asked before the work. --force, which every verb that writes has, allows to replace inputs.
  Expected<void> CheckFiles() const;
  // --quiet: no text on standard output, no progress on the other.
  void AddQuietSwitch();
  // Whether text may be printed: not with --quiet, nor where an output has standard output.
  bool TextWanted() const;
  bool StandardOutputTaken() const;
  bool Forced() const;

  bool Given(const std::string& name) const;  // on the line, whatever its value
  bool Has(const std::string& name) const;    // was declared

  const CommandLine& line() const;  // the whole of it

 private:
  Flag Declare(void* option, FlagTarget target);

  friend class CommandLine;
  std::vector<FlagText> Texts() const;
  Expected<void> CheckNames() const;
  FilePlan Files() const;
  void AddForce();  // last in --help

  std::unique_ptr<Impl> impl_;
};

// The whole line: lyrefit [-v] VERB ...
class CommandLine {
 public:
  explicit CommandLine(const std::string& footer);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  void Add(const Verb& verb);

  // Sets all targets. The text that --help or --version asks for; empty if there is a verb to run.
  Expected<std::string> Parse(int argc, char** argv);

  // Does what the verb on the line does; the exit code.
  Expected<int> Run() const;

  // What `lyrefit VERB --help` prints.
  Expected<std::string> Help(const std::string& verb) const;
  std::vector<VerbText> Verbs() const;
  int verbosity() const;
  bool quiet() const;  // --quiet of the verb that was asked for

 private:
  const VerbLine* Chosen() const;  // none where there was no verb on the line

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lyrefit
