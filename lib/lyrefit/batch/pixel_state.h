#pragma once

#include <string>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/batch/batch_task.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/devices/cell_report.h"

namespace lyrefit {

// What a pixel is for the yield of its sample.
enum class PixelState {
  kWorking,
  kShorted,
  kDead,      // gives no current
  kWeak,      // works, below the least efficiency
  kUnlit,     // measured in the dark only: does not count
  kDoubtful,  // implausible readings, such as those of another unit (RowStatus::kDoubtful)
  kBroken,    // could not be read
};

template <>
struct EnumTable<PixelState> {
  static constexpr EnumText<PixelState> kRows[] = {
      {PixelState::kWorking, "working"}, {PixelState::kShorted, "shorted"},
      {PixelState::kDead, "dead"},       {PixelState::kWeak, "weak"},
      {PixelState::kUnlit, "unlit"},     {PixelState::kDoubtful, "doubtful"},
      {PixelState::kBroken, "broken"}};
};

// The state of a pixel, and why it does not work, with the figures that decide.
struct JudgedPixel {
  PixelState state = PixelState::kWorking;
  std::string reason;
};

// The sweeps of a cell under its brightest light, the first of each direction; null: none.
struct BrightestSweeps {
  const CellSweep* forward = nullptr;
  const CellSweep* reverse = nullptr;

  // That with more power; null if there is none.
  const CellSweep* better() const;
};

// The sweeps of `report` for the row of a cell.
BrightestSweeps BrightestSweepsOf(const CellReport& report);

// Judges the pixel. `all_dark`: the input states of every curve that it was measured in the dark.
JudgedPixel JudgePixel(const CellReport& report, bool all_dark, const PixelOptions& options);

// Name of the criterion among the options of a run.
inline constexpr char kPixelCriterion[] = "working-pixel";

// The criterion as a sentence, for summaries.
std::string PixelCriterion(const PixelOptions& options);

}  // namespace lyrefit
