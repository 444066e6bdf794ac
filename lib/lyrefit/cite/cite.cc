#include "lyrefit/cite/cite.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "lyrefit/base/address.h"
#include "lyrefit/base/version.h"
#include "lyrefit/cite/references.h"
#include "lyrefit/effects/catalogue.h"

namespace lyrefit {
namespace {

using Json = nlohmann::json;
using Facts = std::set<std::string>;

// What a diagnosis tried and did not name, or could not.
const Facts& NotUsed() {
  static const Facts keys = {"trials",      "alternatives", "mechanisms",
                             "below_floor", "equivalents",  "cannot_be_excluded"};
  return keys;
}

// Whether a value says something: it is not null, false, 0, or empty.
bool Says(const Json& value) {
  if (value.is_number()) return value.get<double>() != 0;
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_string()) return !value.get_ref<const std::string&>().empty();
  return !value.empty();
}

// Adds KEY and KEY=VALUE of all that the report says (Publication::used).
void Collect(const Json& value, const std::string& key, Facts* facts) {
  if (!Says(value)) return;
  if (!key.empty()) facts->insert(key);
  if (value.is_string()) facts->insert(key + "=" + value.get<std::string>());
  if (value.is_array()) {
    for (const Json& member : value) Collect(member, key, facts);
  }
  if (!value.is_object() || !value.value("computed", true)) return;
  for (const auto& [name, member] : value.items()) {
    if (NotUsed().count(name) == 0) Collect(member, name, facts);
  }
}

bool IsFact(const std::string& pattern, const Facts& facts) {
  if (pattern.back() != '*') return facts.count(pattern) > 0;
  const std::string begin = pattern.substr(0, pattern.size() - 1);
  const auto next = facts.lower_bound(begin);
  return next != facts.end() && next->compare(0, begin.size(), begin) == 0;
}

bool IsUsed(const Publication& reference, const Facts& facts) {
  const std::string used = reference.used;
  for (std::size_t begin = 0; begin < used.size();) {
    const std::size_t end = std::min(used.find(' ', begin), used.size());
    if (IsFact(used.substr(begin, end - begin), facts)) return true;
    begin = end + 1;
  }
  return false;
}

// References of the effects that a report fitted or named as causes.
std::set<const Publication*> OfEffects(const Facts& facts) {
  std::set<const Publication*> used;
  for (const Effect* effect : Catalogue()) {
    for (const char* key : {"effect=", "effects=", "causes="}) {
      if (facts.count(std::string(key) + effect->id) == 0) continue;
      for (const Publication* reference : PublicationsIn(effect->reference)) used.insert(reference);
    }
  }
  return used;
}

std::string CiteFacts(const Facts& facts) {
  const std::set<const Publication*> effects = OfEffects(facts);
  std::string text = CiteLyrefit();
  for (const Publication& reference : Publications()) {
    if (effects.count(&reference) > 0 || IsUsed(reference, facts)) text += "\n" + BibTeX(reference);
  }
  return text;
}

}  // namespace

std::string CiteLyrefit() {
  std::string fields = fmt::format(
      "  author = {{{{The lyrefit authors}}}},\n"
      "  title = {{lyrefit: diode-model parameters from measured photovoltaic {{I-V}} curves}},\n"
      "  version = {{{}}},\n",
      Version());
  const std::string year = LYREFIT_YEAR, address = PublishedAt().base;
  if (!year.empty()) fields += "  year = {" + year + "},\n";
  if (!address.empty()) fields += "  url = {" + address + "},\n";
  const std::string missing = std::string(year.empty() ? ", year" : "") +
                              (address.empty() ? ", url (none is published)" : "");
  return (missing.empty() ? "" : "% missing: " + missing.substr(2) + "\n") +
         "@software{lyrefit,\n" + fields + "  license = {BSD-3-Clause}\n}\n";
}

std::string CiteMethods() {
  return CiteFacts({"algorithm=mlo", "refine", "model=sd"}) +
         "\n% lyrefit cite REPORT.json: what a report used\n";
}

