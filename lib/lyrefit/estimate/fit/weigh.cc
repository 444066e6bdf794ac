#include "lyrefit/estimate/fit/weigh.h"

#include "lyrefit/estimate/refine/refine.h"

namespace lyrefit {

std::optional<WeighedFit> WeighAndRefine(ErrorSpec spec, const IvCurve& curve,
                                         const ProgressReporter& progress, RefineProblem* problem,
                                         RefineEnd* end) {
  constexpr int kRounds = 5;
  constexpr double kSettled = 0.01;  // relative change of every size
  WeighedFit weighed;
  ErrorReport& errors = weighed.errors;
  errors.weighed = errors.believed = true;
  errors.stated = spec.kind == ErrorKind::kStated;
  errors.current_stated = !errors.stated && !curve.sigma_A.empty();
  RefineOptions how;
  how.stop = progress.stop();
  const RefineProblem plain = *problem;
  for (int round = 0; round < kRounds && !progress.stop().requested(); ++round) {
    if (!errors.stated) {
      const std::optional<FoundErrors> found = FindErrors(plain, curve, *end);
      if (!found) return {};
      weighed.found = found;
      const bool settled = AreClose(found->sizes, spec.sizes, kSettled);
      spec.sizes = found->sizes;
      errors.gain = found->gain;
      if (settled) break;
    }
    *problem = WeighByErrors(plain, curve, spec, end->p);
    *end = Refine(*problem, end->p, how);
  }
  errors.sizes = spec.sizes;
  return weighed;
}

}  // namespace lyrefit
