#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/read_curve.h"
#include "lyrefit/curve/sidecar.h"

namespace lyrefit {

// What a folder of curves may hold besides them.
constexpr char kCurvesName[] = "curves.csv";
constexpr char kIndexName[] = "index.csv";
constexpr char kDatasetName[] = "dataset.json";

bool IsFile(const std::filesystem::path& path);
bool IsFolder(const std::filesystem::path& path);
bool IsJson(const std::filesystem::path& path);
bool IsTable(const std::filesystem::path& path);  // by its name: .csv, .tsv or .txt

// The name of the folder the path stands in; empty at the root.
std::string FolderNameOf(const std::filesystem::path& path);

// The tables in a folder, by name, except an index.
std::vector<std::filesystem::path> TablesIn(const std::filesystem::path& folder);

// The one curve of a table in generator sign; its conditions are still to be settled.
Expected<IvCurve> ReadTableCurve(const std::string& path, const ReadOptions& options);

// NAME.json beside NAME.csv; says nothing where there is no such file.
Expected<Sidecar> ReadSidecarBeside(const std::string& path, const ReadOptions& options);

}  // namespace lyrefit
