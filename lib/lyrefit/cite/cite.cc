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

}  // namespace lyrefit
