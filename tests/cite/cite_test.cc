#include "lyrefit/cite/cite.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>
#include <vector>

#include "error_of.h"
#include "lyrefit/base/version.h"
#include "lyrefit/cite/references.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/report/json.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

// The keys of entries, in their order. Fails where the text is no BibTeX: an entry is "@type{key," and lines
// "  name = {value}" with balanced braces, and ends with a brace alone; between entries stand lines of comment.
std::vector<std::string> KeysOf(const std::string& bibtex) {
  static const std::regex kHead(
      R"(@(article|inproceedings|techreport|software|misc)\{([a-z0-9_]+),)");
  static const std::regex kField(R"(  [a-z]+ = \{(.*)\}(,?))");
  std::vector<std::string> keys;
  std::istringstream lines(bibtex);
  bool inside = false, more = false;
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (!inside && (line.empty() || line[0] == '%')) continue;
    if (!inside && std::regex_match(line, match, kHead)) {
      keys.push_back(match[2]);
      inside = more = true;
    } else if (inside && more && std::regex_match(line, match, kField)) {
      int depth = 0;
      for (const char c : match[1].str()) {
        depth += c == '{' ? 1 : c == '}' ? -1 : 0;
        EXPECT_GE(depth, 0) << line;
      }
      EXPECT_EQ(depth, 0) << line;
      EXPECT_THAT(match[1].str(), Not(::testing::ContainsRegex("(^|[^\\\\])[&%#$]"))) << line;
      more = match[2] == ",";
    } else if (inside && !more && line == "}") {
      inside = false;
    } else {
      ADD_FAILURE() << "no BibTeX: " << line;
    }
  }
  EXPECT_FALSE(inside);
  return keys;
}

std::vector<std::string> KeysOfReport(const std::string& json) {
  const auto cited = CiteReport(json, "report.json");
  EXPECT_TRUE(cited) << cited.error().ToString();
  return cited ? KeysOf(*cited) : std::vector<std::string>();
}

TEST(References, HaveKeysOfTheirOwnAndAreUsed) {
  std::set<std::string> keys, by_effects;
  for (const Effect* effect : Catalogue()) {
    for (const Publication* named : PublicationsIn(effect->reference))
      by_effects.insert(named->key);
  }
  for (const Publication& reference : Publications()) {
    EXPECT_TRUE(keys.insert(reference.key).second) << reference.key;
    EXPECT_TRUE(*reference.used != '\0' || by_effects.count(reference.key) == 1) << reference.key;
    EXPECT_THAT(KeysOf(BibTeX(reference)), ElementsAre(reference.key));
    EXPECT_EQ(FindPublication(reference.key), &reference);
  }
  EXPECT_GT(keys.size(), 40U);
  EXPECT_EQ(FindPublication("nobody1900"), nullptr);
}

// Its words are keys of the table, but for two effects that nobody published.
TEST(References, AreNamedByEveryEffect) {
  for (const Effect* effect : Catalogue()) {
    const std::string text = effect->reference;
    const bool published =
        std::set<std::string>{"clip", "range_switch", "unknown_structure"}.count(effect->id) == 0;
    const std::size_t parts = 1 + std::count(text.begin(), text.end(), ';');
    EXPECT_EQ(PublicationsIn(text).size(), published ? parts : 0) << effect->id << ": " << text;
  }
}

TEST(References, AreShownAsOneCites) {
  EXPECT_EQ(
      ReferenceText("desoto2006 (linear); mermoud2010"),
      "De Soto, Klein and Beckman 2006, doi:10.1016/j.solener.2005.06.010 (linear); Mermoud and "
      "Lejeune 2010, 25th European Photovoltaic Solar Energy Conference, Valencia");
  EXPECT_EQ(ReferenceText("luo2017"), "Luo et al. 2017, doi:10.1039/C6EE02271E");
  EXPECT_EQ(ReferenceText("iec60904_1 (offsets)"), "IEC 60904-1:2020 (offsets)");
  EXPECT_EQ(ReferenceText("a paper of mine, 2030"), "a paper of mine, 2030");
}

TEST(References, SayWhatIsMissing) {
  EXPECT_THAT(BibTeX(*FindPublication("mlo")),
              HasSubstr("% missing: author, title, year, doi\n@article{mlo,\n"));
  EXPECT_THAT(BibTeX(*FindPublication("storn1997")), Not(HasSubstr("missing")));
}

TEST(Cite, TheSoftwareSaysItsVersion) {
  EXPECT_THAT(KeysOf(CiteLyrefit()), ElementsAre("lyrefit"));
  EXPECT_THAT(CiteLyrefit(), HasSubstr(std::string("version = {") + Version() + "}"));
  EXPECT_THAT(KeysOf(CiteMethods()),
              ElementsAre("lyrefit", "mlo", "dehghani2023", "ceres", "shockley1949"));
}

TEST(Cite, AFitNamesWhatItUsed) {
  const auto curve = ReadCurve(std::string(LYREFIT_DATA_DIR) + "/rtc_france");
  ASSERT_TRUE(curve) << curve.error().ToString();
  FitOptions options;
  options.search.algorithm = Algorithm::kDe;
  options.model = Model::kDoubleDiode;
  const auto report = Fit(*curve, options);
  ASSERT_TRUE(report) << report.error().ToString();
  EXPECT_THAT(KeysOfReport(JsonReport(*report)),
              ElementsAre("lyrefit", "storn1997", "ceres", "patterson1971", "satterthwaite1946",
                          "shockley1949", "sah1957", "tiesinga2021", "easwarakhanthan1986"));
}

TEST(Cite, CountsWhatAReportSaysAndNotWhatItLeftOut) {
  const std::string version = R"({"lyrefit_version": "1", )";
  EXPECT_THAT(KeysOfReport(version + R"("algorithm": "pagmo:cmaes"})"),
              ElementsAre("lyrefit", "biscani2020", "hansen2001"));
  EXPECT_THAT(KeysOfReport(version + R"("floor": null, "draws": 0, "local_optima": {}})"),
              ElementsAre("lyrefit"));
  EXPECT_THAT(KeysOfReport(version + R"("verdict": {"causes": [{"effect": "scatter",
                 "alternatives": [{"effect": "shading"}]}]}, "trials": [{"effect": "outliers"}]})"),
              ElementsAre("lyrefit", "bucciarelli1979"));
  EXPECT_THAT(
      KeysOfReport(version + R"("results": [{"procedure": "iec1", "computed": true, "draws": 9},
                 {"procedure": "desoto", "computed": false}]})"),
      ElementsAre("lyrefit", "iec60891", "jcgm101"));
}

TEST(Cite, RefusesWhatIsNoReport) {
  for (const char* text : {"", "[]", "{}", "voltage,current\n1,2\n"}) {
    EXPECT_THAT(MessageOf(CiteReport(text, "x.json")), HasSubstr("expected the JSON of a report"));
  }
}

}  // namespace
}  // namespace lyrefit
