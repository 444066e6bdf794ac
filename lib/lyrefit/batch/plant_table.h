#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lyrefit/batch/result_row.h"

namespace lyrefit {

// The table inside a plant's page, in a format that a browser unpacks without a library.
//
// Rows are divided into groups of kPlantGroupRows. The cells of a group are stored column by
// column. A column of a group is a separate gzip stream in base64, so that a page unpacks only the
// columns it shows. The unpacked bytes, all numbers little-endian, with n rows, are:
//   byte 0      type: 0 doubles, 1 decimals, 2 texts, 3 words
//   doubles     8 n bytes: first byte 0 of all rows, then byte 1 of all, ...; NaN: unknown
//   decimals    byte 1 is d, byte 2 is w; w n bytes in planes as for doubles. Code 0: unknown; else
//               z = code - 1 is the number k = (z even ? z / 2 : -(z + 1) / 2) / 10^d
//   texts       a JSON array of n texts, null: unknown
//   words       byte 1 is w, bytes 2 to 5 the length of a JSON array of the different words; after
//               it the index of each row's word, w n bytes in planes
// Truth values are the decimals 0 and 1. Numbers are stored bit for bit, with two exceptions: whole
// numbers beyond 2^53 become the nearest double, and minus zero becomes zero.
constexpr int kPlantGroupRows = 8192;

class PlantTable {
 public:
  // `digits`: significant digits to which numbers are rounded; 0 keeps all.
  PlantTable(std::vector<ResultColumn> columns, int digits);

  // Adds a row with one cell for each column. True: the group is full, and TakeGroup must be
  // called.
  bool Add(const ResultRow& row);

  // Returns the concatenated columns of the group in base64, empty without rows. It clears the
  // group.
  std::string TakeGroup();

  // {"columns": [{"name", "unit", "type", "doc"}], "groups": [{"rows", "parts": [number of
  // characters of each column]}]}
  std::string Index() const;

 private:
  struct Group {
    int rows = 0;
    std::vector<std::size_t> parts;
  };
  std::vector<ResultColumn> columns_;
  int digits_;
  std::vector<std::vector<ResultCell>> cells_;  // by column
  std::vector<Group> groups_;
};

}  // namespace lyrefit
