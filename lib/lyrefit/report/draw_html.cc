#include <string_view>

#include "lyrefit/base/number_text.h"
#include "lyrefit/report/document.h"
#include "lyrefit/report/html_parts.h"

namespace lyrefit {
namespace {

constexpr std::size_t kManyRows = 40;                // scripts show longer tables in parts
constexpr const char* kUnreadable = "\xef\xbf\xbd";  // U+FFFD, for characters illegal in a page

std::string HtmlText(const block::Field& field) {
  return (field.name.empty() ? "" : HtmlElement("dt", field.name)) + HtmlElement("dd", field.text) +
         "\n";
}

std::string HtmlText(const block::Sentence& sentence) {
  return HtmlElement("p", sentence.text) + "\n";
}

std::string HtmlText(const block::Legend& legend) { return HtmlElement("p", legend.text) + "\n"; }

std::string HtmlText(const block::Conclusion& conclusion) {
  return "<p>" + HtmlElement("strong", conclusion.text) + "</p>\n";
}

std::string HtmlText(const block::Warning& warning) {
  return "<p role=\"note\">" + HtmlElement("strong", warning.text) + "</p>\n";
}

std::string HtmlText(const block::List& list) {
  std::string html = "<ul>\n";
  for (const std::string& sentence : list.sentences) html += HtmlElement("li", sentence) + "\n";
  return html + "</ul>\n";
}

std::string HtmlText(const block::Entry& entry) {
  std::string html = HtmlElement("dt", entry.title);
  for (const std::string& sentence : entry.sentences) html += HtmlElement("dd", sentence);
  if (entry.sentences.empty()) html += HtmlElement("dd", "");  // each term needs one
  return html + "\n";
}

// A table row. The first cell of a row and each non-empty cell of the head are header cells.
std::string HtmlRow(const std::string& alignment, const block::Table::Row& row, bool head,
                    const std::string& link = "") {
  std::string html = "<tr>";
  for (std::size_t c = 0; c < alignment.size(); ++c) {
    const std::string text = c < row.size() ? row[c] : "";
    const bool names = !text.empty() && (head || c == 0);
    const std::string tag = names ? "th" : "td";
    html += "<" + tag;
    if (names) html += head ? " scope=\"col\"" : " scope=\"row\"";
    if (alignment[c] == 'r') html += " class=\"number\"";
    if (alignment[c] == 'w') html += " class=\"words\"";
    const bool linked = c == 0 && !link.empty();
    if (linked) html.append("><a href=\"").append(HtmlEscaped(link)).append("\"");
    html += ">" + HtmlEscaped(text) + (linked ? "</a></" : "</") + tag + ">";
  }
  return html + "</tr>\n";
}

std::string HtmlText(const block::Preformatted& text) {
  return "<pre>" + HtmlLines(text.lines) + "</pre>\n";
}

std::string HtmlText(const block::Figure& figure) {
  const std::string picture = figure.file.empty()
                                  ? ""
                                  : "<img src=\"" + HtmlEscaped(figure.file) + "\" alt=\"" +
                                        HtmlEscaped(figure.caption) + "\"/>";
  return "<figure>" + picture + HtmlElement("figcaption", figure.caption) + "</figure>\n";
}

std::string HtmlText(const block::LongTable&) { return ""; }

// Draws a block; tables and figures also depend on the page's options.
struct Draw {
  const HtmlLooks& looks;

  std::string operator()(const block::Table& table) const { return HtmlTable(table, looks); }
  std::string operator()(const block::Figure& figure) const {
    return looks.figure ? looks.figure(figure) : HtmlText(figure);
  }
  std::string operator()(const block::LongTable& table) const {
    return looks.long_table ? looks.long_table(table) : HtmlText(table);
  }
  template <typename Block>
  std::string operator()(const Block& any) const {
    return HtmlText(any);
  }
};

}  // namespace

std::string Readable(std::string_view text) {
  std::string readable;
  while (const auto bad = FirstInvalidUtf8(text)) {
    readable.append(text.substr(0, *bad)).append(kUnreadable);
    text.remove_prefix(*bad + 1);
  }
  return readable.append(text);
}

std::string HtmlEscaped(const std::string& text) {
  std::string html;
  for (const char c : Readable(text)) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      case '\'':
        html += "&#39;";
        break;
      case '\n':
      case '\r':
      case '\t':
        html += ' ';
        break;
      default:
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
          html += kUnreadable;
        } else {
          html += c;
        }
    }
  }
  return html;
}

