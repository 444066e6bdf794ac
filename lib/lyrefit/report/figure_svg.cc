#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "lyrefit/base/try.h"
#include "lyrefit/report/figure_parts.h"
#include "lyrefit/report/html_parts.h"

namespace lyrefit {
namespace {

// Start of each picture in gnuplot's standard output.
constexpr char kPictureBegins[] = "<?xml ";

void ReplaceAll(const std::string& what, const std::string& with, std::string* text) {
  for (std::size_t at = text->find(what); at != std::string::npos;
       at = text->find(what, at + with.size())) {
    text->replace(at, what.size(), with);
  }
}

// Replaces "rgb(  0, 114, 178)" within a tag by the page's CSS variable of that colour.
void NameColours(bool letters, std::string* tag) {
  std::size_t at = 0;
  while ((at = tag->find("rgb(", at)) != std::string::npos) {
    const std::size_t end = tag->find(')', at);
    if (end == std::string::npos) return;
    int parts[3] = {};
    const char* next = tag->c_str() + at + 4;
    for (int& part : parts) {
      char* after = nullptr;
      part = static_cast<int>(std::strtol(next, &after, 10));
      next = *after == ',' ? after + 1 : after;
    }
    const std::string hex = fmt::format("{:02x}{:02x}{:02x}", parts[0], parts[1], parts[2]);
    const std::string named = fmt::format("var(--{}-{},#{})", letters ? 't' : 'c', hex, hex);
    tag->replace(at, end + 1 - at, named);
    at += named.size();
  }
  for (const char* quote : {"'", "\""}) {
    ReplaceAll(fmt::format("={0}black{0}", quote), fmt::format("={0}currentColor{0}", quote), tag);
  }
}

// Removes attributes of gnuplot's that change nothing in a page: defaults, and a class without a style.
void DropDefaults(std::string* tag) {
  for (const char* needless : {" stroke-linecap=\"butt\" stroke-linejoin=\"miter\"",
                               " class=\"gridline\"", " color=\"currentColor\""}) {
    ReplaceAll(needless, "", tag);
  }
}

// Prefixes ids with that of the picture, as gnuplot's ids are unique in one picture only.
void NameIds(const std::string& id, std::string* tag) {
  for (const char* quote : {"'", "\""}) {
    ReplaceAll(fmt::format(" id={}", quote), fmt::format(" id={}{}-", quote, id), tag);
    ReplaceAll(fmt::format("href={}#", quote), fmt::format("href={}#{}-", quote, id), tag);
  }
  ReplaceAll("url(#", "url(#" + id + "-", tag);
}

// Whether an empty group begins at `at`; `end` becomes the position after it.
bool IsEmptyGroup(const std::string& svg, std::size_t at, std::size_t* end) {
  if (svg.compare(at, 3, "<g ") != 0) return false;
  const std::size_t close = svg.find('>', at);
  if (close == std::string::npos) return false;
  const std::size_t next = svg.find_first_not_of(" \t\n", close + 1);
  if (next == std::string::npos || svg.compare(next, 4, "</g>") != 0) return false;
  *end = next + 4;
  return true;
}

// The drawing without the background, which the page provides.
Expected<std::string> Drawing(const std::string& svg, const std::string& id) {
  const std::size_t background = svg.find("fill=\"#ffffff\"/>");
  const std::size_t end = svg.rfind("</g>");
  const std::size_t begin = svg.find("<defs>");
  if (background == std::string::npos || begin == std::string::npos || end < begin) {
    return Fail("gnuplot's picture is not as expected");
  }
  const std::size_t shapes_end = svg.find("</defs>", begin) + 7;
  const bool shapes_used = svg.find("href='#", shapes_end) != std::string::npos ||
                           svg.find("url(#", shapes_end) != std::string::npos;
  std::string drawing;
  for (std::size_t at = shapes_used ? begin : shapes_end; at < end;) {
    std::size_t next = at + 1;
    if (IsEmptyGroup(svg, at, &next)) {
      at = next;
      continue;
    }
    if (svg[at] == '<') {
      next = svg.find('>', at) + 1;
      std::string tag = svg.substr(at, next - at);
      NameColours(tag.find("font-family") != std::string::npos, &tag);
      DropDefaults(&tag);
      NameIds(id, &tag);
      drawing += tag;
    } else if (svg[at] != '\t' &&
               (svg[at] != '\n' || (!drawing.empty() && drawing.back() != '\n'))) {
      drawing += svg[at];
    }
    at = next;
  }
  return Readable(drawing);
}

// The size of gnuplot's picture: "0 0 868 826".
std::string ViewBox(const std::string& svg) {
  constexpr char kName[] = "viewBox=\"";
  const std::size_t at = svg.find(kName);
  if (at == std::string::npos) return "0 0 800 600";
  const std::size_t begin = at + sizeof(kName) - 1;
  return svg.substr(begin, svg.find('"', begin) - begin);
}

Expected<std::string> Inline(const std::string& svg, const PagePicture& picture) {
  TRY(const std::string drawing, Drawing(svg, picture.id));
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
      "viewBox=\"{}\" role=\"img\" aria-labelledby=\"{}-title {}-text\">\n"
      "<title id=\"{}-title\">{}</title>\n<desc id=\"{}-text\">{}</desc>\n<g>\n{}</g>\n</svg>\n",
      ViewBox(svg), picture.id, picture.id, picture.id, HtmlEscaped(picture.figure->title),
      picture.id, HtmlEscaped(picture.description), drawing);
}

}  // namespace

