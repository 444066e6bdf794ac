#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lyrefit/batch/result_row.h"

namespace lyrefit {

// The table inside a plant's page, for a browser to unpack without a library.
//
// Rows stand in groups of kPlantGroupRows, the cells of a group column by column. A column of a
// group is a gzip stream of its own, in base64, so that a page reads the columns that it shows and
// nothing else. Unpacked it is, all numbers little-endian, with n rows:
//   byte 0      what follows: 0 doubles, 1 decimals, 2 texts, 3 words
//   doubles     8 n bytes: first byte 0 of all rows, then byte 1 of all, ...; NaN is not known
//   decimals    byte 1 is d, byte 2 is w; w n bytes in planes as above. A code of 0 is not known,
//               else z = code - 1 is the number k = (z even ? z / 2 : -(z + 1) / 2) / 10^d
//   texts       a JSON array of n texts, null where not known
//   words       byte 1 is w, bytes 2 to 5 the length of a JSON array of the words that occur; after
//               it the place of each row's word, w n bytes in planes
// Truths are the decimals 0 and 1. Numbers are the doubles given, bit for bit, but for whole numbers
// beyond 2^53, which are the nearest double, and minus zero, which is zero.
constexpr int kPlantGroupRows = 8192;

class PlantTable {
 public:
  // `digits`: significant digits that numbers are rounded to; 0 keeps all.
  PlantTable(std::vector<ResultColumn> columns, int digits);

  // One cell a column. Returns whether the group is full and has to be taken.
  bool Add(const ResultRow& row);

  // The columns of the group one behind the other in base64, nothing where there are no rows. The
  // group is empty afterwards.
  std::string TakeGroup();

  // {"columns": [{"name", "unit", "type", "doc"}], "groups": [{"rows", "parts": [characters of each
  // column]}]}
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
