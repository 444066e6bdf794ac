#include "lyrefit/report/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "lyrefit/base/file.h"
#include "lyrefit/report/gnuplot.h"
#include "lyrefit/report/plot_script.h"

namespace lyrefit {
namespace {

// "svg" or "png", from the extension.
Expected<std::string> TerminalFor(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  if (extension == ".svg" || extension == ".png") return extension.substr(1);
  return Fail(fmt::format("expected a plot file that ends in .svg or .png, found {}",
                          extension.empty() ? "no extension" : extension),
              path);
}

}  // namespace

Expected<void> DrawScript(const std::function<std::string(const std::string& terminal)>& script,
                          const std::string& path) {
  const Expected<std::string> terminal = TerminalFor(path);
  if (!terminal) return tl::unexpected(terminal.error());
  const Expected<std::string> picture = RunGnuplot(script(*terminal));
  if (!picture) return Fail(picture.error().message, path);
  return WriteTextFile(path, *picture);
}

Expected<void> PlotFit(const FitReport& report, const std::string& path) {
  return DrawScript([&](const std::string& terminal) { return PlotScript(report, terminal); },
                    path);
}

Expected<void> CheckPlot(const std::string& path) {
  const Expected<std::string> terminal = TerminalFor(path);
  if (!terminal) return tl::unexpected(terminal.error());
  const Expected<std::string> answer = RunGnuplot("set print '-'; print GPVAL_VERSION\n");
  if (!answer) return Fail(answer.error().message, path);
  return {};
}

}  // namespace lyrefit
