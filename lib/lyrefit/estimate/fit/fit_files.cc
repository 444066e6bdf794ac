#include "lyrefit/estimate/fit/fit_files.h"

#include <optional>

#include "lyrefit/base/file.h"
#include "lyrefit/base/parallel.h"

namespace lyrefit {
std::vector<FittedFile> FitFiles(
    const std::vector<std::string>& files, int threads, const Observer& observer,
    const std::function<Expected<FitReport>(int i, const Observer& observer)>& fit) {
  const ProgressReporter progress(observer, 0);
  progress.BeginSilently("fit", static_cast<std::int64_t>(files.size()));
  std::vector<std::optional<Expected<FitReport>>> reports(files.size());
  ParallelFor(static_cast<int>(files.size()), threads, [&](int i) {
    const StopToken& stop = progress.stop();
    if (stop.requested()) return;
    const StoppableReads reads(stop);
    reports[i] = fit(i, stop.AsObserver());
    if (stop.requested() && !*reports[i]) reports[i].reset();  // its error may come from the stop
    progress.Step();
  });
  std::vector<FittedFile> fits;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (reports[i]) fits.push_back({files[i], std::move(*reports[i])});
  }
  return fits;
}

}  // namespace lyrefit
