#include "about.h"
#include "lyrefit/base/address.h"
#include "verbs.h"

namespace lyrefit {
namespace {

// A user's question and the verbs that answer it.
struct Answer {
  const char* verb;
  const char* does;
  const char* example;
};
struct Question {
  const char* question;
  std::vector<Answer> answers;
};

const std::vector<Question>& Questions() {
  static const std::vector<Question> questions = {
      {"What does my file hold?",
       {{"inspect", "columns, units, curves, what is missing and which flag says it",
         "lyrefit inspect module.csv"}}},
      {"What are the parameters of my cell or module?",
       {{"fit", "from a measured curve", "lyrefit fit module.csv --cells 60 --temperature-C 45"},
        {"datasheet", "from what its data sheet prints",
         "lyrefit datasheet --isc 9.05 --voc 37.8 --imp 8.58 --vmp 30.3 \\\n"
         "                   --alpha 0.06% --beta -0.31% --cells 60"}}},
      {"Can I trust them?",
       {{"certify", "is there a better fit than this? a proof",
         "lyrefit certify module.csv --cells 60 --temperature-C 45"}}},
      {"What is wrong with this curve?",
       {{"diagnose", "shading, series resistance, a bad sensor, ...: what, how large, how sure",
         "lyrefit diagnose sweep.csv --cells 60 --temperature-C 45 --plot diagnosis.svg"}}},
      {"What is my laboratory cell like?",
       {{"cell", "up and down, lit and dark, lights, Suns-Voc: efficiency, hysteresis, losses",
         "lyrefit cell up_down.csv dark.csv suns_voc.csv --area-cm2 0.16 --html cell.html"}}},
      {"What would it deliver elsewhere?",
       {{"translate", "this curve at standard conditions: +- how much, pass or fail",
         "lyrefit translate string07.csv --to 1000,25 --rated-W 300 --modules 12"},
        {"fit", "one device behind curves at many irradiances and temperatures",
         "lyrefit fit folder_of_curves --family desoto --pvlib module.json"},
        {"simulate", "the curve of a device, with its faults and noise",
         "lyrefit simulate --from fit.json --with shading:d=0.3,w=0.3333 --out shaded.csv"}}},
      {"What of a whole plant?",
       {{"batch", "a row a string: fitted, diagnosed or tested against its rating and neighbours",
         "lyrefit batch plant_folder --task field-test --module module.json \\\n"
         "                   --out results --html plant.html"},
        {"pack", "thousands of curves, in whatever shape, as one curve a row",
         "lyrefit pack plant/ --out plant.jsonl"},
        {"merge", "the results of its shards, done on several machines",
         "lyrefit merge shards --out results"}}},
      {"Which algorithm should I use?",
       {{"compare", "many runs of each, with tests of which is better",
         "lyrefit compare data/rtc_france --runs 50"}}},
      {"Does a published table hold?",
       {{"audit", "does the claimed RMSE come out of the printed parameters?",
         "lyrefit audit data/paper/rows.csv"}}},
      {"What do I cite?",
       {{"cite", "BibTeX of what a report used: software, methods, standards",
         "lyrefit cite report.json > methods.bib"}}},
  };
  return questions;
}

}  // namespace

std::string Whereabouts() {
  const Addresses& at = PublishedAt();
  if (*at.base == '\0') {
    return "No address is published: in a clone of the sources cmake/site.sh makes the manual, and "
           "README.md\nis where it begins.";
  }
  std::string text = std::string("Published at ") + at.base;
  if (*at.site != '\0') text += std::string("\nManual: ") + at.site;
  if (*at.tracker != '\0') text += std::string("\nQuestions and mistakes: ") + at.tracker;
  return text;
}

std::string FirstPage() {
  std::string text = "lyrefit: diode-model parameters from measured photovoltaic I-V curves\n";
  for (const Question& question : Questions()) {
    text += std::string("\n") + question.question + "\n";
    for (const Answer& answer : question.answers) {
      text += "  " + std::string(answer.verb) +
              std::string(13 - std::string(answer.verb).size(), ' ') + answer.does + "\n" +
              std::string(15, ' ') + answer.example + "\n";
    }
  }
  return text +
         "\nlyrefit --help lists the verbs, lyrefit VERB --help every flag of one.\n"
         "lyrefit help terms says what the words in reports mean.\n"
         "lyrefit completion bash|zsh|fish and lyrefit man write what their names say.\n" +
         Whereabouts() + "\n" + kLeftOut;
}

}  // namespace lyrefit
