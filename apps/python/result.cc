#include "result.h"

#include "bindings.h"
#include "errors.h"
#include "keywords.h"
#include "lyrefit/base/file.h"
#include "lyrefit/report/page.h"
#include "work.h"

namespace lyrefit::python {
namespace {

constexpr char kResultDoc[] =
    "What a verb found: a mapping with the keys of the command's JSON.\n\n"
    "``result['rmse']['refined']['solved_current_A']`` reads a number; numbers that are not known\n"
    "are None. ``data/schema`` has a JSON schema of each.\n";

std::string HtmlOf(const Result& result) {
  return Unlocked([&] { return DrawHtml(result.record().document()); });
}

void SavePage(const Result& result, py::handle file, bool interactive) {
  const std::string path = TextOf("file", file);
  Must(Unlocked([&] {
    PageOptions options;
    options.interactive = interactive;
    return WriteTextFile(path, DrawPage(result.record().document(), result.FullJson(), options));
  }));
}

// One line, for the interactive prompt.
std::string Describe(const Result& result) {
  std::string brief = result.record().brief();
  while (!brief.empty() && brief.back() == '\n') brief.pop_back();
  return "<lyrefit " + brief + ">";
}

constexpr char kSavePlotDoc[] =
    "save_plot($self, file, kind='plot')\n--\n\n"
    "Draw the picture (--plot) into a file.\n\n"
    "Parameters\n----------\n"
    "file : path\n"
    "    FILE.svg, FILE.png or, for a paper, FILE.pdf. gnuplot draws it.\n"
    "kind : str\n"
    "    ``'plot'``; of compare() also ``'convergence'``: the median of the best RMSE so far above "
    "the\n"
    "    reference, over evaluations, of every search, your own among them "
    "(--convergence-plot).\n\n"
    "Raises\n------\n"
    "lyrefit.Error\n"
    "    Another ending, a kind that this result has not, no gnuplot, a file that cannot be "
    "written.\n";

void SavePlot(const Result& result, py::handle file, const std::string& kind) {
  const std::string path = TextOf("file", file);
  if (kind != "plot" && kind != "convergence") {
    Raise({"kind: expected 'plot' or 'convergence', found '" + kind + "'", {}});
  }
  const Record::Plot& draw = kind == "plot" ? result.record().plot : result.record().convergence;
  if (!draw) {
    Raise({kind == "plot" ? "there is no picture of this"
                          : "kind: only a result of compare() has a convergence picture",
           path});
  }
  Must(Unlocked([&] { return draw(path); }));
}

}  // namespace

const std::string& Result::Json() const {
  if (json_.empty()) json_ = record_.json(JsonPoints::kThinned);
  return json_;
}

const py::dict& Result::Dictionary() const {
  if (!dictionary_) dictionary_ = py::module_::import("lyrefit._former").attr("loads")(Json());
  return static_cast<const py::dict&>(dictionary_);
}

void BindResult(py::module_* module) {
  const auto words = [](const Result& result) { return result.Dictionary(); };
  py::class_<Result> type(*module, "Result", kResultDoc);
  NeverChanges(&type, "to_dict() or json");
  type.def("__getitem__",
           [words](const Result& r, py::handle key) { return py::object(words(r)[key]); })
      .def("__iter__", [words](const Result& r) { return py::iter(words(r)); })
      .def("__len__", [words](const Result& r) { return py::len(words(r)); })
      .def("__contains__", [words](const Result& r, py::handle k) { return words(r).contains(k); })
      .def(
          "keys", [words](const Result& r) { return words(r).attr("keys")(); },
          "keys($self)\n--\n\nOf the JSON.")
      .def(
          "values", [words](const Result& r) { return words(r).attr("values")(); },
          "values($self)\n--\n\nOf the JSON.")
      .def(
          "items", [words](const Result& r) { return words(r).attr("items")(); },
          "items($self)\n--\n\nOf the JSON.")
      .def(
          "get",
          [words](const Result& r, py::handle key, py::handle otherwise) {
            return words(r).attr("get")(key, otherwise);
          },
          py::arg("key"), py::arg("default") = py::none(),
          "get($self, key, default=None)\n--\n\nWhat stands under `key`, or `default`.")
      .def(
          "to_dict",
          [](const Result& r) { return py::module_::import("json").attr("loads")(r.Json()); },
          "to_dict($self)\n--\n\nThe whole of it, as json.loads reads it.")
      .def_property_readonly("json", &Result::Json,
                             "str: what the command writes under --json, byte for byte.")
      .def_property_readonly("full_json", &Result::FullJson,
                             "str: the same with every reading (--full-json).")
      .def_property_readonly(
          "text", [](const Result& r) { return r.record().text(Length::kShort); },
          "str: the report as the command prints it.")
      .def_property_readonly(
          "full_text", [](const Result& r) { return r.record().text(Length::kWhole); },
          "str: the whole report (--verbose).")
      .def_property_readonly(
          "brief", [](const Result& r) { return r.record().brief(); }, "str: the same in short.")
      .def("save_page", &SavePage, py::arg("file"), py::arg("interactive") = true,
           "save_page($self, file, interactive=True)\n--\n\n"
           "Write the report as a page to send (--html): pictures, tables and data in one file.")
      .def("save_plot", &SavePlot, py::arg("file"), py::arg("kind") = "plot", kSavePlotDoc)
      .def("_repr_html_", &HtmlOf)
      .def("_ipython_key_completions_", [words](const Result& r) { return py::list(words(r)); })
      .def("__repr__", &Describe)
      .def("__str__", [](const Result& r) { return r.record().text(Length::kShort); });
}

}  // namespace lyrefit::python
