#pragma once

#include <map>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/model/device.h"
#include "lyrefit/study/comparison.h"

namespace lyrefit {

// A published value that repeated runs of a search should reproduce.
struct PublishedValue {
  std::string table;  // "Table 12"
  std::string curve;  // name of the data set, "rtc_france"
  Model model = Model::kSingleDiode;
  std::string algorithm;  // name of the compared algorithm, "mlo" or "Pm=0.5 gamma=0.25"
  std::string quantity;   // "min", "mean", "max" or "std" of the searched RMSE in A; others are
                          // stored only
  std::string text;       // as printed
  double value = 0;
  std::string note;
};

// Reads a table with the columns table, curve, model, algorithm, quantity, value and note in any
// order. Errors carry file, line and column.
Expected<std::vector<PublishedValue>> ReadPublished(const std::string& path);

// Reads a table with the columns table and remark. Returns the remarks by table name.
Expected<std::map<std::string, std::string>> ReadRemarks(const std::string& path);

enum class Check {
  kReproduced,
  kNotReproduced,
  kCannotTell,  // random variation spans more than a factor of 10, so almost any value would agree
};

template <>
struct EnumTable<Check> {
  static constexpr EnumText<Check> kRows[] = {{Check::kReproduced, "yes"},
                                              {Check::kNotReproduced, "no"},
                                              {Check::kCannotTell, "cannot tell"}};
};

// A published statistic and the same statistic of the repeated runs. The runs are split into
// batches of the size used in the publication; each batch gives one value.
struct CheckedValue {
  PublishedValue published;
  double ours = kUnknown;  // geometric mean over the batches
  double low = kUnknown;   // 99 % prediction interval of one further batch, on a logarithmic scale,
  double high = kUnknown;  // widened by half a unit of the last printed digit
  int batches = 0;
  Check check = Check::kNotReproduced;  // kReproduced: the printed value lies in the interval
};

// Checks every value whose curve, model and algorithm `comparison` contains; others are left out.
// Needs at least two batches of `batch` runs.
std::vector<CheckedValue> CheckPublished(const std::vector<PublishedValue>& published,
                                         const Comparison& comparison, int batch);

}  // namespace lyrefit
