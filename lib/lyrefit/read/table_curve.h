#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/sidecar.h"
#include "lyrefit/read/text_encoding.h"

namespace lyrefit {

// Names of files in a folder of curves.
constexpr char kCurvesName[] = "curves.csv";
constexpr char kIndexName[] = "index.csv";
constexpr char kDatasetName[] = "dataset.json";

bool IsFile(const std::filesystem::path& path);
// Error if a path found in a folder is a pipe or device, since opening a pipe would wait for its
// writer.
Expected<void> CheckIsNoStream(const std::filesystem::path& path);
bool IsFolder(const std::filesystem::path& path);
bool IsJson(const std::filesystem::path& path);
bool IsTable(const std::filesystem::path& path);  // by its extension: .csv, .txt, .dat, ...

// Name of the folder that contains the path; empty at the root.
std::string FolderNameOf(const std::filesystem::path& path);

// The table in a folder of one curve: curve.csv, or a table of the folder's own name, as IV_Swinger
// writes it. Empty if there is none.
std::filesystem::path CurveInFolder(const std::filesystem::path& folder);

// Paths of the tables in a folder, sorted by name, except an index.
std::vector<std::filesystem::path> TablesIn(const std::filesystem::path& folder);
// Whether a folder below holds a table.
bool HoldsTablesBelow(const std::filesystem::path& folder);

// A curve in generator sign whose conditions are still open.
struct RawCurve {
  IvCurve curve;
  Sidecar stated;         // conditions of the sidecar and of the table's head
  bool per_area = false;  // current_A holds A/cm2
};

// Reads the single curve of a table.
Expected<RawCurve> ReadTableCurve(const std::string& path, const ReadOptions& options);

// Interprets the content of a table that was already read. The sidecar is read from the disk.
Expected<RawCurve> TableCurveOfFile(const DecodedText& text, const std::string& path,
                                    const ReadOptions& options);

// Interprets a table's text without looking for a sidecar.
Expected<RawCurve> TableCurveFromText(const DecodedText& text, const std::string& path,
                                      const ReadOptions& options);

// Determines the conditions, converts current densities and checks the curve.
Expected<IvCurve> FinishCurve(RawCurve raw, const ReadOptions& options);

// Reads the sidecar NAME.json of the table NAME.csv; an empty Sidecar if there is none.
Expected<Sidecar> ReadSidecarBeside(const std::string& path, const ReadOptions& options);

// Keeps the rows of the sweep number `wanted`. If unset, the file must hold one sweep, or sweeps in
// both directions at one irradiance (within 2 %) and temperature (within 1 K), which are kept
// together. With `holds_curves` the numbers denote different curves, which are never kept together.
// Errors: no such sweep, or several that need a selection.
Expected<void> SelectSweep(std::optional<int> wanted, bool holds_curves, IvCurve* curve);

// Whether the sweeps differ by more than 2 % in irradiance or 1 K in temperature.
bool SweepsDifferInConditions(const IvCurve& curve);

}  // namespace lyrefit
