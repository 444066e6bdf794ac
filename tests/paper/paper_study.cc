#include "paper/paper_study.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "lyrefit/base/parallel.h"
#include "lyrefit/base/seconds.h"
#include "lyrefit/base/version.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/estimate/fit/search_space.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/read_curve_set.h"
#include "lyrefit/settings/bounds_file.h"
#include "lyrefit/study/algorithms.h"
#include "lyrefit/study/audit.h"
#include "lyrefit/study/compare.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

const std::vector<Model> kModels = {Model::kSingleDiode, Model::kDoubleDiode, Model::kTripleDiode};

// Names of the studies in the journal.
struct Section {
  const char* name;
  Comparison PaperStudy::*comparison;
};
constexpr Section kSections[] = {{"msx60", &PaperStudy::msx60},
                                 {"rtc_france", &PaperStudy::rtc_france},
                                 {"sensitivity", &PaperStudy::sensitivity},
                                 {"ranked", &PaperStudy::ranked},
                                 {"budget", &PaperStudy::budget},
                                 {"s75", &PaperStudy::s75}};

// MLO with every pair of Pm (outer loop) and gamma of `steps`, named "Pm=0.5 gamma=0.25".
std::vector<ComparedAlgorithm> SensitivityAlgorithms(const std::vector<double>& steps,
                                                     const SearchOptions& search) {
  std::vector<ComparedAlgorithm> result;
  for (const double memory_rate : steps) {
    for (const double distance_coefficient : steps) {
      ComparedAlgorithm compared;
      compared.name = fmt::format("Pm={:g} gamma={:g}", memory_rate, distance_coefficient);
      compared.algorithm = ToText(Algorithm::kMlo);
      compared.search = search;
      compared.search.algorithm = Algorithm::kMlo;
      compared.search.memory_rate = memory_rate;
      compared.search.distance_coefficient = distance_coefficient;
      result.push_back(std::move(compared));
    }
  }
  return result;
}

class PaperRun {
 public:
  PaperRun(std::string folder, const PaperStudyOptions& options, const Observer& observer)
      : folder_(std::move(folder)), observer_(observer) {
    study_.options = options;
  }

  Expected<PaperStudy> Run() {
    const auto begin = std::chrono::steady_clock::now();
    study_.version = Version();
    const auto published = ReadPublished((folder_ / "published.csv").string());
    if (!published) return tl::unexpected(published.error());
    // The timed searches run first, before other studies increase the memory of the process.
    for (const auto step : {&PaperRun::Time, &PaperRun::Audit, &PaperRun::Certify, &PaperRun::Msx60,
                            &PaperRun::RtcFrance, &PaperRun::Sensitivity, &PaperRun::S75,
                            &PaperRun::Rank, &PaperRun::Budget}) {
      if (auto done = (this->*step)(); !done) return tl::unexpected(done.error());
      if (stopped_) break;
    }
    if (stopped_) {
      PaperStudy nothing;
      nothing.interrupted = true;
      nothing.remarks = study_.remarks;
      return nothing;
    }
    for (const PublishedValue& value : *published) {
      if (value.table == "Table 9") study_.machine.push_back(value);
    }
    for (const Comparison* comparison : {&study_.msx60, &study_.rtc_france, &study_.sensitivity}) {
      const auto checked = CheckPublished(*published, *comparison, study_.options.batch);
      study_.values.insert(study_.values.end(), checked.begin(), checked.end());
    }
    study_.s75_values = CheckPublished(*published, study_.s75, study_.options.batch);
    study_.seconds = SecondsSince(begin);
    return std::move(study_);
  }

 private:
  // A curve in a folder beside that of the paper, with published bounds.
  Expected<CompareCurve> Subject(const std::string& name, const std::string& bounds) const {
    const fs::path folder = (folder_ / ".." / name).lexically_normal();
    Expected<IvCurve> curve = ReadCurve(folder.string());
    if (!curve) return tl::unexpected(curve.error());
    Expected<BoundsSpec> spec = ReadBoundsFile((folder / ("bounds-" + bounds + ".json")).string());
    if (!spec) return tl::unexpected(spec.error());
    spec->name = bounds;
    return MakeSubject(std::move(*curve), std::move(*spec));
  }

  // The MSX-60 module at the 75 C used in the paper.
  Expected<CompareCurve> PaperMsx60() const {
    constexpr double kPaperTemperature_C = 75;
    Expected<CompareCurve> subject = Subject("msx60", "paper");
    if (subject) {
      subject->curve.conditions.cell_temperature_K = kPaperTemperature_C + kZeroCelsius_K;
    }
    return subject;
  }

