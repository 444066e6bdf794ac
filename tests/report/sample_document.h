#pragma once

#include "lyrefit/report/document.h"

namespace lyrefit {

// Every kind of block, and names that mean something to Markdown and HTML.
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
  section.blocks.push_back(block::Preformatted{"a   <b>"});
  section.blocks.push_back(block::Figure{"current & voltage"});
  section.blocks.push_back(block::Conclusion{"all < well"});
  AddSections({section, {"empty"}, {"below", {block::Sentence{"deeper"}}, 1}}, &document);
  return document;
}

}  // namespace lyrefit