Expected<std::string> CiteReport(const std::string& json, const std::string& source) {
  Json report = Json::parse(json, nullptr, false);
  if (!report.is_array()) report = Json::array({report});  // else of many fits
  const auto says_version = [](const Json& one) { return one.contains("lyrefit_version"); };
  if (!std::any_of(report.begin(), report.end(), says_version)) {
    return Fail("expected the JSON of a report, as --json FILE of fit, compare, diagnose writes it",
                source);
  }
  Facts facts;
  Collect(report, "", &facts);
  return CiteFacts(facts);
}

namespace {

std::vector<std::string> Split(const std::string& text, const std::string& by) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find(by, begin)) != std::string::npos;
       begin = end + by.size()) {
    parts.push_back(text.substr(begin, end - begin));
  }
  parts.push_back(text.substr(begin));
  return parts;
}

// "Storn and Price 1997, doi:10.1023/A:1008202821328"; of a standard its number.
std::string InShort(const Publication& reference) {
  if (std::string(reference.type) == "misc") return reference.in;
  std::string text;
  const std::vector<std::string> authors = Split(reference.author, " and ");
  if (authors.size() > 3 || authors.back() == "others") {
    text = authors.front().substr(0, authors.front().find(',')) + " et al.";
  } else {
    for (std::size_t i = 0; i < authors.size(); ++i) {
      if (i > 0) text += i + 1 < authors.size() ? ", " : " and ";
      text += authors[i].substr(0, authors[i].find(','));
    }
  }
  text += fmt::format(" {}", reference.year);
  if (*reference.doi != '\0') return text + ", doi:" + reference.doi;
  text += fmt::format(", {}", reference.in);
  if (*reference.volume != '\0') text += fmt::format(" {}", reference.volume);
  return *reference.pages != '\0' ? fmt::format("{}, {}", text, reference.pages) : text;
}

// The field of BibTeX that `in` is.
const char* PlaceField(const std::string& type) {
  if (type == "article") return "journal";
  if (type == "inproceedings") return "booktitle";
  return type == "techreport" ? "institution" : "howpublished";
}

}  // namespace

std::vector<const Publication*> PublicationsIn(const std::string& text) {
  std::vector<const Publication*> found;
  for (const std::string& part : Split(text, "; ")) {
    if (const Publication* one = FindPublication(part.substr(0, part.find(' '))))
      found.push_back(one);
  }
  return found;
}

std::string ReferenceText(const std::string& text) {
  std::string shown;
  for (const std::string& part : Split(text, "; ")) {
    const std::size_t end = part.find(' ');
    const Publication* const one = FindPublication(part.substr(0, end));
    if (!shown.empty()) shown += "; ";
    shown += one == nullptr ? part : InShort(*one);
    if (one != nullptr && end != std::string::npos) shown += part.substr(end);
  }
  return shown;
}

std::string BibTeX(const Publication& reference) {
  const std::string type = reference.type;
  const bool article = type == "article";
  const struct {
    const char* name;
    const char* value;
    bool expected;
  } fields[] = {
      {"author", reference.author, true},
      {"title", reference.title, true},
      {PlaceField(type), reference.in, type != "software"},
      {"year", reference.year, true},
      {"volume", reference.volume, article},
      {"number", reference.number, false},
      {"pages", reference.pages, article},
      {"doi", reference.doi, article},
  };
  std::string entry = fmt::format("@{}{{{}", type, reference.key);
  std::string missing;
  for (const auto& field : fields) {
    if (*field.value != '\0') {
      entry += fmt::format(",\n  {} = {{{}}}", field.name, field.value);
    } else if (field.expected) {
      missing += (missing.empty() ? "% missing: " : ", ") + std::string(field.name);
    }
  }
  return (missing.empty() ? "" : missing + "\n") + entry + "\n}\n";
}

}  // namespace lyrefit
