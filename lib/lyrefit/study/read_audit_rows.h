#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/law/device.h"

namespace LYREFIT_PUBLIC lyrefit {

// A number as a publication prints it: the digits say how exactly it is known.
struct PrintedNumber {
  std::string text;      // "3.23021e-1", in the unit of its column
  double value = 0;      // in ampere, ohm or 1
  double half_unit = 0;  // half a unit of the last digit, in the same; 0: exact
  double factor = 1;     // the column's unit in ampere or ohm: 1e-6 for uA
};

// One row of a published table of parameters.
struct AuditRow {
  std::string source;     // "Table 10"
  std::string device;     // a curve's folder or file
  std::string algorithm;  // as the table calls it
  Model model = Model::kSingleDiode;
  PrintedNumber rmse;           // the claim
  bool sum_of_squares = false;  // `rmse` is one, in A^2, as long as the points are not known
  std::vector<PrintedNumber> parameters;  // in the device's order; empty: none are given
  std::optional<Objective> objective;     // of the claim; unset: that of the audit
  // What the row says about its conditions; unset: those of the curve.
  std::optional<double> temperature_C;
  std::optional<int> cells;  // in series
  std::optional<ConstantSet> constants;
  std::string bounds;     // "paper": bounds-paper.json beside the curve
  std::string note;       // as the table has it; nothing reads it
  int line = 0;           // of the file, from 1
  int device_column = 0;  // where the device stands in its line, from 1
  int bounds_column = 0;  // and where the bounds do; 0: they are not named
};

// A table of published parameters as it was read.
struct AuditRows {
  std::string path;  // of the table
  std::vector<AuditRow> rows;
  std::vector<Error> bad_rows;  // what could not be read, with file, line and column
  std::string remark;           // how its bytes were read, where they are no UTF-8
};

// Reads a table with a header that names its columns, in any order and case: source, device, model
// (sd, dd, td), algorithm, rmse_A, Iph_A, Rs_ohm, Rsh_ohm, Is1_A, n1, and Is2_A, n2, Is3_A, n3
// where a model has them; if there are any, also objective, temperature_C, cells, constants, bounds
// and note. A claim may be a sum of squares instead, in sse_A2. A current may be in A, mA, uA or nA
// and a resistance in ohm, mohm or 100ohm; columns of several units may stand side by side, and a
// row fills one of them; a row without any parameters has its claim alone. Comma, semicolon or tab
// between the fields; lines that start with '#' are comments.
// A file that is no UTF-8 is read as those of curves are: UTF-16, or Windows-1252.
//
// A printed zero, and an n without decimals (it stands at a bound), are exact. An unknown, repeated
// or missing column is an error of the whole file; a row that cannot be read is one of `bad_rows`.
Expected<AuditRows> ReadAuditRows(const std::string& path);

}  // namespace lyrefit
