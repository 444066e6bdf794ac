// Writes the page of a synthetic plant, for the tests in a browser:
//   synthetic_plant_page ROWS PAGE [DIGITS [ROWS_FILE]]
// ROWS_FILE receives the rows as JSON Lines.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "batch/synthetic_rows.h"
#include "lyrefit/batch/plant_page.h"

namespace lyrefit {
namespace {

std::string JsonLine(const std::vector<ResultColumn>& columns, const ResultRow& row) {
  nlohmann::ordered_json json;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    std::visit(
        [&](const auto& value) {
          if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::monostate>) {
            json[columns[c].name] = nullptr;
          } else {
            json[columns[c].name] = value;
          }
        },
        row.cells[c]);
  }
  return json.dump() + "\n";
}

int MakePage(std::int64_t rows, const std::string& file, int digits, const char* rows_file) {
  PlantPageOptions options;
  options.plant = "Synthetic-up plant";
  options.digits = digits;
  options.facts = {{"Instrument", "curve tracer, 100 points"},
                   {"Options", "field test, tolerance 5 %"},
                   {"Seed", "1"}};
  const auto columns = SyntheticPlantColumns();
  auto page = PlantPage::Open(file, columns, options);
  std::ofstream beside;
  if (rows_file) beside.open(rows_file);
  Expected<void> done;
  for (std::int64_t row = 0; page && done && row < rows; ++row) {
    const ResultRow made = SyntheticPlantResult(1, row);
    done = (*page)->Add(made);
    if (rows_file) beside << JsonLine(columns, made);
  }
  if (page && done) done = (*page)->Finish();
  if (page && done) return 0;
  std::fprintf(stderr, "%s\n", (page ? done.error() : page.error()).ToString().c_str());
  return 1;
}

}  // namespace
}  // namespace lyrefit

int main(int count, char** arguments) {
  if (count < 3) return 1;
  return lyrefit::MakePage(std::atoll(arguments[1]), arguments[2],
                           count > 3 ? std::atoi(arguments[3]) : 0,
                           count > 4 ? arguments[4] : nullptr);
}
