#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/batch/result_row.h"

namespace LYREFIT_PUBLIC lyrefit {

// The page of a plant: one self-contained HTML file that loads nothing. The summary of the rows is
// in it as text, tables and two pictures, readable on paper, in mail and without scripts. A script
// shows every row: a table to sort and filter, the plant's tree as a heat map, the worst curves,
// distributions, one column against another, trends.
//
// Any columns are allowed. These names have a meaning if they exist:
//   id                       '/' separates the levels of the plant's tree
//   status                   "fine" or another status, with its reason in `reason`
//   zone                     begins with "pass", or the string needs work; without this column a
//                            string with a cause needs work
//   cause, cause_title, cause_sentence, equivalents, separate_by
//   cause_about              sweep, instrument or conditions: the string needs no work, but a
//                            repeated measurement; any other value is a cause of the plant
//   date                     ISO 8601
//   performance_factor, else group_deviation_percent, recoverable_power_W, lack_of_fit_percent
//                            the column that ranks the worst strings
//   Pmax_stc_W, Pmax_stc_U_W (k = 2), rated_power_W, recoverable_power_W
//   sparkline                currents at even steps of V / Voc from 0 to 1, a byte each, in 1/255
//                            of the largest, base64
//   page                     the string's own page: a path from PlantPageOptions::results

// A fact about the whole plant: an instrument, a non-default option, the seed.
struct PlantFact {
  std::string name;  // subject of the text
  std::string text;  // sentence or value
};

// Name and settings of a plant's page.
struct PlantPageOptions {
  std::string plant = "Plant";  // name of the plant
  std::vector<PlantFact> facts = {};
  // Significant digits of the numbers in the page. 0 keeps all, bit for bit. 6 halve the size of
  // the page.
  int digits = 0;
  // Prefix from the page to the folder of the results, to which paths of pages are relative: "" or
  // a relative URL that ends with '/'.
  std::string results = {};
};

// Writer of a plant's page. Rows are added one by one and stored compressed in a nameless file
// beside `file`, so that memory does not grow with their number. `file` is replaced when the page
// is complete.
class PlantPage {
 public:
  // Errors: no column, a folder that is not writable.
  static Expected<std::unique_ptr<PlantPage>> Open(const std::string& file,
                                                   std::vector<ResultColumn> columns,
                                                   PlantPageOptions options = {});
  virtual ~PlantPage() = default;

  // Adds a row with one cell for each column; missing cells are unknown. Errors: a full disk.
  virtual Expected<void> Add(const ResultRow& row) = 0;

  // Writes the page. Without this call nothing is left of the page.
  virtual Expected<void> Finish() = 0;
};

// Writes the page of existing rows: JSON Lines, one object a row. The keys are the columns, in the
// order of their first occurrence. A column is numeric if all its values are numbers. Columns in
// `known` take their units and descriptions from it. The file is read twice, line by line. Returns
// the number of rows. Errors: no such file, a line that is no JSON object.
Expected<std::int64_t> WritePlantPage(const std::string& results_jsonl, const std::string& file,
                                      const PlantPageOptions& options = {},
                                      const std::vector<ResultColumn>& known = {});

// Writes the page of a folder from RunBatch or MergeShards. Columns and facts are taken from its
// schema. The page links to the pages of single strings. Numbers are shortened if there are many
// rows. Returns the number of rows.
Expected<std::int64_t> WritePlantPageOf(const std::string& folder, const std::string& file,
                                        const std::string& plant);

// The relative URL from the folder of `file` to `folder`, with '/' at its end; "" if both are
// equal.
std::string UrlFrom(const std::string& file, const std::string& folder);

}  // namespace lyrefit