  SearchOptions PaperSearch() const {
    SearchOptions search;
    search.population = study_.options.population;
    search.iterations = study_.options.iterations;
    return search;
  }

  CompareOptions Options(std::vector<Model> models, int runs) const {
    CompareOptions options;
    options.models = std::move(models);
    options.seed = study_.options.seed;
    options.runs = runs;
    options.threads = study_.options.threads;
    options.constants = ConstantSet::kLiterature;
    options.rankings = false;
    return options;
  }

  Expected<void> Study(const Expected<CompareCurve>& subject,
                       const std::vector<ComparedAlgorithm>& algorithms,
                       const CompareOptions& options, Comparison PaperStudy::*result) {
    if (!subject) return tl::unexpected(subject.error());
    return Study(std::vector<CompareCurve>{*subject}, algorithms, options, result);
  }

  Expected<void> Study(const std::vector<CompareCurve>& subjects,
                       const std::vector<ComparedAlgorithm>& algorithms, CompareOptions options,
                       Comparison PaperStudy::*result) {
    options.journal = study_.options.journal;
    for (const Section& section : kSections) {
      if (section.comparison == result) options.journal_section = section.name;
    }
    Expected<Comparison> comparison = Compare(subjects, algorithms, options, observer_);
    if (!comparison) return tl::unexpected(comparison.error());
    stopped_ = comparison->interrupted;
    for (const std::string& remark : comparison->remarks) {
      study_.remarks.push_back(options.journal_section + ": " + remark);
    }
    study_.*result = std::move(*comparison);
    return {};
  }

  Expected<void> Time() {
    const Expected<CompareCurve> subject = PaperMsx60();
    if (!subject) return tl::unexpected(subject.error());
    for (const Algorithm algorithm : {Algorithm::kLo, Algorithm::kMlo}) {
      FitOptions fit;
      fit.model = Model::kTripleDiode;
      fit.objective = Objective::kMeasuredCurrent;
      fit.constants = ConstantSet::kLiterature;
      fit.bounds = subject->bounds;
      fit.search = PaperSearch();
      fit.search.seed = study_.options.seed;
      fit.search.algorithm = algorithm;
      fit.polish = fit.random_baseline = false;
      std::vector<double> seconds;
      TimedSearch timed;
      constexpr int kTimes = 5;
      for (int i = 0; i < kTimes; ++i) {
        const auto report = Fit(subject->curve, fit, observer_);
        if (!report) return tl::unexpected(report.error());
        stopped_ = report->interrupted;
        if (stopped_) return {};
        seconds.push_back(report->search.seconds);
        timed.evaluations = report->search.evaluations;
      }
      std::nth_element(seconds.begin(), seconds.begin() + kTimes / 2, seconds.end());
      timed.algorithm = ToText(algorithm);
      timed.seconds = seconds[kTimes / 2];
      rusage usage{};
      if (getrusage(RUSAGE_SELF, &usage) == 0) {
        timed.memory_MB = static_cast<double>(usage.ru_maxrss) / 1024;  // kilobytes on Linux
      }
      study_.timed.push_back(timed);
    }
    return {};
  }

  Expected<void> Audit() {
    Expected<AuditReport> audit = lyrefit::Audit((folder_ / "rows.csv").string(), {});
    if (!audit) return tl::unexpected(audit.error());
    study_.audit = std::move(*audit);
    study_.audit.path = "rows.csv";  // independent of the location of the folder
    return {};
  }

  Expected<void> Certify() {
    for (const char* name : {"rtc_france", "pwp201", "stm6_40_36", "stp6_120_36", "msx60"}) {
      const fs::path folder = (folder_ / ".." / name).lexically_normal();
      const Expected<IvCurve> curve = ReadCurve(folder.string());
      if (!curve) return tl::unexpected(curve.error());
      for (const auto& [lower, upper] : {std::pair(1.0, 2.0), std::pair(0.5, 4.0)}) {
        CertifyOptions options;
        options.n_lower = lower;
        options.n_upper = upper;
        Expected<Certificate> certificate = lyrefit::Certify(*curve, options, observer_);
        if (!certificate) return tl::unexpected(certificate.error());
        stopped_ = certificate->interrupted;
        if (stopped_) return {};
        study_.certificates.push_back(std::move(*certificate));
      }
    }
    return {};
  }

