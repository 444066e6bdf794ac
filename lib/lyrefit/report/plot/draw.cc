#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "lyrefit/base/file.h"
#include "lyrefit/base/try.h"
#include "lyrefit/report/plot/figure.h"
#include "lyrefit/report/plot/gnuplot.h"

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

Expected<void> DrawFigure(const Figure& figure, const std::string& path, PlotPoints points) {
  TRY(const std::string terminal, TerminalFor(path));
  const Expected<std::string> picture = RunGnuplot(FigureScript(figure, terminal, points));
  if (!picture) return Fail(picture.error().message, path);
  return WriteTextFile(path, *picture);
}

Expected<void> CheckPlot(const std::string& path) {
  TRY(TerminalFor(path));
  const Expected<std::string> answer = RunGnuplot("set print '-'; print GPVAL_VERSION\n");
  if (!answer) return Fail(answer.error().message, path);
  return {};
}

}  // namespace lyrefit
