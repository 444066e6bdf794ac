#pragma once

#include <string>
#include <string_view>
#include <vector>

// What all pages share: one file of HTML that fetches nothing, in light and dark, on a phone and on
// paper, for eyes, keyboard and screen reader. What stands in it is its caller's.
namespace lyrefit {

// Data for scripts, `lyrefit.data(id)` there.
struct PageData {
  std::string id;
  std::string json;
  bool packed = false;  // compressed: for what is large and nobody reads in the source
};

struct PageShell {
  std::string title;                      // plain text
  std::string summary;                    // HTML below the title
  std::string body;                       // HTML within <main>
  std::string style;                      // CSS after what every page has
  std::vector<std::string> scripts = {};  // JavaScript, in this order, when all else is there
  std::vector<PageData> data = {};
  bool plotly = false;  // embed it, `lyrefit.plotly()` in scripts; not where it is not installed
};

// The page. Scripts find what page.js offers in `lyrefit`: data(id), bytes(id), plotly(), colour(hex),
// onTheme(function). Without scripts everything in `body` is read as it stands.
std::string DrawShell(const PageShell& shell);

// Whether DrawShell() has Plotly to embed.
bool PlotlyIsEmbedded();

// JSON as it may stand within <script>, whatever names it holds.
std::string ScriptSafe(std::string_view json);

// gzip, the same bytes for the same text; and bytes as text.
std::string Gzipped(std::string_view text);
std::string Base64(std::string_view bytes);

}  // namespace lyrefit
