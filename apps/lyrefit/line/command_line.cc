#include "command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <deque>
#include <sstream>

#include "line_errors.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/version.h"
#include "lyrefit/read/read_module.h"

namespace lyrefit {
namespace {

constexpr char kOutput[] = "Output";  // heading of the output files in --help
constexpr char kAbout[] = "About lyrefit";
constexpr char kExperimental[] = "Experimental, may change in a minor version";

// Below the purpose of an experimental verb its own --help says what it is.
class HelpFormat : public CLI::Formatter {
  std::string make_description(const CLI::App* app) const override {
    const std::string text = Formatter::make_description(app);
    return app->get_group() == kExperimental ? text + "(" + kExperimentalNote + ")\n" : text;
  }
};

// The parser's error, in own words where CLI11's message is not sufficient.
Error CommandLineError(const CLI::ParseError& error) {
  std::string message = error.what();
  const bool extra = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  if (extra && message.find('=') != std::string::npos) {
    message += " (repeat --bound, --fix or --set before each value)";
  }
  const std::size_t value = message.rfind(" = ");
  if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr && value != std::string::npos) {
    message += DecimalPointHint(message.substr(value + 3));
  }
  const std::size_t repeated = message.find(": At Most 1 required");
  if (repeated != std::string::npos)
    message = message.substr(0, repeated) + ": given more than once";
  return {message, {}};
}

// What the parser would read as another whole number: it takes a leading zero for octal digits, and
// what is too large for the largest one. `least_is_0`: it would take -1 for the largest one, too.
std::string NotWhole(const std::string& text, bool least_is_0) {
  const bool negative = !text.empty() && text.front() == '-';
  if (negative && least_is_0) return "expected a whole number from 0, found " + text;
  const std::string_view digits = std::string_view(text).substr(negative ? 1 : 0);
  std::uint64_t value = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool leading = digits.size() > 1 && digits.front() == '0';
  if (!leading && read.ec != std::errc::result_out_of_range) return "";
  return "expected a whole number without leading zeros up to 18446744073709551615, found " + text;
}

}  // namespace

struct Flag::Impl {
  CLI::Option* option = nullptr;
  FlagTarget target;  // empty: a null pointer
  bool reads = false;
  bool curves = false;
  bool writes = false;
  bool folder = false;  // an output folder
  bool draws = false;
  std::vector<std::string> choices;
};

struct VerbLine::Impl {
  const CommandLine* line;
  bool* whole;
  const Verb* verb;
  CLI::App* app;
  std::function<Expected<int>()> run;
  std::deque<Flag::Impl> flags;  // deque: addresses stay valid
  std::vector<OutputFile> more_outputs;
  std::deque<std::pair<bool, std::function<void()>>> switches;  // whether given, and its function
  bool force = false;
  bool quiet = false;
};

struct CommandLine::Impl {
  CLI::App app{"lyrefit: diode-model parameters from measured photovoltaic I-V curves", "lyrefit"};
  std::vector<std::unique_ptr<VerbLine>> verbs;
  int log_level = 0;
  bool whole = false;

