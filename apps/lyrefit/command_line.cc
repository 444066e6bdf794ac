#include "command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <deque>
#include <sstream>

#include "lyrefit/base/option.h"
#include "lyrefit/base/version.h"

namespace lyrefit {
namespace {

constexpr char kOutput[] = "Output";  // the heading of the files in --help

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

// Letters to insert, delete, replace or exchange with their neighbour to make `b` of `a`.
std::size_t Distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      const bool same = a[i - 1] == b[j - 1];
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

// The first word of the line that is no flag.
std::string FirstWord(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (argv[i][0] != '-') return argv[i];
  }
  return "";
}

// A line without a verb of ours: which was meant, or which there are.
Error NoVerb(const CLI::App& app, int argc, char** argv) {
  const std::string word = FirstWord(argc, argv);
  std::string near, all;
  std::size_t nearest = 3;  // more than two letters off is another word
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
    const std::string& name = verb->get_name();
    all += (all.empty() ? "" : ", ") + name;
    const bool begun = word.size() >= 2 && name.rfind(word, 0) == 0;
    const std::size_t distance = begun ? 0 : Distance(word, name);
    if (distance >= std::min(nearest, name.size())) continue;
    nearest = distance;
    near = name;
  }
  if (word.empty()) return {"expected a verb: " + all, {}};
  if (near.empty()) return {"no verb '" + word + "': expected " + all, {}};
  return {"no verb '" + word + "'; did you mean " + near + "?", {}};
}

std::string NotNegative(const std::string& text) {
  return !text.empty() && text.front() == '-' ? "expected a whole number from 0, found " + text
                                              : std::string();
}

}  // namespace

struct Flag::Impl {
  CLI::Option* option;
  FlagTarget target;  // none: a null pointer
  bool reads = false;
  bool curves = false;
  bool writes = false;
  bool draws = false;
};

struct Verb::Impl {
  CLI::App* app;
  std::deque<Flag::Impl> flags;  // addresses stay
  std::vector<OutputFile> more_outputs;
  bool force = false;
  bool quiet = false;
};

struct CommandLine::Impl {
  CLI::App app{"lyrefit: diode-model parameters from measured photovoltaic I-V curves", "lyrefit"};
  std::vector<std::unique_ptr<Verb>> verbs;
  int verbosity = 0;
};

Flag& Flag::Group(const std::string& heading) {
  impl_->option->group(heading);
  return *this;
}

Flag& Flag::Type(const std::string& name) {
  impl_->option->type_name(name);
  return *this;
}

Flag& Flag::Required() {
  impl_->option->required();
  return *this;
}

Flag& Flag::Excludes(const std::string& other) {
  impl_->option->excludes(other);
  return *this;
}

Flag& Flag::OneEach() {
  impl_->option->allow_extra_args(false);
  return *this;
}

Flag& Flag::Reads() {
  impl_->reads = true;
  return *this;
}

Flag& Flag::ReadsCurves() {
  impl_->curves = true;
  return Reads();
}

Flag& Flag::Writes() {
  impl_->writes = true;
  return Type("FILE").Group(kOutput);
}

Flag& Flag::Draws() {
  impl_->draws = true;
  return Writes();
}

Flag& Flag::Between(int least, int most) {
  impl_->option->check(CLI::Range(least, most).description(""));
  return *this;
}

Flag& Flag::Between(double least, double most) {
  impl_->option->check(CLI::Range(least, most).description(""));
  return *this;
}

Flag& Flag::Within(double lower, double upper) {
  const auto in_range = [lower, upper](const std::string& text) {
    double value = 0;
    if (!CLI::detail::lexical_cast(text, value)) return std::string();
    if (value >= lower && value <= upper) return std::string();
    return text + " is outside [" + NumberText(lower) + ", " + NumberText(upper) + "]";
  };
  impl_->option->check(in_range, "");
  return *this;
}

