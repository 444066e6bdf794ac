// Writes the results of a synthetic plant and their page, for the tests in a browser:
//   synthetic_plant_page ROWS FOLDER PAGE
// FOLDER receives results.csv, results.jsonl and results.schema.json. ROWS is a number, or "hostile" for rows whose
// texts try to be more than texts.
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "plant/made_results.h"
#include "plant/plant_page.h"
#include "plant/synthetic_rows.h"

namespace lyrefit {
namespace {

// A row with this text in the place of its names.
ResultRow Hostile(std::int64_t row, const std::string& text) {
  ResultRow made = SyntheticPlantResult(1, row);
  const auto columns = SyntheticPlantColumns();
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const std::string& name = columns[c].name;
    if (name == "id") made.cells[c] = text + "/" + std::to_string(row);
    if (name == "cause_title" || name == "cause" || name == "page") made.cells[c] = text;
  }
  return made;
}

constexpr const char* kHostile[] = {"<img src=x onerror=alert(1)>",
                                    "</script><script>alert(1)</script>",
                                    "=1+cmd|' /C calc'!A0",
                                    "a,\"b\"\nc",
                                    "../../etc/passwd",
                                    "javascript:alert(1)",
                                    "%{x} &amp; {{y}}",
                                    "\xe5\xa4\xaa\xe9\x99\xbd \xc3\x9c"
                                    "ber \xf0\x9f\x8c\x9e",
                                    "__proto__"};

}  // namespace
}  // namespace lyrefit

int main(int count, char** arguments) {
  if (count != 4) return 1;
  const std::string folder = arguments[2];
  std::filesystem::create_directories(folder);
  {
    lyrefit::MadeResults results(
        folder, lyrefit::SyntheticPlantColumns(),
        {{"options", {{"tracer", "100 points"}, {"seed", "1"}}}, {"task", "field-test"}});
    for (std::int64_t row = 0; row < std::atoll(arguments[1]); ++row) {
      results.Add(lyrefit::SyntheticPlantResult(1, row));
    }
    std::int64_t row = 0;
    for (const char* text : lyrefit::kHostile) {
      if (arguments[1] == std::string("hostile")) results.Add(lyrefit::Hostile(row++, text));
    }
  }
  const auto rows = lyrefit::WritePlantPage(folder, arguments[3], "Synthetic plant");
  if (!rows) std::fprintf(stderr, "%s\n", rows.error().ToString().c_str());
  return rows ? 0 : 1;
}
