#include <fmt/format.h>

#include "diagnose_command.h"
#include "interrupt.h"
#include "lyrefit/report/diagnosis_plot.h"
#include "lyrefit/report/diagnosis_text.h"
#include "lyrefit/report/healthy_text.h"
#include "lyrefit/report/json.h"
#include "output.h"

namespace lyrefit {

void DiagnoseCommand::AddHealthyFlags() {
  constexpr char kGroup[] = "Against its own past";
  verb_
      ->AddOption("--healthy", &healthy_files_,
                  "healthy sweeps of the same module or its neighbours, files or folders: CURVE is "
                  "compared with them, and diagnosed without what they all have")
      .ReadsCurves()
      .Group(kGroup);
  verb_
      ->AddSwitch("--module", &module_,
                  "all curves of CURVE are sweeps of one module: find the odd ones")
      .Group(kGroup);
  AddTableFlags(verb_, kHealthyOptionRows, kGroup, &healthy_);
}

Expected<void> DiagnoseCommand::CheckHealthyFlags() const {
  if (!module_ && healthy_files_.empty()) return {};
  if (module_ && !healthy_files_.empty()) return Fail("only one of --healthy and --module");
  if (together_ || !answers_file_.empty()) {
    return Fail("--together and --answers are not for --healthy and --module");
  }
  if (module_ && !(output_.plot_file.empty() && extend_file_.empty())) {
    return Fail("--plot and --extend are not for --module");
  }
  if (!module_ && files_.size() > 1) {
    return Fail("--healthy compares one CURVE; for many sweeps of one module: --module");
  }
  return {};
}

Expected<std::vector<IvCurve>> DiagnoseCommand::ReadSweeps(const std::vector<std::string>& files,
                                                           const ConditionFlags& conditions) const {
  std::vector<IvCurve> sweeps;
  for (const std::string& file : files) {
    Expected<CurveSet> set;
    if (HoldsCurveSet(file, reading_)) {
      set = ReadCurveSet(file, reading_);
    } else {
      Expected<IvCurve> curve = ReadCurve(file, reading_);
      if (!curve) return tl::unexpected(curve.error());
      set = SetOfOne(std::move(*curve));
    }
    if (!set) return tl::unexpected(set.error());
    if (auto applied = ApplyConditionFlags(conditions, &*set); !applied) {
      return tl::unexpected(applied.error());
    }
    for (IvCurve& curve : set->curves) sweeps.push_back(std::move(curve));
  }
  return sweeps;
}

int DiagnoseCommand::RunModule() {
  healthy_.threads = options_.threads;
  const auto sweeps = ReadSweeps(files_, conditions_);
  if (!sweeps) return Refuse(sweeps.error());
  const auto odd = FindOddSweeps(*sweeps, healthy_);
  if (!odd) return Refuse(odd.error());
  if (!output_.json_file.empty()) {
    const auto written = WriteOutput(output_.json_file, OddSweepsJson(*odd));
    if (!written) return Refuse(written.error());
  }
  if (!verb_->TextWanted()) return kExitFine;
  const auto text = WriteOutput("-", output_.brief ? BriefOddSweeps(*odd) : OddSweepsText(*odd));
  return text ? kExitFine : Refuse(text.error());
}

int DiagnoseCommand::RunHealthy() {
  healthy_.threads = options_.threads;
  const auto sweep = ReadSweeps(files_, conditions_);
  if (!sweep) return Refuse(sweep.error());
  if (sweep->size() != 1) {
    return Refuse(Error{
        fmt::format("--healthy compares one sweep, this measurement has {} curves", sweep->size()),
        files_.front()});
  }
  ConditionFlags module = conditions_;  // light and temperature are this sweep's
  module.irradiance_W_m2.reset();
  module.temperature_C.reset();
  const auto healthy = ReadSweeps(healthy_files_, module);
  if (!healthy) return Refuse(healthy.error());
  const auto comparison = CompareWithHealthy(sweep->front(), *healthy, healthy_);
  if (!comparison) return Refuse(comparison.error());
  const auto diagnosis = Diagnose(comparison->without_common, options_, TerminalObserver());
  if (!diagnosis) return Refuse(diagnosis.error());
  const auto write = [&]() -> Expected<void> {
    if (!output_.json_file.empty()) {
      const std::string json = HealthyJson(*comparison, *diagnosis);
      if (auto written = WriteOutput(output_.json_file, json); !written) return written;
    }
    if (!extend_file_.empty()) {
      const std::string fit = JsonReport(diagnosis->extended, output_.points());
      if (auto written = WriteOutput(extend_file_, fit); !written) return written;
    }
    if (!output_.plot_file.empty()) {
      if (auto drawn = PlotDiagnosis(*diagnosis, output_.plot_file); !drawn) return drawn;
    }
    if (!verb_->TextWanted()) return {};
    return WriteOutput("-", output_.brief
                                ? BriefHealthy(*comparison) + BriefDiagnosis(*diagnosis)
                                : HealthyText(*comparison) + "\n" + DiagnosisText(*diagnosis));
  };
  if (auto written = write(); !written) return Refuse(written.error());
  if (diagnosis->interrupted) return kExitInterrupted;
  return diagnosis->extended.usable ? kExitFine : kExitNotUsable;
}

}  // namespace lyrefit
