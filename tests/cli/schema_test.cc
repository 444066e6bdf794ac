// Validates the JSON of every verb against its schema in data/schema.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "repeats.h"
#include "run_app.h"

namespace lyrefit {
namespace {

const std::string kData = std::string(LYREFIT_DATA_DIR) + "/";
const std::string kChecker = kData + "../tests/cli/check_schema.py";
const std::string kSearch = " --population 10 --iterations 10 --quiet ";
const std::string kCauses = " --effects nonohmic_shunt,irr_step --no-held-out --quiet ";

bool Works(const std::string& command) { return std::system(command.c_str()) == 0; }

// The command of a Python with the module jsonschema; empty if there is none.
std::string Python() {
  for (const std::string python : {"python3", "/usr/bin/python3"}) {
    if (Works(python + " -c 'import jsonschema' 2>/dev/null")) return python;
  }
  return "";
}

struct SchemaCase {
  std::string name;
  std::string arguments;  // FILE stands for the output file
  std::string schema;
};

void PrintTo(const SchemaCase& c, std::ostream* out) { *out << c.name; }

class Schema : public ::testing::TestWithParam<SchemaCase> {};

TEST_P(Schema, HoldsForWhatIsWritten) {
  SKIP_IF_SANITIZED();
  const std::string python = Python();
  if (python.empty()) GTEST_SKIP() << "no Python with jsonschema (Debian: python3-jsonschema)";
  const TempFolder folder;
  const std::string file = folder.Path("record.json");
  std::string arguments = GetParam().arguments;
  arguments.replace(arguments.find("FILE"), 4, "'" + file + "'");
  const AppResult run = RunApp(arguments);
  ASSERT_TRUE(run.exit_code == 0 || run.exit_code == 2) << run.err;
  ASSERT_FALSE(FileText(file).empty()) << run.err;
  const std::string said = folder.Path("said");
  const std::string schema = kData + "schema/" + GetParam().schema + ".json";
  EXPECT_TRUE(
      Works(python + " '" + kChecker + "' '" + schema + "' '" + file + "' >'" + said + "' 2>&1"))
      << FileText(said);
}

std::vector<SchemaCase> SchemaCases() {
  const std::string rtc = kData + "rtc_france ", set = kData + "s75_constructed ";
  const std::string shaded = kData + "diagnosis/shaded_module.csv ";
  const std::string sweeps = kData + "diagnosis/sweeps ";
  const std::string module =
      "datasheet --isc 4.70 --voc 21.4 --imp 4.26 --vmp 17.6 --alpha 0.002 --beta -0.076 --cells "
      "36 ";
  return {
      {"Fit", "fit " + rtc + "--floor --json FILE" + kSearch, "fit"},
      {"FitAuto", "fit " + rtc + "--model auto --noise field --json FILE" + kSearch, "fit"},
      {"FitWithoutPolish", "fit " + rtc + "--no-polish --json FILE" + kSearch, "fit"},
      {"FitOfSeveral", "fit " + rtc + kData + "pwp201 --json FILE" + kSearch, "fit"},
      {"FitWithEffects", "fit " + shaded + "--with shading --json FILE --quiet", "fit"},
      {"Family", "fit " + set + "--family desoto --with temp_offset --json FILE" + kSearch,
       "family"},
      {"FamilyAuto", "fit " + set + "--family auto --json FILE" + kSearch, "family"},
      {"FamilyOneByOne", "fit " + set + "--family free --json FILE --quiet", "family"},
      {"TwoJunctions", "fit " + rtc + "--junctions 2 --json FILE" + kSearch, "two_junctions"},
      {"Pvlib", "fit " + set + "--family pvsyst --pvlib FILE" + kSearch, "pvlib"},
      {"DataSheet", module + "--json FILE", "data_sheet"},
      {"Translation",
       "translate " + rtc +
           "--irradiance-Wm2 1000 --rated-W 0.32 --json FILE --effects nonohmic_shunt,irr_step "
           "--quiet",
       "translation"},
      {"DataSheetForPvlib", module + "--pvlib FILE", "pvlib"},
      {"Diagnosis", "diagnose " + shaded + "--json FILE" + kCauses, "diagnosis"},
      {"DiagnosisOfSeveral", "diagnose " + rtc + kData + "pwp201 --json FILE" + kCauses,
       "diagnosis"},
      {"ExtendedModel", "diagnose " + shaded + "--extend FILE" + kCauses, "fit"},
      {"Answers", "diagnose " + shaded + "--answers FILE" + kCauses, "answers"},
      {"Reference",
       "diagnose " + kData + "diagnosis/sweep_now.csv --reference " + sweeps + "--json FILE" +
           kCauses,
       "reference"},
      {"OutlierSweeps", "diagnose " + sweeps + "--module --json FILE --quiet", "outlier_sweeps"},
      {"Cell",
       "cell " + kData + "cell/pair.csv " + kData + "cell/suns.csv " + kData +
           "cell/lit_dark.csv --json FILE --quiet",
       "cell"},
      {"Trend", "trend " + kData + "trend/year.csv --json FILE --quiet", "trend"},
      {"TrendOfOperatingPoints",
       "trend --operating " + kData + "trend/operating.csv --module " + kData +
           "trend/module.json --json FILE --quiet",
       "trend"},
      {"Certificate", "certify " + rtc + "--json FILE --quiet", "certificate"},
      {"Comparison",
       "compare " + rtc +
           "--models sd --runs 3 --population 10 --iterations 10 --json FILE "
           "--quiet",
       "comparison"},
      {"ComparisonWithEffects",
       "compare " + shaded +
           "--with shading:w=0.3333 --models sd --algorithms mlo,random --runs 2 --population 5 "
           "--iterations 4 --json FILE --quiet",
       "comparison"},
      {"Audit", "audit " + kData + "paper/rows.csv --json FILE", "audit"},
      {"Inspection", "inspect " + kData + "formats/head_tracer.csv --json FILE --quiet",
       "inspection"},
      {"InspectionOfSeveral",
       "inspect " + kData + "formats " + kData + "formats/other_names.csv " + kData +
           "formats/current_first.txt " + kData + "formats/matrix_sam.csv --json FILE --quiet",
       "inspection"},
      {"AuditOfClaims", "audit " + kData + "published/rows.csv --json FILE", "audit"},
  };
}

INSTANTIATE_TEST_SUITE_P(OfEveryVerb, Schema, ::testing::ValuesIn(SchemaCases()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace lyrefit