Expected<std::vector<std::string>> InlineSvgs(const std::vector<PagePicture>& pictures) {
  std::vector<std::string> svgs;
  if (pictures.empty()) return svgs;
  std::string script;
  for (const PagePicture& picture : pictures) {
    script += "reset\nunset object\nunset label\nunset arrow\n" +
              FigureScript(*picture.figure, "svg") + "unset output\n";
  }
  TRY(const std::string drawn, RunGnuplot(script));
  std::size_t at = drawn.find(kPictureBegins);
  for (const PagePicture& picture : pictures) {
    if (at == std::string::npos) return Fail("gnuplot drew fewer pictures than were asked for");
    const std::size_t next = drawn.find(kPictureBegins, at + 1);
    TRY(std::string svg, Inline(drawn.substr(at, next - at), picture));
    svgs.push_back(std::move(svg));
    at = next;
  }
  return svgs;
}

namespace {

constexpr int kLeft = 96;  // for the axis of the leftmost panels
constexpr int kGap = 64;   // between panels, for the numbers of the right panel's axis
constexpr int kRight = 24;
constexpr int kRightAxis = 88;
constexpr int kTitle = 44;
constexpr int kLegendRow = 24;
constexpr int kPanelTitle = 34;
constexpr int kAxis = 64;  // below a panel
constexpr int kColourBarRoom = 60;
constexpr int kBarAbove = 54;  // the lower end of the picture
constexpr int kBarHeight = 12;
constexpr int kBarLabel = 9;  // above the lower end of the picture, below the bar's numbers
constexpr int kLine = 36;     // length of a line sample in the legend
constexpr int kLetter = 9;

std::string Terminal(const PageLayout& page, const std::string& terminal) {
  if (terminal == "svg") {
    return fmt::format(
        "set terminal svg size {},{} enhanced font 'DejaVu Sans,14' background '#ffffff'\n",
        page.width, page.height);
  }
  if (terminal == "pdf") {  // in inches, of 96 pixels
    return fmt::format(
        "set terminal pdfcairo size {}in,{}in enhanced font 'DejaVu Sans,9.5' fontscale 1 "
        "linewidth 1.5\n",
        page.width / 96.0, page.height / 96.0);
  }
  return fmt::format(
      "set terminal pngcairo size {},{} enhanced font 'DejaVu Sans,11' fontscale 1.5 linewidth "
      "1.5\n",
      1.5 * page.width, 1.5 * page.height);
}

// The legend. Tags above 1000 belong to the page.
std::string Legend(const Figure& figure, const PageLayout& page) {
  const double w = page.width;
  const double h = page.height;
  const double left =
      kLeft + std::max(0.0, 0.5 * (w - kLeft - kRight - page.legend_columns * page.entry_width));
  std::string script;
  for (int i = 0; i < static_cast<int>(figure.legend.size()); ++i) {
    const LegendEntry& entry = figure.legend[i];
    const double x = left + page.entry_width * (i % page.legend_columns);
    const int row = i / page.legend_columns;
    const double y = 1 - (kTitle + kLegendRow * (row + 0.5)) / h;
    const double end = (x + kLine) / w;
    const std::string& colour = entry.look.colour;
    if (entry.mark == LegendMark::kBox || entry.mark == LegendMark::kBar) {
      script += fmt::format(
          "set object {} rectangle from screen {:.5f},{:.5f} to screen {:.5f},{:.5f} "
          "fc rgb '{}' fs solid {} border lc rgb '{}'\n",
          1001 + i, x / w, y - 6 / h, end, y + 6 / h, colour,
          entry.mark == LegendMark::kBox ? 0.45 : 1, colour);
    } else if (entry.mark != LegendMark::kPoint) {
      script += fmt::format(
          "set arrow {} from screen {:.5f},{:.5f} to screen {:.5f},{:.5f} nohead lw 2 lc rgb '{}' "
          "dt {}\n",
          1001 + i, x / w, y, end, y, colour, entry.look.dash);
    }
    if (entry.mark == LegendMark::kLineAndPoint || entry.mark == LegendMark::kPoint) {
      script +=
          fmt::format("set label {} '' at screen {:.5f},{:.5f} point pt {} ps 1 lc rgb '{}'\n",
                      3001 + i, (x + 0.5 * kLine) / w, y, entry.look.point, colour);
    }
    script += fmt::format("set label {} {} at screen {:.5f},{:.5f} left noenhanced\n", 2001 + i,
                          GnuplotText(entry.name), end + 8 / w, y);
  }
  return script;
}

std::string ColourBarCommands(const ColourBar& bar, const PageLayout& page) {
  return fmt::format(
      "set palette defined (0 '#0072B2', 0.5 '#8C8C8C', 1 '#D55E00')\n"
      "set cbrange [{:g}:{:g}]\n"
      "set colorbox horizontal user origin screen 0.36, screen {:.5f} size screen 0.28, screen "
      "{:.5f}\n"
      "set label 1002 {} at screen 0.5,{:.5f} center noenhanced\n",
      bar.low, bar.high, kBarAbove / page.height, kBarHeight / page.height, GnuplotText(bar.label),
      kBarLabel / page.height);
}

}  // namespace

