// Experimental: may change in a minor version (data/stable).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/model/device.h"

namespace LYREFIT_PUBLIC lyrefit {

// A number as a publication prints it. Its digits determine its precision.
struct PrintedNumber {
  std::string text;      // "3.23021e-1", in the unit of its column
  double value = 0;      // in ampere, ohm or 1
  double half_unit = 0;  // half a unit of the last digit, in the unit of `value`; 0: exact
  double factor = 1;     // the column's unit in ampere or ohm: 1e-6 for uA
};

// One row of a published table of parameters.
struct AuditRow {
  std::string source;     // "Table 10"
  std::string device;     // folder or file of a curve
  std::string algorithm;  // as named in the table
  Model model = Model::kSingleDiode;
  PrintedNumber rmse;  // the claimed RMSE
  // `rmse` is a sum of squares in A^2 until the number of points is known.
  bool sum_of_squares = false;
  std::vector<PrintedNumber> parameters;  // in the device's order; empty: none are given
  std::optional<Objective> objective;     // of the claim; unset: the objective of the audit
  // Conditions stated by the row; unset: those of the curve.
  std::optional<double> temperature_C;
  std::optional<int> cells;  // in series
  std::optional<ConstantSet> constants;
  std::string bounds;     // "paper": bounds-paper.json beside the curve
  std::string note;       // as in the table; not evaluated
  int line = 0;           // of the file, from 1
  int device_column = 0;  // column of the device in its line, from 1
  int bounds_column = 0;  // column of the bounds in its line, from 1; 0: no bounds are named
};

// A table of published parameters as it was read.
struct AuditRows {
  std::string path;  // of the table
  std::vector<AuditRow> rows;
  std::vector<Error> bad_rows;  // unreadable rows, with file, line and column
  std::string remark;           // encoding of the file, if it is not UTF-8
};

// Reads a table with a header that names its columns, in any order and case. The columns are
// source, device, model (sd, dd, td), algorithm, rmse_A, Iph_A, Rs_ohm, Rsh_ohm, Is1_A, n1, and
// Is2_A, n2, Is3_A, n3 where a model has them. The columns objective, temperature_C, cells,
// constants, bounds and note are optional. Instead of rmse_A a claim may be a sum of squares in
// sse_A2. A current may be in A, mA, uA or nA and a resistance in ohm, mohm or 100ohm. A quantity
// may have columns of several units, and a row fills one of them. A row without parameters has only
// its claim. Fields are separated by comma, semicolon or tab. Lines that start with '#' are
// comments. A file that is not UTF-8 is decoded as UTF-16 or Windows-1252, like a curve file.
//
// A printed zero is exact. An n without decimals is exact too, since it is at a bound. An unknown,
// repeated or missing column is an error of the whole file. An unreadable row becomes one of
// `bad_rows`.
Expected<AuditRows> ReadAuditRows(const std::string& path);

}  // namespace lyrefit
