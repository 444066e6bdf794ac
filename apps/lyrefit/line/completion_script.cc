#include "about.h"

namespace lyrefit {
namespace {

std::string JoinWords(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

// Quotes a text for a shell. zsh and bash need the quotes closed around a quote, fish needs it
// escaped.
std::string ShellQuoted(const std::string& text, const char* quote, bool escape_backslash) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') {
      quoted += quote;
    } else {
      if (c == '\\' && escape_backslash) quoted += c;
      quoted += c;
    }
  }
  return quoted + "'";
}
std::string ShellWord(const std::string& text) { return ShellQuoted(text, "'\\''", false); }
std::string FishWord(const std::string& text) { return ShellQuoted(text, "\\'", true); }

bool IsFlag(const FlagText& flag) { return flag.name.rfind("--", 0) == 0; }

std::string VerbNames(const std::vector<VerbText>& verbs) {
  std::vector<std::string> names;
  names.reserve(verbs.size());
  for (const VerbText& verb : verbs) names.push_back(verb.name);
  return JoinWords(names);
}

// Allowed words of a positional argument, such as the topic of help.
std::vector<std::string> OwnWords(const VerbText& verb) {
  for (const FlagText& flag : verb.flags) {
    if (!IsFlag(flag) && !flag.choices.empty()) return flag.choices;
  }
  return {};
}

std::string BashScript(const std::vector<VerbText>& verbs) {
  std::string flags, values;
  for (const VerbText& verb : verbs) {
    std::vector<std::string> words = OwnWords(verb);
    for (const FlagText& flag : verb.flags) {
      if (!IsFlag(flag)) continue;
      words.push_back(flag.name);
      if (flag.type.empty()) continue;
      const std::string choices = flag.file ? "" : JoinWords(flag.choices);
      values += "    '" + verb.name + " " + flag.name + "') words=" + ShellWord(choices) + " ;;\n";
    }
    flags += "        " + verb.name + ") words=" + ShellWord(JoinWords(words)) + " ;;\n";
  }
  return "# bash completion of lyrefit: source <(lyrefit completion bash)\n"
         "_lyrefit() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
         "  local verb= word words=\n"
         "  for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n"
         "    case $word in -*) ;; *) verb=$word; break ;; esac\n"
         "  done\n"
         "  case \"$verb $before\" in\n" +
         values +
         "    *)\n"
         "      case $verb in\n" +
         flags +
         "        '') words=" + ShellWord(VerbNames(verbs) + " --help --version --verbose --log") +
         " ;;\n"
         "      esac ;;\n"
         "  esac\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
         "}\n"
         "complete -o default -F _lyrefit lyrefit\n";
}

// Escapes a help text for the brackets of zsh's _arguments.
std::string ZshDoc(const std::string& text) {
  std::string doc;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == '\\' || c == ':') doc += '\\';
    doc += c;
  }
  return doc;
}

std::string ZshSpec(const FlagText& flag) {
  const std::string message = flag.type.empty() ? " " : ZshDoc(flag.type);
  const std::string action = flag.file              ? "_files"
                             : flag.choices.empty() ? " "
                                                    : "(" + JoinWords(flag.choices) + ")";
  if (!IsFlag(flag)) return "'*:" + ZshDoc(flag.name) + ":" + action + "'";
  std::string spec = "*" + flag.name + "[" + ZshDoc(flag.doc) + "]";
  if (!flag.type.empty()) spec += ":" + message + ":" + action;
  return ShellWord(spec);
}

std::string ZshScript(const std::vector<VerbText>& verbs) {
  std::string names, cases;
  for (const VerbText& verb : verbs) {
    names += "    " + ShellWord(verb.name + ":" + ZshDoc(verb.line)) + "\n";
    cases += "    " + verb.name + ")\n      _arguments";
    for (const FlagText& flag : verb.flags) {
      if (IsFlag(flag) || flag.name[0] != '-') cases += " \\\n        " + ZshSpec(flag);
    }
    cases += " ;;\n";
  }
  return "#compdef lyrefit\n"
         "# zsh completion of lyrefit: lyrefit completion zsh > a folder of $fpath/_lyrefit\n"
         "_lyrefit() {\n"
         "  local -a verbs\n"
         "  verbs=(\n" +
         names +
         "  )\n"
         "  if (( CURRENT == 2 )); then\n"
         "    _describe verb verbs\n"
         "    return\n"
         "  fi\n"
         "  shift words\n"
         "  (( CURRENT-- ))\n"
         "  case $words[1] in\n" +
         cases +
         "  esac\n"
         "}\n"
         "if [[ $zsh_eval_context[-1] == loadautofunc ]]; then\n"
         "  _lyrefit \"$@\"\n"
         "else\n"
         "  compdef _lyrefit lyrefit\n"
         "fi\n";
}

std::string FishScript(const std::vector<VerbText>& verbs) {
  std::string text =
      "# fish completion of lyrefit: lyrefit completion fish > "
      "~/.config/fish/completions/lyrefit.fish\n";
  for (const VerbText& verb : verbs) {
    text += "complete -c lyrefit -n __fish_use_subcommand -f -a " + verb.name + " -d " +
            FishWord(verb.line) + "\n";
  }
  for (const VerbText& verb : verbs) {
    const std::string begin =
        "complete -c lyrefit -n '__fish_seen_subcommand_from " + verb.name + "'";
    const std::vector<std::string> own = OwnWords(verb);
    if (!own.empty()) text += begin + " -f -a " + FishWord(JoinWords(own)) + "\n";
    for (const FlagText& flag : verb.flags) {
      if (!IsFlag(flag)) continue;
      text += begin + " -l " + flag.name.substr(2) + " -d " + FishWord(flag.doc);
      if (flag.file) text += " -r -F";
      if (!flag.file && !flag.type.empty()) text += " -x";
      if (!flag.choices.empty()) text += " -a " + FishWord(JoinWords(flag.choices));
      text += "\n";
    }
  }
  return text;
}

}  // namespace

std::string CompletionScript(const std::string& shell, const std::vector<VerbText>& verbs) {
  if (shell == "bash") return BashScript(verbs);
  return shell == "zsh" ? ZshScript(verbs) : FishScript(verbs);
}

}  // namespace lyrefit
