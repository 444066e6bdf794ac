#include <algorithm>
#include <cmath>

#include "lyrefit/report/figure_parts.h"

namespace lyrefit {
namespace {

// Rows of a whole figure that make an SVG of one megabyte. A mark takes ten times the bytes of a
// corner of a line.
constexpr std::size_t kMostMarksDrawn = 3 * kMostMarks;
constexpr std::size_t kMostCorners = 4 * kMostMarks;

bool HasMarks(const Series& series) {
  return series.kind == SeriesKind::kPoints || series.kind == SeriesKind::kLineAndPoints;
}

// Largest length of each stretch for a total of at most `most`; short stretches are kept whole.
std::size_t ShareOf(std::size_t most, std::vector<std::size_t> sizes) {
  std::sort(sizes.begin(), sizes.end());
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const std::size_t each = most / (sizes.size() - i);
    if (sizes[i] > each) return each;
    most -= sizes[i];
  }
  return kAllRows;
}

// Thinned rows from `begin` to `end`. Distances in x are logarithmic on a logarithmic axis.
std::vector<FigureRow> Stretch(const Panel& panel, const Series& series, std::size_t begin,
                               std::size_t end, std::size_t most) {
  const auto at = [&series](std::size_t i) { return series.rows.begin() + static_cast<long>(i); };
  if (end - begin <= most) return {at(begin), at(end)};
  std::vector<double> x, y;
  for (std::size_t i = begin; i < end; ++i) {
    x.push_back(panel.x.log ? std::log(series.rows[i][0]) : series.rows[i][0]);
    y.push_back(series.rows[i][1]);
  }
  std::vector<FigureRow> rows;
  for (const std::size_t i : MarksToDraw(x, y, std::max<std::size_t>(most, 4))) {
    rows.push_back(series.rows[begin + i]);
  }
  return rows;
}

}  // namespace

MostRows MostOf(const Figure& figure) {
  std::vector<std::size_t> marks, corners;
  for (const Panel& panel : figure.panels) {
    for (const Series& series : panel.series) {
      std::vector<std::size_t>& sizes = HasMarks(series) ? marks : corners;
      std::size_t begin = 0;
      for (const std::size_t end : series.ends) {
        sizes.push_back(end - begin);
        begin = end;
      }
      sizes.push_back(series.rows.size() - begin);
    }
  }
  return {ShareOf(kMostMarksDrawn, std::move(marks)), ShareOf(kMostCorners, std::move(corners))};
}

std::vector<std::vector<FigureRow>> RowsToDraw(const Panel& panel, const Series& series,
                                               const MostRows& most) {
  std::size_t each = HasMarks(series) ? most.marks : most.corners;
  if (series.kind == SeriesKind::kStems) each = std::min(each, most.marks);  // drawn with marks
  const bool whole = series.kind == SeriesKind::kBox || series.kind == SeriesKind::kBars ||
                     series.kind == SeriesKind::kCells;
  if (whole) each = kAllRows;  // quartiles require all rows; a bar without its neighbours is a gap
  std::vector<std::vector<FigureRow>> stretches;
  std::size_t begin = 0;
  for (const std::size_t end : series.ends) {
    stretches.push_back(Stretch(panel, series, begin, end, each));
    begin = end;
  }
  stretches.push_back(Stretch(panel, series, begin, series.rows.size(), each));
  return stretches;
}

}  // namespace lyrefit
