#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/read/column.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/records.h"
#include "lyrefit/read/table_columns.h"
#include "lyrefit/read/table_curve.h"

namespace lyrefit {

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
