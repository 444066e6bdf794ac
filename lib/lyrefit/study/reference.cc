#include "lyrefit/study/reference.h"

#include <fmt/format.h>

#include "lyrefit/certify/certify.h"
#include "lyrefit/certify/floor.h"
#include "lyrefit/estimate/fit/usable.h"

namespace lyrefit {
namespace {

// Largest number of convex problems in one proof. Without a proof the best of all runs is the
// reference.
constexpr std::int64_t kEffort = 20000;
constexpr std::int64_t kSolvedEffort = 4000;  // for the solved current, which takes longer for each

bool Within(const std::vector<double>& parameters, const std::vector<ParameterBounds>& bounds) {
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (!(parameters[i] >= bounds[i].lower && parameters[i] <= bounds[i].upper)) return false;
  }
  return true;
}

}  // namespace

Reference FindReference(const CompareCurve& subject, Model model, const CompareOptions& options,
                        const BestFound& best, const Observer& observer) {
  Reference reference;
  reference.rmse_A = best.rmse_A;
  reference.origin = "best of all runs";
  reference.parameters = best.parameters;
  const Device device = MakeDevice(model, subject.curve.conditions, options.constants);
  auto bounds = MakeBounds(subject.bounds, device, subject.curve);
  if (!bounds) return reference;
  const std::vector<double> none_fixed(device.size(), kUnknown);
  reference.steepest_n = LeaveOutSteps(subject.curve, device, none_fixed, &*bounds);
  CertifyOptions certify = RangesOf(*bounds, options.constants, {model});
  certify.objective = options.objective;
  certify.effort = options.objective == Objective::kSolvedCurrent ? kSolvedEffort : kEffort;
  const auto certificate = Certify(subject.curve, certify, observer);
  if (!certificate) return reference;
  reference.interrupted = certificate->interrupted;
  if (reference.interrupted) {
    reference.origin += " so far";
    return reference;
  }
  const ModelCertificate& proof = certificate->models.at(0);
  reference.lower_bound_A = proof.lower_bound_A;
  if (certificate->floor.certified) reference.floor_A = certificate->floor.rmse_A;
  if (proof.rmse_A < reference.rmse_A && Within(proof.parameters, *bounds)) {
    reference.rmse_A = proof.rmse_A;
    reference.parameters = proof.parameters;
    reference.origin = "found by the proof";
  }
  const double gap = 1 - reference.lower_bound_A / reference.rmse_A;
  reference.certified = gap <= kCertifiedGap;
  if (reference.certified) {
    reference.origin = "certified optimum";
  } else {
    reference.origin += fmt::format("; proved lower bound {:.3g} % below", 100 * gap);
  }
  return reference;
}

}  // namespace lyrefit
