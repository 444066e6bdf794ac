#include "about.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/version.h"

namespace lyrefit {
namespace {

// Escapes a text for roff: backslashes and hyphens stay literal, and no line starts a request.
std::string Roff(const std::string& text) {
  std::string roff;
  bool at_begin = true;
  for (const char c : text) {
    if (at_begin && (c == '.' || c == '\'')) roff += "\\&";
    at_begin = c == '\n';
    if (c == '\\') {
      roff += "\\e";
    } else if (c == '-') {
      roff += "\\-";
    } else {
      roff += c;
    }
  }
  return roff;
}

std::string FlagEntry(const FlagText& flag) {
  std::string entry = ".TP\n\\fB" + Roff(flag.name) + "\\fR";
  if (!flag.type.empty() && flag.name[0] == '-') entry += " \\fI" + Roff(flag.type) + "\\fR";
  return entry + "\n" + Roff(flag.doc) + "\n";
}

// The groups in the order of --help.
std::vector<std::string> GroupsOf(const VerbText& verb) {
  std::vector<std::string> groups;
  for (const FlagText& flag : verb.flags) {
    bool known = false;
    for (const std::string& group : groups) known = known || group == flag.group;
    if (!known) groups.push_back(flag.group);
  }
  return groups;
}

std::string VerbSection(const VerbText& verb) {
  std::string text = ".SH LYREFIT " + Roff(verb.name) + "\n" + Roff(verb.line) + ".\n";
  if (verb.kind == VerbKind::kExperimental) text += "(" + Roff(kExperimentalNote) + ")\n";
  for (const std::string& group : GroupsOf(verb)) {
    text += ".SS " + Roff(group) + "\n";
    for (const FlagText& flag : verb.flags) {
      if (flag.group == group) text += FlagEntry(flag);
    }
  }
  if (!verb.footer.empty()) text += ".PP\n.nf\n" + Roff(verb.footer) + "\n.fi\n";
  return text;
}

}  // namespace

std::string ManualPage(const std::vector<VerbText>& verbs) {
  std::string text = ".TH LYREFIT 1 \"\" \"lyrefit " + Roff(Version()) +
                     "\"\n.SH NAME\nlyrefit \\- diode\\-model parameters from measured "
                     "photovoltaic I\\-V curves\n"
                     ".SH SYNOPSIS\n\\fBlyrefit\\fR [\\fB\\-\\-log\\fR] \\fIVERB\\fR ...\n"
                     ".SH VERBS\n";
  for (const VerbText& verb : verbs) {
    text += ".TP\n\\fB" + Roff(verb.name) + "\\fR\n" + Roff(verb.line) + "\n";
  }
  for (const VerbText& verb : verbs) text += VerbSection(verb);
  text += ".SH SEE ALSO\n.nf\n" + Roff(Whereabouts()) + "\n.fi\n";
  return text;
}

}  // namespace lyrefit
