#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/read_curve.h"

namespace LYREFIT_PUBLIC lyrefit {

// Many curves, read one by one in constant memory, whatever shape they come in:
//   - one curve a row: JSON Lines, or CSV whose columns hold lists of voltages and currents ("0 1 2",
//     "0;1;2", "[0, 1, 2]", or pairs in one column, "V*I#0*8.1#1*8.0#"),
//   - a long table: a row a reading, the curve's id beside it (in one column or in several: site,
//     inverter, combiner, string), the rows of a curve together,
//   - JSON with a list of curves: ivcurves, or objects with lists of voltage and current,
//   - a folder tree of single curves, whose paths are the identities
//     (site/inverter/combiner/string.csv); sidecars lie beside the tables,
//   - single curves as ReadCurve takes them.
// Names of columns and keys are those that ReadCurve knows; what states a condition or is a key of a
// sidecar (cells_in_series, irradiance_W_m2, cell_temperature_C, technology, date, ...) counts, the
// rest is kept beside. A JSON object in a column `more` counts as if its keys were columns.
//
// The id is that of `id`, `curve_id`, `string_id` or `path`; else `site`, `block`, `inverter`,
// `combiner`, `mppt`, `string` and `curve`, as many as there are, joined by '/' in this order; else
// `name`, `label`, `module`, `device` or `serial`; else the place, "strings:17". Of a folder's
// tables it is the path below the folder, without its ending; a file `curve.csv` is its folder.
// Where several folders are given their names come first.
//
// A curve is never lost: a row that is cut, too long or stands under an id that was used before is
// an item too, whose Read gives the error.

// k of N parts of the input, from 1: the curves that begin in that part of all bytes. A shard reads
// through what lies before it (about three seconds a gigabyte), for the numbers of the lines and for
// the ids that are used already, so that N shards give what one run gives.
struct Shard {
  int k = 1;   // which part, from 1
  int of = 1;  // how many parts
};

// How the input is read, and which part of it.
struct BatchReadOptions {
  ReadOptions reading;  // largest_file_bytes limits a row, too
  Shard shard;
};

// A curve as it stands in the input: found, not yet read.
struct BatchItem {
  std::int64_t place = 0;      // among those of this shard, from 0
  std::string id;              // "site/inv01/comb2/str07"; '/' separates the levels of a plant
  std::string where;           // "strings.csv:17", or its file
  std::string bytes;           // of its row or rows; empty where it is a file of its own
  std::int64_t end = 0;        // of size(), how much lies behind it when it is done
  int input = 0;               // of those given, from 0
  std::int64_t line = 0;       // where it begins in its file, from 1; 0: it is a file
  std::int64_t number = 0;     // among those of its input, from 0
  bool unnamed = false;        // nothing names it: the id is its place
  std::optional<Error> error;  // known already when it was found
};

// What it holds. A broken one keeps the id it stands under, where that can be told.
struct BatchCurve {
  std::string id;
  Expected<IvCurve> curve;  // or why it cannot be read
  std::map<std::string, std::string>
      beside;  // what else stands beside it: date, rated_power_W, ...
};

// Where the curves of a batch come from, one after the other.
class BatchSource {
 public:
  virtual ~BatchSource() = default;
  // The next one in the order of the input, none at the end. From one thread. Errors: the input
  // cannot be read any further.
  virtual Expected<std::optional<BatchItem>> Next() = 0;
  // From any thread.
  virtual BatchCurve Read(const BatchItem& item) const = 0;
  // What `end` of the last item comes to, in bytes; 0: not known (standard input, a pipe). For progress.
  virtual std::int64_t size() const = 0;
  // Differs where the input of this shard does: the names of the files, their sizes, and their bytes
  // (CRC-32) up to where the shard ends, since ids and lines count from the beginning. Of a folder
  // tree: the names, sizes and bytes of its tables and of the files beside them. Reads all that, at
  // one to two gigabytes a second. Up to its first '-' it says names and sizes, which all shards of one
  // input have alike. Standard input and pipes have none: empty.
  virtual Expected<std::string> Digest() const = 0;
  // What was left aside, and why, in plain sentences: files of a folder that are no tables.
  virtual std::vector<std::string> Remarks() const = 0;
};

// `inputs` are files and folders, read one after the other; "-" is standard input. It
// and pipes are for rows and long tables. Errors: no such file, a shape that is not known, rows in
// UTF-16; of Next, an input without any curve.
//
// Memory: a block of the file, the longest row, and 34 MB for the ids from some thousand up to 1.9
// million of them (16 to 36 bytes for each one beyond). They are told apart by hashes of 64 bits:
// among a million, two that differ are taken for one with a probability of 3e-8.
Expected<std::unique_ptr<BatchSource>> OpenBatch(const std::vector<std::string>& inputs,
                                                 const BatchReadOptions& options = {});

}  // namespace lyrefit