  Expected<void> Msx60() {
    const int runs = study_.options.batch * study_.options.batches;
    return Study(PaperMsx60(), PlainAlgorithms({Algorithm::kLo, Algorithm::kMlo}, PaperSearch()),
                 Options(kModels, runs), &PaperStudy::msx60);
  }

  Expected<void> RtcFrance() {
    // The variants of Table 16 are the settings (Pm 0.25, gamma 0) and (Pm 0, gamma 0.5) of Table
    // 17.
    std::vector<ComparedAlgorithm> algorithms = PlainAlgorithms(
        {Algorithm::kLo, Algorithm::kLoMblss, Algorithm::kLoDmlss, Algorithm::kMlo}, PaperSearch());
    algorithms[1].search.memory_rate = 0.25;
    algorithms[2].search.distance_coefficient = 0.5;
    const int runs = study_.options.batch * study_.options.batches;
    return Study(Subject("rtc_france", "literature"), algorithms, Options(kModels, runs),
                 &PaperStudy::rtc_france);
  }

  Expected<void> Sensitivity() {
    const std::vector<double> steps = {0, 0.25, 0.5, 0.75, 1};
    CompareOptions options =
        Options({Model::kTripleDiode}, study_.options.batch * study_.options.sensitivity_batches);
    options.polish = false;
    return Study(Subject("rtc_france", "literature"), SensitivityAlgorithms(steps, PaperSearch()),
                 options, &PaperStudy::sensitivity);
  }

  // The paper does not state the number of diodes fitted to the S75. Its standard deviations of
  // 1e-17 A suggest one.
  Expected<void> S75() {
    const fs::path folder = (folder_ / ".." / "s75_constructed").lexically_normal();
    Expected<CurveSet> set = ReadCurveSet(folder.string());
    if (!set) return tl::unexpected(set.error());
    Expected<BoundsSpec> bounds = ReadBoundsFile((folder / "bounds-paper.json").string());
    if (!bounds) return tl::unexpected(bounds.error());
    bounds->name = "paper";
    std::vector<CompareCurve> subjects;
    for (IvCurve& curve : set->curves) {
      const Conditions& at = curve.conditions;
      curve.name = fmt::format("{}/{:g}x{:g}", set->name, at.irradiance_W_m2,
                               at.cell_temperature_K - kZeroCelsius_K);
      subjects.push_back(MakeSubject(std::move(curve), *bounds));
    }
    return Study(
        subjects, PlainAlgorithms({Algorithm::kLo, Algorithm::kMlo}, PaperSearch()),
        Options({Model::kSingleDiode}, study_.options.batch * study_.options.sensitivity_batches),
        &PaperStudy::s75);
  }

  Expected<void> Rank() {
    std::vector<ComparedAlgorithm> algorithms =
        PlainAlgorithms({Algorithm::kMlo, Algorithm::kLo, Algorithm::kLoMblss, Algorithm::kLoDmlss,
                         Algorithm::kDe, Algorithm::kRandom},
                        PaperSearch());
    for (ComparedAlgorithm peer : study_.options.peers) {
      peer.search.population = PaperSearch().population;
      peer.search.iterations = PaperSearch().iterations;
      algorithms.push_back(std::move(peer));
    }
    CompareOptions options = Options({Model::kTripleDiode}, study_.options.ranked_runs);
    options.rankings = true;
    return Study(Subject("rtc_france", "literature"), algorithms, options, &PaperStudy::ranked);
  }

  Expected<void> Budget() {
    const std::vector<std::int64_t> budgets = {10, 30, 100, 300, 1000, 3000, 10000, 30000, 100000};
    CompareOptions options = Options(kModels, study_.options.budget_runs);
    options.constants = ConstantSet::kCodata;
    options.plain_polish = true;
    return Study(
        Subject("rtc_france", "paper"),
        BudgetAlgorithms({Algorithm::kMlo, Algorithm::kLo, Algorithm::kDe, Algorithm::kRandom},
                         budgets),
        options, &PaperStudy::budget);
  }

  const fs::path folder_;
  const Observer& observer_;
  PaperStudy study_;
  bool stopped_ = false;
};

}  // namespace

Expected<PaperStudy> ReproducePaper(const std::string& folder, const PaperStudyOptions& options,
                                    const Observer& observer) {
  return PaperRun(folder, options, observer).Run();
}

}  // namespace lyrefit
