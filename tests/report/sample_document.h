#pragma once

#include "lyrefit/report/document.h"

namespace lyrefit {

// Every kind of block, with text that contains markup of Markdown and HTML.
inline Document HostileDocument() {
  Document document;
  document.banners = {"DOUBTFUL: is <b>this</b> a *curve*?"};
  document.head.heading = "report of </title><script>alert(\"1 & 2\")</script>";
  AddField("curve", "a_b_c.csv & 'others'", &document.head);
  AddField("", "and one more", &document.head);
  Section section = {"1. Results | <i>of</i> all"};
  AddField("size", "3 V", &section);
  AddTable({"lrw",
            {{"", "RMSE", ""}, {"name", "A", "`why`"}},
            {{"<td>|</td>", "1", "first"}, {"second\nline"}}},
           &section);
  AddSentence("# 1 of 2 [links](http://x) at $3 ~ \\ 4 \x01", &section);
  AddList({"- one", "2. two"}, &section);
  AddTable({"lr", {{"", "A"}}, {{"x", "1"}, {"y", "2"}}, "of <a>", {{0, "*first*"}, {1, "& last"}}},
           &section);
  section.blocks.push_back(block::Legend{"* <star>"});
  section.blocks.push_back(block::Warning{"<!"});
  section.blocks.push_back(block::Entry{"a_b & c", {"x < y", "- z"}});
  section.blocks.push_back(block::Entry{"alone"});
  section.blocks.push_back(block::Preformatted{"a   <b>\n```\n"});
  section.blocks.push_back(block::Figure{"seen \"there\"", "a.svg"});
  section.blocks.push_back(block::Figure{"current & voltage"});
  section.blocks.push_back(block::Conclusion{"all < well"});
  AddSections({section, {"empty"}, {"below", {block::Sentence{"deeper"}}, 1}}, &document);
  return document;
}

}  // namespace lyrefit
