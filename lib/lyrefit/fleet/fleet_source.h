#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/read_curve.h"

namespace lyrefit {

// Many curves, read one by one in constant memory, whatever shape they come in:
//   - one curve a row: JSON Lines, or CSV whose columns hold lists of voltages and currents,
//   - a long table: a row a reading, the curve's id beside it, the rows of a curve together,
//   - ivcurves JSON,
//   - a folder tree of single curves, whose paths are the identities (site/inverter/combiner/string).

// k of N parts of the input, from 1; by bytes at line ends, or by files.
struct Shard {
  int k = 1;
  int of = 1;
};

struct FleetReadOptions {
  ReadOptions reading;
  Shard shard;
};

// A curve as it stands in the input: found, not yet read.
struct FleetItem {
  std::int64_t place = 0;  // among those of this shard, from 0
  std::string where;       // "strings.csv:17", or its file
  std::string bytes;       // of its row or rows; empty where it is a file of its own
  std::int64_t end = 0;  // of the shard's bytes (or files), how many lie behind it when it is done
};

// What it holds. A broken one keeps the id it stands under, where that can be told.
struct FleetCurve {
  std::string id;  // "site/inv01/comb2/str07"; '/' separates the levels of a plant
  Expected<IvCurve> curve;
  std::map<std::string, std::string>
      beside;  // what else stands beside it: date, rated_power_W, ...
};

class FleetSource {
 public:
  virtual ~FleetSource() = default;
  // The next one in the order of the input, none at the end. From one thread.
  virtual Expected<std::optional<FleetItem>> Next() = 0;
  // From any thread.
  virtual FleetCurve Read(const FleetItem& item) const = 0;
  // What `end` of the last item comes to; for progress.
  virtual std::int64_t size() const = 0;
  // Differs where the input of this shard does: its bytes, its names.
  virtual std::string Digest() const = 0;
};

// Errors: no such file, a shape that is not known, a shard of a shape that has to be packed first.
Expected<std::unique_ptr<FleetSource>> OpenFleet(const std::vector<std::string>& inputs,
                                                 const FleetReadOptions& options = {});

}  // namespace lyrefit