PageLayout LayOut(const Figure& figure) {
  const int panels = static_cast<int>(figure.panels.size());
  const int entries = static_cast<int>(figure.legend.size());
  PageLayout page;
  page.columns = std::max(1, std::min(figure.columns, panels));
  // A page of few columns uses wider panels.
  page.panel_width = figure.panel_width > 0 ? figure.panel_width
                     : page.columns == 1    ? 640
                     : page.columns == 2    ? 500
                                            : 400;
  const bool right_axis = std::any_of(figure.panels.begin(), figure.panels.end(),
                                      [](const Panel& panel) { return panel.right.has_value(); });
  page.width = kLeft + page.columns * page.panel_width + (page.columns - 1) * kGap +
               (right_axis ? kRightAxis : kRight);
  std::size_t longest = 1;
  for (const LegendEntry& entry : figure.legend) longest = std::max(longest, entry.name.size());
  page.entry_width = kLine + 34 + kLetter * static_cast<double>(longest);
  page.legend_columns = std::clamp(static_cast<int>((page.width - kLeft) / page.entry_width), 1,
                                   std::max(1, entries));
  const int legend_rows = (entries + page.legend_columns - 1) / page.legend_columns;
  page.height = kTitle + kLegendRow * legend_rows;
  for (int p = 0; p < panels; ++p) {
    const int first_of_row = p - p % page.columns;
    page.top.push_back(p == first_of_row ? page.height + kPanelTitle : page.top[first_of_row]);
    if (p != first_of_row) continue;
    page.height += kPanelTitle + figure.panels[p].height + kAxis + figure.margin_below +
                   (figure.colour_bar ? kColourBarRoom : 0);
  }
  return page;
}

std::string PageCommands(const Figure& figure, const PageLayout& page,
                         const std::string& terminal) {
  std::string script = "set encoding utf8\n" + Terminal(page, terminal);
  script +=
      "set multiplot\nunset key\nset border lw 0.8\nset grid back lt 1 lw 0.6 lc rgb '#d8d8d8'\n"
      "set tics nomirror out scale 0.6\n";
  script += fmt::format("set label 1001 {} at screen 0.5,{:.5f} center noenhanced\n",
                        GnuplotText(figure.title), 1 - 22 / page.height);
  script += Legend(figure, page);
  if (figure.colour_bar) script += ColourBarCommands(*figure.colour_bar, page);
  return script;
}

std::string PlacePanel(const Figure& figure, const PageLayout& page, int p) {
  const Panel& panel = figure.panels[p];
  const double w = page.width;
  const double h = page.height;
  const int column = p % page.columns;
  const double left = kLeft + column * (page.panel_width + kGap);
  const double right = left + page.panel_width;
  const double bottom = page.top[p] + panel.height;
  std::string script;
  if (p > 0) script += "unset arrow\nunset label\nunset object\n";  // already drawn
  script += fmt::format(
      "set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\n"
      "set tmargin at screen {:.5f}\nset bmargin at screen {:.5f}\n"
      "set title {} noenhanced offset 0,-0.6\n",
      left / w, right / w, 1 - page.top[p] / h, 1 - bottom / h, GnuplotText(panel.title));
  script += fmt::format("set label 1 {} at graph 0.5, screen {:.5f} center noenhanced\n",
                        GnuplotText(panel.x.label), 1 - (bottom + 46) / h);
  const auto upright = [&](int tag, const Axis& axis, double x) {
    const std::string colour =
        axis.colour == "black" ? "" : fmt::format(" tc rgb '{}'", axis.colour);
    return fmt::format("set label {} {} at screen {:.5f}, graph 0.5 center rotate noenhanced{}\n",
                       tag, GnuplotText(axis.label), x / w, colour);
  };
  if (column == 0) script += upright(2, panel.y, 20);
  if (panel.right) script += upright(3, *panel.right, right + kRightAxis - 16);
  return script;
}

std::string GnuplotText(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') quoted += '\'';
    quoted += static_cast<unsigned char>(c) < 32 ? ' ' : c;
  }
  return quoted + "'";
}

}  // namespace lyrefit
