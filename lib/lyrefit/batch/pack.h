// Experimental: may change in a minor version (data/stable).
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/stream/batch_source.h"

namespace LYREFIT_PUBLIC lyrefit {

// Conversion of any shape of many curves to one curve a row. OpenBatch reads the rows back to the
// same curves, bit for bit. The rows can be split into shards.
enum class PackFormat {
  kJsonLines,
  // Columns id, irradiance_W_m2, cell_temperature_C, cells_in_series, voltage_V, current_A, more.
  kCsv
};

// Result of PackBatch.
struct PackReport {
  std::int64_t curves = 0;  // number written, including broken ones
  std::int64_t broken = 0;  // of `curves`: broken; their rows have the reason as "error"
  std::string first_error;  // of the first broken one
  bool interrupted = false;
};

// Receives the text of some rows.
using PackSink = std::function<Expected<void>(std::string_view text)>;

// Reads on up to `threads` threads (0: all cores) and writes in the order of the input. Unstated
// conditions are left out. The reader's assumptions are written as "assumptions". Errors: the input
// cannot be read further, or an error of `sink`.
Expected<PackReport> PackBatch(BatchSource* source, PackFormat format, int threads,
                               const PackSink& sink, const Observer& observer = {});

// PackBatch into a file, which gets its name when all rows are written. An error or an interrupted
// run leaves an existing file unchanged.
Expected<PackReport> PackBatchInto(const std::string& file, BatchSource* source, PackFormat format,
                                   int threads, const Observer& observer = {});

// The text of one row with its line end.
std::string PackedRow(const BatchCurve& curve, PackFormat format);

}  // namespace lyrefit
