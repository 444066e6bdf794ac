#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "lyrefit/base/error.h"
#include "lyrefit/batch/batch_source.h"
#include "lyrefit/batch/row_fields.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/read_curve.h"

namespace lyrefit {

// Prefix of the error of a row that was already broken when it was packed.
inline constexpr std::string_view kPackedAsBroken = "packed as a broken one: ";

// Position of a row, for its errors.
struct RowPlace {
  const std::string& file;
  std::int64_t line;

  // `other_line`: line of a single reading, if it differs from the row's; 0: the row's line.
  tl::unexpected<Error> Refuse(std::string message, int column = 0,
                               std::int64_t other_line = 0) const {
    return Fail(std::move(message), file, static_cast<int>(other_line == 0 ? line : other_line),
                column);
  }
};

// The curve of a row. Its lists have the column names of ReadCurve, and its scalars state
// conditions and notes. `id` becomes the curve's name.
Expected<IvCurve> CurveOfRow(const RowFields& fields, const RowPlace& place, const std::string& id,
                             const ReadOptions& options);

// The scalars that are neither a condition nor a note nor part of the id.
std::map<std::string, std::string> BesideOfRow(const RowFields& fields);

}  // namespace lyrefit
