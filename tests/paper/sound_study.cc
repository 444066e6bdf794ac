#include "paper/sound_study.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>

#include "lyrefit/base/median.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/random.h"
#include "lyrefit/base/seconds.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/estimate/refine/refine.h"
#include "lyrefit/estimate/refine/separable.h"
#include "lyrefit/read/read_curve.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

// Least-squares problem of the model within the ranges of the proof.
RefineProblem ProblemOf(const Certificate& certificate, Model model) {
  const IvCurve& curve = certificate.curve;
  const CertifyOptions& ranges = certificate.options;
  Device device = MakeDevice(model, curve.conditions, ranges.constants);
  const double current = LargestMagnitude(curve.current_A);
  const double resistance = certificate.reference_voltage_V / current;
  std::vector<double> lower(device.size(), 0), upper(device.size(), 10 * current);
  lower[kRs] = ranges.rs_lower_ohm;
  upper[kRs] = std::isfinite(ranges.rs_upper_ohm) ? ranges.rs_upper_ohm : certificate.rs_upper_ohm;
  upper[kIph] = std::min(upper[kIph], ranges.iph_upper_A);
  lower[kRsh] = std::max(1e-6 * resistance, ranges.rsh_lower_ohm);
  upper[kRsh] = std::min(1e12 * resistance, ranges.rsh_upper_ohm);
  for (int d = 0; d < DiodeCount(device); ++d) {
    const int is = SaturationCurrentIndex(d);
    upper[is] = std::min(upper[is], ranges.is_upper_A);
    lower[IdealityIndex(d)] = ranges.n_lower;
    upper[IdealityIndex(d)] = ranges.n_upper;
  }
  return MakeRefineProblem(std::move(device), ranges.objective, curve.voltage_V, curve.current_A,
                           {}, std::move(lower), std::move(upper));
}

std::vector<double> RandomParameters(const RefineProblem& problem, double reference_V,
                                     RandomStream* random) {
  const auto between = [&](int i) {
    return problem.lower[i] + (problem.upper[i] - problem.lower[i]) * random->Uniform();
  };
  std::vector<double> p(problem.device.size());
  const double current = problem.current_scale_A;
  p[kIph] = std::min(2 * current * random->Uniform(), problem.upper[kIph]);
  p[kRs] = problem.lower[kRs] + (between(kRs) - problem.lower[kRs]) * random->Uniform();
  p[kRsh] =
      std::min(reference_V / current * std::pow(10, 4 * random->Uniform()), problem.upper[kRsh]);
  for (int d = 0; d < DiodeCount(problem.device); ++d) {
    const int n = IdealityIndex(d);
    p[n] = between(n);
    const int is = SaturationCurrentIndex(d);
    const double per_volt = 1 / (p[n] * problem.device.module_thermal_voltage_V);
    p[is] = std::min(current * random->Uniform() / std::expm1(per_volt * reference_V),
                     problem.upper[is]);
  }
  return p;
}

// Lowest RMSE that searches find for one model.
double SearchedRmse(const Certificate& certificate, Model model, const std::vector<double>& known,
                    RandomStream* random) {
  constexpr int kGridStarts = 3, kRandomStarts = 2, kPlainDraws = 20;
  const RefineProblem problem = ProblemOf(certificate, model);
  const double reference_V = certificate.reference_voltage_V;
  double best = kInfinity;
  const auto refine = [&](const std::vector<double>& start) {
    std::vector<double> end = RefineFrom(problem, start).p;
    for (std::size_t i = 0; i < end.size(); ++i) {  // points outside the ranges do not count
      end[i] = std::min(std::max(end[i], problem.lower[i]), problem.upper[i]);
    }
    best = std::min(best, MeanSquare(problem, end));
  };
  if (!known.empty()) refine(known);
  for (const auto& start : SeparableStarts(problem, 0, kGridStarts)) refine(start.p);
  for (int i = 0; i < kRandomStarts; ++i) refine(RandomParameters(problem, reference_V, random));
  for (int i = 0; i < kPlainDraws; ++i) {
    const auto drawn = RandomParameters(problem, reference_V, random);
    best = std::min(best, MeanSquare(problem, drawn));
  }
  return std::sqrt(best);
}

HeldBound Held(double lower_bound_A, double gap, bool certified, double best_A, double rounding_A) {
  HeldBound held;
  held.lower_bound_A = lower_bound_A;
  held.best_A = best_A;
  held.gap = gap;
  held.certified = certified;
  held.violated = lower_bound_A > best_A + rounding_A;
  return held;
}

// RMSE of `fit` with its default ranges; infinity if the fit fails.
double FittedRmse(const Certificate& certificate, Model model) {
  FitOptions options;
  options.model = model;
  options.objective = certificate.options.objective;
  options.intervals = Intervals::kNone;
  const auto report = Fit(certificate.curve, options);
  if (!report) return kInfinity;
  return options.objective == Objective::kMeasuredCurrent ? report->rmse.refined.measured_current_A
                                                          : report->rmse.refined.solved_current_A;
}

Expected<HeldCertificate> HoldSynthetic(const SyntheticProblem& made, Objective objective,
                                        const SoundOptions& study, int number,
                                        const Observer& observer) {
  CertifyOptions options = made.ranges;
  options.objective = objective;
  options.effort = study.effort;
  TRY(HeldCertificate held,
      HoldCertificate(made.curve, options, made.model, made.parameters,
                      study.seed + static_cast<std::uint64_t>(number), observer));
  held.noise = made.noise;
  held.planted = made.planted;
  return held;
}

