#include "lyrefit/report/page_shell.h"

#include <zlib.h>

#include "lyrefit/base/version.h"
#include "lyrefit/report/html_parts.h"
#include "lyrefit/report/page_assets.h"

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
    return "<script type=\"application/gzip\" id=\"" + id + "\">" + Base64(Gzipped(data.json)) +
           "</script>\n";
  }
  return "<script type=\"application/json\" id=\"" + id + "\">" + ScriptSafe(data.json) +
         "</script>\n";
}

// Plotly with its licence, which must accompany every copy.
std::string PlotlyElements() {
  return "<details class=\"licence\"><summary>Parts by others</summary>\n<p>Charts: plotly.js "
         "(basic bundle), under the MIT licence.</p>\n<pre>" +
         HtmlLines(std::string(PlotlyLicence())) +
         "</pre></details>\n<script type=\"application/gzip\" id=\"plotly\">" +
         Base64(PackedPlotly()) + "</script>\n";
}

}  // namespace

bool PlotlyIsEmbedded() { return !PackedPlotly().empty(); }

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
  if (shell.plotly && PlotlyIsEmbedded()) html += PlotlyElements();
  html += "</footer>\n<script>\n" + std::string(PageScript()) + "</script>\n";
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

std::string Gzipped(std::string_view text) {
  constexpr int kGzip = 15 + 16;  // the largest window, and a gzip header without a time
  z_stream stream = {};
  deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kGzip, 8, Z_DEFAULT_STRATEGY);
  std::string packed(deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
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
