#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lyrefit/batch/result_row.h"
#include "lyrefit/batch/row_text.h"

namespace lyrefit {

// Writes the files of results from which the page of a plant is made.
class MadeResults {
 public:
  MadeResults(const std::string& folder, std::vector<ResultColumn> columns,
              const nlohmann::ordered_json& run = nlohmann::ordered_json::object())
      : columns_(std::move(columns)),
        csv_(folder + "/results.csv"),
        lines_(folder + "/results.jsonl") {
    csv_ << HeadCsv(columns_);
    const nlohmann::ordered_json schema = {{"fields", FieldsJson(columns_)}, {"lyrefit", run}};
    std::ofstream(folder + "/results.schema.json")
        << schema.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  }

  // Adds a row; missing cells are unknown.
  void Add(ResultRow row) {
    row.cells.resize(columns_.size());
    csv_ << RowCsv(row);
    lines_ << RowJson(columns_, row) << '\n';
  }

 private:
  std::vector<ResultColumn> columns_;
  std::ofstream csv_, lines_;
};

}  // namespace lyrefit
