#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace made {

using Row = std::map<std::string, std::string>;  // cells by column name

// Reads a CSV file with a column id. Returns an error message, empty on success.
std::string ReadRows(const std::string& path, std::vector<Row>* rows);

// The cell of a column; empty if there is none.
std::string At(const Row& row, const char* name);

// The words of a text, with any of the characters `between` between them.
std::set<std::string> Words(const std::string& text, const char* between);

}  // namespace made
