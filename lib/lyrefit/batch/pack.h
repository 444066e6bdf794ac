#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/batch/batch_source.h"

namespace LYREFIT_PUBLIC lyrefit {

// Any shape of many curves as one curve a row, which OpenBatch reads back to the same curves, bit
// for bit, and which can be split into shards.
enum class PackFormat {
  kJsonLines,
  kCsv  // id, irradiance_W_m2, cell_temperature_C, cells_in_series, voltage_V, current_A, more
};

// What a run of PackBatch came to.
struct PackReport {
  std::int64_t curves = 0;  // written, broken ones among them
  std::int64_t broken = 0;  // of them; their rows hold the reason as "error"
  std::string first_error;  // of the first broken one
  bool interrupted = false;
};

// Takes the text of some rows.
using PackSink = std::function<Expected<void>(std::string_view text)>;

// Reads on up to `threads` threads (0: all cores) and writes in the order of the input. Conditions
// that nobody stated are left out; what the reader assumed goes along as "assumptions". Errors: the
// input cannot be read any further, or those of `sink`.
Expected<PackReport> PackBatch(BatchSource* source, PackFormat format, int threads,
                               const PackSink& sink, const Observer& observer = {});

// The same into a file, which gets its name when all rows are in it: an error or an interrupted run
// leaves what was there before.
Expected<PackReport> PackBatchInto(const std::string& file, BatchSource* source, PackFormat format,
                                   int threads, const Observer& observer = {});

// One row with its end.
std::string PackedRow(const BatchCurve& curve, PackFormat format);

}  // namespace lyrefit
