#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "lyrefit/report/document.h"
#include "lyrefit/report/readable.h"

// How a document becomes elements of a page, for who draws pages of it.
namespace lyrefit {

// What HTML reads as its own is spelled out; what no page may hold becomes U+FFFD.
std::string HtmlEscaped(const std::string& text);

// The same of lines, whose ends and blanks stay.
std::string HtmlLines(const std::string& lines);

// "<tag>text</tag>", the text escaped.
std::string HtmlElement(const std::string& tag, const std::string& text);

struct HtmlLooks {
  bool boxes = false;  // tables in boxes that scroll, which a keyboard can reach
  // What stands for a picture; without it its file, or the caption alone.
  std::function<std::string(const block::Figure&)> figure = {};
};

std::string HtmlTable(const block::Table& table, const HtmlLooks& looks);

// What stands in a section, below its heading.
std::string HtmlBlocks(const std::vector<block::Any>& blocks, const HtmlLooks& looks);

// With its heading. `id`, if any, is what links name it by.
std::string HtmlSection(const Section& section, const HtmlLooks& looks, const std::string& id);

}  // namespace lyrefit