Verb::Verb(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Verb::~Verb() = default;

Flag Verb::Declare(void* option, FlagTarget target) {
  impl_->flags.push_back({static_cast<CLI::Option*>(option), target});
  return Flag(&impl_->flags.back());
}

Flag Verb::AddOption(const std::string& name, FlagTarget target, const std::string& doc) {
  CLI::Option* const option =
      std::visit([&](auto* value) { return impl_->app->add_option(name, *value, doc); }, target);
  // The parser would take -1 for the largest number there is.
  if (std::holds_alternative<std::uint64_t*>(target)) option->check(NotNegative, "");
  return Declare(option, target);
}

Flag Verb::AddReader(const std::string& name, FlagReader read, const std::string& doc) {
  const auto parse = [name, read = std::move(read)](const std::string& text) {
    const Expected<void> done = read(text);
    if (!done) throw CLI::ValidationError(name, done.error().message);
  };
  return Declare(impl_->app->add_option_function<std::string>(name, parse, doc), {});
}

Flag Verb::AddSwitch(const std::string& name, bool* target, const std::string& doc) {
  return Declare(impl_->app->add_flag(name, *target, doc), {});
}

void Verb::Footer(const std::string& text) { impl_->app->footer(text); }

void Verb::AlsoWrites(const std::string& flag, const std::string& path) {
  impl_->more_outputs.push_back({flag, path});
}

FilePlan Verb::Files() const {
  FilePlan plan;
  plan.force = impl_->force;
  for (const Flag::Impl& flag : impl_->flags) {
    if (flag.writes) {
      const std::string& path = *std::get<std::string*>(flag.target);
      plan.outputs.push_back({flag.option->get_name(), path, flag.draws});
    }
    if (!flag.reads) continue;
    if (const auto* path = std::get_if<std::string*>(&flag.target)) {
      plan.inputs.push_back({**path, flag.curves});
    }
    if (const auto* paths = std::get_if<std::vector<std::string>*>(&flag.target)) {
      for (const std::string& path : **paths) plan.inputs.push_back({path, flag.curves});
    }
  }
  plan.outputs.insert(plan.outputs.end(), impl_->more_outputs.begin(), impl_->more_outputs.end());
  return plan;
}

Expected<void> Verb::CheckNames() const {
  for (const Flag::Impl& flag : impl_->flags) {
    if (!flag.reads && !flag.writes) continue;
    for (const std::string& value : flag.option->results()) {
      if (!value.empty()) continue;
      return Fail(flag.option->get_name() + ": expected the name of a file, found nothing");
    }
  }
  return {};
}

Expected<void> Verb::CheckFiles() const {
  if (auto named = CheckNames(); !named) return named;
  return CheckFilePlan(Files());
}

void Verb::AddQuietSwitch() {
  AddSwitch("--quiet", &impl_->quiet, "no text, no progress").Group(kOutput);
}

bool Verb::TextWanted() const { return !impl_->quiet && !StandardOutputTaken(); }

bool Verb::StandardOutputTaken() const {
  const FilePlan plan = Files();
  return std::any_of(plan.outputs.begin(), plan.outputs.end(),
                     [](const OutputFile& output) { return output.path == "-"; });
}

bool Verb::Forced() const { return impl_->force; }

void Verb::AddForce() {
  const auto writes = [](const Flag::Impl& flag) { return flag.writes; };
  if (std::none_of(impl_->flags.begin(), impl_->flags.end(), writes)) return;
  impl_->app->add_flag("--force", impl_->force, "replace even what this run reads")->group(kOutput);
}

bool Verb::Given(const std::string& name) const { return impl_->app->count(name) > 0; }

bool Verb::Chosen() const { return impl_->app->parsed(); }

CommandLine::CommandLine(const std::string& footer) : impl_(std::make_unique<Impl>()) {
  CLI::App& app = impl_->app;
  app.set_version_flag("--version", std::string("lyrefit ") + Version());
  app.footer(footer);
  app.require_subcommand(1);
  app.fallthrough();
  app.add_flag("-v,--v,--verbose", impl_->verbosity, "log what happens inside; twice for more");
}

CommandLine::~CommandLine() = default;

Verb* CommandLine::AddVerb(const std::string& name, const std::string& doc) {
  auto verb = std::make_unique<Verb::Impl>();
  verb->app = impl_->app.add_subcommand(name, doc);
  impl_->verbs.push_back(std::make_unique<Verb>(std::move(verb)));
  return impl_->verbs.back().get();
}

Expected<std::string> CommandLine::Parse(int argc, char** argv) {
  for (const std::unique_ptr<Verb>& verb : impl_->verbs) verb->AddForce();
  try {
    impl_->app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) {
      const bool verb = !impl_->app.get_subcommands().empty();
      return tl::unexpected(verb ? CommandLineError(error) : NoVerb(impl_->app, argc, argv));
    }
    std::ostringstream text;  // --help, --version
    impl_->app.exit(error, text, text);
    return text.str();
  }
  return std::string();
}

std::string CommandLine::Help() const { return impl_->app.help(); }

int CommandLine::verbosity() const { return impl_->verbosity; }

bool CommandLine::quiet() const {
  return std::any_of(impl_->verbs.begin(), impl_->verbs.end(),
                     [](const auto& verb) { return verb->Chosen() && verb->impl_->quiet; });
}

}  // namespace lyrefit
