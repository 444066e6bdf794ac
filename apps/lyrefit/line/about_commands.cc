#include "about.h"
#include "flags.h"
#include "lyrefit/base/try.h"
#include "verbs.h"

// The verbs about lyrefit itself: help, completion and man.
namespace lyrefit {
namespace {

constexpr char kHelpFooter[] =
    "Examples:\n"
    "  lyrefit help\n"
    "  lyrefit help terms\n"
    "  lyrefit help fit";

constexpr char kCompletionFooter[] =
    "Examples:\n"
    "  source <(lyrefit completion bash)\n"
    "  lyrefit completion zsh > ~/.zfunc/_lyrefit\n"
    "  lyrefit completion fish > ~/.config/fish/completions/lyrefit.fish";

constexpr char kManFooter[] =
    "Examples:\n"
    "  lyrefit man > lyrefit.1\n"
    "  lyrefit man | man -l -";

enum class Shell { kBash, kZsh, kFish };

}  // namespace

template <>
struct EnumTable<Shell> {
  static constexpr EnumText<Shell> kRows[] = {
      {Shell::kBash, "bash"}, {Shell::kZsh, "zsh"}, {Shell::kFish, "fish"}};
};

namespace {

struct AboutRequest {
  std::string topic;
  std::optional<Shell> shell;
};

void DeclareHelp(VerbLine* verb, AboutRequest* request) {
  verb->AddOption("TOPIC", &request->topic,
                  "terms: what the words in reports mean; a verb: its flags; nothing: which verb "
                  "answers which question");
}

Expected<int> RunHelp(VerbLine& verb, AboutRequest& request) {
  if (request.topic.empty()) {
    TRY(WriteOutput("-", FirstPage()));
  } else if (request.topic == "terms") {
    TRY(WriteOutput("-", Glossary()));
  } else {
    TRY(const std::string help, verb.line().Help(request.topic));
    TRY(WriteOutput("-", help));
  }
  return kExitFine;
}

void DeclareCompletion(VerbLine* verb, AboutRequest* request) {
  const auto read = [request](const std::string& text) -> Expected<void> {
    request->shell = FromText<Shell>(text);
    if (request->shell) return {};
    return Fail("expected one of " + AllTexts<Shell>() + ", found '" + text + "'");
  };
  verb->AddReader("SHELL", read, "bash, zsh or fish").OneOf(AllTexts<Shell>()).Required();
}

Expected<int> RunCompletion(VerbLine& verb, AboutRequest& request) {
  TRY(WriteOutput("-", CompletionScript(ToText(*request.shell), verb.line().Verbs())));
  return kExitFine;
}

void DeclareMan(VerbLine*, AboutRequest*) {}

Expected<int> RunMan(VerbLine& verb, AboutRequest&) {
  TRY(WriteOutput("-", ManualPage(verb.line().Verbs())));
  return kExitFine;
}

}  // namespace

const Verb kHelpVerb = {"help",
                        "Which verb answers which question, the terms, or the flags of a verb",
                        kHelpFooter,
                        "help alone",
                        Declare<AboutRequest, DeclareHelp, RunHelp>,
                        VerbKind::kAbout};

const Verb kCompletionVerb = {"completion",
                              "Print a script that completes verbs and flags in a shell",
                              kCompletionFooter,
                              "the script alone",
                              Declare<AboutRequest, DeclareCompletion, RunCompletion>,
                              VerbKind::kAbout};

const Verb kManVerb = {"man",
                       "Print the manual page",
                       kManFooter,
                       "roff alone",
                       Declare<AboutRequest, DeclareMan, RunMan>,
                       VerbKind::kAbout};

}  // namespace lyrefit
