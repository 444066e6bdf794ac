#include "lyrefit/report/page.h"

#include <fmt/format.h>

#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>
#include <utility>

#include "lyrefit/report/html_parts.h"
#include "lyrefit/report/page_shell.h"

namespace lyrefit {
namespace {

constexpr std::size_t kPackedFrom =
    200000;                              // bytes of JSON; smaller data stay readable in the source
constexpr std::size_t kFewSections = 4;  // a page of fewer sections has no list of contents

std::string FigureId(std::size_t number) { return fmt::format("figure-{}", number); }

// The pictures of a document in reading order.
std::vector<const block::Figure*> FiguresOf(const Document& document) {
  std::vector<const block::Figure*> figures;
  const auto collect = [&figures](const Section& section) {
    for (const block::Any& any : section.blocks) {
      const auto* const figure = std::get_if<block::Figure>(&any);
      if (figure != nullptr && !figure->figure.panels.empty()) figures.push_back(figure);
    }
  };
  collect(document.head);
  for (const Section& section : document.sections) collect(section);
  return figures;
}

// A picture with its caption and, folded below it, a table of its numbers.
std::string FigureElement(const block::Figure& figure, const std::string& id,
                          const std::string& still) {
  std::string html = fmt::format("<figure id=\"{}\" aria-labelledby=\"{}-caption\">\n", id, id);
  html += "<div class=\"tools\" hidden=\"\" role=\"group\" aria-label=\"Chart\"></div>\n";
  html += still.empty()
              ? "<noscript><p role=\"note\">This picture needs scripts; below it stands what it "
                "shows.</p></noscript>\n"
              : "<div class=\"still\" role=\"group\" tabindex=\"0\" aria-label=\"Picture\">\n" +
                    still + "</div>\n";
  html += "<div class=\"live\"></div>\n";
  html += fmt::format("<figcaption id=\"{}-caption\">{}</figcaption>\n", id,
                      HtmlEscaped(figure.caption));
  if (!figure.readings.rows.empty()) {
    html += "<details class=\"readings\"><summary>The picture in numbers</summary>\n" +
            HtmlTable(figure.readings, {true, {}, {}}) + "</details>\n";
  }
  return html + "</figure>\n";
}

// Static pictures, drawn by one run of gnuplot; empty if they are not requested.
std::vector<std::string> DrawStills(const std::vector<const block::Figure*>& figures,
                                    const PageOptions& options) {
  if (!options.stills) return std::vector<std::string>(figures.size());
  std::vector<PagePicture> pictures;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    pictures.push_back({&figures[i]->figure, FigureId(i + 1), figures[i]->caption});
  }
  Expected<std::vector<std::string>> svgs = InlineSvgs(pictures);
  if (svgs) return *std::move(svgs);
  const std::string why =
      "<p role=\"note\">" +
      HtmlElement("strong", "The picture could not be drawn: " + svgs.error().message + ".") +
      "</p>\n";
  return std::vector<std::string>(figures.size(), why);
}

// The HTML element of every picture.
std::map<const block::Figure*, std::string> DrawFigures(
    const std::vector<const block::Figure*>& figures, const PageOptions& options) {
  const std::vector<std::string> stills = DrawStills(figures, options);
  std::map<const block::Figure*, std::string> elements;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    elements[figures[i]] = FigureElement(*figures[i], FigureId(i + 1), stills[i]);
  }
  return elements;
}

constexpr char kVerdictBegin[] = "<div class=\"verdict\">\n<h2>Verdict</h2>\n";
constexpr char kAheadBegin[] = "<!--ahead-->\n", kAheadEnd[] = "<!--/ahead-->\n";

// Whether a section holds only the verdict.
bool IsVerdict(const Section& section, const std::string& verdict) {
  if (section.blocks.size() != 1) return false;
  const auto* const sentence = std::get_if<block::Sentence>(&section.blocks.front());
  const auto* const conclusion = std::get_if<block::Conclusion>(&section.blocks.front());
  return (sentence != nullptr && sentence->text == verdict) ||
         (conclusion != nullptr && conclusion->text == verdict);
}

// The document in the order of a page: the summary below the title, then the sections.
struct PageParts {
  std::string summary;
  std::vector<const Section*> sections;
};

PageParts Arrange(const Document& document) {
  PageParts parts;
  for (const std::string& banner : document.banners) {
    parts.summary += "<p role=\"alert\">" + HtmlElement("strong", banner) + "</p>\n";
  }
  if (!document.verdict.empty()) {
    parts.summary += kVerdictBegin;
    std::istringstream lines(document.verdict);
    for (std::string line; std::getline(lines, line);) {
      parts.summary += HtmlElement("p", line) + "\n";
    }
    parts.summary += "</div>\n";
  }
  for (const Section& section : document.sections) {
    if (section.warns) {
      parts.summary += "<div role=\"note\">\n<h2>Warnings</h2>\n" +
                       HtmlBlocks(section.blocks, {true, {}, {}}) + "</div>\n";
    } else if (!IsVerdict(section, document.verdict)) {
      parts.sections.push_back(&section);
    }
  }
  return parts;
}

