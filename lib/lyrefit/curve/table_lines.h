#pragma once

#include <csv.h>

#include <string>
#include <string_view>
#include <vector>

namespace lyrefit {

// Whether a line that begins with this character is a comment.
constexpr bool BeginsComment(char c) { return c == '#' || c == '%'; }

// The lines of a text, counted from 1; ends of line may be LF, CRLF or, without any LF, CR.
class LineReader {
 public:
  // From `offset`, behind `lines_before` lines.
  explicit LineReader(std::string_view text, std::size_t offset = 0, int lines_before = 0);

  // The next line without its end; false at the end of the text.
  bool Next(std::string_view* line);

  // The next line that is neither blank nor a comment ('#' or '%').
  bool NextContent(std::string_view* line);

  // The same; `offset` becomes where it began.
  bool NextContent(std::string_view* line, std::size_t* offset);

  // So that the line returned last, which began at `offset`, comes again.
  void StepBack(std::size_t offset) {
    at_ = offset;
    --number_;
  }

  int number() const { return number_; }  // of the line returned last
  std::size_t offset() const { return at_; }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  int number_ = 0;
  char end_ = '\n';
};

// Splits single lines at one delimiter with libcsv, which takes care of quotes and blanks around
// the fields. With ' ' any run of blanks and tabs separates.
class LineSplitter {
 public:
  explicit LineSplitter(char delimiter);
  ~LineSplitter();
  LineSplitter(const LineSplitter&) = delete;
  LineSplitter& operator=(const LineSplitter&) = delete;

  // False if the quotes do not close. The fields live until the next call.
  bool Split(std::string_view line);

  std::size_t size() const { return ends_.size(); }
  std::string_view operator[](std::size_t i) const;

 private:
  static void TakeField(void* text, std::size_t length, void* self);

  char delimiter_;
  csv_parser parser_;
  std::string line_;     // in libcsv's form
  std::string content_;  // all fields, one behind the other
  std::vector<std::size_t> ends_;
};

// Where field `index` of `line` begins, counted from 1 in bytes.
int FieldColumn(std::string_view line, char delimiter, std::size_t index);

}  // namespace lyrefit
