#include "lyrefit/diagnose/measurement.h"

#include <algorithm>

#include "lyrefit/base/try.h"
#include "lyrefit/model/make_readings.h"

namespace lyrefit {
namespace {

std::vector<double> StatedSigma(const CurveSet& set, double scale_A) {
  std::vector<double> stated;
  for (const IvCurve& curve : set.curves) {
    if (curve.sigma_A.empty()) return {};
    for (const double sigma : curve.sigma_A) stated.push_back(sigma / scale_A);
  }
  return stated;
}

}  // namespace

Expected<Measurement> MakeMeasurement(const CurveSet& set) {
  constexpr std::size_t kFewest = 7;
  Measurement measurement;
  TRY(measurement.readings, MakeReadings(set, &measurement.warnings));
  const std::size_t count = measurement.readings.points.size();
  if (count < kFewest) {
    return Fail("a diagnosis needs 7 readings or more, there are " + std::to_string(count));
  }
  measurement.notes = set.curves.front().notes;
  const double scale_A = measurement.readings.scale.current_A;
  std::optional<double> limit = measurement.notes.compliance_A;
  if (limit) *limit /= scale_A;
  Readings sweeps = measurement.readings;  // Suns-Voc traces stand last
  const auto trace = [](const Reading& reading) { return reading.suns_voc; };
  sweeps.points.erase(std::find_if(sweeps.points.begin(), sweeps.points.end(), trace),
                      sweeps.points.end());
  measurement.values = LookAtValues(sweeps, limit);
  measurement.stated_sigma = StatedSigma(set, scale_A);
  return measurement;
}

}  // namespace lyrefit
