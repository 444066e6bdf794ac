#pragma once

#include <map>
#include <string>
#include <string_view>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/records.h"
#include "lyrefit/stream/batch_source.h"

namespace lyrefit {

// Prefix of the error of a row that was already broken when it was packed.
inline constexpr std::string_view kPackedAsBroken = "packed as a broken one: ";

// The curve of a row. Its lists have the column names of ReadCurve, and its scalars state
// conditions and notes. `id` becomes the curve's name.
Expected<IvCurve> CurveOfRow(const Records& fields, const RecordPlace& place, const std::string& id,
                             const ReadOptions& options);

// The scalars that are neither a condition nor a note nor part of the id.
std::map<std::string, std::string> BesideOfRow(const Records& fields);

}  // namespace lyrefit
