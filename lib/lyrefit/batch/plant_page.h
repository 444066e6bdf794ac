#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/batch/result_row.h"

namespace LYREFIT_PUBLIC lyrefit {

// The page of a plant: one HTML file that needs no other and fetches nothing. What the rows come to
// stands in it as text, tables and two pictures, to be read on paper, in mail and without scripts; a
// script shows every row: a table to sort and filter, the plant's tree as a heat map, the worst
// curves, distributions, one column over another, trends.
//
// Columns may be any. These are understood by their names where they are there:
//   id                       '/' parts the levels of the plant's tree
//   status                   "fine" or anything else, with its reason in `reason`
//   zone                     begins with "pass", or the string needs work; without this column a
//                            string with a cause needs work
//   cause, cause_title, cause_sentence, equivalents, separate_by
//   cause_about              sweep, instrument or conditions: the string does not need work, but has
//                            to be measured again; anything else counts as a cause of the plant
//   date                     ISO 8601
//   performance_factor, else group_deviation_percent, recoverable_power_W, lack_of_fit_percent
//                            by which the worst are chosen
//   Pmax_stc_W, Pmax_stc_U_W (k = 2), rated_power_W, recoverable_power_W
//   sketch                   currents at even steps of V / Voc from 0 to 1, a byte each, in 1/255 of
//                            the largest, base64
//   page                     the string's own page: a path from PlantPageOptions::results

// A line about the whole: an instrument, options that are not the defaults, the seed.
struct PlantFact {
  std::string name;  // what the text is about
  std::string text;  // in plain words
};

// What the page of a plant is called and says besides its rows.
struct PlantPageOptions {
  std::string plant = "Plant";  // its name
  std::vector<PlantFact> facts = {};
  // Significant digits of the numbers in the page. 0 keeps all, bit for bit; 6 make a page of
  // half the size.
  int digits = 0;
  // What leads from the page to the folder of the results, in which paths of pages begin: "" or a
  // relative URL that ends with '/'.
  std::string results = {};
};

// Rows go into it one by one and from there, compressed, into a file without a name beside `file`,
// so that memory does not grow with their number. `file` is replaced when the page is complete.
class PlantPage {
 public:
  // Errors: no column, a folder that cannot be written to.
  static Expected<std::unique_ptr<PlantPage>> Open(const std::string& file,
                                                   std::vector<ResultColumn> columns,
                                                   PlantPageOptions options = {});
  virtual ~PlantPage() = default;

  // One cell a column; missing ones are not known. Errors: a full disk.
  virtual Expected<void> Add(const ResultRow& row) = 0;

  // Writes the page. Without it nothing is left of it.
  virtual Expected<void> Finish() = 0;
};

// The page of rows that were written before: JSON Lines, an object a row; its keys are the columns,
// in the order in which they first stand, each a number where every value of it is one. Columns that
// `known` names have their units and lines from there. Reads the file twice, line by line.
// Errors: no such file, a line that is no JSON object.
Expected<std::int64_t> WritePlantPage(const std::string& results_jsonl, const std::string& file,
                                      const PlantPageOptions& options = {},
                                      const std::vector<ResultColumn>& known = {});

// The same of a folder that RunBatch or MergeShards wrote: with the columns and the facts of its
// schema, links to the pages of single strings, and shorter numbers where there are many rows.
Expected<std::int64_t> WritePlantPageOf(const std::string& folder, const std::string& file,
                                        const std::string& plant);

// The relative URL from the folder of a file to a folder, with '/' at its end; "" where it is that.
std::string UrlFrom(const std::string& file, const std::string& folder);

}  // namespace lyrefit
