// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// A publication, as an entry of BibTeX. A field that no source at hand states is empty.
struct Publication {
  const char* key;   // of the entry
  const char* type;  // "article", "inproceedings", "techreport", "software" or "misc" (a standard)
  const char*
      author;         // as BibTeX has authors: "Storn, R. and Price, K."; "others" for further ones
  const char* title;  // without its final full stop
  const char* in;     // the journal, the conference, the institution or the number of a standard
  const char* year;   // of publication
  const char* volume;  // of the journal
  const char* number;  // of the issue
  const char* pages;   // "341--359", or the number of an article
  const char* doi;     // without "doi:"
  // What makes a report use it, separated by blanks: KEY, a key of its JSON that says something, or
  // KEY=VALUE, one with this text. A VALUE may end in *. Empty: only effects name it.
  const char* used;
};

// The table of all references, in the order of reports.
const std::vector<Publication>& Publications();

// The reference with this key, nullptr if there is none.
const Publication* FindPublication(const std::string& key);

// The references that a text names: keys, each with a remark or none, such as "desoto2006 (linear);
// mermoud2010". Effects have such a text (Effect::reference). Other words name none.
std::vector<const Publication*> PublicationsIn(const std::string& text);

// The text with its keys as one cites: "De Soto, Klein and Beckman 2006, doi:10.1016/... (linear)".
std::string ReferenceText(const std::string& text);

// The entry in BibTeX, below a line "% missing: ..." where fields are empty that one expects.
std::string BibTeX(const Publication& reference);

}  // namespace lyrefit
