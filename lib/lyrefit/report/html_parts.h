#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "lyrefit/report/document.h"
#include "lyrefit/report/readable.h"

// Conversion of a document to HTML elements, for functions that draw pages.
namespace lyrefit {

// Escapes characters with a meaning in HTML; characters that are illegal in a page become U+FFFD.
std::string HtmlEscaped(const std::string& text);

// Escapes lines as HtmlEscaped does and keeps line ends and blanks.
std::string HtmlLines(const std::string& lines);

// "<tag>text</tag>" with the text escaped.
std::string HtmlElement(const std::string& tag, const std::string& text);

struct HtmlLooks {
  bool boxes = false;  // tables in scrolling boxes that the keyboard can focus
  // The element of a picture; without it the picture's file, or the caption alone.
  std::function<std::string(const block::Figure&)> figure = {};
  // The element of a table of many rows; without it nothing.
  std::function<std::string(const block::LongTable&)> long_table = {};
};

std::string HtmlTable(const block::Table& table, const HtmlLooks& looks);

// The content of a section, below its heading.
std::string HtmlBlocks(const std::vector<block::Any>& blocks, const HtmlLooks& looks);

// A section with its heading. `id` is its target for links; it may be empty.
std::string HtmlSection(const Section& section, const HtmlLooks& looks, const std::string& id);

}  // namespace lyrefit