std::string HtmlLines(const std::string& lines) {
  std::string html;
  std::string line;
  for (const char c : lines) {
    if (c != '\n') {
      line += c;
      continue;
    }
    html += HtmlEscaped(line) + "\n";
    line.clear();
  }
  return html + HtmlEscaped(line);
}

std::string HtmlElement(const std::string& tag, const std::string& text) {
  return "<" + tag + ">" + HtmlEscaped(text) + "</" + tag + ">";
}

std::string HtmlTable(const block::Table& table, const HtmlLooks& looks) {
  std::string html = "<table>\n";
  if (!table.caption.empty()) html += HtmlElement("caption", table.caption) + "\n";
  if (!table.heads.empty()) {
    html += "<thead>\n";
    for (const auto& row : table.heads) html += HtmlRow(table.alignment, row, true);
    html += "</thead>\n";
  }
  html += "<tbody>\n";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    for (const block::Table::Span& span : table.spans) {
      if (span.row != r) continue;
      html += "<tr><th scope=\"colgroup\" colspan=\"" + std::to_string(table.alignment.size()) +
              "\">" + HtmlEscaped(span.title) + "</th></tr>\n";
    }
    html += HtmlRow(table.alignment, table.rows[r], false,
                    r < table.links.size() ? table.links[r] : "");
  }
  html += "</tbody>\n</table>\n";
  if (!looks.boxes) return html;
  const std::string name = table.caption.empty() ? "Table" : HtmlEscaped(table.caption);
  const char* const kind = table.rows.size() > kManyRows ? "box long" : "box";
  return std::string("<div class=\"") + kind + "\" role=\"group\" tabindex=\"0\" aria-label=\"" +
         name + "\">\n" + html + "</div>\n";
}

// Adjacent fields and entries form one list.
std::string HtmlBlocks(const std::vector<block::Any>& blocks, const HtmlLooks& looks) {
  std::string html;
  bool in_fields = false;
  for (const block::Any& one : blocks) {
    const bool is_field =
        std::holds_alternative<block::Field>(one) || std::holds_alternative<block::Entry>(one);
    if (is_field != in_fields) html += is_field ? "<dl>\n" : "</dl>\n";
    in_fields = is_field;
    html += std::visit(Draw{looks}, one);
  }
  return html + (in_fields ? "</dl>\n" : "");
}

std::string HtmlSection(const Section& section, const HtmlLooks& looks, const std::string& id) {
  std::string html = "<section" + (id.empty() ? "" : " id=\"" + id + "\"") + ">\n";
  const std::string heading =
      section.heading.empty()
          ? ""
          : HtmlElement(section.depth == 0 ? "h2" : "h3", section.heading) + "\n";
  const std::string blocks = HtmlBlocks(section.blocks, looks);
  if (section.folded) {
    html +=
        "<details class=\"fold\">\n<summary>" + heading + "</summary>\n" + blocks + "</details>\n";
  } else {
    html += heading + blocks;
  }
  return html + "</section>\n";
}

std::string DrawHtml(const Document& document) {
  const HtmlLooks looks;
  const std::string& title = document.head.heading;
  std::string html =
      "<!DOCTYPE html>\n"
      "<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n"
      "<head>\n"
      "<meta charset=\"utf-8\"/>\n";
  html += HtmlElement("title", title.empty() ? "lyrefit" : title) + "\n";
  html += "<style>th { text-align: left } .number { text-align: right }</style>\n</head>\n<body>\n";
  for (const std::string& banner : document.banners) {
    html += "<p role=\"alert\">" + HtmlElement("strong", banner) + "</p>\n";
  }
  html += "<header>\n" + (title.empty() ? "" : HtmlElement("h1", title) + "\n") +
          HtmlBlocks(document.head.blocks, looks) + "</header>\n";
  for (const Section& section : document.sections) html += HtmlSection(section, looks, "");
  return html + "</body>\n</html>\n";
}

}  // namespace lyrefit
