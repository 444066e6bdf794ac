// Experimental: may change in a minor version (data/stable).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/curve_kind.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/read/read_curve.h"

namespace LYREFIT_PUBLIC lyrefit {

// A line above a table, or one of its results.
struct HeadLineNote {
  int line = 0;       // of the file, from 1
  std::string text;   // as it stands
  std::string taken;  // "irradiance 912 W/m2"; empty: not understood, and not used
};

// A curve as it is read.
struct CurveNote {
  std::string name;        // as for --column and --curve
  std::size_t points = 0;  // readings
  double least_V = kUnknown;
  double largest_V = kUnknown;
  KeyPoints key_points;                   // of the readings; unknown of a dark curve
  KindOfMeasurement kind;                 // what was measured
  std::string direction;                  // "up", "down", "up and down"
  std::optional<double> irradiance_W_m2;  // if stated
  std::optional<double> temperature_C;    // if stated
};

// Something that the file does not say, or why it is not read, and the flag that says it.
struct WayOut {
  std::string what;  // "cell temperature", or what would be read with the flag
  std::string flag;  // "--cells N"
};

// What a file holds, and how it is understood.
struct Inspection {
  std::string file;        // its path as it was given
  std::string form;        // "table", "JSON document", "PVsyst module", "folder", ...
  std::string encoding;    // "UTF-8", "UTF-16", "Windows-1252"; empty for a folder
  std::string separator;   // of a table: "comma", "tab", ...
  std::string decimal;     // "point", "comma"
  int header_line = 0;     // 0: none
  int first_row_line = 0;  // 0: no table
  int rows = 0;            // of numbers
  std::vector<ColumnNote> columns;
  std::vector<HeadLineNote> head;
  std::size_t curve_count = 0;  // also of those that are not in `curves`
  std::vector<CurveNote> curves;
  std::vector<std::pair<std::string, std::string>> values;  // of a module: "Isc (A)", "9.05"
  std::string refusal;               // why no curve is read; empty: none is refused
  std::vector<WayOut> missing;       // and the ways out of a refusal
  std::vector<std::string> doubts;   // of the readings, and of curves that are refused
  std::vector<std::string> assumed;  // by the reader
  std::vector<std::string> next;     // what to run: "lyrefit fit FILE"
};

// Curves that are described one by one; of more the number is stated.
constexpr std::size_t kMostCurveNotes = 20;

// Looks at a file or folder of any shape that this library knows, and at any other text: it answers
// also where a reader refuses. "-" is standard input. Errors: no such file, no text (a workbook, a
// binary file).
Expected<Inspection> Inspect(const std::string& path, const ReadOptions& options = {});

// The answer as text of at most 100 columns.
std::string InspectionText(const Inspection& inspection);

// The answers as JSON (data/schema/inspection.json); those of several files are an array.
std::string InspectionJson(const std::vector<Inspection>& inspections);

}  // namespace lyrefit
