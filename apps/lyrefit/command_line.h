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
  // Values allowed, both ends included.
  Flag& Between(int least, int most);
  Flag& Between(double least, double most);
  // The same in the words of an option table.
  Flag& Within(double lower, double upper);

 private:
  friend class Verb;
  struct Impl;
  explicit Flag(Impl* impl) : impl_(impl) {}
  Impl* impl_;  // owned by the verb
};

// One verb and its flags.
class Verb {
 public:
  struct Impl;
  explicit Verb(std::unique_ptr<Impl> impl);
  ~Verb();
  Verb(const Verb&) = delete;
  Verb& operator=(const Verb&) = delete;

  // `name` is "--flag", or "CURVE" for what stands without a flag.
  Flag AddOption(const std::string& name, FlagTarget target, const std::string& doc);
  // `read` is called with the value as soon as the line is parsed.
  Flag AddReader(const std::string& name, FlagReader read, const std::string& doc);
  // A flag without a value.
  Flag AddSwitch(const std::string& name, bool* target, const std::string& doc);
  void Footer(const std::string& text);  // below the flags in --help

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
  bool Chosen() const;

 private:
  Flag Declare(void* option, FlagTarget target);

  friend class CommandLine;
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

  // Lives as long as the command line.
  Verb* AddVerb(const std::string& name, const std::string& doc);

  // Sets all targets. The text that --help or --version asks for; empty if there is a verb to run.
  Expected<std::string> Parse(int argc, char** argv);

  std::string Help() const;
  int verbosity() const;
  bool quiet() const;  // --quiet of the verb that was asked for

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lyrefit
