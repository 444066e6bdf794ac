#include <fmt/format.h>

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

}  // namespace lyrefit
