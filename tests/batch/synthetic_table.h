#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace made {

// Rows of a CSV file with a column `id`.

using Row = std::map<std::string, std::string>;  // cells by column name

// Returns an error message, empty on success.
std::string ReadRows(const std::string& path, std::vector<Row>* rows);
std::string At(const Row& row, const char* name);  // empty for a missing column
std::set<std::string> Words(const std::string& text, const char* between);

}  // namespace made
