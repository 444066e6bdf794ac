#pragma once

#include <map>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/law/device.h"
#include "lyrefit/study/comparison.h"

namespace lyrefit {

// A figure of a publication that repeated runs of a search should give again.
struct PublishedValue {
  std::string table;  // "Table 12"
  std::string curve;  // name of the data set, "rtc_france"
  Model model = Model::kSingleDiode;
  std::string algorithm;  // name of the compared, "mlo" or "Pm=0.5 gamma=0.25"
  std::string quantity;   // "min", "mean", "max", "std" of the searched RMSE in A; others are kept
  std::string text;       // as printed
  double value = 0;
  std::string note;
};

// A table with the columns table, curve, model, algorithm, quantity, value, note in any order.
// Errors carry file, line and column.
Expected<std::vector<PublishedValue>> ReadPublished(const std::string& path);

// A table with the columns table, remark: what is to be said of each table, by its name.
Expected<std::map<std::string, std::string>> ReadRemarks(const std::string& path);

enum class Check {
  kReproduced,
  kNotReproduced,
  kCannotTell,  // chance spans more than a factor of 10: almost any figure would do
};

template <>
struct EnumTable<Check> {
  static constexpr EnumText<Check> kRows[] = {{Check::kReproduced, "yes"},
                                              {Check::kNotReproduced, "no"},
                                              {Check::kCannotTell, "cannot tell"}};
};

// What the same statistic of our runs is: the runs are taken in batches as long as the
// publication's, and each batch gives one value.
struct CheckedValue {
  PublishedValue published;
  double ours = kUnknown;  // geometric mean over the batches
  double low = kUnknown;   // 99 % prediction interval for one more batch, on a logarithmic scale,
  double high = kUnknown;  // widened by half a unit of the last digit printed
  int batches = 0;
  Check check = Check::kNotReproduced;  // reproduced: the printed value lies within
};

// Checks every value that `comparison` has a curve, model and compared for; the others are left
// out. Needs at least two batches of `batch` runs.
std::vector<CheckedValue> CheckPublished(const std::vector<PublishedValue>& published,
                                         const Comparison& comparison, int batch);

}  // namespace lyrefit
