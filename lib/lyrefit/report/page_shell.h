#pragma once
// The common frame of all pages: one HTML file without network access, for light and dark, phones
// and paper, keyboard and screen reader. The caller supplies the content.

#include <zlib.h>

#include <string>
#include <string_view>
#include <vector>

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
  bool table = false;   // embed Tabulator and the script of the table of many rows, if installed
};

// Start of the element for the rows of a table of many rows, in a page with `table`. Compressed CSV
// (PackedText) belongs right behind it; no other text of a page contains it.
constexpr char kRowsElement[] = "<script type=\"application/gzip\" id=\"rows\">";

// Draws the page. Scripts find the functions of page.js in `lyrefit`: data(id), bytes(id), text(id),
// plotly(), tabulator(), colour(hex), onTheme(function). `body` must be readable without scripts.
std::string DrawShell(const PageShell& shell);

// Whether this build has Plotly and Tabulator to embed.
bool PlotlyIsEmbedded();
bool TabulatorIsEmbedded();

// JSON that is safe within <script>, whatever its strings contain.
std::string ScriptSafe(std::string_view json);

// Compresses a text that comes in parts: gzip in base64, with equal results for equal texts.
class PackedText {
 public:
  PackedText();
  ~PackedText() { deflateEnd(&stream_); }
  PackedText(const PackedText&) = delete;
  PackedText& operator=(const PackedText&) = delete;

  // The next part of the result, which may be empty.
  std::string Add(std::string_view text) { return Pack(text, Z_NO_FLUSH); }
  std::string End() { return Pack({}, Z_FINISH); }

 private:
  std::string Pack(std::string_view text, int flush);

  z_stream stream_ = {};
  std::string waiting_;  // less than three bytes, which base64 writes together
};

// A whole text, and bytes as base64 text.
std::string Packed(std::string_view text);
std::string Base64(std::string_view bytes);

// Files that pages embed, from `assets/` and from the build machine. The source is written by
// cmake/EmbedAssets.cmake.
std::string_view PageStyle();
std::string_view PageScript();
std::string_view TableScript();

// Plotly's basic bundle, gzipped; empty if it was not installed at build time.
std::string_view PackedPlotly();
std::string_view PlotlyLicence();

// Tabulator, gzipped; empty if it was not installed at build time.
std::string_view PackedTabulator();
std::string_view PackedTabulatorStyle();
std::string_view TabulatorLicence();

}  // namespace lyrefit
