// Experimental: may change in a minor version (data/stable).
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
#include "lyrefit/read/read_curve.h"

namespace LYREFIT_PUBLIC lyrefit {

// Many curves, read one by one in constant memory, in any of these shapes:
//   - one curve a row: JSON Lines, or CSV whose columns hold lists of voltages and currents
//     ("0 1 2", "0;1;2", "[0, 1, 2]", or pairs in one column, "V*I#0*8.1#1*8.0#"),
//   - a long table: one reading a row with the curve's id (in one column or in several: site,
//     inverter, combiner, string); the rows of a curve must be adjacent,
//   - JSON with a list of curves: ivcurves, or objects with lists of voltage and current,
//   - a folder tree of files, whose paths are the ids (site/inverter/combiner/string.csv); sidecars
//     are beside the tables. A file of several curves adds their ids (substrate3/pixel1),
//   - single curves in the formats of ReadCurve.
// Names of columns and keys are those of ReadCurve. Conditions and sidecar keys (cells_in_series,
// irradiance_W_m2, cell_temperature_C, technology, date, ...) are evaluated; other values are
// stored in BatchCurve::beside. The keys of a JSON object in a column `more` are treated as
// columns.
//
// The id is the first of these that exists: `id`, `curve_id`, `string_id` or `path`; the existing
// ones of `site`, `block`, `inverter`, `combiner`, `mppt`, `string` and `curve`, joined by '/' in
// this order; `name`, `label`, `module`, `device` or `serial`; the position, "strings:17". In a
// folder tree the id is the path below the folder without its ending. For a file `curve.csv` it is
// the path of its folder. If several folders are given, their names come first.
//
// With ReadOptions::whole_cells an item is a laboratory cell: the curves of a file whose names differ
// by the words of light and direction alone (up and down, lit and dark, several lights), or all
// curves of a file that holds one cell. In rows and long tables a curve is a cell.
//
// With ReadOptions::whole_files an item is a file, such as the sweeps of a device over time. It is not
// read here.
//
// No curve is dropped. A truncated or overlong row, or one with a repeated id, is an item whose
// Read returns the error.

// Part k of N of the input, from 1: the curves that begin in that part of all bytes. A shard also
// reads the bytes before its part (about three seconds a gigabyte). It needs them for line numbers
// and used ids, so that N shards give the results of one run.
struct Shard {
  int k = 1;   // number of the part, from 1
  int of = 1;  // number of parts
};

// How the input is read, and which shard of it.
struct BatchReadOptions {
  ReadOptions reading;  // largest_file_bytes also limits a row
  Shard shard;
};

class BatchInput;

// The position of a curve in the input, before it is read.
struct BatchItem {
  std::int64_t place = 0;      // index among the curves of this shard, from 0
  std::string id;              // "site/inv01/comb2/str07"; '/' separates the levels of a plant
  std::string where;           // "strings.csv:17", or the name of its file
  std::string bytes;           // of its row or rows; empty for a file of its own
  std::int64_t end = 0;        // bytes of the shard up to the end of the curve; see size()
  int input = 0;               // index of the input, from 0
  std::int64_t number = 0;     // index among the curves of its input, from 0
  std::int64_t line = 0;       // first line in its file, from 1; 0: a file of its own
  std::int64_t in_file = 0;    // index among the curves of a file that is not rows, from 0
  bool unnamed = false;        // the input has no name for it; the id is its position
  std::optional<Error> error;  // error found before reading
  std::shared_ptr<const BatchInput> reader;  // of the file that holds it
};

// A curve read from an item. A broken one keeps its id if the id is readable.
struct BatchCurve {
  std::string id;
  Expected<IvCurve> curve;  // or the error of reading it
  std::map<std::string, std::string>
      beside;                      // values that are not evaluated: date, rated_power_W, ...
  std::vector<IvCurve> more = {};  // the other curves of the same cell, with whole_cells
  std::string file = {};  // path of the item's file, with whole_files; `curve` is then empty
};

// A sequence of curves for a batch.
class BatchSource {
 public:
  virtual ~BatchSource() = default;
  // The next item in the order of the input; empty at the end. From one thread only. Errors: the
  // input cannot be read further.
  virtual Expected<std::optional<BatchItem>> Next() = 0;
  // Reads the curve of an item. Thread-safe.
  virtual BatchCurve Read(const BatchItem& item) const = 0;
  // Largest value of BatchItem::end in bytes, for progress; 0: unknown (standard input, a pipe).
  virtual std::int64_t size() const = 0;
  // A text that differs if the input of this shard differs. It covers file names, file sizes and
  // the bytes (CRC-32) up to the end of the shard, since ids and lines count from the beginning.
  // For a folder tree it covers the tables and the files beside them. Computing it reads all these
  // bytes, at one to two gigabytes a second. The part before the first '-' covers names and sizes
  // and is equal for all shards of one input. Empty for standard input and pipes.
  virtual Expected<std::string> Digest() const = 0;
  // Sentences on ignored files of a folder that are no tables.
  virtual std::vector<std::string> Remarks() const = 0;
};

// Opens the batch of `inputs`, which are files and folders, in their order. "-" is standard input;
// it and pipes may hold rows and long tables only. Errors: no such file, an unknown shape, rows in
// UTF-16. An input without any curve is an error of Next.
//
// Memory: a block of the file, the longest row, and 34 MB for ids, from some thousand up to 1.9
// million of them. Each further id takes 16 to 36 bytes. Ids are compared by hashes of 64 bits.
// Among a million ids, two different ones are taken for equal with a probability of 3e-8.
Expected<std::unique_ptr<BatchSource>> OpenBatch(const std::vector<std::string>& inputs,
                                                 const BatchReadOptions& options = {});

}  // namespace lyrefit