// Names in the first column of labels.csv, without the header line.
Expected<std::vector<std::string>> LabelledNames(const std::string& folder) {
  const std::string path = (fs::path(folder) / "labels.csv").string();
  std::ifstream table(path);
  std::string line;
  if (!std::getline(table, line)) return Fail("no table of labels: " + path);
  std::vector<std::string> names;
  while (std::getline(table, line)) names.push_back(line.substr(0, line.find(',')));
  return names;
}

// Runs job(0) .. job(count - 1) in parallel until the observer stops them.
template <class Job>
Expected<SoundStudy> RunJobs(int count, const SoundOptions& options, const char* stage,
                             const Observer& observer, const Job& job) {
  const Instant begin = Now();
  SoundStudy study;
  study.version = Version();
  study.options = options;
  std::vector<std::optional<Expected<HeldCertificate>>> done(count);
  const ProgressReporter progress(observer, stage, count);
  ParallelFor(count, options.threads, [&](int i) {
    if (progress.Stopped()) return;
    done[i] = job(i, progress.stop().AsObserver());
    progress.Step();
  });
  study.interrupted = progress.Stopped();
  for (auto& one : done) {
    if (!one || study.interrupted) continue;
    if (*one) {
      study.held.push_back(std::move(**one));
    } else {
      ++study.unusable;
    }
  }
  study.seconds = SecondsSince(begin);
  return study;
}

}  // namespace

int HeldCertificate::violations() const {
  int count = floor.violated ? 1 : 0;
  for (const HeldBound& model : models) count += model.violated ? 1 : 0;
  return count;
}

Expected<HeldCertificate> HoldCertificate(const IvCurve& curve, const CertifyOptions& options,
                                          Model model, const std::vector<double>& known,
                                          std::uint64_t seed, const Observer& observer) {
  TRY(const Certificate certificate, Certify(curve, options, observer));
  const double rounding_A = kCertifiedRounding * LargestMagnitude(curve.current_A);
  RandomStream random(seed, 1);
  HeldCertificate held;
  held.name = curve.name;
  held.objective = options.objective;
  held.points = static_cast<int>(curve.size());
  held.n_upper = options.n_upper;
  held.seconds = certificate.seconds;
  held.diodes = static_cast<int>(model);
  double best = kInfinity;  // carried over, as more diodes include fewer ones with Is = 0
  for (const ModelCertificate& proof : certificate.models) {
    const bool same = proof.model == model && !known.empty();
    if (same) {
      held.planted_A = std::sqrt(MeanSquare(ProblemOf(certificate, model), known));
      best = std::min(best, held.planted_A);
    }
    const double attained =
        std::sqrt(MeanSquare(ProblemOf(certificate, proof.model), proof.parameters));
    if (known.empty()) best = std::min(best, FittedRmse(certificate, proof.model));
    best = std::min(
        {best, attained,
         SearchedRmse(certificate, proof.model, same ? known : std::vector<double>(), &random)});
    held.models.push_back(Held(proof.lower_bound_A, proof.gap, proof.certified, best, rounding_A));
  }
  const Floor& floor = certificate.floor;
  best = std::min(best, floor.rmse_A);
  held.floor = Held(floor.lower_bound_A, floor.gap, floor.certified, best, rounding_A);
  return held;
}

Expected<SoundStudy> StudySynthetic(const SoundOptions& options, const Observer& observer) {
  const auto job = [&](int i, const Observer& inside) {
    const SyntheticProblem made = MakeProblem(options.seed, i / 2);
    const Objective objective =
        i % 2 == 0 ? Objective::kMeasuredCurrent : Objective::kSolvedCurrent;
    return HoldSynthetic(made, objective, options, i / 2, inside);
  };
  return RunJobs(2 * options.problems, options, "made problems", observer, job);
}

Expected<SoundStudy> StudyWide(const SoundOptions& options, const Observer& observer) {
  const auto job = [&](int i, const Observer& inside) {
    return HoldSynthetic(MakeWideProblem(options.seed, i), Objective::kMeasuredCurrent, options, i,
                         inside);
  };
  return RunJobs(options.problems, options, "wide ranges of Rs", observer, job);
}

Expected<SoundStudy> StudyMeasured(const std::string& folder, const SoundOptions& options,
                                   const Observer& observer) {
  TRY(const std::vector<std::string> names, LabelledNames(folder));
  const auto job = [&](int i, const Observer& inside) -> Expected<HeldCertificate> {
    TRY(const IvCurve curve, ReadCurve((fs::path(folder) / (names[i / 2] + ".csv")).string()));
    CertifyOptions proof;
    proof.models = {Model::kSingleDiode, Model::kDoubleDiode};
    proof.objective = i % 2 == 0 ? Objective::kMeasuredCurrent : Objective::kSolvedCurrent;
    proof.effort = options.effort;
    return HoldCertificate(curve, proof, Model::kSingleDiode, {}, options.seed, inside);
  };
  return RunJobs(2 * static_cast<int>(names.size()), options, "measured curves", observer, job);
}

}  // namespace lyrefit