// The place of a table of many rows, which a script fills.
constexpr char kLongTable[] =
    "<noscript><p role=\"note\">The table of all rows needs scripts, which do not run here; the "
    "tables and pictures above hold what matters most.</p></noscript>\n"
    "<div id=\"rows-table\"></div>\n";

// What the script of the table has to know.
std::string LongTableJson(const block::LongTable& table) {
  nlohmann::ordered_json json = {{"links", table.links},
                                 {"columns", nlohmann::ordered_json::array()}};
  for (const block::LongTable::Column& column : table.columns) {
    json["columns"].push_back({{"name", column.name},
                               {"doc", column.doc},
                               {"number", column.number},
                               {"shown", column.shown}});
  }
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string Contents(const std::vector<const Section*>& sections) {
  if (sections.size() < kFewSections) return "";
  std::string html = "<nav class=\"contents\" aria-label=\"Contents\">\n<ul>\n";
  for (std::size_t i = 0; i < sections.size(); ++i) {
    if (sections[i]->heading.empty() || sections[i]->depth > 0 || sections[i]->folded) continue;
    html += fmt::format("<li><a href=\"#section-{}\">{}</a></li>\n", i + 1,
                        HtmlEscaped(sections[i]->heading));
  }
  return html + "</ul>\n</nav>\n";
}

std::string SignatureLines(const std::vector<std::string>& signatures) {
  if (signatures.empty()) return "";
  std::string html = "<div class=\"sign\">\n";
  for (const std::string& who : signatures) html += HtmlElement("p", who) + "\n";
  return html + "</div>\n";
}

}  // namespace

std::string DrawPage(const Document& document, const std::string& json,
                     const PageOptions& options) {
  const std::vector<const block::Figure*> figures = FiguresOf(document);
  const auto elements = DrawFigures(figures, options);
  PageShell page;
  const HtmlLooks looks = {true,
                           [&elements](const block::Figure& figure) {
                             const auto found = elements.find(&figure);
                             return found == elements.end() ? std::string() : found->second;
                           },
                           [&page](const block::LongTable& table) {
                             page.table = true;
                             page.data.push_back({"rows-columns", LongTableJson(table)});
                             return std::string(kLongTable);
                           }};
  const PageParts parts = Arrange(document);
  page.title = document.head.heading;
  page.summary = parts.summary;
  // Pictures first, then the fields of the measurement.
  std::vector<block::Any> fields;
  for (const block::Any& any : document.head.blocks) {
    const auto* const figure = std::get_if<block::Figure>(&any);
    if (figure == nullptr) {
      fields.push_back(any);
    } else {
      page.body += looks.figure(*figure);
    }
  }
  page.body +=
      "<section>\n" + HtmlBlocks(fields, looks) + "</section>\n" + Contents(parts.sections);
  for (std::size_t i = 0; i < parts.sections.size(); ++i) {
    page.body += HtmlSection(*parts.sections[i], looks, fmt::format("section-{}", i + 1));
  }
  page.body += SignatureLines(document.signatures);
  if (!json.empty()) page.data.push_back({"record", json, json.size() > kPackedFrom});
  page.plotly = options.interactive && (page.table || !figures.empty()) && PlotlyIsEmbedded();
  for (std::size_t i = 0; page.plotly && i < figures.size(); ++i) {
    page.data.push_back({FigureId(i + 1) + "-chart", PlotlyJson(figures[i]->figure)});
  }
  return DrawShell(page);
}

std::string WithVerdictAhead(const std::string& page, const std::vector<std::string>& lines,
                             const std::string& own) {
  const std::string_view begin_mark = kAheadBegin, end_mark = kAheadEnd;
  const std::size_t verdict = page.find(kVerdictBegin);
  if (verdict == std::string::npos) return page;
  const std::size_t begin = verdict + std::strlen(kVerdictBegin);
  std::size_t end = begin;
  if (page.compare(begin, begin_mark.size(), begin_mark) == 0) {
    const std::size_t last = page.find(end_mark, begin);
    if (last != std::string::npos) end = last + end_mark.size();
  }
  std::string ahead(begin_mark);
  for (const std::string& line : lines) ahead += "<p>" + HtmlElement("strong", line) + "</p>\n";
  ahead += HtmlElement("p", own) + "\n";
  return page.substr(0, begin) + ahead.append(end_mark) + page.substr(end);
}

}  // namespace lyrefit
