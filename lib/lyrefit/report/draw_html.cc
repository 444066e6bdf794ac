#include <string_view>

#include "lyrefit/curve/number_text.h"
#include "lyrefit/report/document.h"

namespace lyrefit {
namespace {

constexpr const char* kUnreadable = "\xef\xbf\xbd";  // U+FFFD, in place of what a page may not hold

// Names come from files, and files hold anything.
std::string Readable(std::string_view text) {
  std::string readable;
  while (const auto bad = FirstInvalidUtf8(text)) {
    readable.append(text.substr(0, *bad)).append(kUnreadable);
    text.remove_prefix(*bad + 1);
  }
  return readable.append(text);
}

// What HTML reads as its own is spelled out.
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

std::string Element(const std::string& tag, const std::string& text) {
  return "<" + tag + ">" + HtmlEscaped(text) + "</" + tag + ">";
}

std::string HtmlText(const block::Field& field) {
  return (field.name.empty() ? "" : Element("dt", field.name)) + Element("dd", field.text) + "\n";
}

std::string HtmlText(const block::Sentence& sentence) { return Element("p", sentence.text) + "\n"; }

std::string HtmlText(const block::Legend& legend) { return Element("p", legend.text) + "\n"; }

std::string HtmlText(const block::Conclusion& conclusion) {
  return "<p>" + Element("strong", conclusion.text) + "</p>\n";
}

std::string HtmlText(const block::Warning& warning) {
  return "<p role=\"note\">" + Element("strong", warning.text) + "</p>\n";
}

std::string HtmlText(const block::List& list) {
  std::string html = "<ul>\n";
  for (const std::string& sentence : list.sentences) html += Element("li", sentence) + "\n";
  return html + "</ul>\n";
}

std::string HtmlText(const block::Entry& entry) {
  std::string html = Element("dt", entry.title);
  for (const std::string& sentence : entry.sentences) html += Element("dd", sentence);
  if (entry.sentences.empty()) html += Element("dd", "");  // no term goes without one
  return html + "\n";
}

// The first cell of a row names it; a cell of the head that is empty names nothing.
std::string HtmlRow(const std::string& alignment, const block::Table::Row& row, bool head) {
  std::string html = "<tr>";
  for (std::size_t c = 0; c < alignment.size(); ++c) {
    const std::string text = c < row.size() ? row[c] : "";
    const bool names = !text.empty() && (head || c == 0);
    const std::string tag = names ? "th" : "td";
    html += "<" + tag;
    if (names) html += head ? " scope=\"col\"" : " scope=\"row\"";
    if (alignment[c] == 'r') html += " class=\"number\"";
    html += ">" + HtmlEscaped(text) + "</" + tag + ">";
  }
  return html + "</tr>\n";
}

std::string HtmlText(const block::Table& table) {
  std::string html = "<table>\n";
  if (!table.caption.empty()) html += Element("caption", table.caption) + "\n";
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
    html += HtmlRow(table.alignment, table.rows[r], false);
  }
  return html + "</tbody>\n</table>\n";
}

std::string HtmlText(const block::Preformatted& text) {
  std::string html = "<pre>";
  std::string line;
  for (const char c : text.lines) {
    if (c != '\n') {
      line += c;
      continue;
    }
    html += HtmlEscaped(line) + "\n";
    line.clear();
  }
  return html + HtmlEscaped(line) + "</pre>\n";
}

std::string HtmlText(const block::Figure& figure) {
  const std::string picture = figure.file.empty()
                                  ? ""
                                  : "<img src=\"" + HtmlEscaped(figure.file) + "\" alt=\"" +
                                        HtmlEscaped(figure.caption) + "\"/>";
  return "<figure>" + picture + Element("figcaption", figure.caption) + "</figure>\n";
}

// Fields and entries that follow each other are one list.
std::string HtmlBlocks(const std::vector<block::Any>& blocks) {
  std::string html;
  bool in_fields = false;
  for (const block::Any& one : blocks) {
    const bool is_field =
        std::holds_alternative<block::Field>(one) || std::holds_alternative<block::Entry>(one);
    if (is_field != in_fields) html += is_field ? "<dl>\n" : "</dl>\n";
    in_fields = is_field;
    html += std::visit([](const auto& any) { return HtmlText(any); }, one);
  }
  return html + (in_fields ? "</dl>\n" : "");
}

std::string HtmlSection(const Section& section) {
  std::string html = "<section>\n";
  if (!section.heading.empty()) {
    html += Element(section.depth == 0 ? "h2" : "h3", section.heading) + "\n";
  }
  return html + HtmlBlocks(section.blocks) + "</section>\n";
}

}  // namespace

std::string DrawHtml(const Document& document) {
  const std::string& title = document.head.heading;
  std::string html =
      "<!DOCTYPE html>\n"
      "<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n"
      "<head>\n"
      "<meta charset=\"utf-8\"/>\n";
  html += Element("title", title.empty() ? "lyrefit" : title) + "\n";
  html += "<style>th { text-align: left } .number { text-align: right }</style>\n</head>\n<body>\n";
  for (const std::string& banner : document.banners) {
    html += "<p role=\"alert\">" + Element("strong", banner) + "</p>\n";
  }
  html += "<header>\n" + (title.empty() ? "" : Element("h1", title) + "\n") +
          HtmlBlocks(document.head.blocks) + "</header>\n";
  for (const Section& section : document.sections) html += HtmlSection(section);
  return html + "</body>\n</html>\n";
}

}  // namespace lyrefit