  std::vector<const Verb*> Verbs() const {
    std::vector<const Verb*> all;
    for (const std::unique_ptr<VerbLine>& verb : verbs) all.push_back(verb->impl_->verb);
    return all;
  }
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

Flag& Flag::Experimental() {
  impl_->option->description(impl_->option->get_description() + "; " + kExperimentalNote);
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

Flag& Flag::WritesFolder() {
  impl_->folder = true;
  return Type("DIR").Group(kOutput);
}

Flag& Flag::Writes() {
  impl_->writes = true;
  return Type("FILE").Group(kOutput);
}

Flag& Flag::Draws() {
  impl_->draws = true;
  return Writes();
}

Flag& Flag::OneOf(const std::string& texts) {
  std::istringstream list(texts);
  for (std::string text; std::getline(list >> std::ws, text, ',');) {
    impl_->choices.push_back(text);
  }
  return *this;
}

Flag& Flag::Between(int least, int most) {
  impl_->option->check(CLI::Range(least, most).description(""));
  return *this;
}

Flag& Flag::Within(double lower, double upper) {
  const auto in_range = [lower, upper](const std::string& text) {
    double value = 0;
    if (!CLI::detail::lexical_cast(text, value)) return std::string();
    if (value >= lower && value <= upper) return std::string();
    if (lower == -kOverflowCode && upper == kOverflowCode) {
      return "expected a finite number, found " + text;
    }
    return text + " is outside [" + NumberText(lower) + ", " + NumberText(upper) + "]";
  };
  impl_->option->check(in_range, "");
  return *this;
}

VerbLine::VerbLine(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
VerbLine::~VerbLine() = default;

Flag VerbLine::Declare(void* option, FlagTarget target) {
  impl_->flags.emplace_back();
  impl_->flags.back().option = static_cast<CLI::Option*>(option);
  impl_->flags.back().target = target;
  return Flag(&impl_->flags.back());
}

Flag VerbLine::AddOption(const std::string& name, FlagTarget target, const std::string& doc) {
  CLI::Option* const option =
      std::visit([&](auto* value) { return impl_->app->add_option(name, *value, doc); }, target);
  const bool least_is_0 = std::holds_alternative<std::uint64_t*>(target);
  const bool whole = least_is_0 || std::holds_alternative<int*>(target) ||
                     std::holds_alternative<std::int64_t*>(target) ||
                     std::holds_alternative<std::optional<int>*>(target);
  if (whole) {
    option->check([=](const std::string& text) { return NotWhole(text, least_is_0); }, "");
  }
  return Declare(option, target);
}

Flag VerbLine::AddReader(const std::string& name, FlagReader read, const std::string& doc) {
  const auto parse = [name, read = std::move(read)](const std::string& text) {
    const Expected<void> done = read(text);
    if (!done) throw CLI::ValidationError(name, done.error().ToString());
  };
  return Declare(impl_->app->add_option_function<std::string>(name, parse, doc), {});
}

Flag VerbLine::AddListReader(const std::string& name, FlagReader read, const std::string& doc) {
  const auto parse = [name, read = std::move(read)](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      const Expected<void> done = read(text);
      if (!done) throw CLI::ValidationError(name, done.error().ToString());
    }
  };
  CLI::Option* const option =
      impl_->app->add_option_function<std::vector<std::string>>(name, parse, doc);
  return Declare(option, {}).OneEach();
}

Flag VerbLine::AddSwitch(const std::string& name, bool* target, const std::string& doc) {
  return Declare(impl_->app->add_flag(name, *target, doc), {});
}

Flag VerbLine::AddSwitch(const std::string& name, std::function<void()> set,
                         const std::string& doc) {
  impl_->switches.push_back({false, std::move(set)});
  return AddSwitch(name, &impl_->switches.back().first, doc);
}

void VerbLine::AlsoWrites(const std::string& flag, const std::string& path) {
  impl_->more_outputs.push_back({flag, path});
}

FilePlan VerbLine::Files() const {
  FilePlan plan;
  plan.force = impl_->force;
  for (const Flag::Impl& flag : impl_->flags) {
    if (flag.writes) {
      const std::string& path = *std::get<std::string*>(flag.target);
      plan.outputs.push_back({flag.option->get_name(), path, flag.draws});
    }
    if (!flag.reads) continue;
    for (const std::string& path : flag.option->results()) {
      plan.inputs.push_back({path, flag.curves});
      const std::string file = FileOfModule(path);  // of FILE#NAME
      if (file != path) plan.inputs.push_back({file, false});
    }
  }
  plan.outputs.insert(plan.outputs.end(), impl_->more_outputs.begin(), impl_->more_outputs.end());
  return plan;
}

Expected<void> VerbLine::CheckNames() const {
  for (const Flag::Impl& flag : impl_->flags) {
    if (!flag.reads && !flag.writes) continue;
    for (const std::string& value : flag.option->results()) {
      if (!value.empty()) continue;
      return Fail(flag.option->get_name() + ": expected the name of a file, found nothing");
    }
  }
  return {};
}

Expected<void> VerbLine::CheckFiles() const {
  if (auto named = CheckNames(); !named) return named;
  return CheckFilePlan(Files());
}

void VerbLine::AddQuietSwitch() {
  AddSwitch("--quiet", &impl_->quiet, "no text, no progress").Group(kOutput);
}

bool VerbLine::TextWanted() const { return !impl_->quiet && !StandardOutputTaken(); }

bool VerbLine::StandardOutputTaken() const {
  const FilePlan plan = Files();
  return std::any_of(plan.outputs.begin(), plan.outputs.end(),
                     [](const OutputFile& output) { return output.path == "-"; });
}

bool VerbLine::Forced() const { return impl_->force; }

bool VerbLine::Whole() const { return *impl_->whole; }

void VerbLine::AddLast() {
  if (impl_->verb->kind != VerbKind::kAbout) {
    impl_->app->add_flag("-v,--verbose", *impl_->whole, "the whole report")->group(kOutput);
  }
  const auto writes = [](const Flag::Impl& flag) { return flag.writes || flag.folder; };
  if (std::none_of(impl_->flags.begin(), impl_->flags.end(), writes)) return;
  impl_->app->add_flag("--force", impl_->force, "replace even what this run reads")->group(kOutput);
}

bool VerbLine::Given(const std::string& name) const { return impl_->app->count(name) > 0; }

std::vector<FlagText> VerbLine::Texts() const {
  std::vector<FlagText> texts;
  for (const CLI::Option* option : impl_->app->get_options()) {
    FlagText text{option->get_name(),
                  option->get_type_name(),
                  option->get_description(),
                  option->get_group(),
                  false,
                  {}};
    if (option->get_items_expected_max() == 0) text.type.clear();
    for (const Flag::Impl& flag : impl_->flags) {
      if (flag.option != option) continue;
      text.file = flag.reads || flag.writes || text.type == "DIR";
      text.choices = flag.choices;
    }
    texts.push_back(std::move(text));
  }
  return texts;
}

bool VerbLine::Has(const std::string& name) const {
  return impl_->app->get_option_no_throw(name) != nullptr;
}

const CommandLine& VerbLine::line() const { return *impl_->line; }

CommandLine::CommandLine(const std::string& footer) : impl_(std::make_unique<Impl>()) {
  CLI::App& app = impl_->app;
  app.set_version_flag("--version", std::string("lyrefit ") + Version());
  app.formatter(std::make_shared<HelpFormat>());
  app.footer(footer);
  app.require_subcommand(1);
  app.fallthrough();
  app.add_flag("-v,--v,--verbose", impl_->whole, "the whole report of any verb");
  app.add_flag("--log", impl_->log_level, "log what happens inside; twice or --log=2 for more");
}

CommandLine::~CommandLine() = default;

void CommandLine::Add(const Verb& verb) {
  auto made = std::make_unique<VerbLine::Impl>();
  made->line = this;
  made->whole = &impl_->whole;
  made->verb = &verb;
  made->app = impl_->app.add_subcommand(verb.name, verb.line);
  made->app->footer(verb.footer);
  if (verb.kind == VerbKind::kExperimental) made->app->group(kExperimental);
  if (verb.kind == VerbKind::kAbout) made->app->group(kAbout);
  impl_->verbs.push_back(std::make_unique<VerbLine>(std::move(made)));
  VerbLine* const line = impl_->verbs.back().get();
  line->impl_->run = verb.declare(line);
  line->AddLast();
}

const VerbLine* CommandLine::Chosen() const {
  for (const std::unique_ptr<VerbLine>& verb : impl_->verbs) {
    if (verb->impl_->app->parsed()) return verb.get();
  }
  return nullptr;
}

Expected<std::string> CommandLine::Parse(int argc, char** argv) {
  std::vector<std::string> words = CurrentWords(argc, argv);
  std::vector<char*> pointers;
  pointers.reserve(words.size());
  for (std::string& word : words) pointers.push_back(word.data());
  try {
    impl_->app.parse(argc, pointers.data());
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // --help, --version
      std::ostringstream text;
      impl_->app.exit(error, text, text);
      return text.str();
    }
    const VerbLine* const verb = Chosen();
    if (verb == nullptr) return tl::unexpected(NoSuchVerb(FirstWord(argc, argv), impl_->Verbs()));
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
      auto other = OtherTarget(*verb->impl_->verb, impl_->app.remaining(true));
      if (!other) {
        other = NearFlag(*verb->impl_->verb, verb->Texts(), impl_->app.remaining(true));
      }
      if (other) return tl::unexpected(std::move(*other));
    }
    return tl::unexpected(CommandLineError(error));
  }
  for (const auto& [given, set] : Chosen()->impl_->switches) {
    if (given) set();
  }
  return std::string();
}

Expected<int> CommandLine::Run() const { return Chosen()->impl_->run(); }

Expected<std::string> CommandLine::Help(const std::string& verb) const {
  for (const std::unique_ptr<VerbLine>& known : impl_->verbs) {
    if (known->impl_->verb->name == verb) return known->impl_->app->help(impl_->app.get_name());
  }
  return tl::unexpected(NoSuchVerb(verb, impl_->Verbs()));
}

std::vector<VerbText> CommandLine::Verbs() const {
  std::vector<VerbText> verbs;
  for (const std::unique_ptr<VerbLine>& verb : impl_->verbs) {
    const Verb& data = *verb->impl_->verb;
    verbs.push_back({data.name, data.line, data.footer, data.kind, verb->Texts()});
  }
  return verbs;
}

int CommandLine::log_level() const { return impl_->log_level; }

bool CommandLine::quiet() const {
  return std::any_of(impl_->verbs.begin(), impl_->verbs.end(), [](const auto& verb) {
    return verb->impl_->app->parsed() && verb->impl_->quiet;
  });
}

}  // namespace lyrefit
