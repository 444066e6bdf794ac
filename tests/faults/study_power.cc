#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "faults/study.h"

namespace faults {
namespace {

constexpr std::array<double, 6> kEdges = {3, 5, 7, 10, 15, 25};
constexpr int kBands = 5;

double NormalBelow(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

// Detection threshold of a search over the number of effective directions of the kind of data.
double BlindThreshold(Kind kind, double level) {
  constexpr std::array<double, kKinds> kDirections = {5.7, 6.8, 9.1, 6.0, 6.9, 10.4};
  const double beyond = level / kDirections[static_cast<int>(kind)];
  double low = 0, high = 10;
  while (high - low > 1e-9) {
    const double middle = (low + high) / 2;
    (1 - NormalBelow(middle) > beyond ? low : high) = middle;
  }
  return low;
}

struct Band {
  int cases = 0;
  int detected = 0;
  int first_right = 0;
  int in_set = 0;
  int named = 0;
  int set_size = 0;
  double ideal = 0;
  double seconds = 0;

  void Add(const Run& run, double threshold) {
    const CaseScore score = ScoreCase(run.with_fault, run.answer);
    ++cases;
    detected += score.detected;
    first_right += score.first_right;
    in_set += score.in_set;
    named += score.named;
    set_size += score.set_size;
    ideal += NormalBelow(run.with_fault.causes[0].misfit - threshold);
    seconds += run.answer.seconds;
  }
};

// The last band is for effects that the base model absorbs. Only parameter values can show them.
using Bands = std::array<Band, kBands + 1>;

int BandOf(double misfit) {
  if (misfit < 0.5 * kEdges[0]) return kBands;
  const auto edge = std::upper_bound(kEdges.begin(), kEdges.end(), misfit);
  return std::clamp(static_cast<int>(edge - kEdges.begin()) - 1, 0, kBands - 1);
}

void Print(const char* kind, const char* effect, const Bands& bands, std::FILE* csv) {
  for (int i = 0; i <= kBands; ++i) {
    const Band& band = bands[i];
    if (band.cases == 0) continue;
    const double from = i < kBands ? kEdges[i] : 0;
    const double to = i < kBands ? kEdges[i + 1] : 0;
    const double size = band.detected > 0 ? static_cast<double>(band.set_size) / band.detected : 0;
    const double ideal = 100 * band.ideal / band.cases;
    const double seconds = band.seconds / band.cases;
    std::printf("%-7s %-21s %3.0f-%-3.0f %5d %7.1f %7.1f %7.1f %7.1f %7.1f %5.2f %7.3f\n", kind,
                effect, from, to, band.cases, ideal, Percent(band.detected, band.cases),
                Percent(band.first_right, band.cases), Percent(band.in_set, band.cases),
                Percent(band.named, band.cases), size, seconds);
    if (csv == nullptr) continue;
    std::fprintf(csv, "%s,%s,%g,%g,%d,%.2f,%d,%d,%d,%d,%.3f,%.4f\n", kind, effect, from, to,
                 band.cases, ideal, band.detected, band.first_right, band.in_set, band.named, size,
                 seconds);
  }
}

void Report(Kind kind, const Injection& injection, const std::vector<Run>& runs, Bands* mean,
            std::FILE* csv) {
  Bands bands;
  int missing = 0, failed = 0;
  std::string error;
  const double threshold = BlindThreshold(kind, 0.05);
  for (const Run& run : runs) {
    missing += !run.made;
    if (!run.made) continue;
    if (!run.answer.error.empty()) ++failed, error = run.answer.error;
    const int band = BandOf(run.with_fault.causes[0].misfit);
    bands[band].Add(run, threshold);
    if (band < kBands) (*mean)[band].Add(run, threshold);
  }
  Print(Name(kind), injection.name, bands, csv);
  if (missing > 0) std::printf("        %s: no device for %d cases\n", injection.name, missing);
  if (failed > 0) std::printf("        %s: %d errors: %s\n", injection.name, failed, error.c_str());
}

void PrintRows(Kind kind, const Injection& injection, const std::vector<Run>& runs,
               std::FILE* rows) {
  for (std::size_t i = 0; i < runs.size() && rows != nullptr; ++i) {
    if (!runs[i].made) continue;
    const Case& with_fault = runs[i].with_fault;
    const CaseScore score = ScoreCase(with_fault, runs[i].answer);
    std::fprintf(rows, "%s,%s,%zu,%s,%d,%zu,%.3f,%.4g,%d,%d,%d,%.3f,%s\n", Name(kind),
                 injection.name, i, Name(with_fault.noise), with_fault.measurement.cells,
                 with_fault.measurement.voltage.size(), with_fault.causes[0].misfit,
                 with_fault.causes[0].strength, score.detected, score.first_right, score.named,
                 runs[i].answer.seconds, Text(runs[i].answer).c_str());
  }
}

// Sets `*file` to nullptr if `path` is empty.
bool Open(const std::string& path, const char* header, std::FILE** file) {
  *file = path.empty() ? nullptr : std::fopen(path.c_str(), "w");
  if (*file != nullptr) std::fputs(header, *file);
  if (*file == nullptr && !path.empty()) std::perror(path.c_str());
  return *file != nullptr || path.empty();
}

}  // namespace

int StudyPower(const StudyOptions& options) {
  const int cases = options.cases > 0 ? options.cases : 200;
  std::FILE* csv = nullptr;
  std::FILE* rows = nullptr;
  if (!Open(options.csv,
            "kind,effect,misfit_from,misfit_to,cases,ideal_percent,detected,first_right,in_set,"
            "named,mean_set_size,seconds\n",
            &csv) ||
      !Open(options.rows,
            "kind,effect,number,noise,cells,readings,misfit,strength,detected,first_right,named,"
            "seconds,answer\n",
            &rows)) {
    return 1;
  }
  std::printf("%-7s %-21s %-7s %5s %7s %7s %7s %7s %7s %5s %7s\n", "kind", "effect", "misfit",
              "cases", "ideal%", "found%", "first%", "inset%", "named%", "size", "s/case");
  for (const Kind kind : KindsCalled(options.kind)) {
    Bands mean;
    for (const Injection* injection : HidesCalled(options.effect, kind)) {
      const auto runs = RunCases(options, kind, *injection, cases, kEdges[0], kEdges[kBands]);
      Report(kind, *injection, runs, &mean, csv);
      PrintRows(kind, *injection, runs, rows);
    }
    Print(Name(kind), "all", mean, csv);
  }
  if (csv != nullptr) std::fclose(csv);
  if (rows != nullptr) std::fclose(rows);
  return 0;
}

}  // namespace faults
