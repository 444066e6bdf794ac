#pragma once

#include <string>
#include <string_view>
#include <vector>

// The common frame of all pages: one HTML file without network access, for light and dark, phones
// and paper, keyboard and screen reader. The caller supplies the content.
namespace lyrefit {

// Data for scripts, which read it by `lyrefit.data(id)`.
struct PageData {
  std::string id;
  std::string json;
  bool packed = false;  // compressed; for data too large to be read in the source
};

struct PageShell {
  std::string title;                      // plain text
  std::string summary;                    // HTML below the title
  std::string body;                       // HTML within <main>
  std::string style;                      // CSS after the common style
  std::vector<std::string> scripts = {};  // JavaScript, run in order after all else has loaded
  std::vector<PageData> data = {};
  bool plotly = false;  // embed Plotly for `lyrefit.plotly()`, if installed
};

// Draws the page. Scripts find the functions of page.js in `lyrefit`: data(id), bytes(id),
// plotly(), colour(hex), onTheme(function). `body` must be readable without scripts.
std::string DrawShell(const PageShell& shell);

// Whether this build has Plotly to embed.
bool PlotlyIsEmbedded();

// JSON that is safe within <script>, whatever its strings contain.
std::string ScriptSafe(std::string_view json);

// gzip, with equal bytes for equal texts; bytes as base64 text.
std::string Gzipped(std::string_view text);
std::string Base64(std::string_view bytes);

}  // namespace lyrefit
