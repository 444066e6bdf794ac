#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/read/column.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/table_columns.h"
#include "lyrefit/read/table_curve.h"

namespace lyrefit {

// What every layout is parsed to: names with scalars or with lists of readings. CurveOfRecords makes a
// curve of them.

// A value beside the readings.
struct RecordScalar {
  std::string name;
  std::string text;      // without quotes; a number as written
  bool is_text = false;  // marked as text, not a number
  int column = 0;        // in its line, from 1
};

// A list of readings.
struct Record {
  std::string name;
  std::vector<double> values;  // NaN where one is missing
  int column = 0;
  std::string bad;  // the first value that is no finite number, as written
  std::size_t bad_at = 0;
  int bad_column = 0;         // its column in the line, from 1; 0: unknown
  std::int64_t bad_line = 0;  // its line, if each reading has a line of its own
  bool has_bad = false;       // whether there is such a value
  bool bad_is_text = false;   // true: it is text and cannot be treated as missing
};

struct Records {
  std::vector<RecordScalar> scalars;
  std::vector<Record> lists;
  std::vector<std::string> assumptions;  // assumptions made when the row was packed
  Setup setup = Setup::kUnknown;         // of the measurement, where the layout tells it
  bool nested = false;                   // has values that are neither scalars nor lists of scalars
};

// Adds one item to a list: a number, a missing value, or an invalid text.
void AddReading(std::string_view text, bool decimal_comma, int column, Record* list);

// Position of records, for errors.
struct RecordPlace {
  const std::string& file;
  std::int64_t line = 0;  // 0: unknown

  // `other_line`: line of a single reading, if it differs from the records'; 0: the records' line.
  tl::unexpected<Error> Refuse(std::string message, int column = 0,
                               std::int64_t other_line = 0) const {
    return Fail(std::move(message), file, static_cast<int>(other_line == 0 ? line : other_line),
                column);
  }
};

// The curve of one channel, converted to the units of IvCurve, with the currents' original sign.
// `columns` interprets the lists. Further sweeps of the channel are appended. Optional lists that
// have no number for every reading are not used, and `assumptions` names them. Errors: a list with
// an invalid value, or with a missing one unless `options` skips them; lists of unlike length;
// temperatures that are no degrees Celsius.
Expected<RawCurve> CurveOfRecords(const Records& records, const std::vector<Column>& columns,
                                  const Channel& channel, const ReadOptions& options,
                                  const RecordPlace& place);

// Says how many rows of zeros were left out at the end (LeaveOutPadding); nothing of none.
void SayPadding(std::size_t rows, IvCurve* curve);

}  // namespace lyrefit
