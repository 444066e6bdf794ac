#include "file_plan.h"

#include <fmt/format.h>

#include <filesystem>

#include "lyrefit/base/file.h"
#include "lyrefit/read/curve_files.h"
#include "lyrefit/report/plots.h"

namespace lyrefit {
namespace {

constexpr char kWayOut[] = "name another file, or say --force to replace it";

// Devices and pipes have no content to lose.
bool CanLoseContent(const OutputFile& output) {
  if (output.path.empty() || output.path == "-") return false;
  std::error_code error;
  const auto status = std::filesystem::status(output.path, error);
  return !std::filesystem::exists(status) || std::filesystem::is_regular_file(status);
}

Expected<void> CheckStandardOutput(const FilePlan& plan) {
  std::string flags;
  int count = 0;
  for (const OutputFile& output : plan.outputs) {
    if (output.path != "-" || output.is_picture) continue;
    flags += (count++ == 0 ? "" : " and ") + output.flag;
  }
  if (count > 1) return Fail(fmt::format("only one of {} can have standard output", flags));
  return {};
}

Expected<void> CheckTwins(const FilePlan& plan) {
  for (std::size_t i = 0; i < plan.outputs.size(); ++i) {
    const OutputFile& output = plan.outputs[i];
    if (!CanLoseContent(output)) continue;
    for (std::size_t j = 0; j < i; ++j) {
      const OutputFile& other = plan.outputs[j];
      if (!CanLoseContent(other) || !IsSameFile(output.path, other.path)) continue;
      return Fail(
          fmt::format("{} and {} are to write the same file: name two", other.flag, output.flag),
          output.path);
    }
  }
  return {};
}

FileRole RoleIn(const InputFile& input, const std::string& file) {
  if (input.is_measurement) return RoleOf(file, input.path);
  std::error_code error;
  const bool there = std::filesystem::exists(input.path, error);
  return there && IsSameFile(file, input.path) ? FileRole::kRead : FileRole::kNone;
}

Expected<void> CheckAgainstInput(const OutputFile& output, const InputFile& input) {
  switch (RoleIn(input, output.path)) {
    case FileRole::kNone:
      return {};
    case FileRole::kRead:
      return Fail(fmt::format("{}: this run reads the file: {}", output.flag, kWayOut),
                  output.path);
    case FileRole::kConditions:
      return Fail(fmt::format("{}: a file of this name is read together with {}: {}", output.flag,
                              input.path, kWayOut),
                  output.path);
    case FileRole::kNewCurve:
      return Fail(fmt::format("{}: every table in {} is read as a curve: name a file elsewhere, or "
                              "say --force",
                              output.flag, input.path),
                  output.path);
  }
  return {};
}

Expected<void> CheckInputs(const FilePlan& plan) {
  if (plan.force) return {};
  for (const OutputFile& output : plan.outputs) {
    if (!CanLoseContent(output)) continue;
    for (const InputFile& input : plan.inputs) {
      if (auto checked = CheckAgainstInput(output, input); !checked) return checked;
    }
  }
  return {};
}

Expected<void> CheckCanWrite(const OutputFile& output) {
  if (output.path.empty()) return {};
  if (output.is_picture) {
    if (auto drawable = CheckPlot(output.path); !drawable) return drawable;
  }
  return output.path == "-" ? Expected<void>() : CheckWritable(output.path);
}

}  // namespace

Expected<void> CheckFilePlan(const FilePlan& plan) {
  for (const auto& check : {CheckStandardOutput, CheckTwins, CheckInputs}) {
    if (auto checked = check(plan); !checked) return checked;
  }
  for (const OutputFile& output : plan.outputs) {
    if (auto checked = CheckCanWrite(output); !checked) return checked;
  }
  return {};
}

}  // namespace lyrefit
