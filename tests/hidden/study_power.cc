#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "hidden/study.h"

namespace hidden {
namespace {

constexpr std::array<double, 6> kEdges = {3, 5, 7, 10, 15, 25};
constexpr int kBands = 5;

double NormalBelow(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

// Threshold of a blind search over as many effective directions as the kind of data has.
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
    const Judgement judgement = Judge(run.hidden, run.answer);
    ++cases;
    detected += judgement.detected;
    first_right += judgement.first_right;
    in_set += judgement.in_set;
    named += judgement.named;
    set_size += judgement.set_size;
    ideal += NormalBelow(run.hidden.causes[0].misfit - threshold);
    seconds += run.answer.seconds;
  }
};

// The last one is for what the base model absorbs: it can only be seen in the values.
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

void Report(Kind kind, const Hide& hide, const std::vector<Run>& runs, Bands* mean,
            std::FILE* csv) {
  Bands bands;
  int missing = 0, failed = 0;
  std::string error;
  const double threshold = BlindThreshold(kind, 0.05);
  for (const Run& run : runs) {
    missing += !run.made;
    if (!run.made) continue;
    if (!run.answer.error.empty()) ++failed, error = run.answer.error;
    const int band = BandOf(run.hidden.causes[0].misfit);
    bands[band].Add(run, threshold);
    if (band < kBands) (*mean)[band].Add(run, threshold);
  }
  Print(Name(kind), hide.name, bands, csv);
  if (missing > 0) std::printf("        %s: no device for %d cases\n", hide.name, missing);
  if (failed > 0) std::printf("        %s: %d errors: %s\n", hide.name, failed, error.c_str());
}

}  // namespace

int StudyPower(const StudyOptions& options) {
  const int cases = options.cases > 0 ? options.cases : 200;
  std::FILE* csv = options.csv.empty() ? nullptr : std::fopen(options.csv.c_str(), "w");
  if (!options.csv.empty() && csv == nullptr) {
    std::perror(options.csv.c_str());
    return 1;
  }
  if (csv != nullptr) {
    std::fprintf(csv, "kind,effect,misfit_from,misfit_to,cases,ideal_percent,detected,");
    std::fprintf(csv, "first_right,in_set,named,mean_set_size,seconds\n");
  }
  std::printf("%-7s %-21s %-7s %5s %7s %7s %7s %7s %7s %5s %7s\n", "kind", "effect", "misfit",
              "cases", "ideal%", "found%", "first%", "inset%", "named%", "size", "s/case");
  for (const Kind kind : KindsCalled(options.kind)) {
    Bands mean;
    for (const Hide* hide : HidesCalled(options.effect, kind)) {
      Report(kind, *hide, RunCases(options, kind, *hide, cases, kEdges[0], kEdges[kBands]), &mean,
             csv);
    }
    Print(Name(kind), "all", mean, csv);
  }
  if (csv != nullptr) std::fclose(csv);
  return 0;
}

int StudyConfusion(const StudyOptions& options) {
  const int cases = options.cases > 0 ? options.cases : 100;
  std::printf("%-7s %-21s %5s  %s\n", "kind", "effect", "cases", "first name, % of cases");
  for (const Kind kind : KindsCalled(options.kind)) {
    for (const Hide* hide : HidesCalled(options.effect, kind)) {
      std::map<std::string, int> firsts;
      int made = 0;
      for (const Run& run : RunCases(options, kind, *hide, cases, 7, kEdges[kBands])) {
        if (!run.made) continue;
        ++made;
        ++firsts[Judge(run.hidden, run.answer).first];
      }
      std::vector<std::pair<int, std::string>> order;
      for (const auto& [name, count] : firsts) order.push_back({-count, name});
      std::sort(order.begin(), order.end());
      std::printf("%-7s %-21s %5d ", Name(kind), hide->name, made);
      for (const auto& [count, name] : order) {
        std::printf(" %s %.0f", name.c_str(), Percent(-count, made));
      }
      std::printf("\n");
    }
  }
  return 0;
}

}  // namespace hidden
