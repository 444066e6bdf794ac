#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/read_curve.h"
#include "lyrefit/batch/batch_source.h"
#include "lyrefit/batch/row_fields.h"

namespace lyrefit {

// What the error of a row begins with that was broken when it was packed.
inline constexpr std::string_view kPackedAsBroken = "packed as a broken one: ";

// Where a row stands, for its errors.
struct RowPlace {
  const std::string& file;
  std::int64_t line;

  // `other_line`: of a reading in a line of its own.
  tl::unexpected<Error> Refuse(std::string message, int column = 0,
                               std::int64_t other_line = 0) const {
    return Fail(std::move(message), file, static_cast<int>(other_line == 0 ? line : other_line),
                column);
  }
};

// The curve of a row: its lists under the names of ReadCurve, the conditions and notes that its
// scalars state. `id` is its name.
Expected<IvCurve> CurveOfRow(const RowFields& fields, const RowPlace& place, const std::string& id,
                             const ReadOptions& options);

// The scalars that are neither condition nor note nor part of the id.
std::map<std::string, std::string> BesideOfRow(const RowFields& fields);

}  // namespace lyrefit
