#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/read_curve.h"
#include "lyrefit/curve/sidecar.h"
#include "lyrefit/curve/text_encoding.h"

namespace lyrefit {

// What a folder of curves may hold besides them.
constexpr char kCurvesName[] = "curves.csv";
constexpr char kIndexName[] = "index.csv";
constexpr char kDatasetName[] = "dataset.json";

bool IsFile(const std::filesystem::path& path);
// Of what nobody named: a pipe among the files of a folder would be waited for.
Expected<void> CheckIsNoStream(const std::filesystem::path& path);
bool IsFolder(const std::filesystem::path& path);
bool IsJson(const std::filesystem::path& path);
bool IsTable(const std::filesystem::path& path);  // by its ending: .csv, .txt, .dat, ...

// The name of the folder the path stands in; empty at the root.
std::string FolderNameOf(const std::filesystem::path& path);

// The table of a folder of one curve: curve.csv, or one of the folder's own name, as IV_Swinger
// writes it. Empty if there is none.
std::filesystem::path CurveInFolder(const std::filesystem::path& folder);

// The tables in a folder, by name, except an index.
std::vector<std::filesystem::path> TablesIn(const std::filesystem::path& folder);

// A curve in generator sign whose conditions are still to be settled.
struct RawCurve {
  IvCurve curve;
  Sidecar stated;         // in the file beside it and in its own
  bool per_area = false;  // current_A holds A/cm2
};

// The one curve of a table.
Expected<RawCurve> ReadTableCurve(const std::string& path, const ReadOptions& options);

// The same from what the file holds, which is not read again.
Expected<RawCurve> TableCurveOfFile(const DecodedText& text, const std::string& path,
                                    const ReadOptions& options);

// The same from its text, of which nothing stands beside it.
Expected<RawCurve> TableCurveFromText(const DecodedText& text, const std::string& path,
                                      const ReadOptions& options);

// Settles what is open.
Expected<IvCurve> FinishCurve(RawCurve raw, const ReadOptions& options);

// NAME.json beside NAME.csv; says nothing where there is no such file.
Expected<Sidecar> ReadSidecarBeside(const std::string& path, const ReadOptions& options);

}  // namespace lyrefit
