#include "lyrefit/report/page_shell.h"

#include <utility>

#include "lyrefit/base/version.h"
#include "lyrefit/report/html_parts.h"

namespace lyrefit {
namespace {

// The browser blocks all network access, whatever the page contains.
constexpr char kNoNetwork[] =
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
    "'unsafe-inline'; script-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; "
    "form-action 'none'\"/>\n";

// Buttons are hidden until the script that handles them runs.
constexpr char kTools[] =
    "<div class=\"tools\" hidden=\"\" role=\"group\" aria-label=\"Page\">"
    "<button type=\"button\" data-page=\"theme\">Dark</button>"
    "<button type=\"button\" data-page=\"save\">Save data</button>"
    "<button type=\"button\" data-page=\"print\">Print</button></div>\n";

std::string DataElement(const PageData& data) {
  const std::string id = HtmlEscaped(data.id);
  if (data.packed) {
    return "<script type=\"application/gzip\" id=\"" + id + "\">" + Packed(data.json) +
           "</script>\n";
  }
  return "<script type=\"application/json\" id=\"" + id + "\">" + ScriptSafe(data.json) +
         "</script>\n";
}

// Parts by others, each with its licence, which must accompany every copy.
std::string PartsByOthers(bool plotly, bool table) {
  if (!plotly && !table) return "";
  std::string licences, elements;
  const auto packed = [&elements](const char* id, std::string_view bytes) {
    elements += std::string("<script type=\"application/gzip\" id=\"") + id + "\">" +
                Base64(bytes) + "</script>\n";
  };
  const auto named = [&licences](const char* what, std::string_view licence) {
    licences += HtmlElement("p", what) + "\n<pre>" + HtmlLines(std::string(licence)) + "</pre>\n";
  };
  if (plotly) {
    named("Charts: plotly.js (basic bundle), under the MIT licence.", PlotlyLicence());
    packed("plotly", PackedPlotly());
  }
  if (table) {
    named("Table: Tabulator, under the MIT licence.", TabulatorLicence());
    packed("tabulator", PackedTabulator());
    packed("tabulator-style", PackedTabulatorStyle());
  }
  return "<details class=\"licence\"><summary>Parts by others</summary>\n" + licences +
         "</details>\n" + elements;
}

}  // namespace

bool PlotlyIsEmbedded() { return !PackedPlotly().empty(); }

bool TabulatorIsEmbedded() { return !PackedTabulator().empty(); }

std::string DrawShell(const PageShell& shell) {
  const std::string title = shell.title.empty() ? "lyrefit" : shell.title;
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
      "<meta name=\"color-scheme\" content=\"light dark\"/>\n";
  html += kNoNetwork + HtmlElement("title", title) + "\n<style>\n" + std::string(PageStyle()) +
          shell.style + "</style>\n</head>\n<body>\n" +
          "<a class=\"skip\" href=\"#main\">To the content</a>\n<header class=\"page\">\n" +
          kTools + HtmlElement("h1", title) + "\n" + shell.summary + "</header>\n" +
          "<main id=\"main\" tabindex=\"-1\">\n" + shell.body + "</main>\n<footer>\n" +
          HtmlElement("p", std::string("Made by lyrefit ") + Version() +
                               ". All that the page shows is in this file.");
  for (const PageData& data : shell.data) html += DataElement(data);
  if (shell.table) html += std::string(kRowsElement) + "</script>\n";
  const bool table = shell.table && TabulatorIsEmbedded();
  html += PartsByOthers(shell.plotly && PlotlyIsEmbedded(), table);
  html += "</footer>\n<script>\n" + std::string(PageScript()) + "</script>\n";
  if (table) html += "<script>\n" + std::string(TableScript()) + "</script>\n";
  for (const std::string& script : shell.scripts) html += "<script>\n" + script + "</script>\n";
  return html + "</body>\n</html>\n";
}

std::string ScriptSafe(std::string_view json) {
  std::string safe;
  safe.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {  // occurs in strings only, where the escape is equivalent
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return safe;
}

PackedText::PackedText() {
  constexpr int kGzip = 15 + 16;  // the largest window, and a gzip header without a time
  deflateInit2(&stream_, Z_BEST_COMPRESSION, Z_DEFLATED, kGzip, 8, Z_DEFAULT_STRATEGY);
}

std::string PackedText::Pack(std::string_view text, int flush) {
  std::string block(1 << 16, '\0');
  std::string bytes = std::move(waiting_);
  stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream_.avail_in = static_cast<uInt>(text.size());
  do {
    stream_.next_out = reinterpret_cast<Bytef*>(block.data());
    stream_.avail_out = static_cast<uInt>(block.size());
    deflate(&stream_, flush);
    bytes.append(block, 0, block.size() - stream_.avail_out);
  } while (stream_.avail_out == 0);
  const std::size_t whole = flush == Z_FINISH ? bytes.size() : bytes.size() / 3 * 3;
  waiting_ = bytes.substr(whole);
  bytes.resize(whole);
  return Base64(bytes);
}

std::string Packed(std::string_view text) {
  PackedText packed;
  const std::string first = packed.Add(text);
  return first + packed.End();
}

std::string Base64(std::string_view bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  const auto byte = [bytes](std::size_t i) -> unsigned {
    return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0;
  };
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned three = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    text += kDigits[three >> 18];
    text += kDigits[three >> 12 & 63];
    text += i + 1 < bytes.size() ? kDigits[three >> 6 & 63] : '=';
    text += i + 2 < bytes.size() ? kDigits[three & 63] : '=';
  }
  return text;
}

}  // namespace lyrefit
